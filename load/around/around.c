#include "load/around/around.h"

#include "core/angle.h"
#include "grammar/ir.h"
#include "grammar/mesh_format.h"
#include "grammar/schema.h"
#include "scene/transform.h"

#include <stdlib.h>
#include <string.h>

// Degrees that the view is turned and lowered by, and its angle: every ray goes down by at least ELEVATION -
// FOV / 2, so only the floor is seen behind the mesh.
#define AZIMUTH   20.0
#define ELEVATION 15.0
#define FOV       20.0

#define MARGIN      1.16 // half the picture, as a multiple of half the mesh's extent in it
#define FLOOR       50.0 // half its width, as a multiple of the mesh's largest extent
#define OCCLUSION   0.4  // distance within which a body blocks ambient light, as a share of the extent
#define EXTENT_MOST 1e15 // keeps all numbers of the scene within the language's ranges
#define SMOOTH      0.9  // length of the mean normal above which a vertex looks smooth
#define SMOOTH_PART 0.9  // share of the vertices that must look so
enum {
    VERTICES_LOOKED_AT = 4096,
};

struct frame {
    mat3 turn;         // of the mesh
    vec3 lower, upper; // of the turned mesh
    double extent;     // the largest
    int exponent;      // numbers are rounded to this power of ten
    vec3 position, look_at;
};

// Rows as written: names, with spaces between them.
static void mark(struct ir_head *head, const struct schema_element *schema, const char *names) {
    for (str rest = str_from(names), name; rest.len; rest = str_slice(rest, name.len + 1, rest.len)) {
        const char *space = memchr(rest.ptr, ' ', rest.len);
        name = str_slice(rest, 0, space ? (size_t)(space - rest.ptr) : rest.len);
        head->written |= UINT64_C(1) << schema_find_row(schema, name);
    }
}

// ---- numbers

// Powers of ten are exact here, so the result is the double nearest to its few digits.
static double rounded(double value, int exponent) {
    const double power = pow(10, abs(exponent));
    return exponent < 0 ? round(value * power) / power : round(value / power) * power;
}

static vec3 rounded_point(vec3 p, int exponent) {
    return (vec3){rounded(p.x, exponent) + 0.0, rounded(p.y, exponent) + 0.0, rounded(p.z, exponent) + 0.0};
}

// ---- where things are

static unsigned traits_of(const struct mesh *mesh) {
    return mesh_formats[mesh_format_of_path(mesh->path)].traits;
}

static bool stands_on_its_side(const struct mesh *mesh) {
    return traits_of(mesh) & MESH_Z_UP;
}

static vec3 turned(const struct frame *f, vec3 p) {
    return mat3_apply(f->turn, p);
}

// false: it is a point, or too large. A box is as exact as the numbers that say where it is.
static bool find_box(const struct around_input *in, struct frame *f) {
    const vec3 a = turned(f, in->mesh->lower), b = turned(f, in->mesh->upper);
    f->lower = vec3_min(a, b);
    f->upper = vec3_max(a, b);
    f->extent = vec3_max_abs(vec3_sub(f->upper, f->lower));
    const double most = fmax(vec3_max_abs(f->lower), vec3_max_abs(f->upper));
    if (!(f->extent > 1e-6 * most && f->extent > 1 / EXTENT_MOST && most < EXTENT_MOST))
        return false;
    f->exponent = (int)floor(log10(f->extent)) - 2;
    return true;
}

