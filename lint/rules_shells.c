// Meshes that refract and whose faces disagree on which side is outside, or that cross themselves; and faces
// of the scene in another order than their neighbours.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "core/forest.h"
#include "core/heap.h"
#include "grammar/ir.h"

#include <stdlib.h>
#include <string.h>

// ---- crossing itself

void lint_self_overlap(struct lint *lint) {
    for (uint32_t i = 0; i < lint->meshes.count; i++) {
        struct lint_mesh *mesh = lint->meshes.items[i];
        if (!mesh->first_refracting)
            continue;
        lint_find_pairs(lint, mesh);
        const struct lint_pairs *pairs = &mesh->crossings;
        if (pairs->count == 0)
            continue;
        diag_add(lint->sink, DIAG_SELF_OVERLAP, lint_place_mesh(lint, mesh->first_refracting),
                 "the mesh refracts and crosses itself: %u of its %u triangles cut through others",
                 pairs->count, mesh->mesh->triangle_count);
        lint_note_mesh(lint, mesh, mesh->mesh->triangles[pairs->first].line, "the first is this face");
        lint_note_mesh(lint, mesh, mesh->mesh->triangles[pairs->second].line, "which cuts through this one");
        diag_help(lint->sink, "join the parts%s, so that one surface separates inside from outside",
                  mesh->mesh->is_made ? "" : " in a modelling program");
    }
}

// ---- parts

struct shell {
    uint32_t first;   // triangle with area
    double volume;    // signed, times 6
    double magnitude; // sum of magnitudes of the terms: 2^-40 of it is rounding
};

struct shells {
    const struct lint_tree *tree;
    const struct mesh *mesh;
    uint32_t *parent;    // of merged positions (union-find)
    struct shell *items; // by root
};

static uint32_t shell_of(const struct shells *shells, uint32_t triangle) {
    return forest_root(shells->parent, shells->mesh->merged[shells->mesh->triangles[triangle].corners[0]]);
}

static void connect(struct lint *lint, struct shells *shells) {
    const struct mesh *mesh = shells->mesh;
    shells->parent = ARENA_ARRAY(lint->arena, uint32_t, mesh->position_count);
    forest_init(shells->parent, mesh->position_count);
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 2; k++) {
            const uint32_t *c = mesh->triangles[t].corners;
            forest_join(shells->parent, mesh->merged[c[k]], mesh->merged[c[k + 1]]);
        }
}

static void measure(struct lint *lint, struct shells *shells) {
    const struct mesh *mesh = shells->mesh;
    shells->items = ARENA_ARRAY(lint->arena, struct shell, mesh->position_count);
    for (uint32_t i = 0; i < mesh->position_count; i++)
        shells->items[i].first = IR_NO_INDEX;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        struct shell *shell = &shells->items[shell_of(shells, t)];
        if (shell->first == IR_NO_INDEX && mesh_has_area(mesh, t))
            shell->first = t;
        struct lint_triangle own = lint_mesh_triangle(mesh, t);
        vec3 from =
            mesh->positions[mesh->triangles[shell->first == IR_NO_INDEX ? t : shell->first].corners[0]];
        for (int k = 0; k < 3; k++)
            own.p[k] = vec3_sub(own.p[k], from);
        double part = vec3_dot(own.p[0], vec3_cross(own.p[1], own.p[2]));
        shell->volume += part;
        shell->magnitude += fabs(part);
    }
}

struct around {
    const struct shells *shells;
    uint32_t own; // the shell to leave out
    vec3 origin, direction;
    int sum;
};

static bool wind(void *context, uint32_t first, uint32_t count) {
    struct around *around = context;
    for (uint32_t i = first; i < first + count; i++) {
        uint32_t triangle = around->shells->tree->order[i];
        struct lint_triangle t = lint_mesh_triangle(around->shells->mesh, triangle);
        double at;
        int side;
        if (lint_triangle_ray(&t, around->origin, around->direction, &at, &side) && at > 0 &&
            shell_of(around->shells, triangle) != around->own)
            around->sum += side;
    }
    return true;
}

