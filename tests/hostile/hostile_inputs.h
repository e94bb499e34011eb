// Makes the hostile files in the current folder.
#ifndef GLINT_TESTS_HOSTILE_INPUTS_H
#define GLINT_TESTS_HOSTILE_INPUTS_H

#include <stdbool.h>
#include <stdint.h>

#define HOSTILE_KEPT_TEXT "an old picture"

// false: a file could not be made (errno).
bool hostile_make_inputs(void);

#endif
