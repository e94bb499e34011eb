// The files that the scenes of test_attributes name.
#ifndef GLINT_TESTS_BENCH_FILES_H
#define GLINT_TESTS_BENCH_FILES_H

#include "core/str.h"

#include <stdbool.h>

enum {
    BENCH_MESHES = 2
};
extern const str bench_meshes[BENCH_MESHES]; // names of the files that bench_write_meshes writes

// Into the folder `work`; false: a file cannot be written.
bool bench_write_sky(const char *work);
bool bench_write_meshes(const char *work);

#endif
