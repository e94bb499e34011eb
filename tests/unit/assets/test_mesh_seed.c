// The original project's meshes, where they are: counts, closedness, the outward side.
//
// They are looked for in $GLINT_ASSETS/seed, else in ../shared/assets/seed. Where they are absent, each test
// is skipped.
#include "assets_scene.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

struct seed {
    const char *name;
    uint32_t faces, triangles;
    bool closed;
};

static const struct seed gem = {"asschercut-mesh.obj", 134, 134, true};
static const struct seed dragon = {"dragon-mesh.obj", 14394, 14394, true};
static const struct seed venus = {"venus-mesh.obj", 31398, 31398, true};
static const struct seed logo = {"fudanlogo-mesh.obj", 7520, 7520, true};
static const struct seed bunny = {"bunny-mesh.obj", 431, 431, false};
static const struct seed duck = {"duck.obj", 508, 508, true};
static const struct seed glass = {"glass.obj", 8960, 17920, true};
static const struct seed water = {"water.obj", 12604, 19902, true};
static const struct seed ice = {"ice.obj", 244, 244, true};

static void path_of(const char *name, char path[4096]) {
    const char *folder = getenv("GLINT_ASSETS");
    snprintf(path, 4096, "%s/seed/%s", folder && *folder ? folder : "../shared/assets", name);
}

static struct assets_scene *load_seed(const char *name) {
    static char path[4096];
    path_of(name, path);
    if (access(path, R_OK) != 0)
        skip();
    struct assets_scene *s = assets_scene_begin();
    files_add_root(&s->files, path_folder(str_from(path)));
    assets_scene_model(s, path);
    assets_scene_load(s);
    return s;
}

static void seed_is_read(void **state) {
    const struct seed *seed = *state;
    struct assets_scene *s = load_seed(seed->name);
    const struct mesh *mesh = s->assets.models[0].mesh;
    assert_int_equal(s->sink.errors + s->sink.warnings, 0); // faces of the water are not quite flat: a note
    assert_int_equal(mesh->face_count, seed->faces);
    assert_int_equal(mesh->triangle_count, seed->triangles);
    assert_int_equal(mesh->closed, seed->closed);
    assert_false(mesh->turned);
    assert_int_equal(mesh->volume > 0, seed->closed);
    const vec3 *normals = mesh_smooth_normals(mesh, 180, &s->arena);
    uint32_t zero = 0;
    for (uint32_t i = 0; i < 3 * mesh->triangle_count; i++) {
        zero += vec3_is_zero(normals[i]);
        assert_true(vec3_is_zero(normals[i]) || fabs(vec3_length(normals[i]) - 1) < 1e-12);
    }
    assert_true(zero <= 3 * mesh->zero_area);
    assets_scene_end(s);
}

static void lines_beside_faces_are_noted(void **state) {
    (void)state;
    struct assets_scene *s = load_seed("asschercut_delete.obj");
    assert_int_equal(s->assets.models[0].mesh->triangle_count, 30);
    assert_int_equal(s->sink.count, 1);
    assert_says(s, "asschercut_delete.obj:100:1: warning: 4 points, lines or curves are not drawn [W606]");
    assets_scene_end(s);
}

static void the_background_is_decoded(void **state) {
    (void)state;
    char path[4096];
    path_of("background.jpg", path);
    if (access(path, R_OK) != 0)
        skip();
    struct assets_scene *s = assets_scene_begin();
    files_add_root(&s->files, path_folder(str_from(path)));
    assets_scene_background(s, path);
    assets_scene_load(s);
    assert_int_equal(s->sink.errors, 0);
    assert_int_equal(s->assets.background->width, 7616);
    assert_int_equal(s->assets.background->height, 3808);
    assets_scene_end(s);
}

#define SEED(seed) cmocka_unit_test_prestate(seed_is_read, (void *)(seed))

int main(void) {
    struct CMUnitTest tests[] = {
        SEED(&gem),
        SEED(&dragon),
        SEED(&venus),
        SEED(&logo),
        SEED(&bunny),
        SEED(&duck),
        SEED(&glass),
        SEED(&water),
        SEED(&ice),
        cmocka_unit_test(lines_beside_faces_are_noted),
        cmocka_unit_test(the_background_is_decoded),
    };
    static const char *const names[] = {"gem",  "dragon", "venus", "logo", "bunny",
                                        "duck", "glass",  "water", "ice"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        tests[i].name = names[i];
    return cmocka_run_group_tests(tests, NULL, NULL);
}
