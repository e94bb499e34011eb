// POV-Ray 3.7. Its camera takes any right and up vector, so that our right-handed space stays as it is.
#include "bench/export/export.h"

#include "core/arena.h"
#include "grammar/ir.h"

static void put(struct strbuf *out, const char *before, vec3 v) {
    strbuf_format(out, "%s<%.9g,%.9g,%.9g>", before, v.x, v.y, v.z);
}

// ---- head

static void put_head(const struct export_input *in, struct strbuf *out) {
    const struct view_camera *c = &in->view->camera;
    const struct ir_trace *trace = &in->scene->ir->trace;
    const double aspect = (double)in->width / in->height;
    // Its levels are counted from 1.
    strbuf_format(out,
                  "#version 3.7;\nglobal_settings { assumed_gamma 1 ambient_light 0 max_trace_level %d "
                  "adc_bailout %.9g }\n",
                  trace->max_depth + 1 < 255 ? trace->max_depth + 1 : 255, trace->min_weight);
    put(out, "camera { perspective location ", c->position);
    put(out, " direction ", c->forward);
    put(out, " right ", vec3_mul(c->right, 2 * aspect * c->tan_half_fov));
    put(out, " up ", vec3_mul(c->up, 2 * c->tan_half_fov));
    strbuf_cstr(out, " }\n");
}

static void put_background(const struct export_input *in, struct strbuf *out) {
    const struct scene_background *b = &in->scene->background;
    const bool srgb = in->scene->ir->image.transfer == IR_TRANSFER_SRGB;
    if (!b->picture) {
        put(out, "background { rgb ", b->color);
        strbuf_cstr(out, " }\n");
        return;
    }
    const char *kind = b->picture->depth == PICTURE_RGBE                   ? "hdr"
                       : str_ends_with_nocase(in->background_path, ".png") ? "png"
                                                                           : "jpeg";
    // Its maps begin at +x, ours at -x.
    strbuf_format(
        out,
        "sky_sphere { pigment { image_map { %s \"%.*s\" %s map_type 1 interpolate 2 } rotate y*%.9g } }\n",
        kind, STR_ARG(in->background_path),
        b->picture->depth == PICTURE_RGBE ? ""
        : srgb                            ? "gamma srgb"
                                          : "gamma 1",
        180 + in->background_rotation);
}

static void put_lights(const struct export_input *in, struct strbuf *out) {
    vec3 lower, upper;
    const bool bounded = scene_bounds(in->scene, &lower, &upper);
    const vec3 middle = bounded ? vec3_mul(vec3_add(lower, upper), 0.5) : (vec3){0, 0, 0};
    const double far = bounded ? 10 * vec3_length(vec3_sub(upper, lower)) : 1;
    for (uint32_t i = 0; i < in->view->light_count; i++) {
        const struct view_light *light = &in->view->lights[i];
        const vec3 place =
            light->directional ? vec3_add(middle, vec3_mul(light->to_light, far)) : light->position;
        // 2 / (1 + d^2) of half the light is nearly 1 / d^2.
        put(out, "light_source { ", place);
        put(out, ", rgb ", light->inverse_square ? vec3_mul(light->emission, 0.5) : light->emission);
        if (light->directional)
            put(out, " parallel point_at ", middle);
        strbuf_cstr(out, light->inverse_square ? " fade_distance 1 fade_power 2 }\n" : " }\n");
    }
}

// ---- materials

