// Writes one of the files that are made from the table to standard output:
//     glint_emit json|relaxng|rnc|markdown|limits|codes
// The target `emitted` writes all of them to where they are committed.
#include "grammar/emit/emit.h"

#include <stdio.h>
#include <string.h>

int main(int count, char **arguments) {
    static const struct {
        const char *name;
        void (*emit)(struct strbuf *out);
    } kinds[] = {
        {"json", emit_json_schema},  {"relaxng", emit_relaxng}, {"rnc", emit_relaxng_compact},
        {"markdown", emit_markdown}, {"limits", emit_limits},   {"codes", emit_codes},
    };
    for (size_t i = 0; count == 2 && i < sizeof kinds / sizeof kinds[0]; i++) {
        if (strcmp(arguments[1], kinds[i].name) != 0)
            continue;
        struct strbuf out;
        strbuf_init(&out);
        kinds[i].emit(&out);
        bool failed = out.failed || fwrite(out.data, 1, out.len, stdout) != out.len;
        strbuf_finish(&out);
        return fflush(stdout) != 0 || failed ? 3 : 0;
    }
    fprintf(stderr, "usage: glint_emit json|relaxng|rnc|markdown|limits|codes\n");
    return 2;
}