// The camera that sees all of the mesh, in the middle of the picture.
static void place_camera(const struct around_input *in, const struct ir_image *image, struct frame *f) {
    const mat3 turn = mat3_rotation((vec3){-ELEVATION, AZIMUTH, 0});
    const vec3 right = mat3_column(turn, 0), up = mat3_column(turn, 1), back = mat3_column(turn, 2);
    const double tall = tan(FOV / 2 * RADIANS);
    const double wide =
        tall * (in->width > 0 ? in->width : image->width) / (in->height > 0 ? in->height : image->height);
    vec3 middle = vec3_mul(vec3_add(f->lower, f->upper), 0.5);
    vec3 lower = {INFINITY, INFINITY, INFINITY}, upper = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = 0; i < in->mesh->position_count; i++) {
        const vec3 p = vec3_sub(turned(f, in->mesh->positions[i]), middle);
        const vec3 seen = {vec3_dot(p, right), vec3_dot(p, up), vec3_dot(p, back)};
        lower = vec3_least(lower, seen);
        upper = vec3_greatest(upper, seen);
    }
    middle = vec3_add(middle, vec3_mul(right, (lower.x + upper.x) / 2));
    middle = vec3_add(middle, vec3_mul(up, (lower.y + upper.y) / 2));
    double distance = 0;
    for (uint32_t i = 0; i < in->mesh->position_count; i++) {
        const vec3 p = vec3_sub(turned(f, in->mesh->positions[i]), middle);
        const double half = fmax(fabs(vec3_dot(p, right)) / wide, fabs(vec3_dot(p, up)) / tall);
        distance = fmax(distance, MARGIN * half + vec3_dot(p, back));
    }
    f->look_at = rounded_point(middle, f->exponent);
    f->position = rounded_point(vec3_add(middle, vec3_mul(back, distance)), f->exponent);
}

// ---- smooth or not

struct sampled {
    vec3 sum; // of unit normals
    uint32_t count;
};

static vec3 normal_of(const struct mesh *mesh, const uint32_t *corners) {
    const vec3 a = mesh->positions[corners[0]];
    return vec3_unit(
        vec3_cross(vec3_sub(mesh->positions[corners[1]], a), vec3_sub(mesh->positions[corners[2]], a)));
}

// Samples every `step`-th vertex: the normals of the faces around it.
static bool looks_smooth(const struct mesh *mesh, struct arena *arena) {
    if (mesh->normal_count)
        return true;
    const uint32_t step = mesh->position_count / VERTICES_LOOKED_AT + 1;
    struct sampled *sampled = ARENA_ARRAY(arena, struct sampled, mesh->position_count / step + 1);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++) {
            const uint32_t at = mesh->merged[mesh->triangles[t].corners[k]];
            if (at % step)
                continue;
            sampled[at / step].sum =
                vec3_add(sampled[at / step].sum, normal_of(mesh, mesh->triangles[t].corners));
            sampled[at / step].count++;
        }
    uint32_t seen = 0, smooth = 0;
    for (uint32_t i = 0; i <= (mesh->position_count - 1) / step; i++) {
        seen += sampled[i].count > 2;
        smooth += sampled[i].count > 2 && vec3_length(sampled[i].sum) > SMOOTH * sampled[i].count;
    }
    return seen && smooth > SMOOTH_PART * seen;
}

// ---- the scene

static struct ir_reference add_material(struct ir_scene *scene, struct arena *arena, const char *name,
                                        double specular, struct ir_color color) {
    struct ir_material *material = ARENA_PUSH(arena, &scene->materials);
    schema_init(&SCHEMA_MATERIAL, material);
    material->name = str_from(name);
    material->albedo = (struct ir_weights){.diffuse = 1, .specular = specular};
    material->diffuse_color.color = color;
    material->specular_exponent = 30;
    mark(&material->diffuse_color.head, &SCHEMA_PAINT, "color");
    mark(&material->head, &SCHEMA_MATERIAL, "name albedo diffuse_color");
    if (specular > 0)
        mark(&material->head, &SCHEMA_MATERIAL, "specular_exponent");
    mark(&scene->head, &SCHEMA_SCENE, "material");
    return (struct ir_reference){material->name, scene->materials.count - 1};
}

static void add_picture(struct ir_scene *scene) {
    scene->image.samples = 16;
    scene->image.transfer = IR_TRANSFER_SRGB;
    mark(&scene->image.head, &SCHEMA_IMAGE, "samples transfer");
    mark(&scene->head, &SCHEMA_SCENE, "image");
}

static void add_light(const struct frame *f, struct ir_scene *scene, struct arena *arena) {
    struct ir_light *light = ARENA_PUSH(arena, &scene->lights);
    schema_init(&SCHEMA_LIGHT, light);
    light->name = STR("key");
    light->kind = IR_LIGHT_DIRECTION;
    light->direction = (vec3){0.6, -1, -0.7};
    light->angle = 12;
    light->intensity = 0.9;
    light->color = (struct ir_color){.r = 1, .g = 0.96, .b = 0.9};
    mark(&light->head, &SCHEMA_LIGHT, "name direction angle intensity color");
    scene->ambient.color = (struct ir_color){.r = 0.18, .g = 0.2, .b = 0.24};
    scene->ambient.occlusion = rounded(OCCLUSION * f->extent, f->exponent);
    mark(&scene->ambient.head, &SCHEMA_AMBIENT, "color occlusion");
    scene->background.color = (struct ir_color){.r = 0.55, .g = 0.58, .b = 0.62};
    mark(&scene->background.head, &SCHEMA_BACKGROUND, "color");
    mark(&scene->head, &SCHEMA_SCENE, "light ambient background");
}

