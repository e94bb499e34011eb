// Animation: gives the scene its values in a frame, or checks all its frames.
#include "parser/stages/animate.h"
#include "core/expression.h"
#include "diag/codes/binding.h"
#include "diag/codes/limit.h"

#include "core/heap.h"
#include "grammar/ir_copy.h"
#include "parser/bind/say.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// What checking a frame costs, in additions: for each track, besides its value, and for each element.
enum {
    TRACK_COST = 16,
    ELEMENT_COST = 64,
};

static void set_value(const struct moving *m, const double value[CURVE_WIDTH_MOST]) {
    memcpy(m->field, value, m->width * sizeof *value);
    if (m->parameter && m->width == 3)
        m->field[3] = -1; // no colour as written
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

// Parameters that tracks move, in the frame of the evaluation.
static void move_parameters(void *context, struct evaluation *e) {
    const struct motion *motion = context;
    for (uint32_t i = 0; i < motion->count; i++) {
        double value[CURVE_WIDTH_MOST];
        if (motion->items[i].parameter &&
            moving_value(motion, &motion->items[i], (int32_t)e->at.frame, value))
            set_value(&motion->items[i], value);
    }
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

static bool moves_by_itself(const struct motion *motion) {
    return motion->evaluation && motion->evaluation->moving.count;
}

static void take_frame(struct motion *motion) {
    const struct ir_animation *animation = motion->animation;
    struct diag_sink *sink = motion->loader->input->sink;
    const int32_t frame = animation->frame;
    if (animation->tracks.count == 0 && !moves_by_itself(motion)) {
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
    struct evaluation *e = motion->evaluation;
    struct ir_origin *origin = &motion->loader->output->origin;
    if (e) {
        e->move = move_parameters;
        e->motion = motion;
        e->suffix = arena_format(&motion->loader->scratch, ", in frame %d", (int)frame).ptr;
        evaluation_set_frame(e, frame, frame / animation->rate);
    }
    for (uint32_t i = 0; i < motion->count; i++) {
        struct moving *m = &motion->items[i];
        double value[CURVE_WIDTH_MOST];
        if (m->parameter || !moving_value(motion, m, frame, value) || !moving_fits(motion, m, frame, value))
            continue;
        ir_formula_drop(origin->arena, origin->formulas, bind_head(m->frame), m->row, m->slot, m->component);
        set_value(m, value);
        note_place(motion, m, frame);
    }
    if (e) {
        evaluate_formulas(e);
        evaluation_stop(e);
    }
}

// ---- all frames

static uint64_t cost_of_frame(const struct motion *motion) {
    uint64_t cost = (uint64_t)motion->element_count * ELEMENT_COST;
    for (uint32_t i = 0; i < motion->count; i++)
        cost += TRACK_COST + 2 * motion->items[i].cost; // its value: for itself, and for its element
    for (uint32_t i = 0; motion->evaluation && i < motion->evaluation->moving.count; i++)
        cost += TRACK_COST + 2 * motion->evaluation->moving.items[i].expression.cost;
    return cost;
}

// If checking all frames would cost more than the limit: checks only every n-th, and reports that.
static void choose_step(struct motion *motion) {
    const struct loader *loader = motion->loader;
    const uint64_t most = loader->input->limits->value[LIMIT_ANIMATION_OPERATIONS];
    const uint64_t frames = (uint64_t)motion->animation->frames, cost = cost_of_frame(motion);
    const uint64_t step = cost ? (frames - 1) / (most / cost + 1) + 1 : 1;
    motion->step = (int32_t)step;
    if (step == 1)
        return;
    diag_add(loader->input->sink, DIAG_FRAMES_SKIPPED,
             ir_place_value(&loader->output->origin, &motion->animation->head, &SCHEMA_ANIMATION, "frames"),
             "one frame in %d is checked: %d frames of %llu operations are more than the limit "
             "animation-operations "
             "of %llu",
             (int)step, (int)frames, (unsigned long long)cost, (unsigned long long)most);
    diag_help(loader->input->sink, "--limit animation-operations=%llu checks all of them",
              (unsigned long long)(frames * cost));
}

// Checks that all that is computed has a value in all frames, and one that fits: the first frame in which it
// has not is reported.
static bool look_at_formulas(const struct motion *motion) {
    struct evaluation *e = motion->evaluation;
    bool good = true;
    if (!e)
        return true;
    e->move = move_parameters;
    e->motion = (void *)motion;
    for (int32_t frame = 0; frame < motion->animation->frames && good; frame += motion->step) {
        char suffix[40];
        snprintf(suffix, sizeof suffix, ", in frame %d", (int)frame);
        e->suffix = frame ? suffix : "";
        good = evaluation_set_frame(e, frame, frame / motion->animation->rate) && evaluate_moving(e);
    }
    e->suffix = "";
    return good;
}

// Checks that the track has a value in all frames, and a valid one.
static bool look_at_track(const struct motion *motion, const struct moving *m) {
    double first[CURVE_WIDTH_MOST], value[CURVE_WIDTH_MOST];
    bool moves = false;
    for (uint32_t i = 0; i < m->curve.count; i++)
        if (!moving_fits(motion, m, (int32_t)m->curve.frames[i], &m->curve.values[(size_t)i * m->width]))
            return false;
    for (int32_t frame = 0; frame < motion->animation->frames; frame += motion->step) {
        if (!moving_value(motion, m, frame, value) || !moving_fits(motion, m, frame, value))
            return false;
        if (frame == 0)
            memcpy(first, value, sizeof first);
        moves = moves || memcmp(first, value, m->width * sizeof *value) != 0;
    }
    // A track with one key is still being written.
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

// The top-level element, such as a camera or a material, in which something moves.
static const struct bind_frame *element_of(const struct bind_frame *frame) {
    while (frame->parent && frame->parent->parent)
        frame = frame->parent;
    return frame;
}

static int compare_elements(const void *a, const void *b) {
    const struct bind_frame *const *x = a, *const *y = b;
    if ((*x)->via != (*y)->via)
        return (*x)->via < (*y)->via ? -1 : 1;
    return (*x)->memory < (*y)->memory ? -1 : (*x)->memory > (*y)->memory;
}

// Finds the elements in which something moves, each once: all others keep or break rules in all frames alike.
static void find_elements(struct motion *motion) {
    const struct evaluation *e = motion->evaluation;
    uint32_t count = 0, all = 0;
    motion->elements = ARENA_ARRAY(&motion->loader->scratch, const struct bind_frame *,
                                   (size_t)motion->count + (e ? e->moving.count : 0) + 1);
    for (uint32_t i = 0; i < motion->count; i++)
        if (!motion->items[i].parameter)
            motion->elements[all++] = element_of(motion->items[i].frame);
    for (uint32_t i = 0; e && i < e->moving.count; i++)
        motion->elements[all++] = element_of(e->moving.items[i].frame);
    if (all)
        qsort(motion->elements, all, sizeof *motion->elements, compare_elements);
    for (uint32_t i = 0; i < all; i++)
        if (count == 0 || motion->elements[i]->memory != motion->elements[count - 1]->memory)
            motion->elements[count++] = motion->elements[i];
    motion->element_count = count;
}

// Checks the rules about whole elements, such as that a camera must not look at its own place. Only the first
// frame that breaks one is reported.
static void look_at_elements(const struct motion *motion) {
    struct loader *loader = motion->loader;
    const struct parser_input *input = loader->input;
    double(*saved)[CURVE_WIDTH_MOST] =
        arena_alloc(input->arena, heap_times(motion->count + 1, sizeof *saved));
    bool *was_hex = ARENA_ARRAY(input->arena, bool, motion->count + 1);
    struct evaluation *e = motion->evaluation;
    struct parser_input aside = *input;
    struct diag_sink found;
    diag_sink_init(&found);
    aside.sink = &found;
    for (uint32_t i = 0; i < motion->count; i++) {
        const struct moving *m = &motion->items[i];
        memcpy(saved[i], m->field, m->width * sizeof(double));
        was_hex[i] = m->color && m->color->is_hex;
    }
    for (int32_t frame = 0; frame < motion->animation->frames && found.errors == 0; frame += motion->step) {
        double value[CURVE_WIDTH_MOST];
        if (e) {
            evaluation_set_frame(e, frame, frame / motion->animation->rate);
            evaluate_moving(e);
        }
        for (uint32_t i = 0; i < motion->count; i++)
            if (moving_value(motion, &motion->items[i], frame, value))
                set_value(&motion->items[i], value);
        loader->input = &aside;
        for (uint32_t i = 0; i < motion->element_count; i++)
            validate_element(loader, motion->elements[i]->schema, motion->elements[i]->memory);
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

// Whether the file chooses the frame. A user who chooses one by an option does not ask about the others.
static bool is_frame_of_file(const struct loader *loader, const struct ir_animation *animation) {
    const span at = ir_place_value(&loader->output->origin, &animation->head, &SCHEMA_ANIMATION, "frame");
    return loader->input->sources->items[at.source].kind != SOURCE_KIND_OPTION;
}

// Values without a frame: the formulas' at frame 0.
static void take_still(struct evaluation *e) {
    e->move = NULL;
    for (uint32_t i = 0; i < e->count; i++)
        e->items[i].is_moved = false;
    evaluation_set_frame(e, 0, 0);
    copies_make(e);
    evaluate_formulas(e);
}

static void take_still_again(struct evaluation *e) {
    e->is_quiet = true;
    take_still(e);
    e->is_quiet = false;
}

static void move_scene(struct motion *motion, bool has_frame) {
    struct loader *loader = motion->loader;
    const struct ir_animation *animation = motion->animation;
    const struct diag_sink *sink = loader->input->sink;
    const uint32_t errors = sink->errors;
    motion_find(motion);
    const bool moves = animation->tracks.count || moves_by_itself(motion);
    if (moves) {
        loader->output->origin.motion.frames = animation->frames;
        loader->output->origin.motion.rate = animation->rate;
    }
    if (moves && (!has_frame || is_frame_of_file(loader, animation))) {
        find_elements(motion);
        choose_step(motion);
        for (uint32_t i = 0; i < motion->count; i++)
            if (!motion->items[i].is_repeat)
                look_at_track(motion, &motion->items[i]);
        if (sink->errors == errors)
            look_at_formulas(motion);
        if (sink->errors == errors && errors == 0)
            look_at_elements(motion);
    }
    if (has_frame)
        take_frame(motion);
}

void animate_scene(struct loader *loader, struct ir_scene *scene) {
    const struct ir_animation *animation = &scene->animation;
    const uint32_t row = (uint32_t)schema_find_row(&SCHEMA_SCENE, STR("animation"));
    const uint32_t frame = (uint32_t)schema_find_row(&SCHEMA_ANIMATION, STR("frame"));
    struct evaluation *e = evaluation_begin(loader, scene);
    struct motion motion = {.loader = loader, .scene = scene, .animation = animation, .evaluation = e};
    const bool is_animated = (scene->head.written & bind_bit(row)) && !(scene->head.poisoned & bind_bit(row));
    if (loader->input->keeps_written && (e || is_animated)) // later stages move what is in place
        loader->output->origin.written = ir_copy(scene, loader->input->arena);
    if (e)
        take_still(e);
    if (is_animated) {
        const bool has_frame = animation->head.written & bind_bit(frame);
        if (!animation->head.poisoned)
            move_scene(&motion, has_frame);
        // Frames that were looked at left their values.
        if (e && !has_frame)
            take_still_again(e);
        if (has_frame)
            forget_animation(loader, scene);
    }
    if (e) {
        copies_check_focus(e);
        copies_finish(e);
        evaluation_keep(e);
        if (!loader->is_beside)
            evaluation_tell_unused(e);
    }
    arena_finish(&loader->scratch);
}
