// The GPU layer: choosing devices, buffers, dispatches, the layout of records, and doing without Vulkan.
#include "device_kit.h"
#include "shaders/frame.h"
#include "tests/kernels/kernels.h"
#include "tracer/gpu_records.h"

#include <dlfcn.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static bool hide_loader;

void *__real_dlopen(const char *path, int flags);
void *__wrap_dlopen(const char *path, int flags);
void *__wrap_dlopen(const char *path, int flags) {
    return hide_loader && path && strstr(path, "libvulkan") ? NULL : __real_dlopen(path, flags);
}

// ---- without Vulkan

static void test_no_loader(void **state) {
    (void)state;
    char error[GPU_ERROR_BYTES] = "";
    uint32_t count = 7;
    struct gpu_device_info info;
    struct gpu *gpu = (struct gpu *)1;
    const struct gpu_options options = {.device = NULL};
    hide_loader = true;
    assert_int_equal(gpu_list(&info, 1, &count, error), GPU_NO_LOADER);
    assert_int_equal(count, 0);
    assert_non_null(strstr(error, "libvulkan"));
    assert_int_equal(gpu_create(&options, &gpu, error), GPU_NO_LOADER);
    assert_null(gpu);
    hide_loader = false;
}

static void test_no_driver(void **state) {
    device_kit_need(state, false);
    // Newer loaders read the second name first.
    static const char *const names[] = {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"};
    char *kept[2];
    for (int i = 0; i < 2; i++) {
        const char *old = getenv(names[i]);
        kept[i] = old ? strdup(old) : NULL;
        setenv(names[i], "/nonexistent/driver.json", 1);
    }
    char error[GPU_ERROR_BYTES] = "";
    uint32_t count = 7;
    struct gpu *gpu = NULL;
    assert_int_equal(gpu_list(NULL, 0, &count, error), GPU_NO_DRIVER);
    assert_int_equal(count, 0);
    assert_non_null(strstr(error, "driver"));
    assert_int_equal(gpu_create(&(struct gpu_options){0}, &gpu, error), GPU_NO_DRIVER);
    for (int i = 0; i < 2; i++) {
        if (kept[i])
            setenv(names[i], kept[i], 1);
        else
            unsetenv(names[i]);
        free(kept[i]);
    }
}

// ---- devices

static void test_choice(void **state) {
    device_kit_need(state, false);
    char error[GPU_ERROR_BYTES];
    struct gpu_device_info infos[16];
    uint32_t count, preferred = 0;
    assert_int_equal(gpu_list(infos, 16, &count, error), GPU_OK);
    assert_true(count >= 1 && count <= 16);
    for (uint32_t i = 0; i < count; i++) {
        assert_int_equal(infos[i].number, i);
        assert_true(infos[i].memory_bytes > 0 && infos[i].name[0]);
        preferred += infos[i].preferred;
    }
    assert_int_equal(preferred, 1);
    struct gpu *gpu;
    char upper[sizeof infos[0].name];
    for (size_t i = 0; i < sizeof upper; i++)
        upper[i] = (char)(infos[0].name[i] >= 'a' && infos[0].name[i] <= 'z' ? infos[0].name[i] - 32
                                                                             : infos[0].name[i]);
    const char *good[] = {"0", upper, ""};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(gpu_create(&(struct gpu_options){.device = good[i]}, &gpu, error), GPU_OK);
        assert_true(i == 2 ? gpu_info(gpu)->preferred : strcmp(gpu_info(gpu)->name, infos[0].name) == 0);
        gpu_destroy(gpu);
    }
    const char *bad[] = {"no such device", "99", "00000000000000000000000000000001234"};
    for (int i = 0; i < 3; i++) {
        assert_int_equal(gpu_create(&(struct gpu_options){.device = bad[i]}, &gpu, error), GPU_NO_DEVICE);
        assert_non_null(strstr(error, bad[i]));
        assert_null(gpu);
    }
}