static void add_camera(const struct frame *f, struct ir_scene *scene, struct arena *arena) {
    struct ir_camera *camera = ARENA_PUSH(arena, &scene->cameras);
    schema_init(&SCHEMA_CAMERA, camera);
    camera->name = STR("main");
    camera->position = f->position;
    camera->view = IR_VIEW_LOOK_AT;
    camera->look_at = f->look_at;
    camera->fov = FOV;
    mark(&camera->head, &SCHEMA_CAMERA, "name position look_at fov");
    mark(&scene->head, &SCHEMA_SCENE, "camera");
}

// Just below the mesh: where two surfaces share a plane, neither shows well.
static void add_floor(const struct frame *f, struct ir_scene *scene, struct arena *arena) {
    struct ir_rectangle *floor_of = ARENA_PUSH(arena, &scene->rectangles);
    schema_init(&SCHEMA_RECTANGLE, floor_of);
    const double half = rounded(FLOOR * f->extent, f->exponent + 2), step = pow(10, f->exponent);
    const vec3 middle = rounded_point(f->look_at, f->exponent + 2);
    const double height = rounded(floor(f->lower.y / step - 0.1) * step, f->exponent);
    floor_of->name = STR("floor");
    floor_of->corner = (vec3){middle.x - half, height, middle.z + half};
    floor_of->edge_u = (vec3){2 * half, 0, 0};
    floor_of->edge_v = (vec3){0, 0, -2 * half};
    floor_of->material =
        add_material(scene, arena, "ground", 0, (struct ir_color){.r = 0.5, .g = 0.5, .b = 0.5});
    mark(&floor_of->head, &SCHEMA_RECTANGLE, "name corner edge_u edge_v material");
    mark(&scene->head, &SCHEMA_SCENE, "rectangle");
}

static bool has_materials(const struct mesh *mesh) {
    bool has = false;
    for (uint32_t i = 0; i < mesh->group_count; i++)
        has |= mesh->groups[i].name.len > 0;
    return has && (traits_of(mesh) & MESH_HOLDS_MATERIALS);
}

static void add_model(const struct around_input *in, struct ir_scene *scene) {
    struct ir_model *model = ARENA_PUSH(in->arena, &scene->models);
    schema_init(&SCHEMA_MODEL, model);
    model->mesh.name = in->name;
    mark(&model->head, &SCHEMA_MODEL, "mesh");
    if (!has_materials(in->mesh)) {
        model->material =
            add_material(scene, in->arena, "clay", 0.15, (struct ir_color){.r = 0.62, .g = 0.58, .b = 0.53});
        mark(&model->head, &SCHEMA_MODEL, "material");
    }
    if (looks_smooth(in->mesh, in->arena)) {
        model->smooth = true;
        mark(&model->head, &SCHEMA_MODEL, "smooth");
    }
    if (stands_on_its_side(in->mesh)) {
        model->rotation = (vec3){-90, 0, 0};
        mark(&model->head, &SCHEMA_MODEL, "rotation");
    }
    mark(&scene->head, &SCHEMA_SCENE, "model");
}

bool around_mesh(const struct around_input *in, struct ir_scene *out) {
    struct frame f = {.turn = mat3_rotation((vec3){stands_on_its_side(in->mesh) ? -90 : 0, 0, 0})};
    if (!find_box(in, &f))
        return false;
    schema_init(&SCHEMA_SCENE, out);
    out->version = 1;
    mark(&out->head, &SCHEMA_SCENE, "glint");
    add_picture(out);
    place_camera(in, &out->image, &f);
    add_light(&f, out, in->arena);
    add_camera(&f, out, in->arena);
    add_model(in, out);
    add_floor(&f, out, in->arena);
    return true;
}
