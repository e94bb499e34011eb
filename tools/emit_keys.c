// Writes a JSON Schema that is made from the tables of keys (app/settings/keys.h) to standard output:
//     emit_keys settings|bounds
// The target `emitted` writes both to where they are committed.
#include "app/settings/key_schema.h"

#include <stdio.h>
#include <string.h>

int main(int count, char **arguments) {
    struct strbuf out;
    bool settings = count == 2 && strcmp(arguments[1], "settings") == 0;
    if (!settings && !(count == 2 && strcmp(arguments[1], "bounds") == 0)) {
        fprintf(stderr, "usage: emit_keys settings|bounds\n");
        return 2;
    }
    strbuf_init(&out);
    (settings ? key_schema_settings : key_schema_bounds)(&out);
    bool failed = out.failed || fwrite(out.data, 1, out.len, stdout) != out.len;
    strbuf_finish(&out);
    return fflush(stdout) != 0 || failed ? 3 : 0;
}
