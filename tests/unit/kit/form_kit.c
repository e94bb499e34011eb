#include "form_kit.h"

#include "assets/made/made.h"
#include "assets/mesh_build.h"
#include "core/angle.h"

#include <stdlib.h>

typedef long double real;

struct point {
    real x, y, z;
};

// ---- the body's own axes

// By the three turns one after another, about the scene's axes.
static vec3 turned(const struct form *form, vec3 v) {
    const double x = form->turn.x * RADIANS, y = form->turn.y * RADIANS, z = form->turn.z * RADIANS;
    v = (vec3){v.x, v.y * cos(x) - v.z * sin(x), v.y * sin(x) + v.z * cos(x)};
    v = (vec3){v.x * cos(y) + v.z * sin(y), v.y, v.z * cos(y) - v.x * sin(y)};
    return (vec3){v.x * cos(z) - v.y * sin(z), v.x * sin(z) + v.y * cos(z), v.z};
}

static struct point into(const struct form *form, vec3 v) {
    const vec3 x = turned(form, (vec3){1, 0, 0}), y = turned(form, (vec3){0, 1, 0}),
               z = turned(form, (vec3){0, 0, 1});
    return (struct point){(real)x.x * v.x + (real)x.y * v.y + (real)x.z * v.z,
                          (real)y.x * v.x + (real)y.y * v.y + (real)y.z * v.z,
                          (real)z.x * v.x + (real)z.y * v.y + (real)z.z * v.z};
}

static struct point at(struct point o, struct point d, real t) {
    return (struct point){o.x + d.x * t, o.y + d.y * t, o.z + d.z * t};
}

// ---- the nearest of several places

struct nearest {
    real t;
    struct point normal; // outward, of any length
};

static void offer(struct nearest *nearest, real t, struct point normal) {
    if (t > 0 && t < nearest->t)
        *nearest = (struct nearest){t, normal};
}

// The roots of a t^2 + 2 b t + c; false: none.
static bool roots(real a, real b, real c, real t[2]) {
    const real square = b * b - a * c;
    if (!(square > 0))
        return false;
    const real q = -(b + copysignl(sqrtl(square), b));
    t[0] = q / a;
    t[1] = c / q;
    return true;
}

static void meet_sphere(const struct form *form, struct point o, struct point d, struct nearest *nearest) {
    real t[2];
    if (!roots(d.x * d.x + d.y * d.y + d.z * d.z, o.x * d.x + o.y * d.y + o.z * d.z,
               o.x * o.x + o.y * o.y + o.z * o.z - (real)form->a * form->a, t))
        return;
    offer(nearest, t[0], at(o, d, t[0]));
    offer(nearest, t[1], at(o, d, t[1]));
}

static void meet_frustum(const struct form *form, struct point o, struct point d, struct nearest *nearest) {
    const real slope = ((real)form->b - form->a) / form->c, radius = form->a + slope * o.y;
    real t[2];
    if (roots(d.x * d.x + d.z * d.z - slope * slope * d.y * d.y, o.x * d.x + o.z * d.z - radius * slope * d.y,
              o.x * o.x + o.z * o.z - radius * radius, t))
        for (int k = 0; k < 2; k++) {
            const struct point p = at(o, d, t[k]);
            if (p.y >= 0 && p.y <= form->c)
                offer(nearest, t[k], (struct point){p.x, -slope * sqrtl(p.x * p.x + p.z * p.z), p.z});
        }
    for (int k = 0; k < 2; k++) {
        const real disc = ((k ? form->c : 0) - o.y) / d.y, most = k ? form->b : form->a;
        const struct point p = at(o, d, disc);
        if (p.x * p.x + p.z * p.z <= most * most)
            offer(nearest, disc, (struct point){0, k ? 1 : -1, 0});
    }
}

static void meet_box(const struct form *form, struct point o, struct point d, struct nearest *nearest) {
    const real half[3] = {form->a / 2, form->b / 2, form->c / 2}, from[3] = {o.x, o.y, o.z},
               to[3] = {d.x, d.y, d.z};
    for (int face = 0; face < 6; face++) {
        const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const real side = face % 2 ? half[axis] : -half[axis], t = (side - from[axis]) / to[axis];
        if (fabsl(from[u] + to[u] * t) <= half[u] && fabsl(from[v] + to[v] * t) <= half[v])
            offer(nearest, t,
                  (struct point){axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0});
    }
}

static real outside_torus(const struct form *form, struct point p) {
    const real around = sqrtl(p.x * p.x + p.z * p.z) - form->a;
    return sqrtl(around * around + p.y * p.y) - form->b;
}

static struct point torus_normal(const struct form *form, struct point p) {
    const real away = sqrtl(p.x * p.x + p.z * p.z), part = 1 - form->a / away;
    return (struct point){p.x * part, p.y, p.z * part};
}

// Steps as long as the distance never pass the surface.
static void meet_torus(const struct form *form, struct point o, struct point d, double grown,
                       struct nearest *nearest) {
    enum {
        STEPS = 100000
    };
    const real end = 4 * ((real)form->a + form->b) + sqrtl(o.x * o.x + o.y * o.y + o.z * o.z);
    const real near = 1e-13L * form->a;
    real t = 0;
    for (int i = 0; i < STEPS && t < end; i++) {
        const real step = fabsl(outside_torus(form, at(o, d, t)) - grown);
        if (t > 0 && step < near) {
            offer(nearest, t, torus_normal(form, at(o, d, t)));
            return;
        }
        t += step;
    }
    if (t < end)
        abort();
}

