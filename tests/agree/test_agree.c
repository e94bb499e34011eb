// `check` and `render` agree: what one refuses the other refuses with the same errors at the same places, and
// what the check passes becomes a picture.
//
//     test_agree [--device] damaged                     images that were passed once, each with its message
//     test_agree [--device] mutants SEED COUNT FILE...  images, meshes and material files with mistakes
//     test_agree [--device] generated SEED COUNT        random scenes of extreme values
//     test_agree [--device] scenes FILE...              as they are
//     test_agree [--device] limits                      scenes just within a limit, and just beyond it
//     test_agree hostile                                those of tests/hostile, made in the current folder
//
// Small pictures by the reference, which runs where there is no device, and with --device by a device; then
// it ends with 77 where there is none. Files come from memory; the scene around them is written here.
#include "core/strbuf.h"
#include "diag/codes/device.h"
#include "diag/diag_text.h"
#include "grammar/print/ir_print.h"
#include "load/check.h"
#include "picture/formats/formats.h"
#include "render/reference_shot.h"
#include "tests/agree/damaged.h"
#include "tests/agree/mutate.h"
#include "tests/generate/generate.h"
#include "tests/hostile/hostile_inputs.h"
#include "tests/pictures/picture_kit.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    WIDTH = 6,
    HEIGHT = 4,
    PATH_BYTES = 4096,
};

struct agree {
    struct picture_kit kit; // with a gpu, or with its store alone
    char folder[PATH_BYTES];
    uint32_t passed, refused, failed;
    uint32_t marked; // of the passed: with pixels that are no numbers, or need too many rays
};

struct agree_case {
    const char *name;
    struct session_options options;
    const char *message; // that the check must report; NULL: whatever it says
    const char *limit;   // NAME=VALUE; NULL: none but those that are standard
    bool must_pass;
    bool is_stricter; // the check takes more memory than rendering, and may refuse alone
    bool is_extreme;  // light of any brightness: what no float holds is marked in the picture, and no fault
};

// ---- what is compared

// The errors, each with its place: what both must say.
static void put_errors(struct session *session, struct strbuf *out) {
    for (uint32_t i = 0; i < session->sink.count; i++) {
        const struct diag *item = &session->sink.items[i];
        if (item->severity != DIAG_ERROR)
            continue;
        if (!span_is_none(item->at)) {
            struct source_place at = source_locate(&session->sources, item->at);
            strbuf_format(out, "%.*s:%u:%u: ", STR_ARG(at.path), at.line, at.column);
        }
        strbuf_format(out, "%.*s [%s]\n", STR_ARG(item->message), diag_info(item->code)->code);
    }
}

static void say(struct agree *a, const struct agree_case *c, const char *what, const struct strbuf *text) {
    printf("FAIL %s: %s\n%.*s", c->name, what, text ? (int)text->len : 0, text ? text->data : "");
    a->failed++;
}

// ---- rendering

static bool draw_by_device(struct agree *a, struct session *session, struct image *image) {
    struct shot shot;
    struct render_statistics statistics;
    bool good = shot_open(&shot, session, a->kit.gpu, 0) == SHOT_OK &&
                shot_take(&shot, image, NULL, &statistics) == SHOT_OK;
    shot_close(&shot);
    return good;
}

// The picture, and before it what the device's way does with the scene until a device is needed.
static bool draw_by_reference(struct session *session, struct image *image) {
    struct reference_shot shot;
    struct reference_statistics statistics;
    struct flat_scene flat;
    bool good =
        reference_shot_open(&shot, session, 0,
                            (struct reference_shot_options){.as_file = true, .no_cache = true}) == SHOT_OK;
    struct flat_input input = {.scene = &session->resolved,
                               .view = &shot.view,
                               .origin = session_origin(session, &shot.view),
                               .limits = &session->options.limits,
                               .sink = &session->sink};
    good = good && flatten(&input, &flat);
    if (good)
        flat_finish(&flat);
    good = good && reference_shot_take(&shot, image, NULL, NULL, &statistics) == SHOT_OK;
    reference_shot_close(&shot);
    return good;
}

