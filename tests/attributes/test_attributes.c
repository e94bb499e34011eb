// Every attribute is used wherever light is computed: by the device's tracer, by its path log, by the
// reference.
//
// Random scenes that have an attribute are rendered as they are and with another value of it. Where the
// device's picture changes visibly, the reference's must change in the same way, and `pick` must tell the
// colours of both. A row of the table whose changes no picture shows, in any of the scenes, fails by its
// name: nothing uses it. Left out are texts (names, and files, which have tests of their own) and what holds
// other rows.
//
// Usage: test_attributes WORK_FOLDER [ROW]...
// A ROW is the name of one, as "roughness", of all elements that have it, or "material.roughness"; none: all
// rows. Seed by seed a line says how many are proven.
#include "bench_files.h"

#include "files/output.h"
#include "grammar/ir.h"
#include "grammar/ir_walk.h"
#include "grammar/print/ir_print.h"
#include "grammar/schema.h"
#include "render/pick.h"
#include "render/reference_shot.h"
#include "tests/generate/generate.h"
#include "tests/pictures/picture_kit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum {
    SEEDS = 60,       // at most: it ends where all rows are proven
    SEEDS_FAINT = 20, // after so many, rows whose changes only rounding shows count as proven
    ROWS_MAX = 256,
    TRIES_A_SCENE = 2, // elements in which a row is changed, of one scene
    TOP = 8,           // pixels that changed most, which the reference is asked about
    PATH_BYTES = 1024,
};

// A row of the table, or one component of weights.
struct use {
    const struct schema_element *schema;
    const struct schema_row *row;
    uint32_t component;
    bool proven;
    bool faint;       // the picture changed in a bit, and nowhere to be seen
    const char *lack; // what failed where it was tried
    uint32_t tries;   // in this scene
};

struct pictures {
    struct session session;
    struct image device, reference;
    struct image_display display;
    bool has_reference;
};

struct bench {
    struct picture_kit kit;
    const char *work;
    char **only; // rows, ending with NULL; none: all
    struct use uses[ROWS_MAX];
    uint32_t count;
    struct arena arena;
    struct ir_scene *scene; // of this seed
    struct pictures before; // as it is, once a change asks for it
    bool asked_before, has_before;
};

// ---- the rows

// When pixels have enough samples is a question that only the device asks: tests/adaptive.
static bool is_stop(const struct schema_row *row) {
    return strcmp(row->name, "error") == 0 || strcmp(row->name, "min_samples") == 0;
}

static bool is_light(const struct schema_row *row) {
    return row->kind != SCHEMA_TEXT && row->kind != SCHEMA_ELEMENT && row->kind != SCHEMA_LIST &&
           row->range != SCHEMA_RANGE_VERSION && !row->plain && !is_stop(row);
}

// What moves shows in a frame, not in the picture of the scene: tests/batch.
static bool is_motion(const struct schema_element *schema) {
    return schema == &SCHEMA_ANIMATION || schema == &SCHEMA_TRACK || schema == &SCHEMA_KEYFRAME;
}

// What makes copies: they are made before a scene is drawn (tests/equal, tests/cli/run_copies.sh and
// run_objects.sh).
static bool is_copying(const struct schema_element *schema) {
    return schema == &SCHEMA_VARIABLE || schema == &SCHEMA_OBJECT || schema == &SCHEMA_INSTANCE ||
           schema == &SCHEMA_MATRIX || schema == &SCHEMA_MATRIX_ROW;
}

// What a mesh of the scene is made of: random points are not shapes (tests/unit/assets makes those).
static bool is_made(const struct schema_element *schema) {
    const struct schema_element *const made[] = {&SCHEMA_MESH,  &SCHEMA_LATHE,   &SCHEMA_OUTLINE_POINT,
                                                 &SCHEMA_TORUS, &SCHEMA_EXTRUDE, &SCHEMA_HOLE,
                                                 &SCHEMA_FACES, &SCHEMA_VERTEX,  &SCHEMA_UV,
                                                 &SCHEMA_FACE,  &SCHEMA_CORNER,  &SCHEMA_MESH_TEXT};
    for (size_t i = 0; i < sizeof made / sizeof *made; i++)
        if (schema == made[i])
            return true;
    return false;
}

