// The embedded SPIR-V: no operation that a driver may fuse, none whose order of rounding it may choose.
// Reference: SPIR-V Specification 1.6, section 3; GLSL.std.450 extended instructions.
#include "shaders/kernels.h"
#include "tests/kernels/kernels.h"

#include <setjmp.h>
#include <spirv/unified1/spirv.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum {
    HEADER_WORDS = 5,
};

struct module {
    const char *name;
    const uint32_t *words;
    size_t count;
};

static bool must_be_decorated(uint32_t opcode) {
    static const uint32_t opcodes[] = {SpvOpFNegate, SpvOpFAdd, SpvOpFSub, SpvOpFMul,
                                       SpvOpFDiv,    SpvOpFRem, SpvOpFMod, SpvOpVectorTimesScalar};
    for (size_t i = 0; i < sizeof opcodes / sizeof *opcodes; i++)
        if (opcodes[i] == opcode)
            return true;
    return false;
}

// MatrixTimesScalar .. OuterProduct, Dot
static bool is_reordered(uint32_t opcode) {
    return opcode >= 143 && opcode <= 148;
}

// FMix, Length, Distance, Cross, Normalize, FaceForward, Reflect, Refract; Pow and the angles, whose
// errors the specification hardly bounds.
static bool is_loose_call(uint32_t number) {
    static const uint32_t numbers[] = {46, 66, 67, 68, 69, 70, 71, 72, 26, 16, 17, 18, 25};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (numbers[i] == number)
            return true;
    return false;
}

// How many operations of a module break the rules; says which where `tell`.
static int faults_of(const struct module *module, bool tell) {
    bool *decorated = calloc(module->words[3], sizeof *decorated);
    int faults = 0;
    for (size_t at = HEADER_WORDS; at < module->count; at += module->words[at] >> 16) {
        const uint32_t *word = module->words + at, opcode = word[0] & 0xffff;
        if (opcode == SpvOpDecorate && word[2] == SpvDecorationNoContraction)
            decorated[word[1]] = true;
        const bool fault = (must_be_decorated(opcode) && !decorated[word[2]]) || is_reordered(opcode) ||
                           (opcode == SpvOpExtInst && is_loose_call(word[4]));
        if (fault && tell)
            fprintf(stderr, "%s: word %zu: opcode %u\n", module->name, at, (unsigned)opcode);
        faults += fault;
    }
    free(decorated);
    return faults;
}

// How often a module asks for it; more than once is not allowed.
static int preserves_nan(const struct module *module, uint32_t bits) {
    int count = 0;
    for (size_t at = HEADER_WORDS; at < module->count; at += module->words[at] >> 16)
        count += (module->words[at] & 0xffff) == SpvOpExecutionMode &&
                 module->words[at + 2] == SpvExecutionModeSignedZeroInfNanPreserve &&
                 module->words[at + 3] == bits;
    return count;
}

// Whether it may compute with doubles.
static bool has_doubles(const struct module *module) {
    for (size_t at = HEADER_WORDS; at < module->count; at += module->words[at] >> 16)
        if ((module->words[at] & 0xffff) == SpvOpCapability && module->words[at + 1] == SpvCapabilityFloat64)
            return true;
    return false;
}

// How many values of a type of doubles are computed: that the module traces in double precision at all.
static int count_doubles(const struct module *module) {
    bool *is_double = calloc(module->words[3], sizeof *is_double); // types by id
    int count = 0;
    for (size_t at = HEADER_WORDS; at < module->count; at += module->words[at] >> 16) {
        const uint32_t *word = module->words + at, opcode = word[0] & 0xffff;
        if (opcode == SpvOpTypeFloat)
            is_double[word[1]] = word[2] == 64;
        if (opcode == SpvOpTypeVector)
            is_double[word[1]] = is_double[word[2]];
        count += must_be_decorated(opcode) && is_double[word[1]];
    }
    free(is_double);
    return count;
}

// How many parameters are pointers that the function only loads from: glslang passes a struct so, and
// lavapipe's compiler pays for each of its members.
static int count_read_pointers(const struct module *module) {
    const uint32_t bound = module->words[3];
    bool *is_pointer = calloc(bound, sizeof *is_pointer); // types by id
    bool *is_read = calloc(bound, sizeof *is_read), *is_used = calloc(bound, sizeof *is_used);
    int count = 0;
    for (size_t at = HEADER_WORDS; at < module->count; at += module->words[at] >> 16) {
        const uint32_t *word = module->words + at, opcode = word[0] & 0xffff, length = word[0] >> 16;
        if (opcode == SpvOpTypePointer)
            is_pointer[word[1]] = word[2] == SpvStorageClassFunction;
        if (opcode == SpvOpLoad && word[3] < bound)
            is_read[word[3]] = true;
        for (uint32_t i = 1; i < length && opcode > SpvOpFunctionParameter && opcode != SpvOpLoad; i++)
            if (word[i] < bound)
                is_used[word[i]] = true;
    }
    for (size_t at = HEADER_WORDS; at < module->count; at += module->words[at] >> 16) {
        const uint32_t *word = module->words + at;
        count += (word[0] & 0xffff) == SpvOpFunctionParameter && is_pointer[word[1]] && is_read[word[2]] &&
                 !is_used[word[2]];
    }
    free(is_pointer);
    free(is_read);
    free(is_used);
    return count;
}