// Light itself is not decided by a check: the picture is written, and says where.
static bool only_marks_pixels(const struct session *session) {
    for (uint32_t i = 0; i < session->sink.count; i++) {
        const struct diag *item = &session->sink.items[i];
        if (item->severity == DIAG_ERROR && item->code != DIAG_NOT_FINITE && item->code != DIAG_PATH_SEGMENTS)
            return false;
    }
    return session->sink.errors > 0;
}

// What goes wrong is in the session's sink, or said here.
static void draw(struct agree *a, const struct agree_case *c, struct session *session) {
    struct image image;
    bool good = image_init(&image, WIDTH, HEIGHT) &&
                (a->kit.gpu ? draw_by_device(a, session, &image) : draw_by_reference(session, &image));
    if (!good && session->sink.errors == 0)
        say(a, c, a->kit.gpu ? gpu_error(a->kit.gpu) : "no picture, and no reason", NULL);
    image_finish(&image);
}

// ---- one case

static void compare(struct agree *a, const struct agree_case *c, struct session *checked,
                    struct session *rendered) {
    struct strbuf by_check, by_render;
    strbuf_init(&by_check);
    strbuf_init(&by_render);
    put_errors(checked, &by_check);
    if (c->is_extreme && only_marks_pixels(rendered))
        a->marked++;
    else
        put_errors(rendered, &by_render);
    if (c->is_stricter && checked->sink.errors && rendered->sink.errors == 0)
        put_errors(checked, &by_render);
    strbuf_char(&by_check, '\0');
    strbuf_char(&by_render, '\0');
    if (strcmp(by_check.data, by_render.data) != 0) {
        say(a, c, "the check says", &by_check);
        say(a, c, "but rendering says", &by_render);
    } else if (c->message && !strstr(by_check.data, c->message)) {
        say(a, c, "the check says", &by_check);
    } else if (c->must_pass && checked->sink.errors) {
        say(a, c, "it is whole", &by_check);
    } else {
        ++*(checked->sink.errors || checked->state != SESSION_LOADED ? &a->refused : &a->passed);
    }
    strbuf_finish(&by_check);
    strbuf_finish(&by_render);
}

static void judge(struct agree *a, const struct agree_case *c) {
    struct session checked, rendered;
    struct session_options options = c->options;
    enum limit which;
    options.limits = limits_default();
    if (c->limit)
        limits_set(&options.limits, str_from(c->limit), &which);
    options.width = WIDTH;
    options.height = HEIGHT;
    options.samples = 1;
    check_scene(&checked, &options, a->kit.store);
    options.lint = LINT_CHEAP;
    session_load(&rendered, &options, a->kit.store);
    if (rendered.state == SESSION_LOADED && rendered.sink.errors == 0)
        draw(a, c, &rendered);
    compare(a, c, &checked, &rendered);
    session_finish(&checked);
    session_finish(&rendered);
}

// A scene that names one file, both from memory.
static void judge_file(struct agree *a, const char *name, const char *scene, const char *file, str bytes,
                       const struct agree_case *more) {
    char scene_path[PATH_BYTES + 32], file_path[PATH_BYTES + 32];
    snprintf(scene_path, sizeof scene_path, "%s/agree.glint.yaml", a->folder);
    snprintf(file_path, sizeof file_path, "%s/%s", a->folder, file);
    struct file_overlay overlays[] = {{str_from(scene_path), str_from(scene)}, {str_from(file_path), bytes}};
    struct agree_case c = {
        .name = name,
        .message = more ? more->message : NULL,
        .must_pass = more && more->must_pass,
        .is_extreme = more && more->is_extreme,
        .limit = more ? more->limit : NULL,
        .is_stricter = more && more->is_stricter,
        .options = {.path = str_from(scene_path), .overlays = overlays, .overlay_count = bytes.ptr ? 2 : 1}};
    judge(a, &c);
}

