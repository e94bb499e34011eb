// libFuzzer entry: bytes as profiles, outlines, lists of faces and rings that a scene describes.
//
// The first byte is the kind of the body, the second its options; then come coordinates, a byte each, so that
// points often coincide and lie on lines.
#include "assets/made/made.h"
#include "assets/mesh_build.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    NUMBERS_MOST = 512,
    MEMORY_MOST = 256 << 20,
    TRIANGLES_MOST = 200000,
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool holds, const char *what) {
    if (holds)
        return;
    fprintf(stderr, "made bodies broke a promise: %s\n", what);
    abort();
}

struct input {
    uint8_t kind, options;
    const uint8_t *bytes;
    uint32_t count;
    struct arena arena;
    struct made made;
    struct mesh mesh;
    bool built, must_close;
};

static double number_of(uint8_t byte) {
    const double odd[] = {NAN, INFINITY, 1e18, 1e19, 1e-300, -1e-300};
    return byte >= 250 ? odd[byte - 250] : ((double)byte - 32) / 8;
}

static struct ir_pair *pairs_of(struct input *in) {
    struct ir_pair *pairs = ARENA_ARRAY(&in->arena, struct ir_pair, in->count / 2);
    for (uint32_t i = 0; i < in->count / 2; i++)
        pairs[i] = (struct ir_pair){number_of(in->bytes[2 * i]), number_of(in->bytes[2 * i + 1])};
    return pairs;
}

static double tolerance_of(const struct input *in) {
    return in->options & 8 ? 0.1 : 1e-3;
}

static void build_lathe(struct input *in, const struct made_to *to) {
    const struct ir_pair *points = pairs_of(in);
    const uint32_t count = in->count / 2;
    const struct made_lathe lathe = {points, count, in->options & 1, in->options & 2 ? 360 : 100,
                                     tolerance_of(in)};
    in->built = made_build_lathe(&lathe, to, &in->made);
    if (count == 0)
        return;
    const struct ir_pair first = points[0], last = points[count - 1];
    in->must_close = (first.u == 0 && last.u == 0) || (count > 3 && first.u == last.u && first.v == last.v);
}

// A byte of 249 ends an outline.
static void build_extrude(struct input *in, const struct made_to *to) {
    const struct ir_pair *points = pairs_of(in);
    struct made_outline *outlines = ARENA_ARRAY(&in->arena, struct made_outline, in->count + 1);
    uint32_t count = 0;
    outlines[0].points = points;
    for (uint32_t i = 0; i < in->count / 2; i++) {
        if (in->bytes[2 * i] == 249)
            outlines[++count].points = points + i + 1;
        else
            outlines[count].count++;
    }
    const struct made_extrude extrude = {
        outlines, count + 1, in->options & 1, 2, in->options & 2 ? 0.25 : 0, tolerance_of(in)};
    in->built = made_build_extrude(&extrude, to, &in->made);
    in->must_close = true;
}

static void build_faces(struct input *in, const struct made_to *to) {
    const uint32_t vertices = in->options % 16 < in->count / 3 ? in->options % 16 : in->count / 3;
    const uint32_t corners = in->count - 3 * vertices;
    vec3 *at = ARENA_ARRAY(&in->arena, vec3, vertices);
    uint32_t *list = ARENA_ARRAY(&in->arena, uint32_t, corners);
    uint32_t *firsts = ARENA_ARRAY(&in->arena, uint32_t, corners + 1);
    uint32_t faces = 0;
    for (uint32_t i = 0; i < vertices; i++)
        at[i] = (vec3){number_of(in->bytes[3 * i]), number_of(in->bytes[3 * i + 1]),
                       number_of(in->bytes[3 * i + 2])};
    for (uint32_t i = 0; i < corners; i++) {
        list[i] = in->bytes[3 * vertices + i] & 15;
        if (i == 0 || in->bytes[3 * vertices + i] & 64)
            firsts[faces++] = i;
    }
    const struct made_faces made = {at, vertices, list, corners, firsts, faces, NULL, 0};
    in->built = made_build_faces(&made, to, &in->made);
}

static void build_torus(struct input *in, const struct made_to *to) {
    if (in->count < 2)
        return;
    const struct made_torus torus = {number_of(in->bytes[0]), number_of(in->bytes[1]), tolerance_of(in)};
    in->built = made_build_torus(&torus, to, &in->made);
    in->must_close = true;
}

static void run(void *context) {
    struct input *in = context;
    const struct made_to to = {&in->arena, TRIANGLES_MOST};
    void (*const builders[])(struct input *, const struct made_to *) = {build_lathe, build_extrude,
                                                                        build_faces, build_torus};
    builders[in->kind % 4](in, &to);
    if (!in->built)
        return;
    const uint64_t triangles = in->made.triangle_count;
    mesh_build(&in->made.polygons, STR("made"), &in->arena, &in->mesh);
    require(in->mesh.triangle_count == triangles, "the count of triangles");
    require(!in->must_close || in->mesh.closed, "closed");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size < 3)
        return 0;
    struct input in = {.kind = data[0], .options = data[1], .bytes = data + 2};
    in.count = size - 2 < NUMBERS_MOST ? (uint32_t)(size - 2) : NUMBERS_MOST;
    arena_init(&in.arena, MEMORY_MOST);
    arena_init(&in.mesh.arena, MEMORY_MOST);
    const enum arena_fault fault =
        arena_guarded_all((struct arena *[]){&in.arena, &in.mesh.arena, NULL}, run, &in);
    require(fault == ARENA_FAULT_NONE, "memory");
    require(in.built || in.made.fault.text[0] || (in.kind % 4 == 3 && in.count < 2),
            "a sentence for every fault");
    arena_finish(&in.arena);
    arena_finish(&in.mesh.arena);
    return 0;
}