static void check_module(const struct module *module) {
    const bool is_double = strstr(module->name, "64"), may_fuse = strstr(module->name, "_fused_");
    const bool traces = !strstr(module->name, "layout") && !strstr(module->name, "resolve");
    // In single precision too where a device has them: for what rounding leaves open.
    const bool has_wide =
        traces && !may_fuse && !strstr(module->name, "_pairs_") && !strstr(module->name, "_alternative_");
    const int doubles = count_doubles(module);
    assert_int_equal(module->words[0], SpvMagicNumber);
    assert_int_equal(faults_of(module, !may_fuse) > 0, may_fuse);
    assert_int_equal(preserves_nan(module, 32), 1);
    assert_int_equal(preserves_nan(module, 64), has_doubles(module));
    assert_true(has_doubles(module) || !(is_double || has_wide));
    assert_true(!traces || !has_doubles(module) || is_double || has_wide);
    assert_int_equal(doubles > 0, has_wide);
    assert_int_equal(doubles > 100, is_double && traces);
    if (traces)
        assert_int_equal(count_read_pointers(module) == 0, strstr(module->name, "_texels") != NULL);
}

// Each kernel that the build makes: BUILT_KERNELS is KERNEL(name) of all of them.
#define KERNEL(name) {#name, &kernel_##name},
static const struct {
    const char *name;
    const struct kernel *kernel;
} kernels[] = {BUILT_KERNELS};
#undef KERNEL

// Those whose operations may
// be fused carry no decoration, those for the layout of records compute nothing, and resolving only adds
// floats.
static void test_kernels(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++) {
        uint32_t *words = kernel_inflate(kernels[i].kernel);
        assert_non_null(words);
        const struct module module = {kernels[i].name, words, kernels[i].kernel->words};
        check_module(&module);
        free(words);
    }
}

// The module that the build made of this name; NULL: none.
static FILE *open_module(const char *name) {
    static const char *const folders[] = {KERNEL_FOLDERS};
    FILE *file = NULL;
    for (size_t i = 0; !file && i < sizeof folders / sizeof *folders; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s.spv", folders[i], name);
        file = fopen(path, "rb");
    }
    return file;
}

// Packing loses no word: each kernel is what was compiled, decorated and validated.
static void test_nothing_is_lost(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++) {
        const size_t count = kernels[i].kernel->words;
        uint32_t *words = kernel_inflate(kernels[i].kernel),
                 *compiled = malloc((count + 1) * sizeof *compiled);
        FILE *file = open_module(kernels[i].name);
        assert_non_null(words);
        assert_non_null(file);
        assert_int_equal(fread(compiled, sizeof *compiled, count + 1, file), count);
        assert_memory_equal(words, compiled, count * sizeof *compiled);
        fclose(file);
        free(words);
        free(compiled);
    }
}

// A module that is not whole is none.
static void test_broken_kernel(void **state) {
    (void)state;
    struct kernel kernel = kernel_trace_texels;
    kernel.own.deflated_bytes--;
    assert_null(kernel_inflate(&kernel));
    kernel = kernel_trace_texels;
    kernel.packed_words++;
    assert_null(kernel_inflate(&kernel));
    kernel.packed_words -= 2;
    assert_null(kernel_inflate(&kernel));
    kernel = kernel_trace_texels;
    kernel.group_count--;
    assert_null(kernel_inflate(&kernel));
    kernel = kernel_trace_texels;
    kernel.words++;
    assert_null(kernel_inflate(&kernel));
    kernel.words -= 2;
    assert_null(kernel_inflate(&kernel));
}

// The check above can fail: without one decoration, and with a dot product in place of an addition.
static void test_faults_are_found(void **state) {
    (void)state;
    const size_t count = kernel_trace_texels.words;
    uint32_t *copy = kernel_inflate(&kernel_trace_texels);
    assert_non_null(copy);
    const struct module module = {"copy", copy, count};
    size_t decoration = 0, addition = 0;
    for (size_t at = HEADER_WORDS; at < count; at += copy[at] >> 16) {
        if ((copy[at] & 0xffff) == SpvOpDecorate && copy[at + 2] == SpvDecorationNoContraction)
            decoration = at;
        if ((copy[at] & 0xffff) == SpvOpFAdd)
            addition = at;
    }
    assert_true(decoration && addition);
    copy[decoration + 2] = 0;
    assert_int_equal(faults_of(&module, false), 1);
    copy[decoration + 2] = SpvDecorationNoContraction;
    copy[addition] = (copy[addition] & 0xffff0000u) | 148;
    assert_int_equal(faults_of(&module, false), 1);
    free(copy);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_kernels), cmocka_unit_test(test_nothing_is_lost),
                                       cmocka_unit_test(test_broken_kernel),
                                       cmocka_unit_test(test_faults_are_found)};
    return cmocka_run_group_tests_name("shaders", tests, NULL, NULL);
}
