// A glTF scene for tests: 20 boxes with an image each, a glass gem that is shown four times (scaled, mirrored
// and sheared), triangles as a strip, as a fan and without indices, a mesh moved by sparse values, two
// cameras, three lights. Its accessors have all types of components.
//
// Ownership: the caller's buffers. Thread safety: one thread.
#ifndef GLINT_TESTS_GLTF_SAMPLE_H
#define GLINT_TESTS_GLTF_SAMPLE_H

#include "core/strbuf.h"

enum sample_form {
    SAMPLE_GLB,      // one file
    SAMPLE_EMBEDDED, // JSON with `data:` addresses
    SAMPLE_BESIDE,   // JSON; the buffer and the images are files beside it
};

enum {
    SAMPLE_IMAGES = 20
};

struct sample {
    struct strbuf file;
    struct strbuf buffer;                // "sample data.bin", of SAMPLE_BESIDE
    struct strbuf images[SAMPLE_IMAGES]; // "image 0.png" and so on
};

void sample_make(enum sample_form form, struct sample *out);
void sample_finish(struct sample *sample);

#endif
