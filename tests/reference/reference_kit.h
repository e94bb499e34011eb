// References over scenes made in memory (tests/unit/kit/flat_kit.h), and random numbers.
#ifndef GLINT_TESTS_REFERENCE_REFERENCE_KIT_H
#define GLINT_TESTS_REFERENCE_REFERENCE_KIT_H

#include "reference/reference.h"
#include "tests/unit/kit/flat_kit.h"
#include "tests/unit/kit/random.h"

// Millions of rays take minutes under the sanitizers.
#ifdef GLINT_ARENA_EXACT
#define REFERENCE_TEST_RAYS 60000
#else
#define REFERENCE_TEST_RAYS 1000000
#endif

// A camera at `position` that looks along -z with a vertical field of 90 degrees.
void reference_kit_camera(struct kit *kit, vec3 position);
// The scene as it now is; fails the test where there is no memory.
struct reference *reference_kit_make(struct kit *kit, enum reference_test test, bool no_tree);
struct reference *reference_kit_make_quickly(struct kit *kit); // with the tree for few rays

vec3 random_in_cube(uint64_t *random); // -1..1 each
uint32_t random_below(uint64_t *random, uint32_t end);

// Many triangles of all shapes and sizes in -1..1, in one open mesh.
struct mesh *reference_kit_soup(struct kit *kit, uint32_t triangles, uint64_t seed);

#endif
