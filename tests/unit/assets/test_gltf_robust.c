// glTF files in three forms, whole and damaged: a mesh that holds together, or an error at a place; never a
// crash, never without end.
#include "assets_scene.h"
#include "core/splitmix.h"
#include "gltf/sample.h"

#include <stdio.h>

enum {
    MUTATIONS = 1500,
    PREFIX_STEP = 61, // of JSON, whose prefixes are all read from the beginning
};

static void assert_holds_together(const struct mesh *mesh) {
    assert_true(mesh->is_binary); // a face's line is its number
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            const struct mesh_triangle *triangle = &mesh->triangles[t];
            assert_true(triangle->corners[k] < mesh->position_count && triangle->group < mesh->group_count);
            assert_true(triangle->normals[k] == IR_NO_INDEX || triangle->normals[k] < mesh->normal_count);
            if (mesh->textured && mesh->textured[t][k] != IR_NO_INDEX)
                assert_true(mesh->textured[t][k] < mesh->coordinate_count);
        }
    for (uint32_t i = 0; i < mesh->position_count; i++)
        assert_true(vec3_max_abs(mesh->positions[i]) <= 1e36);
}

// How many triangles the file has as one mesh; 0: an error was told.
static uint32_t load(const char *name, const char *bytes, size_t size) {
    struct assets_scene *s = assets_scene_begin();
    char *copy = malloc(size ? size : 1); // of the exact size, so that reading beyond it is seen
    memcpy(copy, bytes, size);
    assets_scene_bytes(s, name, copy, size);
    s->limits.value[LIMIT_MESH_MEMORY] = 8 << 20;
    s->limits.value[LIMIT_MESH_TRIANGLES] = 10000;
    assets_scene_model(s, name);
    assets_scene_load(s);
    const struct mesh *mesh = s->assets.models[0].mesh;
    const uint32_t triangles = mesh ? mesh->triangle_count : 0;
    if (mesh)
        assert_holds_together(mesh);
    else
        assert_true(s->sink.errors > 0);
    assert_true(strlen(assets_scene_text(s)) < 100000);
    assets_scene_end(s);
    free(copy);
    return triangles;
}

static const uint32_t all_triangles = SAMPLE_IMAGES * 12 + 4 * 8 + 2 * 4;

static void whole_files(void **state) {
    (void)state;
    struct sample sample;
    sample_make(SAMPLE_GLB, &sample);
    assert_int_equal(load("a.glb", sample.file.data, sample.file.len), all_triangles);
    sample_finish(&sample);
    sample_make(SAMPLE_EMBEDDED, &sample);
    assert_int_equal(load("a.gltf", sample.file.data, sample.file.len), all_triangles);
    sample_finish(&sample);
}

static void every_prefix(void **state) {
    (void)state;
    struct sample sample;
    sample_make(SAMPLE_GLB, &sample);
    for (size_t n = 0; n < sample.file.len; n++)
        assert_int_equal(load("a.glb", sample.file.data, n), 0);
    sample_finish(&sample);
    sample_make(SAMPLE_EMBEDDED, &sample);
    for (size_t n = 0; n + 2 < sample.file.len; n += PREFIX_STEP)
        assert_int_equal(load("a.gltf", sample.file.data, n), 0);
    sample_finish(&sample);
}

// Files that use one thing each: what fuzzing begins with. None of them ends in spaces, so that less of it is
// not whole.
static void every_prefix_of_small_files(void **state) {
    (void)state;
    static const char *const names[] = {"triangle.gltf", "strips.gltf", "looks.gltf", "sparse.glb"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[4096], bytes[4096];
        snprintf(path, sizeof path, "tests/fuzz/seeds/gltf/%s", names[i]);
        FILE *file = fopen(path, "rb");
        assert_non_null(file);
        const size_t size = fread(bytes, 1, sizeof bytes, file);
        assert_int_equal(fclose(file), 0);
        assert_true(size > 0 && size < sizeof bytes && load(names[i], bytes, size) > 0);
        for (size_t n = 0; n < size; n++)
            assert_int_equal(load(names[i], bytes, n), 0);
    }
}

// Digits become other digits, so that counts, offsets and numbers of things are wrong; other bytes anything.
static void changed_bytes(void **state) {
    (void)state;
    uint64_t random = 1;
    struct sample sample;
    sample_make(SAMPLE_GLB, &sample);
    for (int i = 0; i < MUTATIONS; i++) {
        char *bytes = malloc(sample.file.len);
        memcpy(bytes, sample.file.data, sample.file.len);
        for (int k = 0; k < 1 + i % 4; k++) {
            const uint64_t r = splitmix_next(&random);
            char *at = &bytes[(r >> 8) % sample.file.len];
            *at = (char)(*at >= '0' && *at <= '9' ? '0' + r % 10 : r & 0xFF);
        }
        load("a.glb", bytes, sample.file.len);
        free(bytes);
    }
    sample_finish(&sample);
}

// A count costs a file nothing: it must cost nothing to read either.
static void huge_counts(void **state) {
    (void)state;
    static const char *const texts[] = {
        "{\"asset\":{\"version\":\"2.0\"},\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\",\"count\":"
        "4000000000}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0}]}",
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":9007199254740992,\"uri\":\"data:;"
        "base64,AAAA\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":9007199254740992}],\"accessors\":[{\"bufferView\":0,"
        "\"componentType\":5126,\"type\":\"VEC3\",\"count\":300000000}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0}]}",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        assert_int_equal(load("a.gltf", texts[i], strlen(texts[i])), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_files),
        cmocka_unit_test(every_prefix),
        cmocka_unit_test(every_prefix_of_small_files),
        cmocka_unit_test(changed_bytes),
        cmocka_unit_test(huge_counts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
