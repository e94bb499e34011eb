// Scenes for other tracers, and their pictures by our encoder.
//
//     bench_export pov|tachyon SCENE OUT [--assets DIR] [--size WxH] [--set PATH=VALUE]...
//     bench_export png IN.ppm OUT.png
//
// The first prints an object of JSON: what the tool cannot show of the scene, and whether pictures are
// encoded as sRGB. The other writes a binary PPM of 8 bits as PNG. Exit: 0 done, 1 the scene, a file or
// memory failed, 2 usage.
#include "bench/export/export.h"
#include "core/number.h"
#include "diag/diag_text.h"
#include "files/output.h"
#include "grammar/ir.h"
#include "load/session.h"
#include "picture/write/encode_internal.h"
#include "scene/transform.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SETS_MOST = 16,
    SIDE_MOST = 65536,
};

struct options {
    const char *words[3]; // what, from, to
    str assets, sets[SETS_MOST];
    uint32_t set_count, width, height;
};

bool export_normals(const struct scene_body *body, const vec3 *normals, uint32_t triangle, vec3 out[3]) {
    const mat3 map = transform_for_normals(body->object_to_world.linear);
    bool good = true;
    for (uint32_t k = 0; k < 3; k++) {
        out[k] = vec3_unit(mat3_apply(map, normals[3 * (size_t)triangle + k]));
        good = good && !vec3_is_zero(out[k]);
    }
    return good;
}

static int fail(const char *path, const char *what) {
    fprintf(stderr, "bench_export: %s: %s\n", path, what);
    return 1;
}

static int write_file(const char *path, const struct strbuf *bytes) {
    const int error = bytes->failed ? 0 : output_whole(path, bytes->data, bytes->len);
    if (bytes->failed)
        return fail(path, "not enough memory");
    return error ? fail(path, strerror(error)) : 0;
}

// ---- scenes

static str image_path(const struct assets *assets) {
    for (uint32_t i = 0; i < assets->uses.count; i++)
        if (strcmp(assets->uses.items[i].what, "image") == 0)
            return assets->uses.items[i].canonical;
    return STR("");
}

static int export_loaded(const struct options *o, struct session *session) {
    struct view view;
    struct strbuf text;
    if (!session_view(session, 0, &view))
        return fail(o->words[1], "not enough memory");
    for (uint32_t i = 0; i < session->resolved.material_count; i++)
        if (scene_material_is_painted(&session->resolved.materials[i]))
            return fail(o->words[1], "images on bodies and filtered checkers cannot be exported");
    for (uint32_t i = 0; i < session->resolved.body_count; i++)
        if (session->resolved.bodies[i].shape == SCENE_CONE)
            return fail(o->words[1], "cylinders and cones cannot be exported");
    const struct export_input input = {.scene = &session->resolved,
                                       .view = &view,
                                       .background_path = image_path(&session->assets),
                                       .background_rotation = session->scene->background.rotation,
                                       .width = (uint32_t)session->image->width,
                                       .height = (uint32_t)session->image->height};
    strbuf_init(&text);
    const bool pov = strcmp(o->words[0], "pov") == 0;
    const char *lacks = pov ? export_pov(&input, &text) : export_tachyon(&input, &text);
    const int status = write_file(o->words[2], &text);
    strbuf_finish(&text);
    if (status == 0)
        printf("{\"lacks\": \"%s\", \"srgb\": %s, \"width\": %u, \"height\": %u}\n", lacks,
               session->scene->image.transfer == IR_TRANSFER_SRGB ? "true" : "false", input.width,
               input.height);
    return status;
}

static int export_scene(const struct options *o) {
    const struct session_options options = {.path = str_from(o->words[1]),
                                            .asset_paths = &o->assets,
                                            .asset_path_count = o->assets.len != 0,
                                            .sets = o->sets,
                                            .set_count = o->set_count,
                                            .limits = limits_default(),
                                            .width = (int32_t)o->width,
                                            .height = (int32_t)o->height};
    struct asset_store *store = asset_store_create();
    struct session session;
    struct strbuf text;
    int status = 1;
    if (!store)
        return fail(o->words[1], "not enough memory");
    strbuf_init(&text);
    session_load(&session, &options, store);
    if (session.state == SESSION_LOADED && !session.sink.errors) {
        status = export_loaded(o, &session);
    } else {
        diag_text(&text, &session.sink, &session.sources, (struct diag_text_options){.most = 10});
        fwrite(text.data ? text.data : "", 1, text.len, stderr);
    }
    strbuf_finish(&text);
    session_finish(&session);
    asset_store_destroy(store);
    return status;
}