#define IMAGE_SCENE "glint: 1\nbackground: {image: agree.image}\nspheres: [{center: [0, 0, -4], radius: 1}]\n"
#define MESH_SCENE  "glint: 1\nmodels: [{mesh: agree.obj}]\n"
// What a material file says shows through a mesh that names it.
#define LIBRARY_SCENE "glint: 1\nmodels: [{mesh: scenes/meshes/fox.obj}]\n"

// ---- modes

static void run_damaged(struct agree *a) {
    struct strbuf file;
    strbuf_init(&file);
    for (int i = 0; i < damaged_count; i++) {
        const struct damaged *d = &damaged_images[i];
        if (strncmp(d->what, "OpenEXR", 7) == 0 && image_format_missing(IMAGE_EXR))
            continue;
        struct agree_case more = {.message = d->message, .must_pass = !d->message};
        strbuf_clear(&file);
        d->make(&file);
        judge_file(a, d->what, IMAGE_SCENE, "agree.image", strbuf_view(&file), &more);
    }
    strbuf_finish(&file);
}

static void judge_limit(struct agree *a, const char *name, const char *scene, const char *limit,
                        const char *message) {
    struct agree_case more = {.limit = limit, .message = message, .must_pass = !message};
    judge_file(a, name, scene, "", (str){0}, &more);
}

// The scene's memory down to where it does not suffice: around that place each part of the work fails once.
static void run_memory(struct agree *a, const char *scene) {
    char limit[64];
    uint64_t low = 1 << 20, high = 1 << 26; // refused, passed
    while (high - low > 64) {
        const uint64_t middle = low + (high - low) / 2;
        const uint32_t refused = a->refused;
        snprintf(limit, sizeof limit, "scene-memory=%llu", (unsigned long long)middle);
        judge_file(a, limit, scene, "", (str){0}, &(struct agree_case){.limit = limit, .is_stricter = true});
        *(a->refused > refused ? &low : &high) = middle;
    }
}

static void run_limits(struct agree *a) {
    static const char four[] =
        "glint: 1\nrectangles:\n  - {corner: [0, 0, -2], edge_u: [1, 0, 0], edge_v: [0, 1, 0]}\n"
        "  - {corner: [0, 0, -3], edge_u: [1, 0, 0], edge_v: [0, 1, 0]}\n";
    static const char mesh[] = "glint: 1\nmodels: [{mesh: scenes/meshes/gem.obj}]\n"
                               "rectangles: [{corner: [0, 0, -2], edge_u: [1, 0, 0], edge_v: [0, 1, 0]}]\n";
    judge_limit(a, "four triangles", four, "scene-triangles=4", NULL);
    judge_limit(a, "a triangle too many", four, "scene-triangles=3", "the limit scene-triangles is 3 [E501]");
    judge_limit(a, "a mesh and a rectangle", mesh, "scene-triangles=1",
                "the limit scene-triangles is 1 [E501]");
    struct strbuf lights;
    strbuf_init(&lights);
    strbuf_cstr(&lights, "glint: 1\nlights:\n");
    for (int i = 0; i < 3000; i++)
        strbuf_format(&lights, "  - {position: [%d, 5, 5]}\n", i);
    strbuf_char(&lights, '\0');
    run_memory(a, lights.data);
    strbuf_finish(&lights);
}

static bool read_file(const char *path, struct strbuf *out) {
    char piece[4096];
    size_t count;
    FILE *file = fopen(path, "rb");
    strbuf_clear(out);
    while (file && (count = fread(piece, 1, sizeof piece, file)) > 0)
        strbuf_add(out, piece, count);
    return file && fclose(file) == 0;
}

static void run_mutant(struct agree *a, const char *path, uint64_t seed, str bytes, struct strbuf *mutant) {
    char name[PATH_BYTES];
    bool is_mesh = str_ends_with_nocase(str_from(path), ".obj");
    bool is_library = str_ends_with_nocase(str_from(path), ".mtl");
    snprintf(name, sizeof name, "%s, mutant %llu", path, (unsigned long long)seed);
    mutate(bytes, seed, is_mesh || is_library, mutant);
    if (seed % 4) // the others end at their checksums
        mutate_repair_png(mutant);
    judge_file(a, name,
               is_mesh      ? MESH_SCENE
               : is_library ? LIBRARY_SCENE
                            : IMAGE_SCENE,
               is_mesh      ? "agree.obj"
               : is_library ? "scenes/meshes/fox.mtl"
                            : "agree.image",
               strbuf_view(mutant), NULL);
}