static bool is_asked_for(const struct bench *b, const struct schema_element *schema,
                         const struct schema_row *row) {
    char whole[256];
    snprintf(whole, sizeof whole, "%s.%s", schema->name, row->name);
    bool asked = !b->only[0];
    for (char **only = b->only; *only; only++)
        asked |= strcasecmp(*only, whole) == 0 || strcmp(*only, row->name) == 0;
    return asked;
}

static void list_uses(struct bench *b) {
    for (uint32_t i = 0; schema_elements[i]; i++)
        for (uint32_t k = 0; k < schema_elements[i]->row_count && !is_motion(schema_elements[i]); k++) {
            const struct schema_element *schema = schema_elements[i];
            const struct schema_row *row = &schema->rows[k];
            const bool asked =
                is_light(row) && !is_made(schema) && !is_copying(schema) && is_asked_for(b, schema, row);
            const uint32_t components = !asked ? 0 : row->kind == SCHEMA_WEIGHTS ? 4 : 1;
            for (uint32_t c = 0; c < components && b->count < ROWS_MAX; c++)
                b->uses[b->count++] = (struct use){.schema = schema, .row = row, .component = c};
        }
}

// ---- another value

static double in_range(enum schema_range range, double wanted, double otherwise) {
    return schema_in_range(range, wanted) ? wanted : otherwise;
}

static double other_number(const struct schema_row *row, double value) {
    if (row->range == SCHEMA_RANGE_FRACTION)
        return value < 0.25 ? 0.5 : 0.0;
    if (row->range == SCHEMA_RANGE_EXPONENT)
        return value > 20 ? 3 : 60;
    if (row->range == SCHEMA_RANGE_ANGLE)
        return value + 40;
    if (row->range == SCHEMA_RANGE_OPENING && value > 90) // faces of the meshes differ by some 70 degrees
        return 20;
    return in_range(row->range, value * 1.4 + 0.05, value * 0.7);
}

static vec3 other_vector(const struct schema_row *row, vec3 v) {
    if (row->range == SCHEMA_RANGE_SCALE)
        return vec3_mul(v, 1.4);
    const double size = row->range == SCHEMA_RANGE_ANGLE ? 40 : 0.4 * fmax(vec3_max_abs(v), 0.5);
    return vec3_add(v, (vec3){0.8 * size, size, -0.6 * size});
}

static bool other_mesh(struct ir_reference *ref) {
    *ref = (struct ir_reference){bench_meshes[str_equal(ref->name, bench_meshes[0])], IR_NO_INDEX};
    return true;
}

// false: there is none.
static bool other_material(const struct ir_scene *scene, struct ir_reference *ref) {
    for (uint32_t i = 0; i < scene->materials.count; i++)
        if (i != ref->index && scene->materials.items[i].name.len) {
            *ref = (struct ir_reference){scene->materials.items[i].name, i};
            return true;
        }
    return false;
}

static uint32_t word_count(const struct schema_row *row) {
    uint32_t count = 0;
    while (row->words[count])
        count++;
    return count;
}

static bool change(const struct bench *b, const struct use *use, void *field) {
    const struct schema_row *row = use->row;
    switch (row->kind) {
    case SCHEMA_BOOLEAN:
        *(bool *)field = !*(bool *)field;
        return true;
    case SCHEMA_INTEGER: {
        int32_t *value = field;
        *value = row->range == SCHEMA_RANGE_DEPTH      ? (*value > 1 ? 1 : 6)
                 : row->range == SCHEMA_RANGE_PRIORITY ? (*value > 0 ? -1000 : 1000)
                                                       : *value + 1;
        return schema_in_range(row->range, *value);
    }
    case SCHEMA_NUMBER:
        *(double *)field = other_number(row, *(double *)field);
        return true;
    case SCHEMA_WORD:
        *(unsigned *)field = (*(unsigned *)field + 1) % word_count(row);
        return true;
    case SCHEMA_PAIR:
        ((struct ir_pair *)field)->u = other_number(row, ((struct ir_pair *)field)->u);
        return true;
    case SCHEMA_POINT:
        ((struct ir_point *)field)->y = other_number(row, ((struct ir_point *)field)->y);
        return true;
    case SCHEMA_QUAD:
        ((struct ir_quad *)field)->t = other_number(row, ((struct ir_quad *)field)->t);
        return true;
    case SCHEMA_VECTOR:
        *(vec3 *)field = other_vector(row, *(vec3 *)field);
        return true;
    case SCHEMA_COLOR: {
        struct ir_color *color = field;
        const bool is_dark = !color->is_hex && color->r + color->g + color->b < 1;
        *color =
            is_dark ? (struct ir_color){.r = 0.9, .g = 0.8, .b = 0.7} : (struct ir_color){.r = 0.1, .b = 0.2};
        return true;
    }
    case SCHEMA_WEIGHTS:
        ((double *)field)[use->component] += ((double *)field)[use->component] < 0.5 ? 0.4 : -0.4;
        return true;
    case SCHEMA_REFERENCE:
        return row->child == &SCHEMA_MESH ? other_mesh(field) : other_material(b->scene, field);
    default:
        return false;
    }
}

