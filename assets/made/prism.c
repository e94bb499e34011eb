#include "assets/made/prism.h"

#include "assets/made/bevel.h"
#include "assets/made/fault.h"
#include "assets/made/shell.h"

#define ROOT_HALF 0.70710678118654752440

enum {
    TIERS_MOST = 3,
};

// The sides between two heights.
struct tier {
    uint32_t bottom, top;               // the first vertices of the rings there
    bool is_bottom_inset, is_top_inset; // a ring by sides, or one by places
    double slope;                       // z of its normals: 0, or -1 and 1 on bevels
    double v[2];
};

struct building {
    const struct prism *in;
    const struct region *region;
    struct region inset; // of both ends, where there is a bevel
    uint32_t *before;    // per side: the side that it follows
    struct shell shell;
    struct tier tiers[TIERS_MOST];
    uint32_t tier_count;
    struct plane_box box; // of the places that sides use
};

// ---- vertices

static uint32_t add_ring(struct building *b, const struct ir_pair *points, uint32_t count, double z) {
    const uint32_t first = b->shell.out->polygons.vertices.count;
    for (uint32_t i = 0; i < count; i++)
        shell_vertex(&b->shell, (vec3){points[i].u * b->in->scale, points[i].v * b->in->scale, z});
    return first;
}

static uint32_t add_places(struct building *b, double z) {
    return add_ring(b, b->region->places, b->region->place_count, z);
}

static uint32_t add_inset(struct building *b, double z) {
    return add_ring(b, b->inset.points, b->inset.point_count, z);
}

static void add_tiers(struct building *b) {
    const double height = b->in->height, bevel = b->in->bevel;
    if (bevel == 0) {
        const uint32_t bottom = add_places(b, 0);
        b->tiers[b->tier_count++] = (struct tier){bottom, add_places(b, height), false, false, 0, {0, 1}};
        return;
    }
    const double cut = bevel / ROOT_HALF, between = height - 2 * bevel, all = 2 * cut + between;
    const uint32_t bottom = add_inset(b, 0), lower = add_places(b, bevel);
    const uint32_t upper = between > 0 ? add_places(b, height - bevel) : lower;
    const uint32_t top = add_inset(b, height);
    b->tiers[b->tier_count++] = (struct tier){bottom, lower, true, false, -1, {0, cut / all}};
    if (between > 0)
        b->tiers[b->tier_count++] = (struct tier){lower, upper, false, false, 0, {cut / all, 1 - cut / all}};
    b->tiers[b->tier_count++] = (struct tier){upper, top, false, true, 1, {1 - cut / all, 1}};
}

// ---- sides

// At the beginning of a side [0] and at its end [1], as it goes around its area.
static struct prism_look look_of(const struct building *b, uint32_t side) {
    const struct prism_look *look = &b->in->looks[b->region->sides[side].edge];
    if (!b->region->sides[side].is_reversed)
        return *look;
    return (struct prism_look){{plane_mul(look->along[1], -1), plane_mul(look->along[0], -1)},
                               {look->u[1], look->u[0]}};
}

static uint32_t add_normal(struct building *b, struct ir_pair along, double slope) {
    const double share = slope == 0 ? 1 : ROOT_HALF;
    return shell_normal(&b->shell, (vec3){along.v * share, -along.u * share, slope * share});
}

static uint32_t ring_vertex(const struct building *b, uint32_t ring, bool is_inset, uint32_t side, bool end) {
    if (is_inset)
        return ring + (end ? side : b->before[side]);
    return ring + (end ? b->region->sides[side].to : b->region->sides[side].from);
}

