// The table's rows for motion: animation, tracks, keys.
#include "grammar/schema_field.h"

static const char *const interpolation_words[] = {"linear", "smooth", "ease", "step", NULL};
static const char *const interpolation_docs[] = {
    "Straight from key to key.", "Along a curve through all keys, which turns no corner.",
    "Straight from key to key, slow at each.", "Each key's value stays until the next key.", NULL};
static const char *const loop_words[] = {"none", "repeat", "mirror", NULL};
static const char *const loop_docs[] = {"The first key's value before it, the last key's after it.",
                                        "After the last key the first one again.",
                                        "After the last key back to the first, and so on.", NULL};

// A row reads as a unit, its columns in lines of text.
// clang-format off
static const struct schema_row keyframe_rows[] = {
    {.name = "frame", FIELD(ir_keyframe, frame), .example = "50", .range = SCHEMA_RANGE_FRAME, .required = true, .plain = true,
     .also = "time at t", .doc = "The frame, counted from 0; keys are written in the order of their frames."},
    {.name = "value", FIELD(ir_keyframe, value), .example = "30", .text = SCHEMA_TEXT_VALUES, .required = true,
     .also = "v values", .doc = "The value there: as many numbers as the target has."},
};
const struct schema_element SCHEMA_KEYFRAME = {
    ELEMENT("key", "Key", ir_keyframe, keyframe_rows, "A value of a track at a frame.")};

static const struct schema_row track_rows[] = {
    {.name = "target", FIELD(ir_track, target), .example = "background.rotation", .text = SCHEMA_TEXT_TARGET, .key = true,
     .also = "path property attribute channel parameter name id", .required = true,
     .doc = "The way to the value that moves, as for --set: camera.position, models[ball].translation.y, "
            "materials.glass.refractive_index."},
    {.name = "value", FIELD(ir_track, value), .example = "90*time",
     .text = SCHEMA_TEXT_VALUES, .short_form = true, .also = "expression expr formula driver function",
     .doc = "An expression of 'frame' and 'time' instead of keys, or one for each component."},
    {.name = "interpolation", FIELD(ir_track, interpolation), .example = "smooth", .example_alone = true, .words = interpolation_words,
     .word_docs = interpolation_docs, .standard = "linear", .also = "easing curve spline",
     .doc = "What lies between two keys."},
    {.name = "loop", FIELD(ir_track, loop), .example = "repeat", .example_alone = true, .words = loop_words, .word_docs = loop_docs,
     .standard = "none", .also = "cycle extrapolation wrap", .doc = "What lies before the first key and after the last."},
    {.name = "key", .element = "Key", .plural = "keys", FIELD(ir_track, keys), .child = &SCHEMA_KEYFRAME, .example_alone = true,
     .also = "keyframe keyframes", .many = SCHEMA_SEQUENCE, .doc = "Values at frames."},
};
const struct schema_element SCHEMA_TRACK = {
    ELEMENT("track", "Track", ir_track, track_rows, "How one value of the scene moves: by keys, or by an expression.")};

static const struct schema_row animation_rows[] = {
    {.name = "frames", FIELD(ir_animation, frames), .example = "100", .range = SCHEMA_RANGE_FRAMES, .required = true, .plain = true,
     .also = "frame_count length duration count end", .doc = "How many frames there are; they are counted from 0."},
    {.name = "rate", FIELD(ir_animation, rate), .example = "24", .range = SCHEMA_RANGE_RATE, .standard = "25", .plain = true,
     .also = "fps frame_rate framerate frames_per_second", .doc = "Frames in a second, of films and of 'time'."},
    {.name = "frame", FIELD(ir_animation, frame), .example = "12", .example_alone = true, .range = SCHEMA_RANGE_FRAME, .plain = true,
     .also = "current start poster",
     .doc = "The frame that the scene shows by itself; if left out, its values as they are written."},
    {.name = "track", .element = "Track", .plural = "tracks", FIELD(ir_animation, tracks), .child = &SCHEMA_TRACK,
     .also = "channels curves motions", .many = SCHEMA_NAMED_MAP, .doc = "What moves, by the way to it."},
};
const struct schema_element SCHEMA_ANIMATION = {
    ELEMENT("animation", "Animation", ir_animation, animation_rows, "How values of the scene move from frame to frame.")};
// clang-format on