// ---- pictures

static bool write_scene(const struct bench *b, char path[PATH_BYTES]) {
    struct strbuf text;
    strbuf_init(&text);
    snprintf(path, PATH_BYTES, "%s/scene.yaml", b->work);
    ir_write_yaml(b->scene, NULL, NULL, (struct ir_write_options){0}, &text);
    int error = output_whole(path, text.data, text.len);
    strbuf_finish(&text);
    return error == 0;
}

static bool load(struct bench *b, struct pictures *p) {
    char path[PATH_BYTES];
    *p = (struct pictures){.display = {0}};
    if (!write_scene(b, path))
        return false;
    const struct session_options options = {.path = str_from(path), .limits = limits_default()};
    session_load(&p->session, &options, b->kit.store);
    if (p->session.state != SESSION_LOADED || p->session.sink.errors)
        return false;
    p->display = image_display_of(p->session.image);
    return true;
}

static bool by_device(struct bench *b, struct pictures *p) {
    struct shot shot;
    struct render_statistics statistics;
    bool good = shot_open(&shot, &p->session, b->kit.gpu, 0) == SHOT_OK &&
                image_init(&p->device, shot.settings.width, shot.settings.height) &&
                shot_take(&shot, &p->device, NULL, &statistics) == SHOT_OK;
    shot_close(&shot);
    return good && p->session.sink.errors == 0;
}

static bool by_reference(struct pictures *p) {
    struct reference_shot shot;
    struct reference_statistics statistics;
    const struct reference_shot_options options = {.as_file = true, .no_cache = true};
    if (p->has_reference)
        return true;
    bool good = reference_shot_open(&shot, &p->session, 0, options) == SHOT_OK &&
                image_init(&p->reference, shot.settings.width, shot.settings.height) &&
                reference_shot_take(&shot, &p->reference, NULL, NULL, &statistics) == SHOT_OK;
    reference_shot_close(&shot);
    p->has_reference = good;
    return good;
}

static void finish(struct pictures *p) {
    image_finish(&p->device);
    image_finish(&p->reference);
    session_finish(&p->session);
}

// ---- comparing

static bool same_size(const struct image *a, const struct image *b) {
    return a->width == b->width && a->height == b->height;
}

static size_t value_count(const struct image *image) {
    return 3 * (size_t)image->width * image->height;
}

static bool same_shown(const struct pictures *a, const struct pictures *b) {
    const size_t count = value_count(&a->device);
    uint8_t *bytes = malloc(2 * count);
    if (!bytes)
        return true;
    image_to_bytes(&a->device, a->display, bytes);
    image_to_bytes(&b->device, b->display, bytes + count);
    const bool same = memcmp(bytes, bytes + count, count) == 0;
    free(bytes);
    return same;
}

static float change_of(const struct image *a, const struct image *b, size_t value) {
    return fabsf(b->rgb[value] - a->rgb[value]);
}

