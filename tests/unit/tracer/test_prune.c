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
#include <string.h>

#include <cmocka.h>

enum {
    HEADER_WORDS = 5,
};

struct module {
    uint32_t *words;
    size_t count;
};

static void prune(struct module *module, uint64_t features) {
    const uint32_t constants[CONSTANT_COUNT] = {[CONSTANT_FEATURES] = (uint32_t)features,
                                                [CONSTANT_MORE_FEATURES] = (uint32_t)(features >> 32),
                                                [CONSTANT_TRIANGLE_STACK] = 8,
                                                [CONSTANT_SPHERE_STACK] = 1,
                                                [CONSTANT_PACKED_GROUPS] = 1,
                                                [CONSTANT_WORKGROUP] = 64,
                                                [CONSTANT_BRANCHES] = 1};
    const struct gpu_program_source source = {.constants = constants, .constant_count = CONSTANT_COUNT};
    assert_true(gpu_prune(&source, module->words, &module->count));
}

static struct module pruned(const struct kernel *kernel, uint64_t features) {
    struct module module = {kernel_inflate(kernel), kernel->words};
    assert_non_null(module.words);
    prune(&module, features);
    return module;
}

// A pruned module has one form: with its constants in it, whatever they are said to be, it stays as it is.
static void check_form(const struct module *module) {
    struct module again = {malloc(module->count * sizeof *again.words), module->count};
    assert_non_null(again.words);
    memcpy(again.words, module->words, module->count * sizeof *again.words);
    prune(&again, 0);
    assert_int_equal(again.count, module->count);
    assert_memory_equal(again.words, module->words, module->count * sizeof *again.words);
    free(again.words);
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
            check_form(&without);
            check_form(&alone);
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

#define WORDS(length, opcode, ...) (length) << 16 | Spv##opcode, __VA_ARGS__

enum {
    VOID = 1,
    MAIN_TYPE,
    UINT,
    LOCAL,
    TYPE,
    BOOL,
    ZERO,
    BLOCK,
    BLOCKS,
    BUFFER,
    PLACES,
    MAIN,
    ENTRY,
    VARIABLE,
    CALL,
    FUNCTION,
    PARAMETER,
    FIRST,
    FROM,
    READ,
    IS,
    THEN,
    LAST,
    HAS,
    OWN,
    HELD,
    BOUND,
};
static const uint32_t stored_once[] = {
    SpvMagicNumber,
    0x10300,
    0,
    BOUND,
    0,
    WORDS(2, OpCapability, SpvCapabilityShader),
    WORDS(3, OpMemoryModel, SpvAddressingModelLogical, SpvMemoryModelGLSL450),
    WORDS(4, OpEntryPoint, SpvExecutionModelGLCompute, MAIN, 'm'),
    WORDS(2, OpTypeVoid, VOID),
    WORDS(3, OpTypeFunction, MAIN_TYPE, VOID),
    WORDS(4, OpTypeInt, UINT, 32, 0),
    WORDS(4, OpTypePointer, LOCAL, SpvStorageClassFunction, UINT),
    WORDS(4, OpTypeFunction, TYPE, VOID, LOCAL),
    WORDS(2, OpTypeBool, BOOL),
    WORDS(4, OpConstant, UINT, ZERO, 0),
    WORDS(3, OpTypeStruct, BLOCK, UINT),
    WORDS(4, OpTypePointer, BLOCKS, SpvStorageClassStorageBuffer, BLOCK),
    WORDS(4, OpVariable, BLOCKS, BUFFER, SpvStorageClassStorageBuffer),
    WORDS(4, OpTypePointer, PLACES, SpvStorageClassStorageBuffer, UINT),
    WORDS(5, OpFunction, VOID, MAIN, 0, MAIN_TYPE),
    WORDS(2, OpLabel, ENTRY),
    WORDS(4, OpVariable, LOCAL, VARIABLE, SpvStorageClassFunction),
    WORDS(5, OpFunctionCall, VOID, CALL, FUNCTION, VARIABLE),
    1 << 16 | SpvOpReturn,
    1 << 16 | SpvOpFunctionEnd,
    WORDS(5, OpFunction, VOID, FUNCTION, 0, TYPE),
    WORDS(3, OpFunctionParameter, LOCAL, PARAMETER),
    WORDS(2, OpLabel, FIRST),
    WORDS(4, OpVariable, LOCAL, OWN, SpvStorageClassFunction),
    WORDS(5, OpAccessChain, PLACES, FROM, BUFFER, ZERO),
    WORDS(4, OpLoad, UINT, READ, FROM),
    WORDS(5, OpIEqual, BOOL, IS, READ, ZERO),
    WORDS(3, OpStore, OWN, ZERO),
    WORDS(3, OpSelectionMerge, LAST, 0),
    WORDS(4, OpBranchConditional, IS, THEN, LAST),
    WORDS(2, OpLabel, THEN),
    WORDS(3, OpStore, PARAMETER, ZERO),
    WORDS(2, OpBranch, LAST),
    WORDS(2, OpLabel, LAST),
    WORDS(4, OpLoad, UINT, HAS, PARAMETER),
    WORDS(3, OpStore, FROM, HAS),
    WORDS(4, OpLoad, UINT, HELD, OWN),
    WORDS(3, OpStore, FROM, HELD),
    1 << 16 | SpvOpReturn,
    1 << 16 | SpvOpFunctionEnd};

// What is stored once into a parameter is not all that it can hold; into a variable of the function it is.
static void test_stored_once(void **state) {
    (void)state;
    uint32_t words[sizeof stored_once / sizeof *stored_once];
    memcpy(words, stored_once, sizeof stored_once);
    struct module module = {words, sizeof words / sizeof *words};
    prune(&module, 0);
    int loads = 0, stores = 0;
    for (size_t at = HEADER_WORDS; at < module.count; at += module.words[at] >> 16) {
        loads += (module.words[at] & 0xffff) == SpvOpLoad;
        stores += (module.words[at] & 0xffff) == SpvOpStore;
    }
    assert_int_equal(loads, 2);
    assert_int_equal(stores, 3);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_each_feature),
                                       cmocka_unit_test(test_what_is_left),
                                       cmocka_unit_test(test_stored_once)};
    return cmocka_run_group_tests_name("prune", tests, NULL, NULL);
}
