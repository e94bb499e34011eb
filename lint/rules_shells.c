// Meshes that refract and whose faces disagree on which side is outside, or that cross themselves.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "core/forest.h"
#include "core/heap.h"

#include <stdlib.h>

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
        diag_help(lint->sink,
                  "join the parts in a modelling program, so that one surface separates inside from outside");
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
    diag_help(lint->sink,
              "turn these faces in a modelling program: outer walls face outwards, walls of a hollow "
              "into the hollow");
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
    diag_help(lint->sink, "turn all faces outwards in a modelling program: 'recalculate normals'");
}

void lint_inside_out(struct lint *lint) {
    for (uint32_t i = 0; i < lint->meshes.count; i++) {
        struct lint_mesh *mesh = lint->meshes.items[i];
        if (!mesh->first_refracting)
            continue;
        // Parts that cross have no nesting order; the rule above has reported them.
        if (!mesh->mesh->closed)
            check_turned(lint, mesh);
        else if (mesh->crossings.count == 0)
            check_shells(lint, mesh);
    }
}