// The values that changed most, in order.
static uint32_t find_top(const struct image *a, const struct image *b, size_t top[TOP]) {
    uint32_t found = 0;
    for (size_t i = 0; i < value_count(a); i++) {
        const float change = change_of(a, b, i);
        if (!(change > 1.0f / 32) || (found == TOP && change <= change_of(a, b, top[TOP - 1])))
            continue;
        uint32_t at = found < TOP ? found++ : TOP - 1;
        for (; at > 0 && change > change_of(a, b, top[at - 1]); at--)
            top[at] = top[at - 1];
        top[at] = i;
    }
    return found;
}

static bool is_near(double a, double b, double size) {
    return fabs(a - b) <= 0.02 * size + 1e-4;
}

static double channel(vec3 color, size_t c) {
    return c == 0 ? color.x : c == 1 ? color.y : color.z;
}

// Whether the path log says the colour of this value in both tracers' pictures.
static bool pick_agrees(struct bench *b, struct pictures *p, size_t value) {
    struct pick pick;
    const uint32_t pixel = (uint32_t)(value / 3);
    if (p->session.image->samples != 1)
        return true;
    bool good = pick_take(&pick, &p->session, b->kit.gpu, 0, pixel % p->device.width, pixel / p->device.width,
                          0) == SHOT_OK;
    const double shown[2] = {p->device.rgb[value], p->reference.rgb[value]};
    for (int i = 0; good && i < 2; i++)
        good = is_near(channel(pick.logs[i].color, value % 3), shown[i], fabs(shown[i]));
    pick_finish(&pick);
    return good;
}

// Of the values that changed most, half at least change in the reference as they do on the device: the others
// may lie where rounding decides what a ray hits.
static const char *judge(struct bench *b, struct pictures *before, struct pictures *after) {
    size_t top[TOP] = {0};
    const uint32_t count = find_top(&before->device, &after->device, top);
    uint32_t agree = 0;
    bool told = false;
    if (!by_reference(before) || !by_reference(after))
        return "the reference makes no picture";
    for (uint32_t i = 0; i < count; i++) {
        const size_t v = top[i];
        const double device = (double)after->device.rgb[v] - (double)before->device.rgb[v];
        const double reference = (double)after->reference.rgb[v] - (double)before->reference.rgb[v];
        const bool agrees = fabs(device - reference) <= 0.1 * fabs(device);
        agree += agrees;
        told = told || (agrees && pick_agrees(b, after, v));
    }
    if (2 * agree < count)
        return "the reference does not use it as the device does";
    return told ? NULL : "the path that 'pick' tells has other colours";
}

// ---- all

static void note_change(struct bench *b, struct use *use, struct pictures *before, struct pictures *after) {
    size_t top[TOP];
    if (!same_size(&before->device, &after->device)) {
        use->proven = true;
        return;
    }
    const size_t bytes = value_count(&before->device) * sizeof(float);
    const bool same = memcmp(before->device.rgb, after->device.rgb, bytes) == 0;
    if (same && !same_shown(before, after)) { // tone: what is computed stays the same
        use->proven = true;
    } else if (!same && find_top(&before->device, &after->device, top)) {
        use->lack = judge(b, before, after);
        use->proven = use->lack == NULL;
    } else if (!same) {
        use->faint = true;
    }
}

static void *field_of(const struct use *use, void *element) {
    return schema_field(use->row, element);
}

static bool has_before(struct bench *b) {
    if (!b->asked_before)
        b->has_before = load(b, &b->before) && by_device(b, &b->before);
    b->asked_before = true;
    return b->has_before;
}

// true: the picture changed, and everything was as it must be, or was said.
static void try_element(struct bench *b, struct use *use, void *element) {
    struct ir_head *head = element;
    const uint64_t bit = UINT64_C(1) << (use->row - use->schema->rows);
    const struct ir_head head_before = *head;
    unsigned char field_before[64];
    struct pictures after;
    if (use->row->size > sizeof field_before || use->proven || use->tries >= TRIES_A_SCENE)
        return;
    memcpy(field_before, field_of(use, element), use->row->size);
    use->tries++;
    bool good = has_before(b);
    good = change(b, use, field_of(use, element)) && good;
    head->written |= bit;
    memset(&after, 0, sizeof after);
    bool loaded = good && load(b, &after);
    if (loaded && by_device(b, &after)) {
        note_change(b, use, &b->before, &after);
    }
    if (good)
        finish(&after);
    memcpy(field_of(use, element), field_before, use->row->size);
    *head = head_before;
}

