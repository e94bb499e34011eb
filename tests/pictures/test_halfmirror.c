// The original's meshes as half-mirror glass, every hit a branch: slices cannot change a bit of the picture.
//
// Usage: test_halfmirror SCENE [full]. `full` renders 256x192 at 4 samples with slices of 1 500 and 6 000
// iterations; else 64x48 with slices of one ray and of 6 000.
#include "picture_kit.h"

#include <stdio.h>
#include <string.h>

int main(int argc, char **argv) {
    struct picture_kit kit;
    struct image a;
    struct image b;
    const char *seed = picture_seed_folder();
    if (!seed) {
        printf("skipped: the original's meshes are not here\n");
        return 77;
    }
    if (argc < 2 || !picture_kit_open(&kit))
        return 77;
    bool full = argc > 2 && strcmp(argv[2], "full") == 0;
    struct picture_options options = {.width = full ? 256 : 64,
                                      .height = full ? 192 : 48,
                                      .samples = full ? 4 : 1,
                                      .has_slices = true,
                                      .slice_iterations = 6000,
                                      .asset_path = seed};
    bool good = picture_take(&kit, argv[1], &options, &a) && picture_variety(&a) > 100;
    options.slice_iterations = full ? 1500 : 0;
    good = picture_take(&kit, argv[1], &options, &b) && good;
    good = good && picture_differences(&a, &b, "other slices") == 0;
    image_finish(&a);
    image_finish(&b);
    uint32_t messages = picture_kit_close(&kit);
    return !good || messages;
}
