// spirv_values IN.spv OUT.spv: functions of a module take by value what they only read (by_value.h). Exit
// codes: 0, or 1 with a line on stderr.
#include "tools/spirv_exact/by_value.h"
#include "tools/spirv_exact/module.h"

#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv) {
    size_t words = 0;
    if (argc != 3) {
        fprintf(stderr, "usage: spirv_values IN.spv OUT.spv\n");
        return 1;
    }
    uint32_t *module = module_read(argv[1], &words);
    uint32_t *lean = module ? by_value(module, &words) : NULL;
    if (module && !lean)
        fprintf(stderr, "%s:1:1: error: not enough memory\n", argv[1]);
    const bool ok = lean && module_write(argv[2], lean, words);
    free(module);
    free(lean);
    return ok ? 0 : 1;
}