static void try_rows(struct bench *b, const struct schema_element *schema, void *element) {
    for (uint32_t i = 0; i < b->count; i++)
        if (b->uses[i].schema == schema && ir_walk_taken(schema, b->uses[i].row, element))
            try_element(b, &b->uses[i], element);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_any_list list = ir_walk_list(row, element);
        if (!ir_walk_taken(schema, row, element))
            continue;
        if (row->kind == SCHEMA_ELEMENT)
            try_rows(b, row->child, schema_field(row, element));
        for (uint32_t k = 0; k < list.count; k++)
            try_rows(b, row->child, ir_walk_item(row, list, k));
    }
}

static uint32_t count_proven(const struct bench *b) {
    uint32_t proven = 0;
    for (uint32_t i = 0; i < b->count; i++)
        proven += b->uses[i].proven;
    return proven;
}

static bool is_faint(const struct use *use) {
    return use->faint && !use->lack;
}

static bool is_done(const struct bench *b, uint64_t seed) {
    for (uint32_t i = 0; i < b->count; i++)
        if (!b->uses[i].proven && !(seed >= SEEDS_FAINT && is_faint(&b->uses[i])))
            return false;
    return true;
}

static uint64_t row_bit(const struct schema_element *schema, const char *row) {
    return UINT64_C(1) << schema_find_row(schema, str_from(row));
}

static void write_row(const struct schema_element *schema, void *element, const char *row) {
    ((struct ir_head *)element)->written |= row_bit(schema, row);
}

// What few random scenes have: two balls of different glass that overlap where the camera looks.
static void overlap_glass(struct ir_scene *scene) {
    const struct ir_camera *camera = scene->cameras.items;
    if (scene->cameras.count == 0 || camera->view != IR_VIEW_LOOK_AT || scene->spheres.count < 2 ||
        scene->materials.count < 2 || !scene->materials.items[0].name.len ||
        !scene->materials.items[1].name.len)
        return;
    const double size = 0.3 * vec3_length(vec3_sub(camera->look_at, camera->position));
    for (uint32_t i = 0; i < 2; i++) {
        struct ir_sphere *ball = &scene->spheres.items[i];
        struct ir_material *glass = &scene->materials.items[i];
        ball->center = vec3_add(camera->look_at, (vec3){i ? 0.5 * size : 0, i ? 0.4 * size : 0, 0});
        ball->radius = 0.8 * size;
        ball->material = (struct ir_reference){glass->name, i};
        glass->albedo = (struct ir_weights){.specular = 0.3, .reflection = 0.1, .refraction = 0.9};
        glass->refractive_index = i ? 1.6 : 1.2;
        glass->priority = 0; // a tie, which any other value decides
        glass->attenuation_color = (struct ir_color){.r = 0.5, .g = 0.7, .b = 0.9};
        glass->attenuation_distance = size;
        write_row(&SCHEMA_SPHERE, ball, "material");
        write_row(&SCHEMA_MATERIAL, glass, "albedo");
        write_row(&SCHEMA_MATERIAL, glass, "refractive_index");
        write_row(&SCHEMA_MATERIAL, glass, "priority");
        write_row(&SCHEMA_MATERIAL, glass, "attenuation_color");
        write_row(&SCHEMA_MATERIAL, glass, "attenuation_distance");
    }
}

