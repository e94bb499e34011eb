// Tachyon 0.99. It knows neither refraction nor images around a scene nor checkers: transparency goes
// straight on, the background is the image's mean, or the colour, and a checker is its even colour.
#include "bench/export/export.h"

#include "core/arena.h"
#include "core/srgb.h"
#include "grammar/ir.h"

enum {
    MEAN_STEP = 61, // every so many pixels of a background count
};

static void put(struct strbuf *out, const char *before, vec3 v) {
    strbuf_format(out, "%s%.9g %.9g %.9g", before, v.x, v.y, v.z);
}

// A place or a direction: its space is left-handed.
static void put_place(struct strbuf *out, const char *before, vec3 v) {
    put(out, before, (vec3){v.x, v.y, -v.z});
}

static vec3 mean_background(const struct export_input *in) {
    const struct scene_background *b = &in->scene->background;
    const struct picture *picture = b->picture;
    const bool srgb = in->scene->ir->image.transfer == IR_TRANSFER_SRGB;
    if (!picture)
        return b->color;
    double sum[3] = {0, 0, 0}, count = 0;
    for (size_t at = 0; at < (size_t)picture->width * picture->height; at += MEAN_STEP, count++)
        for (size_t c = 0; c < 3; c++) {
            if (picture_is_linear(picture)) {
                sum[c] += (double)picture_linear(picture, at, c);
                continue;
            }
            const double value = (double)picture_stored(picture, at, c) / picture_greatest(picture->depth);
            sum[c] += srgb ? srgb_decode(value) : value;
        }
    return vec3_mul((vec3){sum[0], sum[1], sum[2]}, b->intensity / count);
}

static void put_head(const struct export_input *in, struct strbuf *out) {
    const struct view_camera *c = &in->view->camera;
    // At a distance of ZOOM its picture is 1 high.
    strbuf_format(
        out,
        "BEGIN_SCENE\nRESOLUTION %u %u\nCAMERA\n PROJECTION PERSPECTIVE\n ZOOM %.9g\n ASPECTRATIO 1\n "
        "ANTIALIASING 0\n RAYDEPTH %d\n",
        in->width, in->height, 0.5 / c->tan_half_fov, in->scene->ir->trace.max_depth + 1);
    put_place(out, " CENTER ", c->position);
    put_place(out, "\n VIEWDIR ", c->forward);
    put_place(out, "\n UPDIR ", c->up);
    put(out, "\nEND_CAMERA\nBACKGROUND ", mean_background(in));
    strbuf_char(out, '\n');
}

static void put_lights(const struct export_input *in, struct strbuf *out) {
    for (uint32_t i = 0; i < in->view->light_count; i++) {
        const struct view_light *light = &in->view->lights[i];
        if (light->directional)
            put_place(out, "DIRECTIONAL_LIGHT DIRECTION ", vec3_neg(light->to_light));
        else
            put_place(out, "LIGHT CENTER ", light->position);
        strbuf_cstr(out, light->directional ? "" : " RAD 0.0");
        if (light->inverse_square)
            strbuf_cstr(out, " ATTENUATION CONSTANT 0 LINEAR 0 QUADRATIC 1");
        put(out, " COLOR ", light->emission);
        strbuf_char(out, '\n');
    }
}

// The reflection is called specular, the highlight phong.
static void put_materials(const struct scene *scene, struct strbuf *out) {
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const struct scene_material *m = &scene->materials[i];
        strbuf_format(out, "TEXDEF m%u AMBIENT 0 DIFFUSE %.9g SPECULAR %.9g OPACITY %.9g\n", i,
                      m->diffuse_weight, m->reflection, 1 - fmin(fmax(m->refraction, 0), 1));
        strbuf_format(out, " PHONG PLASTIC %.9g PHONG_SIZE %.9g",
                      m->specular_weight * export_largest(m->specular), m->specular_exponent);
        put(out, " COLOR ", m->diffuse[0]);
        strbuf_cstr(out, " TEXFUNC 0\n");
    }
}

static void put_triangles(const struct scene_body *body, struct strbuf *out) {
    static const char *const names[2][3] = {{" V0 ", " V1 ", " V2 "}, {" N0 ", " N1 ", " N2 "}};
    struct arena arena;
    arena_init(&arena, SIZE_MAX);
    const vec3 *normals =
        body->smooth && body->mesh ? mesh_smooth_normals(body->mesh, body->crease_angle, &arena) : NULL;
    for (uint32_t i = 0; i < body->triangle_count; i++) {
        vec3 parts[2][3];
        scene_corners(body, &body->object_to_world, i, parts[0]);
        const bool smooth = normals && export_normals(body, normals, i, parts[1]);
        strbuf_cstr(out, smooth ? "STRI" : "TRI");
        // In its space a triangle turns the other way, and it goes by that which side its normals are on.
        for (int part = 0; part <= smooth; part++)
            for (int k = 0; k < 3; k++)
                put_place(out, names[part][k], parts[part][body->mirrored ? k : (3 - k) % 3]);
        strbuf_format(out, " m%u\n", scene_body_material(body, i));
    }
    arena_finish(&arena);
}

static const char *lacks(const struct export_input *in) {
    bool refracts = false;
    for (uint32_t i = 0; i < in->scene->material_count; i++)
        refracts |= in->scene->materials[i].refraction > 0;
    if (in->scene->background.picture)
        return refracts ? "a flat background, no refraction, no checkers" : "a flat background, no checkers";
    return refracts ? "no refraction, no checkers" : "no checkers";
}

const char *export_tachyon(const struct export_input *in, struct strbuf *out) {
    put_head(in, out);
    put_lights(in, out);
    put_materials(in->scene, out);
    for (uint32_t i = 0; i < in->scene->body_count; i++) {
        const struct scene_body *body = &in->scene->bodies[i];
        if (body->shape != SCENE_SPHERE) {
            put_triangles(body, out);
            continue;
        }
        put_place(out, "SPHERE CENTER ", body->object_to_world.offset);
        strbuf_format(out, " RAD %.9g m%u\n", body->radius, scene_body_material(body, 0));
    }
    strbuf_cstr(out, "END_SCENE\n");
    return lacks(in);
}
