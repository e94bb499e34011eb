// How many samples pixels take, and may take at most.
#include "diag/codes/rule.h"
#include "lint/lint_internal.h"

#include "grammar/ir.h"

enum {
    SAMPLES_ENOUGH = 256, // enough for pixels to differ in how many they take
};

static bool ends_none(const struct ir_image *image) {
    return image->samples <= image->min_samples;
}

static void advise(struct lint *lint, const char *row, const char *value, const char *what) {
    diag_help(lint->sink, "write %s: %s, %s", row, value, what);
    lint_fix_row(lint, &lint->ir->image.head, &SCHEMA_IMAGE, row, "error", value);
}

// Both must be at fault: the scene, and the image to be rendered, which may have more samples.
void lint_never_ends(struct lint *lint) {
    const struct ir_image *image = &lint->ir->image;
    if (!(image->error > 0) || !ends_none(image) || !ends_none(lint->input->image))
        return;
    diag_add(lint->sink, DIAG_NEVER_ENDS, ir_place_value(lint->origin, &image->head, &SCHEMA_IMAGE, "error"),
             "this error ends no pixel: each takes %d sample%s, and none ends before it has %d (min_samples)",
             image->samples, image->samples == 1 ? "" : "s", image->min_samples);
    const struct schema_row *least = &SCHEMA_IMAGE.rows[schema_find_row(&SCHEMA_IMAGE, STR("min_samples"))];
    const int more = 4 * image->min_samples > SAMPLES_ENOUGH ? 4 * image->min_samples : SAMPLES_ENOUGH;
    if (schema_in_range(least->range, more))
        advise(lint, "samples", arena_format(lint->arena, "%d", more).ptr, "the most that a pixel may take");
    else
        advise(lint, "min_samples", least->standard, "and samples above it");
}
