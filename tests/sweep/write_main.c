// Writes random scenes (sweep_scene.h) and what they name as files.
//
// Usage: write_sweep FOLDER SEED FIRST COUNT
// Scenes FIRST and the COUNT - 1 that follow, of all families by turns; their names on standard output, a
// line each.
#include "files/output.h"
#include "tests/sweep/sweep_scene.h"

#include <stdio.h>
#include <stdlib.h>

static bool write_file(const char *folder, const char *name, const struct strbuf *text) {
    char path[4096];
    struct output output;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (text->failed || !output_open(&output, path))
        return false;
    output_write(&output, text->data, text->len);
    return output_commit(&output);
}

static bool write_scene(const char *folder, const struct sweep_scene *scene) {
    bool good = write_file(folder, scene->name, &scene->text);
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        good = write_file(folder, scene->meshes[i].name, &scene->meshes[i].text) && good;
    return good && printf("%s\n", scene->name) > 0;
}

int main(int argc, char **argv) {
    if (argc != 5) {
        fprintf(stderr, "usage: write_sweep FOLDER SEED FIRST COUNT\n");
        return 2;
    }
    const uint32_t first = (uint32_t)strtoul(argv[3], NULL, 10), count = (uint32_t)strtoul(argv[4], NULL, 10);
    bool good = true;
    for (uint32_t i = first; i < first + count && good; i++) {
        struct sweep_scene scene = {0};
        sweep_scene_make(&scene, strtoull(argv[2], NULL, 10), i % SWEEP_FAMILIES, i / SWEEP_FAMILIES);
        good = write_scene(argv[1], &scene);
        sweep_scene_finish(&scene);
    }
    return good ? 0 : 1;
}
