// Compiled kernels that tests run beside the program's (shaders/kernels.h), by the same two names each.
#ifndef GLINT_TESTS_KERNELS_KERNELS_H
#define GLINT_TESTS_KERNELS_KERNELS_H

#include "shaders/kernel.h"

#define KERNEL(name) extern const struct kernel kernel_##name##_texels, kernel_##name##_storage;

KERNEL(layout) // writes the fields of each record back
KERNEL(probe)  // traces single rays
// In double precision.
KERNEL(layout64)
KERNEL(probe64)
// Of scenes with instances.
KERNEL(layout_instances)
KERNEL(layout64_instances)
// By other ways.
KERNEL(probe_alternative)
KERNEL(probe64_whole) // every triangle is tested in double precision
KERNEL(probe64_bold)  // rejected in single precision, with no margin for its errors

#undef KERNEL

#endif