// ---- buffers

static void test_buffers(void **state) {
    struct gpu *gpu = device_kit_need(state, false);
    const enum gpu_use uses[] = {GPU_WORDS, GPU_TEXELS_U8, GPU_TEXELS_F32, GPU_STORAGE, GPU_UNIFORM};
    const uint64_t sizes[] = {0, 1, 15, 16, 4096, 65536, (16u << 20) + 48};
    uint8_t *in = malloc(sizes[6]), *out = malloc(sizes[6]);
    for (uint64_t i = 0; i < sizes[6]; i++)
        in[i] = (uint8_t)(i * 2654435761u >> 13);
    for (size_t u = 0; u < sizeof uses / sizeof *uses; u++)
        for (size_t s = 0; s < (uses[u] == GPU_UNIFORM ? 5 : 7); s++) {
            struct gpu_buffer *buffer = gpu_buffer_create(gpu, uses[u], sizes[s]);
            assert_non_null(buffer);
            assert_int_equal(gpu_buffer_bytes(buffer), sizes[s]);
            assert_true(gpu_write(gpu, buffer, 0, in, sizes[s]));
            if (sizes[s] >= 16)
                assert_true(gpu_write(gpu, buffer, 4, in + 8, 8));
            memset(out, 0, sizes[s]);
            assert_true(gpu_read(gpu, buffer, 0, out, sizes[s]));
            if (sizes[s] >= 16) {
                assert_memory_equal(out + 4, in + 8, 8);
                memcpy(out + 4, in + 4, 8);
            }
            assert_memory_equal(in, out, sizes[s]);
            gpu_buffer_destroy(gpu, buffer);
        }
    free(in);
    free(out);
    gpu_buffer_destroy(gpu, NULL);
}

static void test_too_large(void **state) {
    struct gpu *gpu = device_kit_need(state, false);
    assert_null(gpu_buffer_create(gpu, GPU_UNIFORM, 1u << 30));
    assert_int_equal(gpu_last_status(gpu), GPU_NO_MEMORY);
    assert_non_null(strstr(gpu_error(gpu), "MiB"));
    assert_null(gpu_buffer_create(gpu, GPU_STORAGE, 1ull << 50));
    assert_int_equal(gpu_last_status(gpu), GPU_NO_MEMORY);
    assert_null(strstr(gpu_error(gpu), "mesh"));
    // A scene's: its author is told what to do.
    assert_null(gpu_buffer_create(gpu, GPU_WORDS, 1ull << 45));
    assert_int_equal(gpu_last_status(gpu), GPU_NO_MEMORY);
    assert_non_null(strstr(gpu_error(gpu), "a buffer of 33554432 MiB exceeds the "));
    assert_non_null(strstr(gpu_error(gpu), gpu_info(gpu)->name));
    assert_non_null(strstr(gpu_error(gpu), "models that share one"));
}

// ---- records

// One record of each kind, as flattening fills them, and their words.
struct all_records {
    struct gpu_node triangle_node, sphere_node;
    struct gpu_triangle triangle;
    struct gpu_sphere sphere;
    struct gpu_body body;
    struct gpu_material material;
    struct gpu_light light;
    struct gpu_normal normal;
};

enum {
    MOST_WORDS = 8 // of a record
};

struct all_words {
    struct gpu_word triangle_node[MOST_WORDS], sphere_node[MOST_WORDS], triangle[MOST_WORDS],
        sphere[MOST_WORDS], body[MOST_WORDS], material[MOST_WORDS], light[MOST_WORDS], normal[MOST_WORDS];
};

// Every number gets a value of its own, with digits that only a double holds.
static double next_number(double *last) {
    *last += 1;
    return *last * (1 + 0x1p-40 + 0x1p-50);
}
#define FILL_REAL3(name, ...)  record->name = (vec3){next_number(last), next_number(last), next_number(last)};
#define FILL_NUMBER(name, ...) record->name = next_number(last);
#define FILL_UINT(name, ...)   record->name = (uint32_t)next_number(last);

