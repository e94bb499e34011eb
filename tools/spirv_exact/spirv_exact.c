// spirv_exact IN.spv OUT.spv [plain]: decorates the operations of a module as shaders/packed/exact.h says;
// with `plain` none, for measuring what that saves and costs. Exit codes: 0, or 1 with a line on stderr.
#include "shaders/packed/exact.h"
#include "tools/spirv_exact/module.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv) {
    const bool plain = argc == 4 && strcmp(argv[3], "plain") == 0;
    if (argc != 3 && !plain) {
        fprintf(stderr, "usage: spirv_exact IN.spv OUT.spv [plain]\n");
        return 1;
    }
    size_t words = 0;
    uint32_t *module = module_read(argv[1], &words);
    if (!module)
        return 1;
    bool *done = calloc(module[3], sizeof *done);
    uint32_t *exact = malloc(EXACT_ROOM(words) * sizeof *exact);
    const bool ok =
        done && exact && module_write(argv[2], exact, exact_decorate(module, words, plain, done, exact));
    free(module);
    free(done);
    free(exact);
    return ok ? 0 : 1;
}
