// Where instances put what their objects hold: the product of the maps of an instance and of those around it.
#include "diag/codes/rule.h"
#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"
#include "scene/scene_internal.h"
#include "scene/shape.h"
#include "scene/transform.h"

#include <float.h>
#include <math.h>

// How different the scales of a map may be in different directions, as a share of them, and how far from
// right angles.
#define EVEN 1e-9

static affine3 map_of(const struct ir_instance *ir) {
    affine3 map = transform_of(ir->scale, ir->rotation, ir->translation);
    if (ir->matrix.rows.count != 3)
        return map;
    double *offset[3] = {&map.offset.x, &map.offset.y, &map.offset.z};
    for (int i = 0; i < 3; i++) {
        const struct ir_quad *row = &ir->matrix.rows.items[i].numbers;
        map.linear.m[i][0] = row->x;
        map.linear.m[i][1] = row->y;
        map.linear.m[i][2] = row->z;
        *offset[i] = row->t;
    }
    return map;
}

void scene_build_places(struct scene *scene, struct arena *arena) {
    const struct ir_instances *instances = &scene->ir->instances;
    const struct schema_row *row = ir_walk_pool(&SCHEMA_INSTANCE);
    if (!scene->ir->copies || !instances->count)
        return;
    affine3 *places = ARENA_ARRAY(arena, affine3, instances->count);
    for (uint32_t i = 0; i < instances->count; i++) {
        const uint32_t around = ir_copies_instance(scene->ir->copies, row, i); // comes before those in it
        const affine3 own = map_of(&instances->items[i]);
        places[i] = around ? affine3_mul(places[around - 1], own) : own;
    }
    scene->places = places;
}

const affine3 *scene_place(const struct scene *scene, const struct schema_element *element, uint32_t index) {
    if (!scene->places)
        return NULL;
    const uint32_t instance = ir_copies_instance(scene->ir->copies, ir_walk_pool(element), index);
    return instance ? &scene->places[instance - 1] : NULL;
}

// Whether a body is in the instance, or in one within it.
static bool is_within(const struct scene *scene, const struct scene_body *body, uint32_t instance) {
    const struct schema_row *row = ir_walk_pool(&SCHEMA_INSTANCE);
    const struct ir_copies *copies = scene->ir->copies;
    uint32_t around =
        body->element ? ir_copies_instance(copies, ir_walk_pool(body->element), body->index) : 0;
    while (around && around - 1 != instance)
        around = ir_copies_instance(copies, row, around - 1);
    return around != 0;
}

bool scene_instance_bounds(const struct scene *scene, str name, vec3 *lower, vec3 *upper) {
    const struct ir_instances *instances = &scene->ir->instances;
    uint32_t instance = 0;
    bool any = false;
    while (instance < instances->count && !str_equal(instances->items[instance].name, name))
        instance++;
    if (!scene->places || instance == instances->count)
        return false;
    for (uint32_t i = 0; i < scene->body_count; i++) {
        const struct scene_body *body = &scene->bodies[i];
        vec3 low, high;
        if (!is_within(scene, body, instance) ||
            !scene_body_bounds(body, &body->object_to_world, &low, &high))
            continue;
        *lower = any ? vec3_least(*lower, low) : low;
        *upper = any ? vec3_greatest(*upper, high) : high;
        any = true;
    }
    return any;
}

// ---- even maps

static bool is_even(const mat3 *linear) {
    const vec3 x = mat3_column(*linear, 0), y = mat3_column(*linear, 1), z = mat3_column(*linear, 2);
    const double lengths[3] = {vec3_length(x), vec3_length(y), vec3_length(z)};
    const double most = fmax(lengths[0], fmax(lengths[1], lengths[2]));
    const double angle =
        fmax(fabs(vec3_dot(vec3_unit(x), vec3_unit(y))),
             fmax(fabs(vec3_dot(vec3_unit(y), vec3_unit(z))), fabs(vec3_dot(vec3_unit(z), vec3_unit(x)))));
    bool even = angle <= EVEN;
    for (int i = 0; i < 3; i++)
        even = even && fabs(lengths[i] - most) <= EVEN * most;
    return even;
}

static mat3 turn_of(const mat3 *linear, double scale) {
    mat3 turn = *linear;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            turn.m[i][k] /= scale;
    return turn;
}

static void scale_cells(struct scene_body *body, struct arena *arena, vec3 scale) {
    struct scene_cells *cells = ARENA_NEW(arena, struct scene_cells);
    *cells = (struct scene_cells){vec3_times(body->cells->scale, scale), body->cells->offset};
    body->cells = cells;
}

