// What moves: gives the scene its values in a frame, or checks all frames of it.
#include "parser/stages/animate.h"
#include "motion/expression.h"

#include "core/heap.h"
#include "parser/bind/say.h"

#include <math.h>
#include <string.h>

enum {
    EVALUATIONS_MOST = 1000000, // of tracks in frames, while all frames are checked: else every n-th
    LOOKS_MOST = 2000000,       // at elements in frames
};

static void set_value(const struct moving *m, const double value[CURVE_WIDTH_MOST]) {
    memcpy(m->field, value, m->width * sizeof *value);
    if (m->color)
        m->color->is_hex = false;
}

// ---- one frame

static void forget_animation(struct loader *loader, struct ir_scene *scene) {
    const uint32_t row = (uint32_t)schema_find_row(&SCHEMA_SCENE, STR("animation"));
    memset(&scene->animation, 0, sizeof scene->animation);
    schema_init(&SCHEMA_ANIMATION, &scene->animation);
    scene->head.written &= ~bind_bit(row);
    scene->head.poisoned &= ~bind_bit(row);
    ir_origin_remove_row(&loader->output->origin, scene->head.origin, row);
}

static void note_place(const struct motion *motion, struct moving *m, int32_t frame) {
    struct ir_origin *places = &motion->loader->output->origin;
    override_mark(m->path, m->frame);
    bind_head(m->frame)->written |= bind_bit(m->row_number);
    ir_origin_add_row(places, bind_head(m->frame)->origin,
                      (struct ir_row_origin){.row = m->row_number,
                                             .key = m->path->path,
                                             .value = moving_place(motion, m, frame)});
}

static void take_frame(struct motion *motion) {
    const struct ir_animation *animation = motion->animation;
    struct diag_sink *sink = motion->loader->input->sink;
    const int32_t frame = animation->frame;
    if (animation->tracks.count == 0) {
        diag_add(
            sink, DIAG_FRAME_BEYOND,
            ir_place_value(&motion->loader->output->origin, &animation->head, &SCHEMA_ANIMATION, "frame"),
            "there is no frame %d: the scene has no animation", (int)frame);
        return;
    }
    if (frame >= animation->frames) {
        diag_add(
            sink, DIAG_FRAME_BEYOND,
            ir_place_value(&motion->loader->output->origin, &animation->head, &SCHEMA_ANIMATION, "frame"),
            "there is no frame %d: the animation has %d frame%s, 0 to %d", (int)frame, (int)animation->frames,
            animation->frames == 1 ? "" : "s", (int)animation->frames - 1);
        return;
    }
    for (uint32_t i = 0; i < motion->count; i++) {
        struct moving *m = &motion->items[i];
        double value[CURVE_WIDTH_MOST];
        if (!moving_value(motion, m, frame, value) || !moving_fits(motion, m, frame, value))
            continue;
        set_value(m, value);
        note_place(motion, m, frame);
    }
}

// ---- all frames

static int32_t stride(const struct motion *motion, uint64_t each, uint64_t most) {
    return (int32_t)((uint64_t)motion->animation->frames * each / most) + 1;
}

// Whether the track has a value in all frames, and what it is worth.
static bool look_at_track(const struct motion *motion, const struct moving *m) {
    double first[CURVE_WIDTH_MOST], value[CURVE_WIDTH_MOST];
    const int32_t step = stride(motion, motion->count, EVALUATIONS_MOST);
    bool moves = false;
    for (uint32_t i = 0; i < m->curve.count; i++)
        if (!moving_fits(motion, m, (int32_t)m->curve.frames[i], &m->curve.values[(size_t)i * m->width]))
            return false;
    for (int32_t frame = 0; frame < motion->animation->frames; frame += step) {
        if (!moving_value(motion, m, frame, value) || !moving_fits(motion, m, frame, value))
            return false;
        if (frame == 0)
            memcpy(first, value, sizeof first);
        moves = moves || memcmp(first, value, m->width * sizeof *value) != 0;
    }
    // One key is a track that is being written.
    if (!moves && motion->animation->frames > 1 && m->curve.count != 1) {
        diag_add(motion->loader->input->sink, DIAG_TRACK_STILL, m->path->path,
                 "nothing moves: %.*s is the same in all frames",
                 STR_ARG(say_subject(&motion->loader->scratch, m->subject)));
        diag_help(motion->loader->input->sink, "write the value in its place, without a track");
    }
    return true;
}

