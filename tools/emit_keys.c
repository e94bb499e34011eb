// Writes a JSON Schema that is made from the tables of keys (load/settings/keys.h) to standard output:
//     emit_keys settings|bounds|tests
// The target `emitted` writes them to where they are committed.
#include "load/settings/key_schema.h"

#include <stdio.h>
#include <string.h>

int main(int count, char **arguments) {
    struct strbuf out;
    static const struct {
        const char *name;
        void (*emit)(struct strbuf *out);
    } schemas[] = {
        {"settings", key_schema_settings}, {"bounds", key_schema_bounds}, {"tests", key_schema_tests}};
    size_t which = 0;
    while (which < 3 && !(count == 2 && strcmp(arguments[1], schemas[which].name) == 0))
        which++;
    if (which == 3) {
        fprintf(stderr, "usage: emit_keys settings|bounds|tests\n");
        return 2;
    }
    strbuf_init(&out);
    schemas[which].emit(&out);
    bool failed = out.failed || fwrite(out.data, 1, out.len, stdout) != out.len;
    strbuf_finish(&out);
    return fflush(stdout) != 0 || failed ? 3 : 0;
}