void scene_body_into(struct scene_body *body, const affine3 *place, struct arena *arena) {
    const affine3 whole = affine3_mul(*place, body->object_to_world);
    double scale = 1;
    switch (body->shape) {
    case SCENE_SPHERE:
    case SCENE_CONE:
        scale = vec3_length(mat3_column(place->linear, 0));
        body->height *= scale;
        body->radius_to *= scale;
        scene_body_place(body, (affine3){turn_of(&whole.linear, scale), whole.offset}, body->radius * scale);
        body->mirrored = false;
        if (scale != 1)
            scale_cells(body, arena, (vec3){1 / scale, 1 / scale, 1 / scale});
        break;
    case SCENE_PARALLELOGRAM: {
        const mat3 own = body->object_to_world.linear;
        const double u = vec3_length(mat3_column(own, 0)), v = vec3_length(mat3_column(own, 1));
        const double to_u = vec3_length(mat3_column(whole.linear, 0)),
                     to_v = vec3_length(mat3_column(whole.linear, 1));
        scene_body_place(body, whole, 0);
        if (u != to_u || v != to_v)
            scale_cells(body, arena, (vec3){u / to_u, v / to_v, 1});
        break;
    }
    case SCENE_MESH:
        scene_body_place(body, whole, 0);
        break;
    }
}

// ---- what is wrong with them

static void report_uneven(const struct scene *scene, struct diag_sink *sink,
                          const struct schema_element *element, uint32_t index, const struct ir_head *head) {
    const struct ir_origin *origin = scene->assets->origin;
    const struct ir_copies *copies = scene->ir->copies;
    const struct schema_row *row = ir_walk_pool(element);
    const uint32_t instance = ir_copies_instance(copies, row, index) - 1;
    const span at = origin ? ir_place_label(origin, head) : SPAN_NONE;
    struct strbuf name;
    if (diag_is_repeat(sink, DIAG_UNEVEN, at))
        return;
    strbuf_init(&name);
    ir_copies_instance_name(copies, instance, &name);
    diag_add(sink, DIAG_UNEVEN, at, "'%.*s' does not scale evenly, and would stretch this %s",
             STR_ARG(strbuf_view(&name)), element->name);
    strbuf_finish(&name);
    if (origin)
        diag_note(sink, ir_place_label(origin, &scene->ir->instances.items[instance].head),
                  "the instance is here");
    diag_help(sink, "scale by one number in all directions; boxes, rectangles and models take any");
}

static void check_even(const struct scene *scene, struct diag_sink *sink,
                       const struct schema_element *element, uint32_t index, const struct ir_head *head) {
    const affine3 *place = scene_place(scene, element, index);
    if (place && !is_even(&place->linear))
        report_uneven(scene, sink, element, index, head);
}

// A scale of 0 is a mistake of its own (E405).
static bool is_known(const struct ir_instance *ir) {
    bool known = !ir->head.poisoned && !ir->matrix.head.poisoned && ir->scale.x != 0 && ir->scale.y != 0 &&
                 ir->scale.z != 0;
    for (uint32_t i = 0; i < ir->matrix.rows.count; i++)
        known = known && !ir->matrix.rows.items[i].head.poisoned;
    return known;
}

void scene_check_places(const struct scene *scene, struct diag_sink *sink) {
    const struct ir_origin *origin = scene->assets->origin;
    if (!scene->places)
        return;
    for (uint32_t i = 0; i < scene->ir->instances.count; i++) {
        const struct ir_head *head = &scene->ir->instances.items[i].head;
        const double room = mat3_determinant(scene->places[i].linear);
        const span at = origin ? ir_place_label(origin, head) : SPAN_NONE;
        if (!is_known(&scene->ir->instances.items[i]) || (isfinite(room) && fabs(room) >= DBL_MIN) ||
            diag_is_repeat(sink, DIAG_FLAT_PLACE, at))
            continue;
        diag_add(sink, DIAG_FLAT_PLACE, at,
                 "the object has no room here: it is pressed into a plane or less");
        diag_help(sink, "the columns of the matrix are where x, y and z lead: three directions, in no plane");
    }
    for (uint32_t i = 0; i < scene->body_count; i++) {
        const struct scene_body *body = &scene->bodies[i];
        if (body->element && (body->shape == SCENE_SPHERE || body->shape == SCENE_CONE))
            check_even(scene, sink, body->element, body->index, body->head);
    }
    for (uint32_t i = 0; i < scene->ir->lights.count; i++) {
        const struct ir_light *light = &scene->ir->lights.items[i];
        if (light->kind == IR_LIGHT_POSITION && light->radius > 0)
            check_even(scene, sink, &SCHEMA_LIGHT, i, &light->head);
    }
}
