// write_meshes IN.ply FOLDER FORM...: a binary PLY file, written as files of other formats: FOLDER/FORM,
// where FORM is as.obj, text.ply, little.ply, big.ply, text.stl or binary.stl. The input is read by the
// bench's reader, not by glint's. Exit: 0 done, 1 not.
#include "bench/mesh/mesh.h"
#include "mesh_kit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool write_form(const struct mesh_kit *kit, const char *folder, enum mesh_kit_form form) {
    char path[4096];
    struct strbuf bytes;
    strbuf_init(&bytes);
    mesh_kit_write(kit, form, &bytes);
    snprintf(path, sizeof path, "%s/%s", folder, mesh_kit_names[form]);
    FILE *file = bytes.failed ? NULL : fopen(path, "wb");
    bool done = file && fwrite(bytes.data, 1, bytes.len, file) == bytes.len;
    done = file && fclose(file) == 0 && done;
    strbuf_finish(&bytes);
    return done;
}

int main(int argc, char **argv) {
    struct bench_mesh mesh;
    if (argc < 4 || !bench_mesh_open("write_meshes", argv[1], &mesh))
        return 1;
    double *positions = malloc(3 * sizeof *positions * mesh.vertex_count);
    for (size_t i = 0; positions && i < 3 * (size_t)mesh.vertex_count; i++)
        positions[i] = (double)mesh.positions[i];
    const struct mesh_kit kit = {.positions = positions,
                                 .vertex_count = mesh.vertex_count,
                                 .corners = mesh.corners,
                                 .face_count = mesh.triangle_count,
                                 .single = true,
                                 .extras = true};
    bool done = positions != NULL;
    for (int i = 3; i < argc; i++) {
        enum mesh_kit_form form = 0;
        while (form < MESH_KIT_FORMS && strcmp(argv[i], mesh_kit_names[form]) != 0)
            form++;
        done = done && form < MESH_KIT_FORMS && write_form(&kit, argv[2], form);
    }
    free(positions);
    bench_mesh_finish(&mesh);
    return !done;
}
