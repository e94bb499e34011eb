// How `glint test` renders and judges pictures, from a YAML file, `glint-test.yaml`:
//
//     pictures: references             # the folder of the reference pictures, beside this file
//     size: 320x240                    # of all pictures; else as each scene says
//     samples: 4
//     bounds: {share: 0.01, flip: 0.02}
//     skip: ["drafts/**"]
//     tests:                           # pictures with settings of their own
//       hall-side.png: {scene: hall.glint.yaml, camera: side, set: ["materials.wall.albedo[0]=0.5"]}
//
// Mistakes are reported at their place, as E805 and E806, and the rest is used. Ownership: the arena's.
// Thread safety: one call belongs to one thread.
#ifndef GLINT_LOAD_SETTINGS_TEST_FILE_H
#define GLINT_LOAD_SETTINGS_TEST_FILE_H

#include "parser/tree/reader.h"
#include "picture/metrics/compare_report.h"

#define TEST_FILE_NAME "glint-test.yaml"

// Bounds without a file, for displayed values: at most this share of the pixels off by more than the
// threshold in a channel, and at most this mean over all channels (docs/accuracy.md, "Other devices").
#define TEST_THRESHOLD (2.0 / 255)
#define TEST_SHARE     0.005
#define TEST_MAE       (0.1 / 255)

struct test_list {
    str *items;
    uint32_t count, capacity;
};

// Settings of all pictures, or of one. What is not given is empty, zero or NULL.
struct test_settings {
    str camera, device;
    span camera_at, device_at;
    int32_t width, height, samples;
    struct test_list sets; // PATH=VALUE
    struct measure_bounds bounds;
    bool has_threshold, has_not_finite;
    double threshold; // of the share
};

struct test_entry {
    str picture, scene; // as written, relative to the file's folder; scene empty: the one of this name
    span picture_at, scene_at;
    struct test_settings own;
};

struct test_file {
    str pictures; // empty: beside the scenes
    span pictures_at;
    struct test_list skip; // patterns of paths
    struct test_settings all;
    struct {
        struct test_entry *items;
        uint32_t count, capacity;
    } entries;
};

// The settings that hold without a file.
void test_file_init(struct test_file *file);
// Reads a source that is in the set; its settings replace those in `file`. false: no memory.
bool test_file_read(const struct reader_context *input, uint32_t source, struct test_file *out);
// `own` over `all`: a bound replaces that of the same metric, and assignments come after those of all.
struct test_settings test_settings_join(const struct test_settings *all, const struct test_settings *own,
                                        struct arena *arena);

#endif
