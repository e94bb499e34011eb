// Writes a generated scene to standard output, for tests that need files:
//     generate_scene SEED yaml|xml [MESH...]
// With meshes the scene is one to render, and may name these.
#include "grammar/print/ir_print.h"
#include "tests/generate/generate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MESHES_MAX = 16
};

int main(int count, char **arguments) {
    struct arena arena;
    struct strbuf out;
    str meshes[MESHES_MAX];
    bool xml = count >= 3 && strcmp(arguments[2], "xml") == 0;
    if (count < 3 || count > 3 + MESHES_MAX || (!xml && strcmp(arguments[2], "yaml") != 0)) {
        fprintf(stderr, "usage: generate_scene SEED yaml|xml [MESH...]\n");
        return 2;
    }
    for (int i = 3; i < count; i++)
        meshes[i - 3] = str_from(arguments[i]);
    const struct generate_options options = {
        .seed = strtoull(arguments[1], NULL, 10),
        .renderable = count > 3,
        .meshes = {meshes, (uint32_t)count - 3},
    };
    arena_init(&arena, (size_t)1 << 28);
    strbuf_init(&out);
    const struct ir_scene *scene = generate_scene(&options, &arena);
    if (xml)
        ir_write_xml(scene, NULL, NULL, (struct ir_write_options){0}, &out);
    else
        ir_write_yaml(scene, NULL, NULL, (struct ir_write_options){0}, &out);
    bool failed = out.failed || fwrite(out.data, 1, out.len, stdout) != out.len || fflush(stdout) != 0;
    strbuf_finish(&out);
    arena_finish(&arena);
    return failed ? 3 : 0;
}
