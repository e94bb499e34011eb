// libFuzzer entry: any bytes as a font, with which a text is made. The last byte, which no font needs,
// chooses options.
#include "assets/made/made.h"
#include "assets/mesh_build.h"

#include <stdio.h>
#include <stdlib.h>

enum {
    MEMORY_MOST = 512 << 20,
    TRIANGLES_MOST = 200000,
};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool holds, const char *what) {
    if (holds)
        return;
    fprintf(stderr, "text broke a promise: %s\n", what);
    abort();
}

struct input {
    str font;
    uint8_t options;
    struct arena arena;
    struct made made;
    struct mesh mesh;
    bool built;
};

static void run(void *context) {
    struct input *in = context;
    static const str texts[] = {{"A", 1}, {"H", 1}, {"AH\nHA", 5}, {"AAA HHH", 7}};
    const struct made_to to = {&in->arena, TRIANGLES_MOST};
    const struct made_text text = {.text = texts[in->options & 3],
                                   .font = in->font,
                                   .height = 1,
                                   .depth = 0.25,
                                   .bevel = in->options & 4 ? 0.01 : 0,
                                   .tolerance = in->options & 8 ? 0.1 : 1e-3,
                                   .align = in->options / 32 % 3};
    in->built = made_build_text(&text, &to, &in->made);
    if (!in->built)
        return;
    mesh_build(&in->made.polygons, STR("made"), &in->arena, &in->mesh);
    require(in->mesh.closed, "closed");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size == 0)
        return 0;
    struct input in = {.font = {(const char *)data, size - 1}, .options = data[size - 1]};
    arena_init(&in.arena, MEMORY_MOST);
    arena_init(&in.mesh.arena, MEMORY_MOST);
    const enum arena_fault fault =
        arena_guarded_all((struct arena *[]){&in.arena, &in.mesh.arena, NULL}, run, &in);
    require(fault == ARENA_FAULT_NONE, "memory");
    require(in.built || in.made.fault.text[0], "a sentence for every fault");
    arena_finish(&in.arena);
    arena_finish(&in.mesh.arena);
    return 0;
}