// Cells are counted in the body's own coordinates; those of a parallelogram along its edges.
static void put_cells(const struct scene_body *body, double cell, struct strbuf *out) {
    affine3 map = body->object_to_world;
    const mat3 m = map.linear;
    if (body->shape == SCENE_SPHERE)
        map.linear = (mat3){{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (body->shape == SCENE_PARALLELOGRAM) {
        const vec3 u = vec3_unit(mat3_column(m, 0)), v = vec3_unit(mat3_column(m, 1));
        const vec3 n = vec3_unit(vec3_cross(u, v));
        map.linear = (mat3){{{u.x, v.x, n.x}, {u.y, v.y, n.y}, {u.z, v.z, n.z}}};
    }
    // A flat one lies in the middle of its cells, where rounding does no harm.
    strbuf_format(out, " %s scale %.9g matrix <",
                  body->shape == SCENE_PARALLELOGRAM ? "translate -z*0.5" : "", cell);
    for (int i = 0; i < 3; i++) {
        const vec3 column = mat3_column(map.linear, i);
        strbuf_format(out, "%.9g,%.9g,%.9g,", column.x, column.y, column.z);
    }
    strbuf_format(out, "%.9g,%.9g,%.9g>", map.offset.x, map.offset.y, map.offset.z);
}

// What is transmitted is taken from its diffuse colour, which ours is not.
static void put_texture(const struct scene_material *m, const struct scene_body *body, struct strbuf *out) {
    const double transmit = fmin(fmax(m->refraction, 0), 1);
    const double diffuse = transmit < 1 ? m->diffuse_weight / (1 - transmit) : 0;
    strbuf_cstr(out, "texture { pigment {");
    if (m->checker)
        strbuf_cstr(out, " checker");
    for (int i = 0; i <= m->checker; i++) {
        put(out, " color rgb ", m->diffuse[i]);
        strbuf_format(out, " transmit %.9g", transmit);
    }
    if (m->checker)
        put_cells(body, m->cell, out);
    strbuf_format(
        out,
        " } finish { ambient 0 emission 0 diffuse %.9g phong %.9g phong_size %.9g reflection { %.9g } } }",
        diffuse, m->specular_weight * export_largest(m->specular), m->specular_exponent, m->reflection);
}

static void put_interior(const struct scene_material *m, const struct scene_body *body, struct strbuf *out) {
    if (m->refraction > 0)
        strbuf_format(out, " interior { ior %.9g }", body->closed ? m->refractive_index : 1.0);
}

// ---- bodies

static void put_triple(struct strbuf *out, uint32_t first, uint32_t texture, bool textures) {
    strbuf_format(out, "<%u,%u,%u>", first, first + 1, first + 2);
    if (textures)
        strbuf_format(out, ",%u", texture);
    strbuf_char(out, '\n');
}

static uint32_t group_of(const struct scene_body *body, uint32_t triangle) {
    return body->mesh ? body->mesh->triangles[triangle].group : 0;
}

static void put_corners(const struct scene_body *body, struct strbuf *out) {
    strbuf_format(out, "mesh2 { vertex_vectors { %u\n", 3 * body->triangle_count);
    for (uint32_t i = 0; i < body->triangle_count; i++) {
        vec3 corners[3];
        scene_corners(body, &body->object_to_world, i, corners);
        for (int k = 0; k < 3; k++)
            put(out, ",", corners[k]);
        strbuf_char(out, '\n');
    }
    strbuf_cstr(out, "}\n");
}

static void put_normals(const struct scene_body *body, struct strbuf *out) {
    struct arena arena;
    arena_init(&arena, SIZE_MAX);
    const vec3 *normals = mesh_smooth_normals(body->mesh, body->crease_angle, &arena);
    strbuf_format(out, "normal_vectors { %u\n", 3 * body->triangle_count);
    for (uint32_t i = 0; i < body->triangle_count; i++) {
        vec3 n[3];
        if (!export_normals(body, normals, i, n))
            n[0] = n[1] = n[2] = (vec3){0, 1, 0};
        for (int k = 0; k < 3; k++)
            put(out, ",", n[k]);
        strbuf_char(out, '\n');
    }
    strbuf_cstr(out, "}\n");
    arena_finish(&arena);
}

static void put_mesh(const struct scene *scene, const struct scene_body *body, struct strbuf *out) {
    const struct scene_material *first = &scene->materials[body->materials[0]];
    put_corners(body, out);
    if (body->smooth && body->mesh)
        put_normals(body, out);
    strbuf_format(out, "texture_list { %u", body->group_count);
    for (uint32_t i = 0; i < body->group_count; i++) {
        strbuf_char(out, ',');
        put_texture(&scene->materials[body->materials[i]], body, out);
    }
    strbuf_format(out, "}\nface_indices { %u\n", body->triangle_count);
    for (uint32_t i = 0; i < body->triangle_count; i++) {
        strbuf_char(out, ',');
        put_triple(out, 3 * i, group_of(body, i), true);
    }
    strbuf_char(out, '}');
    put_interior(first, body, out);
    strbuf_cstr(out, " }\n");
}

static void put_sphere(const struct scene *scene, const struct scene_body *body, struct strbuf *out) {
    const struct scene_material *m = &scene->materials[scene_body_material(body, 0)];
    put(out, "sphere { ", body->object_to_world.offset);
    strbuf_format(out, ", %.9g ", body->radius);
    put_texture(m, body, out);
    put_interior(m, body, out);
    strbuf_cstr(out, " }\n");
}

const char *export_pov(const struct export_input *in, struct strbuf *out) {
    put_head(in, out);
    put_background(in, out);
    put_lights(in, out);
    for (uint32_t i = 0; i < in->scene->body_count; i++) {
        const struct scene_body *body = &in->scene->bodies[i];
        if (body->shape == SCENE_SPHERE)
            put_sphere(in->scene, body, out);
        else if (body->triangle_count)
            put_mesh(in->scene, body, out);
    }
    return in->scene->ir->trace.shadows ? "" : "shadows cannot be switched off";
}