// How often the other shells surround this one, along two rays; false where these differ.
static bool surrounding(const struct shells *shells, uint32_t own, int *times) {
    struct lint_triangle t = lint_mesh_triangle(shells->mesh, shells->items[own].first);
    vec3 middle = vec3_mul(vec3_add(vec3_add(t.p[0], t.p[1]), t.p[2]), 1.0 / 3);
    struct around a = {shells, own, middle, {0.5403023058681398, 0.8414709848078965, 0.2955202066613396}, 0};
    struct around b = {shells, own, middle, {-0.6536436208636119, 0.4546487134128409, 0.7568024953079282}, 0};
    lint_tree_on_ray(shells->tree, a.origin, a.direction, wind, &a);
    lint_tree_on_ray(shells->tree, b.origin, b.direction, wind, &b);
    *times = a.sum;
    return a.sum == b.sum;
}

// A point is inside a solid once or not at all: a shell that faces outwards is inside nothing; one that faces
// inwards is the wall of a hollow in another.
static bool is_wrong(const struct shells *shells, uint32_t root) {
    const struct shell *shell = &shells->items[root];
    if (shell->first == IR_NO_INDEX || fabs(shell->volume) <= ldexp(shell->magnitude, -40))
        return false;
    int times;
    return surrounding(shells, root, &times) && times != (shell->volume > 0 ? 0 : 1);
}

static void check_shells(struct lint *lint, struct lint_mesh *mesh) {
    struct shells shells = {.mesh = mesh->mesh};
    connect(lint, &shells);
    measure(lint, &shells);
    uint32_t parts = 0;
    for (uint32_t i = 0; i < mesh->mesh->position_count; i++)
        parts += shells.items[i].first != IR_NO_INDEX;
    if (parts < 2)
        return;
    shells.tree = lint_tree_of(lint, mesh);
    uint32_t wrong = 0;
    uint32_t line = 0;
    bool nested = false;
    for (uint32_t i = 0; i < mesh->mesh->position_count; i++) {
        if (!is_wrong(&shells, i))
            continue;
        uint32_t here = mesh->mesh->triangles[shells.items[i].first].line;
        if (wrong++ == 0 || here < line) {
            line = here;
            nested = shells.items[i].volume > 0;
        }
    }
    if (wrong == 0)
        return;
    diag_add(lint->sink, DIAG_INSIDE_OUT, lint_place_mesh(lint, mesh->first_refracting),
             "the mesh refracts, and %u of its %u closed parts %s the wrong way", wrong, parts,
             wrong == 1 ? "faces" : "face");
    lint_note_mesh(lint, mesh, line,
                   nested ? "%s with this face lies inside another part and faces outwards like it"
                          : "%s with this face faces inwards and lies in no other part",
                   wrong == 1 ? "the part" : "the first, the part");
    diag_help(lint->sink, "turn these faces%s: outer walls face outwards, walls of a hollow into the hollow",
              mesh->mesh->is_made ? "" : " in a modelling program");
}

// ---- neighbours that disagree

struct half_edge {
    uint32_t high; // the end of higher index
    uint32_t triangle;
    bool leads_down; // to the lower end
};

struct edges {
    uint32_t *first; // by lower end: where its edges begin; one extra entry ends the last
    struct half_edge *items;
};

static bool edge_of(const struct mesh *mesh, uint32_t triangle, int k, uint32_t *low,
                    struct half_edge *edge) {
    uint32_t a = mesh->merged[mesh->triangles[triangle].corners[k]];
    uint32_t b = mesh->merged[mesh->triangles[triangle].corners[(k + 1) % 3]];
    *low = a < b ? a : b;
    *edge = (struct half_edge){a < b ? b : a, triangle, b < a};
    return a != b;
}

