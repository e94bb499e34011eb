#include "fuzz_file.h"

#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static char path[64];

static void remove_file(void) {
    unlink(path);
}

static int open_file(void) {
    static const char *const folders[] = {"/dev/shm", P_tmpdir};
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) {
        snprintf(path, sizeof path, "%s/glint-fuzz-XXXXXX", folders[i]);
        const int file = mkstemp(path);
        if (file >= 0) {
            atexit(remove_file);
            return file;
        }
    }
    abort();
}

const char *fuzz_file(const uint8_t *data, size_t size) {
    static int file = -1;
    if (file < 0)
        file = open_file();
    const bool good = ftruncate(file, 0) == 0 && (size == 0 || pwrite(file, data, size, 0) == (ssize_t)size);
    if (!good)
        abort();
    return path;
}