static void copy_first_error(const struct motion *motion, const struct diag_sink *from, int32_t frame) {
    struct diag_sink *sink = motion->loader->input->sink;
    for (uint32_t i = 0; i < from->count; i++) {
        const struct diag *d = &from->items[i];
        if (d->severity != DIAG_ERROR)
            continue;
        diag_add(sink, d->code, d->at, "in frame %d %.*s", (int)frame, STR_ARG(d->message));
        diag_note(sink, ir_place_label(&motion->loader->output->origin, &motion->animation->head),
                  "moved by the animation");
        return;
    }
}

// The rules of whole elements, such as a camera that looks at its own place: the first frame that breaks one.
static void look_at_elements(const struct motion *motion) {
    struct loader *loader = motion->loader;
    const struct parser_input *input = loader->input;
    const struct ir_scene *scene = motion->scene;
    const uint64_t elements = (uint64_t)ir_body_count(scene) + scene->lights.count + scene->cameras.count + 1;
    const int32_t step = stride(motion, elements, LOOKS_MOST);
    double(*saved)[CURVE_WIDTH_MOST] =
        arena_alloc(input->arena, heap_times(motion->count + 1, sizeof *saved));
    bool *was_hex = ARENA_ARRAY(input->arena, bool, motion->count + 1);
    struct parser_input aside = *input;
    struct diag_sink found;
    diag_sink_init(&found);
    aside.sink = &found;
    for (uint32_t i = 0; i < motion->count; i++) {
        const struct moving *m = &motion->items[i];
        memcpy(saved[i], m->field, m->width * sizeof(double));
        was_hex[i] = m->color && m->color->is_hex;
    }
    for (int32_t frame = 0; frame < motion->animation->frames && found.errors == 0; frame += step) {
        double value[CURVE_WIDTH_MOST];
        for (uint32_t i = 0; i < motion->count; i++)
            if (moving_value(motion, &motion->items[i], frame, value))
                set_value(&motion->items[i], value);
        loader->input = &aside;
        validate_elements(loader, scene);
        loader->input = input;
        if (found.errors)
            copy_first_error(motion, &found, frame);
    }
    for (uint32_t i = 0; i < motion->count; i++) {
        const struct moving *m = &motion->items[i];
        memcpy(m->field, saved[i], m->width * sizeof(double));
        if (m->color)
            m->color->is_hex = was_hex[i];
    }
    diag_sink_finish(&found);
}

// Whether the file names the frame. Who asks for one frame, by an option, asks for nothing about the others.
static bool is_frame_of_file(const struct loader *loader, const struct ir_animation *animation) {
    const span at = ir_place_value(&loader->output->origin, &animation->head, &SCHEMA_ANIMATION, "frame");
    return loader->input->sources->items[at.source].kind != SOURCE_KIND_OPTION;
}

static unsigned inexact_of(const struct ir_animation *animation) {
    unsigned used = 0;
    for (uint32_t i = 0; i < animation->tracks.count; i++) {
        const struct ir_track *track = &animation->tracks.items[i];
        used |= expression_inexact(track->value);
        for (uint32_t k = 0; k < track->keys.count; k++)
            used |= expression_inexact(track->keys.items[k].value);
    }
    return used;
}

void animate_scene(struct loader *loader, struct ir_scene *scene) {
    const struct ir_animation *animation = &scene->animation;
    const uint32_t row = (uint32_t)schema_find_row(&SCHEMA_SCENE, STR("animation"));
    const uint32_t frame = (uint32_t)schema_find_row(&SCHEMA_ANIMATION, STR("frame"));
    const struct diag_sink *sink = loader->input->sink;
    struct motion motion = {.loader = loader, .scene = scene, .animation = animation};
    if (!(scene->head.written & bind_bit(row)) || (scene->head.poisoned & bind_bit(row)))
        return;
    const uint32_t errors = sink->errors;
    const bool is_good = !animation->head.poisoned;
    const bool has_frame = animation->head.written & bind_bit(frame);
    if (is_good)
        motion_find(&motion);
    if (is_good && animation->tracks.count) {
        loader->output->origin.motion.frames = animation->frames;
        loader->output->origin.motion.rate = animation->rate;
        loader->output->origin.motion.inexact = inexact_of(animation);
    }
    if (is_good && (!has_frame || is_frame_of_file(loader, animation))) {
        for (uint32_t i = 0; i < motion.count; i++)
            look_at_track(&motion, &motion.items[i]);
        if (sink->errors == errors && errors == 0)
            look_at_elements(&motion);
    }
    if (is_good && has_frame)
        take_frame(&motion);
    if (has_frame)
        forget_animation(loader, scene);
    arena_finish(&loader->scratch);
}