bool form_first(const struct form *form, vec3 origin, vec3 direction, double grown, struct form_hit *hit) {
    const struct point o = into(form, vec3_sub(origin, form->place)), d = into(form, direction);
    struct nearest nearest = {.t = HUGE_VALL};
    switch (form->kind) {
    case FORM_SPHERE:
        meet_sphere(form, o, d, &nearest);
        break;
    case FORM_FRUSTUM:
        meet_frustum(form, o, d, &nearest);
        break;
    case FORM_BOX:
        meet_box(form, o, d, &nearest);
        break;
    case FORM_TORUS:
        meet_torus(form, o, d, grown, &nearest);
        break;
    }
    if (nearest.t == HUGE_VALL)
        return false;
    const struct point n = nearest.normal;
    const vec3 normal = vec3_unit(turned(form, (vec3){(double)n.x, (double)n.y, (double)n.z}));
    *hit = (struct form_hit){(double)nearest.t, normal, vec3_dot(normal, direction) < 0};
    return true;
}

struct form_near form_near_torus(const struct form *form, vec3 point) {
    const struct point p = into(form, vec3_sub(point, form->place)), n = torus_normal(form, p);
    return (struct form_near){vec3_unit(turned(form, (vec3){(double)n.x, (double)n.y, (double)n.z})),
                              (double)outside_torus(form, p), (double)sqrtl(p.x * p.x + p.z * p.z)};
}

// ---- measures

vec3 form_middle(const struct form *form) {
    const double up = form->kind == FORM_FRUSTUM ? form->c / 2 : 0;
    return vec3_add(form->place, turned(form, (vec3){0, up, 0}));
}

vec3 form_inside(const struct form *form, double share) {
    const double radius = form->kind == FORM_TORUS ? form->a : 0, turn = 2 * PI * share;
    return vec3_add(form_middle(form), turned(form, (vec3){radius * cos(turn), 0, radius * sin(turn)}));
}

double form_reach(const struct form *form) {
    switch (form->kind) {
    case FORM_SPHERE:
        return form->a;
    case FORM_FRUSTUM:
        return hypot(form->c / 2, fmax(form->a, form->b));
    case FORM_BOX:
        return hypot(hypot(form->a, form->b), form->c) / 2;
    case FORM_TORUS:
        return form->a + form->b;
    }
    return 0;
}

double form_area(const struct form *form) {
    const double a = form->a, b = form->b, c = form->c;
    switch (form->kind) {
    case FORM_SPHERE:
        return 4 * PI * a * a;
    case FORM_FRUSTUM:
        return PI * (a * a + b * b + (a + b) * hypot(c, a - b));
    case FORM_BOX:
        return 2 * (a * b + b * c + c * a);
    case FORM_TORUS:
        return 4 * PI * PI * a * b;
    }
    return 0;
}

double form_volume(const struct form *form) {
    const double a = form->a, b = form->b, c = form->c;
    switch (form->kind) {
    case FORM_SPHERE:
        return 4 * PI / 3 * a * a * a;
    case FORM_FRUSTUM:
        return PI / 3 * c * (a * a + a * b + b * b);
    case FORM_BOX:
        return a * b * c;
    case FORM_TORUS:
        return 2 * PI * PI * a * b * b;
    }
    return 0;
}

// ---- as bodies of a scene

static void add_frustum(struct kit *kit, const struct form *form) {
    const vec3 to = vec3_add(form->place, turned(form, (vec3){0, form->c, 0}));
    if (form->a == form->b) {
        struct ir_cylinder *cylinder = kit_cylinder(kit);
        cylinder->from = form->place;
        cylinder->to = to;
        cylinder->radius = form->a;
        return;
    }
    struct ir_cone *cone = kit_cone(kit);
    cone->from = form->place;
    cone->to = to;
    cone->radius_from = form->a;
    cone->radius_to = form->b;
}

static void add_torus(struct kit *kit, const struct form *form, struct mesh *room) {
    const struct made_torus torus = {form->a, form->b, form->tolerance};
    const struct made_to to = {&kit->arena, UINT32_MAX};
    struct made made;
    if (!made_build_torus(&torus, &to, &made))
        abort();
    arena_init(&room->arena, SIZE_MAX);
    mesh_build(&made.polygons, STR("torus"), &kit->arena, room);
    struct ir_model *model = kit_model(kit, room);
    model->smooth = true;
    model->translation = form->place;
    model->rotation = form->turn;
}

void form_add(struct kit *kit, const struct form *form, struct mesh *room) {
    switch (form->kind) {
    case FORM_SPHERE: {
        struct ir_sphere *sphere = kit_sphere(kit);
        sphere->center = form->place;
        sphere->radius = form->a;
        break;
    }
    case FORM_FRUSTUM:
        add_frustum(kit, form);
        break;
    case FORM_BOX: {
        struct ir_box *box = kit_box(kit);
        box->center = form->place;
        box->size = (vec3){form->a, form->b, form->c};
        box->rotation = form->turn;
        break;
    }
    case FORM_TORUS:
        add_torus(kit, form, room);
        break;
    }
}
