// same_kernel MODULE.spv NUMBER OUT.spv: whether a module and the tracing kernel that ships are the same to
// the byte, once pruned for a scene with all features but the one of that number; OUT.spv becomes what ships,
// pruned. Exit codes: 0 yes, 1 no, 2 cannot say.
#include "shaders/features.h"
#include "shaders/frame.h"
#include "shaders/kernels.h"
#include "tools/spirv_exact/module.h"
#include "tracer/gpu/gpu_private.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv) {
    const unsigned long number = argc == 4 ? strtoul(argv[2], NULL, 10) : FEATURE_COUNT;
    size_t cut_words = 0, words = kernel_trace_storage.words;
    uint32_t *cut = number < FEATURE_COUNT ? module_read(argv[1], &cut_words) : NULL;
    uint32_t *whole = kernel_inflate(&kernel_trace_storage);
    if (!cut || !whole) {
        fputs("usage: same_kernel MODULE.spv NUMBER OUT.spv\n", stderr);
        return 2;
    }
    const uint64_t features = FEATURE_ALL & ~(UINT64_C(1) << number);
    const uint32_t constants[CONSTANT_COUNT] = {[CONSTANT_FEATURES] = (uint32_t)features,
                                                [CONSTANT_MORE_FEATURES] = (uint32_t)(features >> 32),
                                                [CONSTANT_TRIANGLE_STACK] = 8,
                                                [CONSTANT_SPHERE_STACK] = 8,
                                                [CONSTANT_WORKGROUP] = 64,
                                                [CONSTANT_AT_ONCE] = 1,
                                                [CONSTANT_BRANCHES] = 8};
    const struct gpu_program_source source = {.constants = constants, .constant_count = CONSTANT_COUNT};
    const bool pruned = gpu_prune(&source, cut, &cut_words) && gpu_prune(&source, whole, &words);
    const bool same = pruned && words == cut_words && memcmp(whole, cut, words * sizeof *cut) == 0;
    if (!same)
        printf("%zu words, %zu in the kernel that ships\n", cut_words, words);
    const bool wrote = pruned && module_write(argv[3], whole, words);
    free(cut);
    free(whole);
    return wrote ? !same : 2;
}
