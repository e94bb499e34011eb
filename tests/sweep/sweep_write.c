// What families are made of, as numbers and as text.
#include "core/splitmix.h"
#include "tests/sweep/sweep_internal.h"

#include <stdio.h>

const struct sweep_family_info sweep_families[SWEEP_FAMILIES] = {
#define X(NAME, name, title) {#name, title},
#include "tests/sweep/families.def"
#undef X
};

// ---- numbers

uint64_t sweep_bits(struct sweep_writer *w) {
    return splitmix_next(&w->random);
}

double sweep_from(struct sweep_writer *w, double least, double most) {
    return least + (most - least) * ((double)(sweep_bits(w) >> 11) * 0x1p-53);
}

double sweep_magnitude(struct sweep_writer *w, double least, double most) {
    return exp(sweep_from(w, log(least), log(most)));
}

uint32_t sweep_count(struct sweep_writer *w, uint32_t least, uint32_t most) {
    return least + (uint32_t)(sweep_bits(w) % (most - least + 1));
}

bool sweep_chance(struct sweep_writer *w, double probability) {
    return sweep_from(w, 0, 1) < probability;
}

vec3 sweep_direction(struct sweep_writer *w) {
    const double z = sweep_from(w, -1, 1);
    const double angle = sweep_from(w, 0, 6.283185307179586);
    const double r = sqrt(1 - z * z);
    return (vec3){r * cos(angle), r * sin(angle), z};
}

vec3 sweep_inside(struct sweep_writer *w, vec3 lower, vec3 upper) {
    const double x = sweep_from(w, lower.x, upper.x), y = sweep_from(w, lower.y, upper.y);
    return (vec3){x, y, sweep_from(w, lower.z, upper.z)};
}

vec3 sweep_box(struct sweep_writer *w, double x0, double x1, double y0, double y1, double z0, double z1) {
    return sweep_inside(w, (vec3){x0, y0, z0}, (vec3){x1, y1, z1});
}

vec3 sweep_around(struct sweep_writer *w, double least, double most) {
    const double distance = least > 0 ? sweep_magnitude(w, least, most) : sweep_from(w, least, most);
    return vec3_mul(sweep_direction(w), distance);
}

vec3 sweep_color(struct sweep_writer *w) {
    return sweep_inside(w, (vec3){0.1, 0.1, 0.1}, (vec3){0.9, 0.9, 0.9});
}

vec3 sweep_apply(const mat3 *m, vec3 v) {
    const vec3 rows[3] = {{m->m[0][0], m->m[0][1], m->m[0][2]},
                          {m->m[1][0], m->m[1][1], m->m[1][2]},
                          {m->m[2][0], m->m[2][1], m->m[2][2]}};
    return (vec3){vec3_dot(rows[0], v), vec3_dot(rows[1], v), vec3_dot(rows[2], v)};
}

mat3 sweep_rotation(struct sweep_writer *w) {
    const vec3 a = sweep_direction(w);
    vec3 b = vec3_cross(a, sweep_direction(w));
    while (vec3_length(b) < 0.1)
        b = vec3_cross(a, sweep_direction(w));
    b = vec3_unit(b);
    const vec3 c = vec3_cross(a, b);
    return (mat3){{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}}};
}

// ---- text

void sweep_put_vector(struct strbuf *out, const char *key, vec3 v) {
    strbuf_format(out, "%s: [%.17g, %.17g, %.17g]", key, v.x, v.y, v.z);
}

static vec3 placed(const struct sweep_writer *w, vec3 p) {
    return vec3_add(w->offset, vec3_mul(sweep_apply(&w->turn, p), w->scale));
}

static vec3 turned(const struct sweep_writer *w, vec3 v) {
    return vec3_mul(sweep_apply(&w->turn, v), w->scale);
}

