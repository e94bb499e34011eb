// The device of cmocka tests: GLINT_DEVICE's or the preferred one, with core validation where the layer is
// installed.
//
// The state of the tests begins with a device_kit. As setup and teardown of one test the functions below fail
// it where the layer has a message; cmocka passes a group whose teardown fails, so a group that shares a
// device ends with the test device_kit_silent. Ownership: device_kit_teardown frees the state.
#ifndef GLINT_TESTS_UNIT_DEVICE_KIT_H
#define GLINT_TESTS_UNIT_DEVICE_KIT_H

#include "tracer/gpu/gpu.h"

struct device_kit {
    struct gpu *gpu; // NULL: none
    uint32_t messages;
};

// Opens the device of a state that the caller made; says on standard error why there is none.
void device_kit_open(struct device_kit *kit);
// A state that is a device_kit alone.
int device_kit_setup(void **state);
int device_kit_teardown(void **state);
// The device; skips the test where there is none, or none that computes with doubles where they are wanted.
struct gpu *device_kit_need(void **state, bool is_double);
// The test that closes the device and finds that the layer has said nothing.
void device_kit_silent(void **state);

#endif