// A counting sort: in the order of triangles within each lower end.
static struct edges list_edges(struct lint *lint, const struct mesh *mesh) {
    struct edges edges = {ARENA_ARRAY(lint->arena, uint32_t, (size_t)mesh->position_count + 1),
                          ARENA_ARRAY(lint->arena, struct half_edge, heap_times(3, mesh->triangle_count))};
    struct half_edge edge;
    uint32_t low;
    for (uint32_t t = 0; t < mesh->triangle_count; t++)
        for (int k = 0; k < 3; k++)
            edges.first[edge_of(mesh, t, k, &low, &edge) ? low : mesh->position_count]++;
    uint32_t sum = 0;
    for (uint32_t i = 0; i <= mesh->position_count; i++) {
        sum += i < mesh->position_count ? edges.first[i] : 0;
        edges.first[i] = sum;
    }
    for (uint32_t t = mesh->triangle_count; t > 0; t--)
        for (int k = 2; k >= 0; k--)
            if (edge_of(mesh, t - 1, k, &low, &edge))
                edges.items[--edges.first[low]] = edge;
    return edges;
}

static int compare_edges(const void *a, const void *b) {
    const struct half_edge *x = a;
    const struct half_edge *y = b;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return x->triangle < y->triangle ? -1 : x->triangle > y->triangle;
}

// Whether the edge has two faces that run along it the same way; *next: the first of another edge.
static bool is_turned(const struct half_edge *edge, const struct half_edge *end,
                      const struct half_edge **next) {
    *next = edge + 1;
    while (*next < end && (*next)->high == edge->high)
        ++*next;
    return *next - edge == 2 && edge[0].leads_down == edge[1].leads_down;
}

// Two faces that run along their common edge the same way: one shows its back where the other shows its
// front.
static void check_turned(struct lint *lint, struct lint_mesh *mesh) {
    struct edges edges = list_edges(lint, mesh->mesh);
    uint32_t turned = 0;
    uint32_t a = IR_NO_INDEX;
    uint32_t b = IR_NO_INDEX;
    for (uint32_t i = 0; i < mesh->mesh->position_count; i++) {
        struct half_edge *begin = edges.items + edges.first[i];
        const struct half_edge *end = edges.items + edges.first[i + 1];
        qsort(begin, (size_t)(end - begin), sizeof *begin, compare_edges);
        for (const struct half_edge *edge = begin, *next; edge < end; edge = next) {
            if (!is_turned(edge, end, &next))
                continue;
            turned++;
            if (edge->triangle < a) {
                a = edge[0].triangle;
                b = edge[1].triangle;
            }
        }
    }
    if (turned == 0)
        return;
    diag_add(lint->sink, DIAG_INSIDE_OUT, lint_place_mesh(lint, mesh->first_refracting),
             "the mesh refracts, and at %u edge%s two of its faces point opposite ways", turned,
             turned == 1 ? "" : "s");
    lint_note_mesh(lint, mesh, mesh->mesh->triangles[a].line, "between this face");
    lint_note_mesh(lint, mesh, mesh->mesh->triangles[b].line, "and this one");
    diag_help(lint->sink, mesh->mesh->is_made
                              ? "a surface that has only one side has no inside: let it not refract"
                              : "turn all faces outwards in a modelling program: 'recalculate normals'");
}

// ---- faces of the scene

// Faces that hang together by edges that no third face has. Face f as it is written is number 2 f, and 2 f +
// 1 if it were turned; numbers in one set show the same side of the surface.
struct side {
    uint32_t written; // faces that show it as they are written
    uint32_t first;   // of them
    double volume;    // signed, times 6, if all showed it
    bool is_open;
};

struct sides {
    const struct mesh *mesh;
    uint32_t *parent;    // of the numbers (union-find)
    struct side *items;  // by root
    uint32_t *neighbour; // by face: the first that shows the other side, from 1; 0: none
    bool *is_open;       // by face
    double magnitude;    // of all terms of volumes: 2^-40 of it is rounding
    uint32_t sheets;     // of faces that hang together
};

static uint32_t face_of(const struct mesh *mesh, uint32_t triangle) {
    return mesh->triangles[triangle].line - 1;
}

static void join_faces(struct sides *sides, uint32_t a, uint32_t b, bool disagree) {
    forest_join(sides->parent, 2 * a, 2 * b + disagree);
    forest_join(sides->parent, 2 * a + 1, 2 * b + !disagree);
    if (!disagree)
        return;
    sides->neighbour[a] = sides->neighbour[a] ? sides->neighbour[a] : b + 1;
    sides->neighbour[b] = sides->neighbour[b] ? sides->neighbour[b] : a + 1;
}

