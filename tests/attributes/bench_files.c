#include "bench_files.h"

#include "core/strbuf.h"
#include "files/output.h"
#include "picture/write/image.h"

#include <stdio.h>
#include <string.h>

enum {
    PATH_BYTES = 1024
};

const str bench_meshes[BENCH_MESHES] = {{"octahedron.obj", sizeof "octahedron.obj" - 1},
                                        {"wedge.obj", sizeof "wedge.obj" - 1}};

// A picture of a few colours as background: stripes that a rotation moves.
bool bench_write_sky(const char *work) {
    char path[PATH_BYTES];
    struct image sky;
    struct strbuf file;
    snprintf(path, sizeof path, "%s/sky.hdr", work);
    if (!image_init(&sky, 16, 8))
        return false;
    for (size_t i = 0; i < 3 * (size_t)sky.width * sky.height; i++)
        sky.rgb[i] = (float)((i / 3 * 7 + i % 3 * 5) % 11) / 10;
    strbuf_init(&file);
    image_encode(&sky, IMAGE_HDR, (struct image_display){0}, &file);
    bool good = output_whole(path, file.data, file.len) == 0;
    strbuf_finish(&file);
    image_finish(&sky);
    return good;
}

static bool write_mesh(const char *work, str name, const char *text) {
    char path[PATH_BYTES];
    snprintf(path, sizeof path, "%s/%.*s", work, STR_ARG(name));
    return output_whole(path, text, strlen(text)) == 0;
}

// Meshes of two materials that their files name and do not have.
bool bench_write_meshes(const char *work) {
    static const char octahedron[] =
        "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
        "vt 0.5 0.5\nvt 1.5 0.75\nvt 0.25 1.25\n"
        "usemtl Gold\nf 1/1 3/2 5/3\nf 3/1 2/2 5/3\nf 2/1 4/2 5/3\nf 4/1 1/2 5/3\n"
        "usemtl Rest\nf 3/1 1/2 6/3\nf 2/1 3/2 6/3\nf 4/1 2/2 6/3\nf 1/1 4/2 6/3\n";
    static const char wedge[] = "v -1 -1 1\nv 1 -1 1\nv 0 1 0.5\nv 0 -0.5 -1\n"
                                "vt 0.5 0.5\nvt 1.5 0.75\nvt 0.25 1.25\n"
                                "usemtl Gold\nf 1/1 2/2 3/3\nf 2/1 4/2 3/3\n"
                                "usemtl Rest\nf 4/1 1/2 3/3\nf 1/1 4/2 2/3\n";
    return write_mesh(work, bench_meshes[0], octahedron) && write_mesh(work, bench_meshes[1], wedge);
}
