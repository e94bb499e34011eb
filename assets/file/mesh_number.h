// A number in the text of a mesh file: written as in the scene language, but superfluous zeros before it are
// allowed.
//
// Input: a word. Output: the nearest double; too small ones are 0, and -0 is 0. Errors: why it is not a
// number, and *value = 0. Thread safety: pure.
#ifndef GLINT_ASSETS_FILE_MESH_NUMBER_H
#define GLINT_ASSETS_FILE_MESH_NUMBER_H

#include "core/number.h"

enum number_status mesh_number(str word, double *value);

#endif