static bool run_mutants(struct agree *a, char **arguments) {
    struct strbuf file, mutant;
    strbuf_init(&file);
    strbuf_init(&mutant);
    uint64_t seed = strtoull(arguments[0], NULL, 10), count = strtoull(arguments[1], NULL, 10);
    bool good = true;
    for (char **path = arguments + 2; *path && good; path++) {
        good = read_file(*path, &file);
        for (uint64_t i = 0; i < count && good; i++)
            run_mutant(a, *path, seed + i, strbuf_view(&file), &mutant);
    }
    strbuf_finish(&file);
    strbuf_finish(&mutant);
    return good && a->refused > 0; // else they were no mistakes
}

static void run_generated(struct agree *a, char **arguments) {
    uint64_t seed = strtoull(arguments[0], NULL, 10), count = strtoull(arguments[1], NULL, 10);
    const str mesh = STR("scenes/meshes/gem.obj"), image = STR("tests/data/image/palette.png");
    for (uint64_t i = seed; i < seed + count; i++) {
        struct generate_options options = {.seed = i, .meshes = {&mesh, 1}, .images = {&image, 1}};
        struct arena arena;
        struct strbuf text;
        char name[64];
        arena_init(&arena, (size_t)1 << 30);
        strbuf_init(&text);
        snprintf(name, sizeof name, "generated %llu", (unsigned long long)i);
        ir_write_yaml(generate_scene(&options, &arena), NULL, NULL, (struct ir_write_options){0}, &text);
        strbuf_char(&text, '\0');
        judge_file(a, name, text.data, "", (str){0}, &(struct agree_case){.is_extreme = true});
        strbuf_finish(&text);
        arena_finish(&arena);
    }
}

static void run_scene(struct agree *a, const char *path) {
    judge(a, &(struct agree_case){.name = path, .options = {.path = str_from(path)}});
}

static bool run_hostile(struct agree *a) {
    if (!hostile_make_inputs())
        return false;
    DIR *folder = opendir(".");
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        if (str_ends_with_nocase(str_from(entry->d_name), ".yaml") ||
            str_ends_with_nocase(str_from(entry->d_name), ".xml"))
            run_scene(a, entry->d_name);
    return folder && closedir(folder) == 0;
}

static bool run(struct agree *a, int count, char **arguments) {
    const char *mode = count > 0 ? arguments[0] : "";
    if (strcmp(mode, "damaged") == 0)
        run_damaged(a);
    else if (strcmp(mode, "mutants") == 0 && count > 3)
        return run_mutants(a, arguments + 1);
    else if (strcmp(mode, "generated") == 0 && count == 3)
        run_generated(a, arguments + 1);
    else if (strcmp(mode, "limits") == 0)
        run_limits(a);
    else if (strcmp(mode, "hostile") == 0)
        return run_hostile(a);
    else if (strcmp(mode, "scenes") == 0)
        for (int i = 1; i < count; i++)
            run_scene(a, arguments[i]);
    else
        return false;
    return true;
}

int main(int argc, char **argv) {
    struct agree a = {0};
    const bool by_device = argc > 1 && strcmp(argv[1], "--device") == 0;
    if (!getcwd(a.folder, sizeof a.folder))
        return 2;
    if (by_device && !picture_kit_open(&a.kit))
        return 77;
    if (!by_device)
        a.kit.store = asset_store_create();
    bool good = a.kit.store && run(&a, argc - 1 - by_device, argv + 1 + by_device);
    uint32_t messages = picture_kit_close(&a.kit);
    printf("%u passed the check and were rendered, %u of them with marked pixels, %u were refused by both "
           "alike, "
           "%u failed\n",
           a.passed, a.marked, a.refused, a.failed);
    return good && a.failed == 0 && a.passed > 0 && messages == 0 ? 0 : 1;
}