// The fields in order, each filled up to words, as the kernel writes them: a number in double precision in
// two components, three of them in two words.
struct listing {
    struct gpu_word words[128];
    uint32_t place;
};

static void list_real3(struct listing *l, bool is_double, vec3 v) {
    if (is_double)
        gpu_pack_double3(l->words, l->place, v);
    else
        gpu_pack_float3(l->words, l->place, v);
    l->place += is_double ? 2 : 1;
}
static void list_real(struct listing *l, bool is_double, double value) {
    if (is_double)
        gpu_pack_double(l->words, l->place++, 0, value);
    else
        gpu_pack_float(l->words, l->place++, 0, value);
}
#define LIST_REAL3(name, ...)  list_real3(l, is_double, record->name);
#define LIST_REAL(name, ...)   list_real(l, is_double, record->name);
#define LIST_FLOAT3(name, ...) list_real3(l, false, record->name);
#define LIST_FLOAT(name, ...)  list_real(l, false, record->name);
#define LIST_UINT(name, ...)   gpu_pack_uint(l->words, l->place++, 0, record->name);

#define RECORD_TEST(name, NAME)                                                                              \
    static void fill_##name(struct gpu_##name *record, double *last) {                                       \
        NAME##_FIELDS(FILL_REAL3, FILL_NUMBER, FILL_REAL3, FILL_NUMBER, FILL_UINT)                           \
    }                                                                                                        \
    static void list_##name(struct listing *l, bool is_double, const struct gpu_##name *record) {            \
        NAME##_FIELDS(LIST_REAL3, LIST_REAL, LIST_FLOAT3, LIST_FLOAT, LIST_UINT)(void) is_double;            \
    }
RECORD_TEST(node, NODE)
RECORD_TEST(triangle, TRIANGLE)
RECORD_TEST(sphere, SPHERE)
RECORD_TEST(body, BODY)
RECORD_TEST(material, MATERIAL)
RECORD_TEST(light, LIGHT)
RECORD_TEST(normal, NORMAL)

// In the kernel's order.
#define ALL_RECORDS(DO)                                                                                      \
    DO(triangle_node, node)                                                                                  \
    DO(sphere_node, node)                                                                                    \
    DO(triangle, triangle)                                                                                   \
    DO(sphere, sphere)                                                                                       \
    DO(body, body)                                                                                           \
    DO(material, material)                                                                                   \
    DO(light, light)                                                                                         \
    DO(normal, normal)

static void make_records(bool is_double, struct all_words *words, struct listing *l) {
    struct all_records all;
    double last = 1000;
    memset(words, 0, sizeof *words);
    memset(l, 0, sizeof *l);
#define MAKE(member, name)                                                                                   \
    fill_##name(&all.member, &last);                                                                         \
    gpu_pack_##name(&all.member, is_double, words->member);                                                  \
    list_##name(l, is_double, &all.member);
    ALL_RECORDS(MAKE)
}

static void bind(struct gpu *gpu, struct gpu_program_source *source, uint32_t binding, const void *data,
                 size_t bytes) {
    struct gpu_buffer *buffer = gpu_buffer_create(gpu, data ? GPU_WORDS : GPU_STORAGE, bytes);
    assert_non_null(buffer);
    assert_true(!data || gpu_write(gpu, buffer, 0, data, bytes));
    source->buffers[binding] = buffer;
}

