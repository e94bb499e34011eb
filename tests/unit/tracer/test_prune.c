// Kernels without what their constants switch off (tracer/gpu/gpu_prune.c): whole modules still, that compute
// each operation as before; how they draw, pictures tell. Reference: SPIR-V Specification 1.6, section 3.
#include "shaders/features.h"
#include "shaders/frame.h"
#include "shaders/kernels.h"
#include "tracer/gpu/gpu_private.h"

#include <setjmp.h>
#include <spirv/unified1/spirv.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

enum {
    HEADER_WORDS = 5,
};

struct module {
    uint32_t *words;
    size_t count;
};

static struct module pruned(const struct kernel *kernel, uint64_t features) {
    const uint32_t constants[CONSTANT_COUNT] = {[CONSTANT_FEATURES] = (uint32_t)features,
                                                [CONSTANT_MORE_FEATURES] = (uint32_t)(features >> 32),
                                                [CONSTANT_TRIANGLE_STACK] = 8,
                                                [CONSTANT_SPHERE_STACK] = 1,
                                                [CONSTANT_PACKED_GROUPS] = 1,
                                                [CONSTANT_WORKGROUP] = 64,
                                                [CONSTANT_BRANCHES] = 1};
    const struct gpu_program_source source = {
        .kernel = kernel, .constants = constants, .constant_count = CONSTANT_COUNT};
    struct module module = {kernel_inflate(kernel), kernel->words};
    assert_non_null(module.words);
    assert_true(gpu_prune(&source, module.words, &module.count));
    return module;
}

static void note(const struct module *module, bool *there, bool *exact) {
    for (size_t at = HEADER_WORDS; at < module->count; at += module->words[at] >> 16) {
        const uint32_t *i = module->words + at, opcode = i[0] & 0xffff;
        assert_true(i[0] >> 16 > 0 && at + (i[0] >> 16) <= module->count);
        if (opcode == SpvOpLabel)
            there[i[1]] = true;
        if (opcode == SpvOpFunction)
            there[i[2]] = true;
        if (opcode == SpvOpDecorate && i[2] == SpvDecorationNoContraction)
            exact[i[1]] = true;
    }
}

// What is named is there, and what is computed is decorated as it was.
static void check(const struct module *module) {
    bool *there = calloc(module->words[3], sizeof *there), *exact = calloc(module->words[3], sizeof *exact);
    note(module, there, exact);
    for (size_t at = HEADER_WORDS; at < module->count; at += module->words[at] >> 16) {
        const uint32_t *i = module->words + at, opcode = i[0] & 0xffff;
        if (opcode == SpvOpFunctionCall)
            assert_true(there[i[3]]);
        if (opcode == SpvOpBranch || opcode == SpvOpSelectionMerge)
            assert_true(there[i[1]]);
        if (opcode == SpvOpBranchConditional)
            assert_true(there[i[2]] && there[i[3]]);
        if (opcode == SpvOpFAdd || opcode == SpvOpFMul)
            assert_true(exact[i[2]]);
    }
    free(there);
    free(exact);
}

static const struct kernel *const kernels[] = {
    &kernel_trace_texels,    &kernel_trace64_texels, &kernel_hits_texels,
    &kernel_log64_texels,    &kernel_trace_storage,  &kernel_trace64_instances_texels,
    &kernel_trace64_storage, &kernel_hits_storage,   &kernel_log64_storage};

static void test_each_feature(void **state) {
    (void)state;
    for (size_t k = 0; k < sizeof kernels / sizeof *kernels; k++)
        for (uint32_t bit = 0; bit < FEATURE_COUNT; bit++) {
            const struct module without = pruned(kernels[k], FEATURE_ALL & ~(UINT64_C(1) << bit));
            const struct module alone = pruned(kernels[k], UINT64_C(1) << bit);
            check(&without);
            check(&alone);
            assert_true(alone.count < kernels[k]->words && without.count <= kernels[k]->words);
            free(without.words);
            free(alone.words);
        }
}

// A scene of spheres has half a kernel at most, and one without anything less still.
static void test_what_is_left(void **state) {
    (void)state;
    const struct module spheres = pruned(&kernel_trace_texels, FEATURE_SPHERES | FEATURE_DIFFUSE),
                        nothing = pruned(&kernel_trace_texels, 0);
    assert_in_range(spheres.count, 1, kernel_trace_texels.words / 2);
    assert_true(nothing.count < spheres.count);
    free(spheres.words);
    free(nothing.words);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_each_feature),
                                       cmocka_unit_test(test_what_is_left)};
    return cmocka_run_group_tests_name("prune", tests, NULL, NULL);
}
