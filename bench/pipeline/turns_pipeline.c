// The vendor's ray-tracing pipeline as a system that takes turns: the scene's triangles, the camera's rays
// and one from each hit to each light that would add something, with flat diffuse shading in the same floats
// as glint's.
//
//     turns_pipeline ... (turns.h)
//
// Scenes that need more than that, and devices without VK_KHR_ray_tracing_pipeline, end with status 77 and
// say why.
#include "bench/pipeline/rt.h"
#include "bench/turns/turns.h"
#include "grammar/ir.h"
#include "load/session.h"
#include "scene/transform.h"

#include <stdlib.h>

struct pipeline {
    struct rt rt;
    struct view view;
    uint32_t triangles;
};

// The arrays of a rt_scene, while they are filled.
struct filling {
    float *vertices, *colors, *lights;
    uint32_t *indices, *materials;
    struct rt_scene scene;
};

static void put(float *to, vec3 v, double last) {
    to[0] = (float)v.x;
    to[1] = (float)v.y;
    to[2] = (float)v.z;
    to[3] = (float)last;
}

// ---- what it can show

static const char *material_needs(const struct scene_material *m) {
    return m->checker                               ? "a checker"
           : scene_material_is_painted(m)           ? "an image"
           : m->reflection > 0 || m->refraction > 0 ? "reflection or refraction"
           : m->specular_weight > 0                 ? "highlights"
                                                    : NULL;
}

static const char *body_needs(const struct scene *scene, const struct scene_body *body) {
    if (body->shape == SCENE_SPHERE)
        return "spheres";
    if (body->shape == SCENE_CONE)
        return "cylinders and cones";
    if (body->smooth)
        return "smooth shading";
    const char *needs = NULL;
    for (uint32_t i = 0; i < body->group_count && !needs; i++)
        needs = material_needs(&scene->materials[body->materials[i]]);
    return needs;
}

static const char *scene_needs(const struct session *session) {
    const struct scene *scene = &session->resolved;
    const char *needs = scene->background.picture ? "a background image" : NULL;
    if (session->image->samples > 1)
        needs = "several samples";
    for (uint32_t i = 0; i < scene->body_count && !needs; i++)
        needs = body_needs(scene, &scene->bodies[i]);
    return needs;
}

// ---- the scene

static size_t vertices_of(const struct scene_body *body) {
    return body->mesh ? body->mesh->position_count : body->triangle_count ? 4 : 0;
}

static bool make_room(struct filling *f, const struct scene *scene, const struct view *view) {
    size_t vertices = 0, triangles = 0;
    for (uint32_t i = 0; i < scene->body_count; i++) {
        vertices += vertices_of(&scene->bodies[i]);
        triangles += scene->bodies[i].triangle_count;
    }
    if (triangles == 0 || vertices > UINT32_MAX || triangles > UINT32_MAX / 3)
        return false;
    f->vertices = calloc(vertices + 1, 3 * sizeof *f->vertices);
    f->indices = calloc(triangles, 3 * sizeof *f->indices);
    f->materials = calloc(triangles, sizeof *f->materials);
    f->colors = calloc(scene->material_count + (size_t)1, 4 * sizeof *f->colors);
    f->lights = calloc(view->light_count + (size_t)1, 8 * sizeof *f->lights);
    return f->vertices && f->indices && f->materials && f->colors && f->lights;
}

static void free_room(struct filling *f) {
    free(f->vertices);
    free(f->indices);
    free(f->materials);
    free(f->colors);
    free(f->lights);
}

static void add_vertex(struct filling *f, vec3 v) {
    float four[4];
    put(four, v, 0);
    for (size_t k = 0; k < 3; k++)
        f->vertices[3 * (size_t)f->scene.vertex_count + k] = four[k];
    f->scene.vertex_count++;
}

static void add_triangle(struct filling *f, uint32_t first, const uint32_t corners[3], uint32_t material) {
    for (size_t k = 0; k < 3; k++)
        f->indices[3 * (size_t)f->scene.triangle_count + k] = first + corners[k];
    f->materials[f->scene.triangle_count++] = material;
}

static void add_body(struct filling *f, const struct scene_body *body, vec3 origin) {
    static const uint32_t halves[2][3] = {{0, 1, 2}, {0, 2, 3}};
    const affine3 map = transform_relative(body->object_to_world, origin);
    const struct mesh *mesh = body->mesh;
    const uint32_t first = f->scene.vertex_count;
    for (uint32_t i = 0; mesh && i < mesh->position_count; i++)
        add_vertex(f, affine3_apply(map, mesh->positions[i]));
    if (!mesh && body->triangle_count) {
        vec3 corners[2][3];
        for (uint32_t half = 0; half < 2; half++)
            scene_corners(body, &map, half, corners[half]);
        for (int k = 0; k < 3; k++)
            add_vertex(f, corners[0][k]);
        add_vertex(f, corners[1][2]);
    }
    for (uint32_t i = 0; i < body->triangle_count; i++)
        add_triangle(f, first, mesh ? mesh->triangles[i].corners : halves[i], scene_body_material(body, i));
}

