#include "device_kit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

void device_kit_open(struct device_kit *kit) {
    char error[GPU_ERROR_BYTES];
    const struct gpu_options options = {
        .device = getenv("GLINT_DEVICE"), .validate = true, .validation_messages = &kit->messages};
    if (gpu_create(&options, &kit->gpu, error) != GPU_OK)
        fprintf(stderr, "skipped: %s\n", error);
}

int device_kit_setup(void **state) {
    struct device_kit *kit = calloc(1, sizeof *kit);
    if (kit)
        device_kit_open(kit);
    *state = kit;
    return kit ? 0 : -1;
}

static void close_device(struct device_kit *kit) {
    gpu_destroy(kit->gpu);
    kit->gpu = NULL;
}

int device_kit_teardown(void **state) {
    struct device_kit *kit = *state;
    close_device(kit);
    const uint32_t messages = kit->messages;
    free(kit);
    if (messages)
        fprintf(stderr, "error: %u validation messages\n", messages);
    return messages ? -1 : 0;
}

struct gpu *device_kit_need(void **state, bool is_double) {
    const struct device_kit *kit = *state;
    if (!kit->gpu || (is_double && !gpu_info(kit->gpu)->has_double))
        skip();
    return kit->gpu;
}

void device_kit_silent(void **state) {
    struct device_kit *kit = *state;
    close_device(kit);
    assert_int_equal(kit->messages, 0);
}