// The kernel over the records.
static struct gpu_program_source layout_source(struct gpu *gpu, bool is_double, const struct all_words *all) {
    const bool texels = gpu_fetches_texels(gpu);
    struct gpu_program_source source = {.kernel = NULL};
    if (is_double)
        source.kernel = texels ? &kernel_layout64_texels : &kernel_layout64_storage;
    else
        source.kernel = texels ? &kernel_layout_texels : &kernel_layout_storage;
    bind(gpu, &source, BINDING_TRIANGLE_NODES, all->triangle_node, sizeof all->triangle_node);
    bind(gpu, &source, BINDING_SPHERE_NODES, all->sphere_node, sizeof all->sphere_node);
    bind(gpu, &source, BINDING_TRIANGLES, all->triangle, sizeof all->triangle);
    bind(gpu, &source, BINDING_SPHERES, all->sphere, sizeof all->sphere);
    bind(gpu, &source, BINDING_BODIES, all->body, sizeof all->body);
    bind(gpu, &source, BINDING_MATERIALS, all->material, sizeof all->material);
    bind(gpu, &source, BINDING_LIGHTS, all->light, sizeof all->light);
    bind(gpu, &source, BINDING_NORMALS, all->normal, sizeof all->normal);
    bind(gpu, &source, BINDING_OUTPUT, NULL, sizeof(struct listing));
    return source;
}

// Runs the kernel, which writes the records' fields back; takes the buffers away.
static void expect_listing(struct gpu *gpu, const struct gpu_program_source *source,
                           const struct listing *listing) {
    struct listing got;
    struct gpu_program *program = gpu_program_create(gpu, source);
    assert_non_null(program);
    double seconds = -1;
    assert_true(gpu_dispatch(gpu, program, 1, 1, NULL));
    assert_true(gpu_submit(gpu));
    assert_true(gpu_wait(gpu, &seconds));
    assert_true(seconds >= 0 && seconds < 60);
    assert_true(gpu_read(gpu, source->buffers[BINDING_OUTPUT], 0, got.words, sizeof got.words));
    assert_memory_equal(got.words, listing->words, listing->place * sizeof(struct gpu_word));
    gpu_program_destroy(gpu, program);
    for (int i = 0; i < GPU_BINDINGS; i++)
        gpu_buffer_destroy(gpu, source->buffers[i]);
}

static void expect_layout(void **state, bool is_double) {
    struct gpu *gpu = device_kit_need(state, is_double);
    struct all_words words;
    struct listing listing;
    make_records(is_double, &words, &listing);
    struct gpu_program_source source = layout_source(gpu, is_double, &words);
    expect_listing(gpu, &source, &listing);
}

static void test_layout(void **state) {
    expect_layout(state, false);
}

static void test_layout64(void **state) {
    expect_layout(state, true);
}

// ---- kernels that are kept

// One entry, as a store would hold it.
struct kept {
    uint64_t key[2];
    char bytes[1 << 16];
    size_t count;
    int asked, found, written;
};

static void *read_kept(void *context, const uint64_t key[2], size_t *count) {
    struct kept *kept = context;
    kept->asked++;
    if (kept->count == 0 || memcmp(kept->key, key, sizeof kept->key) != 0)
        return NULL;
    kept->found++;
    *count = kept->count;
    return memcpy(malloc(kept->count), kept->bytes, kept->count);
}

static void write_kept(void *context, const uint64_t key[2], const void *bytes, size_t count) {
    struct kept *kept = context;
    assert_in_range(count, 1, sizeof kept->bytes);
    memcpy(kept->key, key, sizeof kept->key);
    memcpy(kept->bytes, bytes, count);
    kept->count = count;
    kept->written++;
}