// ---- pictures

// The next number of a head, after spaces and comments.
static bool take_number(FILE *file, unsigned *out) {
    int c = fgetc(file);
    while (c == '#' || c == ' ' || c == '\t' || c == '\n' || c == '\r') {
        while (c == '#' && (c = fgetc(file)) != '\n' && c != EOF)
            c = '#';
        c = fgetc(file);
    }
    return c != EOF && ungetc(c, file) != EOF && fscanf(file, "%u", out) == 1;
}

// The pixels of a PPM of the given file; NULL: it is not one, or memory ended.
static uint8_t *read_ppm(FILE *file, uint32_t *width, uint32_t *height) {
    unsigned w, h, most;
    char magic[2];
    if (fread(magic, 1, 2, file) != 2 || memcmp(magic, "P6", 2) != 0 || !take_number(file, &w) ||
        !take_number(file, &h) || !take_number(file, &most) || most != 255 || w < 1 || h < 1 ||
        w > SIDE_MOST || h > SIDE_MOST || fgetc(file) == EOF)
        return NULL;
    const size_t bytes = 3 * (size_t)w * h;
    uint8_t *pixels = malloc(bytes);
    if (pixels && fread(pixels, 1, bytes, file) == bytes) {
        *width = w;
        *height = h;
        return pixels;
    }
    free(pixels);
    return NULL;
}

static int convert(const char *from, const char *to) {
    uint32_t width, height;
    struct strbuf bytes;
    FILE *file = fopen(from, "rb");
    if (!file)
        return fail(from, "cannot be opened");
    uint8_t *pixels = read_ppm(file, &width, &height);
    fclose(file);
    if (!pixels)
        return fail(from, "is not a binary PPM of 8 bits, or ends too early");
    strbuf_init(&bytes);
    encode_png(width, height, pixels, NULL, &bytes);
    const int status = write_file(to, &bytes);
    strbuf_finish(&bytes);
    free(pixels);
    return status;
}

// ---- the command line

static bool read_side(str text, uint32_t *out) {
    int64_t value;
    if (number_parse_integer(text, &value) != NUMBER_OK || value < 1 || value > SIDE_MOST)
        return false;
    *out = (uint32_t)value;
    return true;
}

static bool read_option(struct options *o, int letter, const char *text) {
    const size_t x = strcspn(text, "x");
    switch (letter) {
    case 'a':
        o->assets = str_from(text);
        return true;
    case 's':
        return text[x] && read_side((str){text, x}, &o->width) &&
               read_side(str_from(text + x + 1), &o->height);
    case 't':
        if (o->set_count < SETS_MOST)
            o->sets[o->set_count++] = str_from(text);
        return o->set_count < SETS_MOST;
    default:
        return false;
    }
}

int main(int argc, char **argv) {
    static const struct option table[] = {
        {"assets", 1, NULL, 'a'}, {"size", 1, NULL, 's'}, {"set", 1, NULL, 't'}, {NULL, 0, NULL, 0}};
    struct options o = {.assets = str_from(getenv("GLINT_ASSETS"))};
    bool good = true;
    for (int letter; good && (letter = getopt_long(argc, argv, "", table, NULL)) != -1;)
        good = read_option(&o, letter, optarg ? optarg : "");
    good = good && argc - optind == 3;
    for (int i = 0; good && i < 3; i++)
        o.words[i] = argv[optind + i];
    if (good && strcmp(o.words[0], "png") == 0)
        return convert(o.words[1], o.words[2]);
    if (good && (strcmp(o.words[0], "pov") == 0 || strcmp(o.words[0], "tachyon") == 0))
        return export_scene(&o);
    fputs("usage: bench_export pov|tachyon SCENE OUT [--assets DIR] [--size WxH] [--set PATH=VALUE]...\n"
          "       bench_export png IN.ppm OUT.png\n",
          stderr);
    return 2;
}