// Nor this: a lens, rough surfaces and samples enough to see them; mirrors that end at their first
// reflection; or parallel rays.
static void change_camera(struct ir_scene *scene, uint64_t seed) {
    struct ir_camera *camera = scene->cameras.items;
    if (scene->cameras.count == 0 || camera->view == IR_VIEW_ROTATION || seed % 3 == 0)
        return;
    const bool looks = camera->view == IR_VIEW_LOOK_AT;
    const vec3 way =
        looks ? vec3_sub(camera->look_at, camera->position) : vec3_mul(vec3_unit(camera->direction), 5);
    const double distance = vec3_length(way);
    write_row(&SCHEMA_CAMERA, camera, "projection");
    camera->projection = seed % 3 == 1 ? IR_PROJECTION_PERSPECTIVE : IR_PROJECTION_ORTHOGRAPHIC;
    if (seed % 3 == 2) {
        camera->size = distance;
        write_row(&SCHEMA_CAMERA, camera, "size");
        return;
    }
    const bool has_distance = seed % 2;
    scene->image.samples = 4;
    write_row(&SCHEMA_IMAGE, &scene->image, "samples");
    camera->fov = 50;
    write_row(&SCHEMA_CAMERA, camera, "fov");
    camera->aperture = 0.1 * distance;
    write_row(&SCHEMA_CAMERA, camera, "aperture");
    camera->focusing = has_distance ? IR_FOCUS_DISTANCE : IR_FOCUS_POINT;
    camera->focus = has_distance ? distance : 0;
    camera->focus_at = has_distance ? (vec3){0, 0, 0} : vec3_add(camera->position, way);
    camera->head.written &= ~(row_bit(&SCHEMA_CAMERA, "focus") | row_bit(&SCHEMA_CAMERA, "focus_at") |
                              row_bit(&SCHEMA_CAMERA, "focus_on"));
    write_row(&SCHEMA_CAMERA, camera, has_distance ? "focus" : "focus_at");
    for (uint32_t i = 0; i < scene->materials.count; i++) {
        struct ir_material *material = &scene->materials.items[i];
        material->albedo.reflection = 0.5;
        material->roughness = 0.3;
        write_row(&SCHEMA_MATERIAL, material, "albedo");
        write_row(&SCHEMA_MATERIAL, material, "roughness");
    }
    scene->trace.max_depth = 1;
    write_row(&SCHEMA_TRACE, &scene->trace, "max_depth");
}

static void try_seed(struct bench *b, uint64_t seed) {
    static const str materials[] = {{"Gold", 4}, {"Rest", 4}};
    static const str images[] = {{"sky.hdr", sizeof "sky.hdr" - 1}};
    const struct generate_options options = {.seed = seed,
                                             .renderable = true,
                                             .plain = true,
                                             .meshes = {bench_meshes, 1},
                                             .images = {images, 1},
                                             .mesh_materials = {materials, 2}};
    arena_init(&b->arena, (size_t)1 << 30);
    b->scene = generate_scene(&options, &b->arena);
    if (seed % 2)
        overlap_glass(b->scene);
    change_camera(b->scene, seed);
    for (uint32_t i = 0; i < b->count; i++)
        b->uses[i].tries = 0;
    try_rows(b, &SCHEMA_SCENE, b->scene);
    if (b->asked_before)
        finish(&b->before);
    b->asked_before = false;
    arena_finish(&b->arena);
}

static int tell(const struct bench *b) {
    int failed = 0;
    for (uint32_t i = 0; i < b->count; i++) {
        const struct use *use = &b->uses[i];
        if (use->proven || is_faint(use))
            continue;
        failed++;
        printf("FAIL '%s' of %s, component %u: %s\n", use->row->name, use->schema->name, use->component,
               use->lack ? use->lack : "no picture of the device changes with it");
    }
    printf("%u rows and components, %d failed\n", b->count, failed);
    return failed;
}

int main(int argc, char **argv) {
    static struct bench b;
    if (argc < 2 || !picture_kit_open(&b.kit))
        return 77;
    b.work = argv[1];
    b.only = argv + 2;
    list_uses(&b);
    if (b.count == 0)
        fprintf(stderr, "no row of that name changes a picture\n");
    bool good = !b.kit.by_reference && b.count > 0 && bench_write_sky(b.work) && bench_write_meshes(b.work);
    for (uint64_t seed = 0; good && seed < SEEDS && !is_done(&b, seed); seed++) {
        try_seed(&b, seed);
        printf("seed %d: %u of %u rows and components proven", (int)seed, count_proven(&b), b.count);
        for (uint32_t i = 0; i < b.count && b.count - count_proven(&b) <= 5; i++)
            if (!b.uses[i].proven)
                printf(", not %s.%s", b.uses[i].schema->name, b.uses[i].row->name);
        printf("\n");
        fflush(stdout);
    }
    int failed = tell(&b);
    return picture_kit_close(&b.kit) || failed || !good;
}
