// Pictures of whole scenes for tests: one device, with core validation where the layer is installed.
#ifndef GLINT_TESTS_PICTURE_KIT_H
#define GLINT_TESTS_PICTURE_KIT_H

#include "render/shot.h"

// What a test changes against what the scene asks for.
struct picture_options {
    int32_t width, height, samples; // 0: the scene's
    uint64_t more_features;         // FEATURE_ bits compiled in beside those needed
    bool has_slices;                // use slice_iterations
    uint32_t slice_iterations;
    const char *asset_path;                              // NULL: none
    void (*edit)(struct ir_scene *scene, void *context); // changes the scene after it was loaded; may be NULL
    void *context;
    bool *was_double; // set to whether the device traced in double precision; may be NULL
};

struct picture_kit {
    struct gpu *gpu;
    bool by_reference; // GLINT_DEVICE is "reference": the tracer in double precision, which has no device
    struct asset_store *store;
    uint32_t validation_messages;
};

// false: no device; the test is to be skipped.
bool picture_kit_open(struct picture_kit *kit);
// The same on a device that reads storage buffers, and traces as GPUs do, though it is a CPU.
bool picture_kit_open_as_gpu(struct picture_kit *kit);
// The number of validation messages, those of closing included.
uint32_t picture_kit_close(struct picture_kit *kit);

// Renders a scene; the caller frees the image. false: the scene or the device failed, said on standard error.
bool picture_take(struct picture_kit *kit, const char *path, const struct picture_options *options,
                  struct image *image);
// How many pixels differ in a bit, -1 where the sizes do. Tells the first on standard error, with `what`.
int64_t picture_differences(const struct image *a, const struct image *b, const char *what);
// How many pixels are not the colour of the first one: a test on a picture that shows nothing proves nothing.
uint64_t picture_variety(const struct image *image);
// The folder of the original's meshes, or NULL: GLINT_ASSETS, else ../shared/assets, with /seed behind it.
const char *picture_seed_folder(void);

#endif
