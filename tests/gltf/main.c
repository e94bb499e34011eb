// make_gltf FOLDER: the sample in its three forms: sample.glb, embedded.gltf, beside.gltf with its files.
#include "sample.h"

#include <stdio.h>

static bool write(const char *folder, const char *name, const struct strbuf *bytes) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    const bool good = file && !bytes->failed && fwrite(bytes->data, 1, bytes->len, file) == bytes->len;
    return file && fclose(file) == 0 && good;
}

int main(int argc, char **argv) {
    static const char *const names[] = {"sample.glb", "embedded.gltf", "beside.gltf"};
    bool good = argc == 2;
    for (int form = 0; good && form < 3; form++) {
        struct sample sample;
        sample_make((enum sample_form)form, &sample);
        good = write(argv[1], names[form], &sample.file);
        for (int i = 0; good && form == SAMPLE_BESIDE && i < SAMPLE_IMAGES; i++) {
            char name[32];
            snprintf(name, sizeof name, "image %d.png", i);
            good = write(argv[1], name, &sample.images[i]);
        }
        if (good && form == SAMPLE_BESIDE)
            good = write(argv[1], "sample data.bin", &sample.buffer);
        sample_finish(&sample);
    }
    return good ? 0 : 1;
}
