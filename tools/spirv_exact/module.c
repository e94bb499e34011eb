#include "tools/spirv_exact/module.h"

#include "shaders/packed/exact.h"

#include <stdio.h>
#include <stdlib.h>

static uint32_t *read_words(FILE *file, size_t *words) {
    const long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    if (size <= 0 || size % 4 != 0 || fseek(file, 0, SEEK_SET) != 0)
        return NULL;
    *words = (size_t)size / 4;
    uint32_t *module = malloc((size_t)size);
    if (module && fread(module, 4, *words, file) == *words && exact_is_sound(module, *words))
        return module;
    free(module);
    return NULL;
}

uint32_t *module_read(const char *path, size_t *words) {
    FILE *file = fopen(path, "rb");
    uint32_t *module = file ? read_words(file, words) : NULL;
    if (file)
        fclose(file);
    if (!module)
        fprintf(stderr, "%s:1:1: error: not a SPIR-V module\n", path);
    return module;
}

bool module_write(const char *path, const uint32_t *module, size_t words) {
    FILE *file = fopen(path, "wb");
    const bool wrote = file && fwrite(module, sizeof *module, words, file) == words;
    const bool ok = file && fclose(file) == 0 && wrote;
    if (!ok)
        fprintf(stderr, "%s:1:1: error: cannot be written\n", path);
    return ok;
}