static void add_light(struct filling *f, const struct view_light *light, vec3 origin) {
    float *to = f->lights + 8 * (size_t)f->scene.light_count++;
    put(to, light->directional ? light->to_light : vec3_sub(light->position, origin), light->directional);
    put(to + 4, light->emission, light->inverse_square);
}

static void fill_frame(struct filling *f, const struct session *session, const struct view *view,
                       vec3 origin) {
    const struct view_camera *c = &view->camera;
    const double aspect = (double)session->image->width / session->image->height;
    float(*frame)[4] = f->scene.frame;
    put(frame[FRAME_POSITION], vec3_sub(c->position, origin), 0);
    put(frame[FRAME_FORWARD], c->forward, 0);
    put(frame[FRAME_RIGHT], vec3_mul(c->right, aspect * c->tan_half_fov), 0);
    put(frame[FRAME_UP], vec3_mul(c->up, c->tan_half_fov), 0);
    put(frame[FRAME_BACKGROUND], session->resolved.background.color, 0);
    put(frame[FRAME_COUNTS], (vec3){view->light_count, session->scene->trace.shadows, 0}, 0);
}

static void fill(struct filling *f, const struct session *session, const struct view *view) {
    const struct scene *scene = &session->resolved;
    const vec3 origin = session_origin(session, view);
    for (uint32_t i = 0; i < scene->body_count; i++)
        add_body(f, &scene->bodies[i], origin);
    for (uint32_t i = 0; i < scene->material_count; i++)
        put(f->colors + 4 * (size_t)i,
            vec3_mul(scene->materials[i].diffuse[0], scene->materials[i].diffuse_weight), 0);
    for (uint32_t i = 0; i < view->light_count; i++)
        add_light(f, &view->lights[i], origin);
    fill_frame(f, session, view, origin);
    f->scene.vertices = f->vertices;
    f->scene.indices = f->indices;
    f->scene.materials = f->materials;
    f->scene.colors = f->colors;
    f->scene.lights = f->lights;
    f->scene.color_count = scene->material_count;
}

// ---- the system

static enum turns_status device_says(const struct pipeline *p) {
    return turns_say(p->rt.cannot ? TURNS_CANNOT : TURNS_FAILED, "%s", p->rt.error);
}

static enum turns_status open_pipeline(void *state, const struct turns_options *o, struct session *session) {
    struct pipeline *p = state;
    struct filling filling = {0};
    const char *needs = scene_needs(session);
    if (needs)
        return turns_say(TURNS_CANNOT,
                         "the pipeline's shaders show flat diffuse triangles, and this scene needs %s",
                         needs);
    if (!rt_open(&p->rt, o->device))
        return device_says(p);
    if (!session_view(session, 0, &p->view) || !make_room(&filling, &session->resolved, &p->view)) {
        free_room(&filling);
        return turns_say(TURNS_FAILED, "no triangles, too many of them, or not enough memory");
    }
    fill(&filling, session, &p->view);
    p->triangles = filling.scene.triangle_count;
    const bool loaded =
        rt_load(&p->rt, &filling.scene, (uint32_t)session->image->width, (uint32_t)session->image->height);
    free_room(&filling);
    return loaded ? TURNS_DONE : device_says(p);
}

static bool take_frame(void *state, struct image *image, double *device) {
    struct pipeline *p = state;
    return rt_frame(&p->rt, image->width, image->height, image->rgb, device) || device_says(p) == TURNS_DONE;
}

static void write_facts(void *state, struct json_writer *w) {
    const struct pipeline *p = state;
    json_write_text(w, "device", str_from(p->rt.name));
    json_write_boolean(w, "on_processor", false);
    json_write_integer(w, "triangles", p->triangles);
    json_write_real(w, "tree_s", p->rt.build_seconds);
    json_write_integer(w, "scene_bytes",
                       p->rt.vertices.bytes + p->rt.indices.bytes + p->rt.materials.bytes + p->rt.low.bytes);
}

static void close_pipeline(void *state) {
    rt_close(&((struct pipeline *)state)->rt);
}

int main(int argc, char **argv) {
    static const struct turns_system system = {"pipeline", open_pipeline, take_frame, write_facts,
                                               close_pipeline};
    static struct pipeline pipeline;
    return turns_main(argc, argv, &system, &pipeline);
}