static void add_side(struct building *b, const struct tier *tier, uint32_t side) {
    const struct prism_look look = look_of(b, side);
    const uint32_t from = add_normal(b, look.along[0], tier->slope);
    const uint32_t to =
        plane_same(look.along[0], look.along[1]) ? from : add_normal(b, look.along[1], tier->slope);
    const bool inset[2] = {tier->is_bottom_inset, tier->is_top_inset};
    const uint32_t rings[2] = {tier->bottom, tier->top};
    struct shell_corner corners[4];
    for (uint32_t i = 0; i < 4; i++) {
        const bool end = i == 1 || i == 2, up = i >= 2;
        corners[i] = (struct shell_corner){ring_vertex(b, rings[up], inset[up], side, end), end ? to : from,
                                           shell_coordinate(&b->shell, look.u[end], tier->v[up])};
    }
    shell_face(&b->shell, corners, 4);
}

// ---- ends

static void add_end(struct building *b, const struct region *cap, uint32_t ring, uint32_t coordinates,
                    bool up) {
    const uint32_t normal = shell_normal(&b->shell, (vec3){0, 0, up ? 1 : -1});
    for (uint32_t t = 0; t < cap->triangle_count; t++) {
        struct shell_corner corners[3];
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t place = cap->triangles[t][up ? k : 2 - k];
            const uint32_t point = cap == &b->inset ? cap->first_at[place] : place;
            corners[k] = (struct shell_corner){ring + point, normal, coordinates + point};
        }
        shell_face(&b->shell, corners, 3);
    }
}

static void add_ends(struct building *b, const struct region *cap) {
    const bool is_inset = cap == &b->inset;
    const struct ir_pair *points = is_inset ? cap->points : cap->places;
    const uint32_t count = is_inset ? cap->point_count : cap->place_count;
    const uint32_t coordinates = shell_box_coordinates(&b->shell, &b->box, points, count);
    add_end(b, cap, b->tiers[0].bottom, coordinates, false);
    add_end(b, cap, b->tiers[b->tier_count - 1].top, coordinates, true);
}

// ----

static bool make_inset(struct building *b, struct made_fault *fault) {
    const double scale = b->in->scale;
    if (bevel_make(b->region, b->in->bevel / scale, &b->inset))
        return true;
    fault->most = bevel_largest(b->region, b->in->bevel / scale) * scale;
    // Rounded to four digits it must not be more than what fits.
    fault->most *= 1 - 0x1p-10;
    return made_fail(fault, MADE_BEVEL, "a bevel of %.6g is too large for the outlines; %.4g fits",
                     b->in->bevel, fault->most);
}

static void link_back(struct building *b, struct arena *arena) {
    b->before = ARENA_ARRAY(arena, uint32_t, b->region->side_count);
    for (uint32_t i = 0; i < b->region->side_count; i++)
        b->before[b->region->sides[i].next] = i;
}

bool prism_build(const struct prism *prism, const struct made_to *to, struct made *out) {
    struct building b = {.in = prism, .region = prism->region};
    if (b.region->side_count == 0)
        return made_fail(&out->fault, MADE_EMPTY, "the outlines enclose nothing");
    if (prism->bevel > 0 && !make_inset(&b, &out->fault))
        return false;
    const struct region *cap = prism->bevel > 0 ? &b.inset : b.region;
    const uint64_t tiers = prism->bevel == 0 ? 1 : prism->height > 2 * prism->bevel ? 3 : 2;
    const uint64_t quads = tiers * b.region->side_count, ends = 2 * (uint64_t)cap->triangle_count;
    if (!made_count(out, to, 2 * quads + ends))
        return false;
    shell_begin(&b.shell, to, out, quads + ends, 4 * quads + 3 * ends);
    link_back(&b, to->arena);
    b.box = PLANE_BOX_EMPTY;
    for (uint32_t i = 0; i < b.region->side_count; i++)
        plane_include(&b.box, b.region->places[b.region->sides[i].from]);
    add_tiers(&b);
    for (uint32_t tier = 0; tier < b.tier_count; tier++)
        for (uint32_t side = 0; side < b.region->side_count; side++)
            add_side(&b, &b.tiers[tier], side);
    add_ends(&b, cap);
    shell_end(&b.shell);
    return true;
}