// Faces that are given twice do not count as neighbours: W412 reports them.
static bool have_same_corners(const struct mesh *mesh, uint32_t a, uint32_t b) {
    uint32_t same = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            same +=
                mesh->merged[mesh->triangles[a].corners[i]] == mesh->merged[mesh->triangles[b].corners[k]];
    return same >= 3;
}

static void join_all(struct lint *lint, struct sides *sides) {
    const struct edges edges = list_edges(lint, sides->mesh);
    for (uint32_t i = 0; i < sides->mesh->position_count; i++) {
        struct half_edge *begin = edges.items + edges.first[i];
        const struct half_edge *end = edges.items + edges.first[i + 1];
        qsort(begin, (size_t)(end - begin), sizeof *begin, compare_edges);
        for (const struct half_edge *edge = begin, *next; edge < end; edge = next) {
            const bool turned = is_turned(edge, end, &next);
            const bool joins =
                next - edge == 2 && !have_same_corners(sides->mesh, edge[0].triangle, edge[1].triangle);
            if (joins)
                join_faces(sides, face_of(sides->mesh, edge[0].triangle),
                           face_of(sides->mesh, edge[1].triangle), turned);
            for (; !joins && edge < next; edge++)
                sides->is_open[face_of(sides->mesh, edge->triangle)] = true;
        }
    }
}

static void measure_sides(struct sides *sides) {
    const struct mesh *mesh = sides->mesh;
    for (uint32_t f = 0; f < mesh->face_count; f++) {
        struct side *own = &sides->items[forest_root(sides->parent, 2 * f)];
        struct side *other = &sides->items[forest_root(sides->parent, 2 * f + 1)];
        sides->sheets += own->written == 0 && other->written == 0;
        own->first = own->written++ == 0 ? f : own->first;
        own->is_open = own->is_open || sides->is_open[f];
        other->is_open = other->is_open || sides->is_open[f];
    }
    const vec3 from = mesh->positions[mesh->triangles[0].corners[0]];
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        struct lint_triangle own = lint_mesh_triangle(mesh, t);
        for (int k = 0; k < 3; k++)
            own.p[k] = vec3_sub(own.p[k], from);
        const double part = vec3_dot(own.p[0], vec3_cross(own.p[1], own.p[2]));
        sides->items[forest_root(sides->parent, 2 * face_of(mesh, t))].volume += part;
        sides->items[forest_root(sides->parent, 2 * face_of(mesh, t) + 1)].volume -= part;
        sides->magnitude += fabs(part);
    }
}

// Whether the face must be turned: where it and its neighbours enclose a body, to look out of it, else to
// look where most of them do. Not of a surface that has only one side.
static bool must_turn(const struct sides *sides, uint32_t face, bool *encloses) {
    const struct side *own = &sides->items[forest_root(sides->parent, 2 * face)];
    const struct side *other = &sides->items[forest_root(sides->parent, 2 * face + 1)];
    *encloses = sides->sheets == 1 && !own->is_open && !other->is_open &&
                fabs(own->volume) > ldexp(sides->magnitude, -40);
    if (own == other || other->written == 0)
        return false;
    if (*encloses)
        return own->volume < 0;
    return own->written != other->written ? own->written < other->written : own->first > other->first;
}