// A Radiance picture of random colours between 0.05 and 0.95.
static const char *make_image(struct sweep_writer *w) {
    struct sweep_scene *scene = w->scene;
    struct sweep_mesh *image = &scene->meshes[scene->mesh_count];
    const char *family = sweep_families[scene->family].name;
    snprintf(image->name, sizeof image->name, "%s-%u-%u.hdr", family, scene->number, scene->mesh_count++);
    strbuf_init(&image->text);
    const uint32_t width = sweep_count(w, 2, 64), height = sweep_count(w, 2, 64);
    strbuf_format(&image->text, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %u +X %u\n", height, width);
    for (uint32_t i = 0; i < width * height; i++) {
        const unsigned char texel[4] = {(unsigned char)sweep_count(w, 13, 243),
                                        (unsigned char)sweep_count(w, 13, 243),
                                        (unsigned char)sweep_count(w, 13, 243), 128};
        strbuf_add(&image->text, texel, sizeof texel);
    }
    return image->name;
}

// `scale`: how much longer the body's own coordinates are than the writer's.
static void put_paint(struct sweep_writer *w, struct strbuf *out, const struct sweep_paint *p, double scale) {
    strbuf_format(out, "    material:\n      albedo: [%.17g, %.17g, %.17g, %.17g]\n", p->diffuse, p->specular,
                  p->reflection, p->refraction);
    if (p->image) {
        strbuf_format(out, "      diffuse_color: {image: {file: %s, repeat: %.17g}}\n", make_image(w),
                      p->repeat);
    } else if (p->cell > 0) {
        strbuf_format(out,
                      "      diffuse_color: {checker: {colors: [[%.17g, %.17g, %.17g], [%.17g, %.17g, "
                      "%.17g]], size: %.17g}}\n",
                      p->color.x, p->color.y, p->color.z, p->other.x, p->other.y, p->other.z,
                      p->cell * scale);
    } else {
        sweep_put_vector(out, "      diffuse_color", p->color);
        strbuf_char(out, '\n');
    }
    strbuf_format(out, "      specular_exponent: %.17g\n      refractive_index: %.17g\n", p->exponent,
                  p->index);
    if (p->roughness > 0)
        strbuf_format(out, "      roughness: %.17g\n", p->roughness);
}

// ---- materials

struct sweep_paint sweep_matt(struct sweep_writer *w) {
    struct sweep_paint p = {.diffuse = sweep_from(w, 0.5, 1), .exponent = 32, .index = 1};
    p.color = sweep_color(w);
    if (sweep_chance(w, 0.3))
        p.specular = sweep_from(w, 0.1, 0.6);
    return p;
}

struct sweep_paint sweep_checkered(struct sweep_writer *w, double cell) {
    struct sweep_paint p = sweep_matt(w);
    p.other = vec3_sub((vec3){1, 1, 1}, p.color);
    p.color = vec3_mul(p.color, 0.5);
    p.cell = cell;
    return p;
}

struct sweep_paint sweep_mirror(struct sweep_writer *w) {
    struct sweep_paint p = sweep_matt(w);
    p.diffuse = sweep_from(w, 0, 0.3);
    p.reflection = sweep_from(w, 0.5, 1);
    return p;
}

struct sweep_paint sweep_glass(struct sweep_writer *w, double index) {
    struct sweep_paint p = sweep_matt(w);
    p.diffuse = sweep_from(w, 0, 0.2);
    p.reflection = sweep_chance(w, 0.6) ? sweep_from(w, 0.02, 0.3) : 0;
    p.refraction = sweep_from(w, 0.6, 0.98);
    p.index = index;
    return p;
}

struct sweep_paint sweep_any_paint(struct sweep_writer *w) {
    switch (sweep_count(w, 0, 4)) {
    case 0:
        return sweep_mirror(w);
    case 1:
        return sweep_glass(w, sweep_from(w, 1.1, 2.4));
    case 2:
        return sweep_checkered(w, sweep_from(w, 0.1, 1));
    default:
        return sweep_matt(w);
    }
}

// ---- things

void sweep_camera(struct sweep_writer *w, vec3 position, vec3 look_at, double fov) {
    const vec3 along = vec3_unit(vec3_sub(look_at, position));
    const vec3 up = fabs(along.y) < 0.98 ? (vec3){0.02, 1, 0.01} : (vec3){0.3, 0.1, 1};
    struct strbuf *out = &w->head;
    strbuf_cstr(out, "camera:\n");
    sweep_put_vector(out, "  position", placed(w, position));
    sweep_put_vector(out, "\n  direction", sweep_apply(&w->turn, along));
    sweep_put_vector(out, "\n  up", sweep_apply(&w->turn, up));
    strbuf_format(out, "\n  fov: %.17g\n", fov);
    w->has_camera = true;
}

void sweep_light(struct sweep_writer *w, vec3 position, double intensity) {
    sweep_put_vector(&w->lights, "  - position", placed(w, position));
    strbuf_format(&w->lights, "\n    intensity: %.17g\n", intensity);
}

void sweep_sun(struct sweep_writer *w, vec3 travels, double intensity) {
    sweep_put_vector(&w->lights, "  - direction", sweep_apply(&w->turn, travels));
    strbuf_format(&w->lights, "\n    intensity: %.17g\n", intensity);
}

void sweep_aperture(struct sweep_writer *w, double aperture, double focus) {
    strbuf_format(&w->head, "  aperture: %.17g\n  focus: %.17g\n", aperture * w->scale, focus * w->scale);
}

void sweep_ambient(struct sweep_writer *w, double intensity, double occlusion) {
    strbuf_format(&w->head, "ambient: {color: [0.9, 0.95, 1], intensity: %.17g, occlusion: %.17g}\n",
                  intensity, occlusion * w->scale);
}

void sweep_ball_light(struct sweep_writer *w, vec3 position, double radius, double intensity) {
    sweep_light(w, position, intensity);
    strbuf_format(&w->lights, "    radius: %.17g\n", radius * w->scale);
}

void sweep_panel_light(struct sweep_writer *w, vec3 corner, double side, double intensity) {
    sweep_put_vector(&w->lights, "  - rectangle: {corner", placed(w, corner));
    sweep_put_vector(&w->lights, ", edge_u", turned(w, (vec3){side, 0, 0}));
    sweep_put_vector(&w->lights, ", edge_v", turned(w, (vec3){0, 0, side}));
    strbuf_format(&w->lights, "}\n    intensity: %.17g\n", intensity);
}

void sweep_sphere(struct sweep_writer *w, vec3 center, double radius, const struct sweep_paint *paint) {
    sweep_put_vector(&w->spheres, "  - center", placed(w, center));
    strbuf_format(&w->spheres, "\n    radius: %.17g\n", radius * w->scale);
    put_paint(w, &w->spheres, paint, w->scale);
}

void sweep_rectangle(struct sweep_writer *w, vec3 corner, vec3 u, vec3 v, const struct sweep_paint *paint) {
    sweep_put_vector(&w->rectangles, "  - corner", placed(w, corner));
    sweep_put_vector(&w->rectangles, "\n    edge_u", turned(w, u));
    sweep_put_vector(&w->rectangles, "\n    edge_v", turned(w, v));
    strbuf_char(&w->rectangles, '\n');
    put_paint(w, &w->rectangles, paint, w->scale);
}

void sweep_close(struct sweep_writer *w) {
    w->scene->closed = true;
    w->background = (vec3){1, 1, 1};
    w->intensity = 1e6;
}

// ---- meshes

// Half of the meshes are written where they are; the model places the others.
void sweep_mesh_begin(struct sweep_writer *w) {
    struct sweep_scene *scene = w->scene;
    struct sweep_mesh *mesh = &scene->meshes[scene->mesh_count];
    const char *family = sweep_families[scene->family].name;
    snprintf(mesh->name, sizeof mesh->name, "%s-%u-%u.obj", family, scene->number, scene->mesh_count++);
    strbuf_init(&mesh->text);
    w->mesh = &mesh->text;
    w->mesh_vertices = 0;
    w->baked = sweep_chance(w, 0.5);
}

uint32_t sweep_vertex(struct sweep_writer *w, vec3 p) {
    const vec3 at = w->baked ? placed(w, p) : sweep_apply(&w->turn, p);
    strbuf_format(w->mesh, "v %.17g %.17g %.17g\n", at.x, at.y, at.z);
    return ++w->mesh_vertices;
}

void sweep_face(struct sweep_writer *w, uint32_t a, uint32_t b, uint32_t c) {
    strbuf_format(w->mesh, "f %u %u %u\n", a, b, c);
}

void sweep_mesh_end(struct sweep_writer *w, bool smooth, const struct sweep_paint *paint) {
    const struct sweep_mesh *mesh = &w->scene->meshes[w->scene->mesh_count - 1];
    strbuf_format(&w->models, "  - mesh: %s\n", mesh->name);
    if (!w->baked) {
        strbuf_format(&w->models, "    scale: %.17g\n", w->scale);
        sweep_put_vector(&w->models, "    translation", w->offset);
        strbuf_char(&w->models, '\n');
    }
    if (smooth)
        strbuf_cstr(&w->models, "    smooth: true\n");
    put_paint(w, &w->models, paint, w->baked ? w->scale : 1);
    w->mesh = NULL;
}