// A device of its own compiles a kernel, twice if that is asked for.
static void compile_with(struct kept *kept, bool always, int programs) {
    char error[GPU_ERROR_BYTES];
    struct gpu *gpu;
    const struct gpu_options options = {.device = getenv("GLINT_DEVICE"),
                                        .keep = {read_kept, write_kept, kept, always}};
    assert_int_equal(gpu_create(&options, &gpu, error), GPU_OK);
    struct all_words all;
    memset(&all, 0, sizeof all);
    struct gpu_program_source source = layout_source(gpu, false, &all);
    for (int i = 0; i < programs; i++) {
        struct gpu_program *program = gpu_program_create(gpu, &source);
        assert_non_null(program);
        assert_true(gpu_dispatch(gpu, program, 1, 1, NULL) && gpu_submit(gpu) && gpu_wait(gpu, NULL));
        gpu_program_destroy(gpu, program);
    }
    for (int i = 0; i < GPU_BINDINGS; i++)
        gpu_buffer_destroy(gpu, source.buffers[i]);
    gpu_destroy(gpu);
}

static void test_kernels_are_kept(void **state) {
    static struct kept kept;
    device_kit_need(state, false);
    kept = (struct kept){.count = 0};
    compile_with(&kept, true, 2);
    assert_int_equal(kept.asked, 1); // the second is the first one's
    assert_int_equal(kept.written, 1);
    compile_with(&kept, true, 1);
    assert_int_equal(kept.found, 1);
    assert_int_equal(kept.written, 1);
    // What a driver does not know is not used; nothing fails.
    memset(kept.bytes, 0xA5, kept.count);
    compile_with(&kept, true, 1);
    assert_int_equal(kept.found, 2);
}

// Mesa keeps what lavapipe compiles.
static void test_a_processor_keeps_nothing(void **state) {
    static struct kept kept;
    struct gpu *gpu = device_kit_need(state, false);
    if (gpu_info(gpu)->kind != GPU_CPU)
        skip();
    kept = (struct kept){.count = 0};
    compile_with(&kept, false, 1);
    assert_int_equal(kept.asked + kept.written, 0);
}

// What the silence of the layer in all other tests is worth: more workgroups than allowed, never submitted,
// are a message.
static void test_messages_are_counted(void **state) {
    device_kit_need(state, false);
    char error[GPU_ERROR_BYTES];
    struct gpu *gpu;
    uint32_t messages = 0;
    const struct gpu_options options = {
        .device = getenv("GLINT_DEVICE"), .validate = true, .validation_messages = &messages};
    assert_int_equal(gpu_create(&options, &gpu, error), GPU_OK);
    struct all_words all;
    memset(&all, 0, sizeof all);
    struct gpu_program_source source = layout_source(gpu, false, &all);
    struct gpu_program *program = gpu_program_create(gpu, &source);
    assert_non_null(program);
    assert_int_equal(messages, 0);
    assert_true(gpu_dispatch(gpu, program, 1, UINT32_MAX, NULL));
    const uint32_t counted = messages;
    gpu_program_destroy(gpu, program);
    for (int i = 0; i < GPU_BINDINGS; i++)
        gpu_buffer_destroy(gpu, source.buffers[i]);
    gpu_destroy(gpu);
    if (counted == 0)
        skip(); // the layer is not installed
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_loader),
        cmocka_unit_test_setup_teardown(test_no_driver, device_kit_setup, device_kit_teardown),
        cmocka_unit_test_setup_teardown(test_choice, device_kit_setup, device_kit_teardown),
        cmocka_unit_test_setup_teardown(test_messages_are_counted, device_kit_setup, device_kit_teardown),
        cmocka_unit_test_setup_teardown(test_kernels_are_kept, device_kit_setup, device_kit_teardown),
        cmocka_unit_test_setup_teardown(test_a_processor_keeps_nothing, device_kit_setup,
                                        device_kit_teardown),
        cmocka_unit_test_setup_teardown(test_buffers, device_kit_setup, device_kit_teardown),
        cmocka_unit_test_setup_teardown(test_too_large, device_kit_setup, device_kit_teardown),
        cmocka_unit_test_setup_teardown(test_layout, device_kit_setup, device_kit_teardown),
        cmocka_unit_test_setup_teardown(test_layout64, device_kit_setup, device_kit_teardown),
    };
    return cmocka_run_group_tests_name("gpu", tests, NULL, NULL);
}