// The corners from the second to the last in the opposite order, each as it is written, with what is between
// them; none where they are not written one after another, as where an anchor stands for one.
static void fix_order(struct lint *lint, const struct ir_face *face) {
    const struct ir_element_origin *at = lint->origin->elements.items;
    const struct ir_corner *c = face->corners.items;
    const uint32_t last = face->corners.count - 1;
    const span begin = at[c[1].head.origin].at, end = at[c[last].head.origin].at;
    for (uint32_t i = 1; i < last; i++) {
        const span own = at[c[i].head.origin].at, next = at[c[i + 1].head.origin].at;
        if (span_is_none(own) || span_is_none(next) || next.source != own.source || next.begin < own.end)
            return;
    }
    const char *text = lint->input->files->sources->items[begin.source].text.ptr;
    const uint32_t length = end.end - begin.begin; // the same bytes in another order
    char *fix = ARENA_ARRAY(lint->arena, char, length), *to = fix;
    for (uint32_t i = 1; i <= last; i++) {
        const span own = at[c[last + 1 - i].head.origin].at, place = at[c[i].head.origin].at;
        memcpy(to, text + own.begin, own.end - own.begin);
        to += own.end - own.begin;
        const uint32_t gap = i < last ? at[c[i + 1].head.origin].at.begin - place.end : 0;
        memcpy(to, text + place.end, gap);
        to += gap;
    }
    diag_fix(lint->sink, false, (span){begin.source, begin.begin, end.end}, (str){fix, length});
}

enum {
    ORDER_SHOWN = 8 // corners of a face
};

static void report_order(struct lint *lint, const struct sides *sides, const struct ir_faces *faces,
                         uint32_t face, bool encloses) {
    const struct ir_face *ir = &faces->faces.items[face];
    diag_add(lint->sink, DIAG_INSIDE_OUT, ir_place_label(lint->origin, &ir->head),
             encloses ? "the corners of this face are in the wrong order: it shows its back to the outside"
                      : "the corners of this face are in the wrong order: it shows its back where the faces "
                        "around it show their front");
    if (sides->neighbour[face])
        diag_note(lint->sink,
                  ir_place_label(lint->origin, &faces->faces.items[sides->neighbour[face] - 1].head),
                  "next to this face, which shows the other side");
    str order = arena_format(lint->arena, "%d", ir->corners.items[0].vertex);
    for (uint32_t i = ir->corners.count; i-- > 1 && ir->corners.count <= ORDER_SHOWN;)
        order = arena_format(lint->arena, "%.*s, %d", STR_ARG(order), ir->corners.items[i].vertex);
    if (ir->corners.count > ORDER_SHOWN)
        diag_help(lint->sink, "write them in the opposite order: counter-clockwise as seen from outside");
    else
        diag_help(lint->sink,
                  "write them in the opposite order, %.*s: counter-clockwise as seen from outside",
                  STR_ARG(order));
    fix_order(lint, ir);
}

// Of every mesh, whatever its material: who writes its faces says by their order which way they look, and
// smooth shading and glass go by that. false: the surface has only one side, so that no order is right.
static bool check_order(struct lint *lint, const struct lint_mesh *mesh, const struct ir_faces *faces) {
    const uint32_t count = mesh->mesh->face_count;
    struct sides sides = {.mesh = mesh->mesh};
    bool have_order = true;
    sides.parent = ARENA_ARRAY(lint->arena, uint32_t, heap_times(2, count));
    sides.items = ARENA_ARRAY(lint->arena, struct side, heap_times(2, count));
    sides.neighbour = ARENA_ARRAY(lint->arena, uint32_t, count);
    sides.is_open = ARENA_ARRAY(lint->arena, bool, count);
    forest_init(sides.parent, 2 * (size_t)count);
    join_all(lint, &sides);
    measure_sides(&sides);
    for (uint32_t f = 0; f < count; f++) {
        bool encloses;
        if (must_turn(&sides, f, &encloses))
            report_order(lint, &sides, faces, f, encloses);
        have_order = have_order && forest_root(sides.parent, 2 * f) != forest_root(sides.parent, 2 * f + 1);
    }
    return have_order;
}

void lint_inside_out(struct lint *lint) {
    for (uint32_t i = 0; i < lint->meshes.count; i++) {
        struct lint_mesh *mesh = lint->meshes.items[i];
        const struct ir_faces *faces = lint_faces(lint, mesh);
        if (!mesh->mesh->closed && faces && check_order(lint, mesh, faces))
            continue;
        if (!mesh->first_refracting)
            continue;
        // Parts that cross have no nesting order; the rule above has reported them.
        if (!mesh->mesh->closed)
            check_turned(lint, mesh);
        else if (mesh->crossings.count == 0)
            check_shells(lint, mesh);
    }
}
