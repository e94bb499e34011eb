// Tracks as curves over numbers of the scene.
#include "diag/codes/binding.h"
#include "diag/diag_expression.h"
#include "parser/stages/animate.h"

#include "core/heap.h"
#include "core/number.h"
#include "core/srgb.h"
#include "grammar/ir_values.h"
#include "grammar/ir_walk.h"
#include "parser/bind/say.h"
#include "parser/bind/visit.h"
#include "parser/tree/mend.h"

#include <stdlib.h>
#include <string.h>

enum {
    CURVE_COST = 16, // cost of one number of a curve, in additions
};

static struct diag_sink *sink(const struct motion *motion) {
    return motion->loader->input->sink;
}

static const struct ir_origin *origin(const struct motion *motion) {
    return &motion->loader->output->origin;
}

static struct arena *scratch(const struct motion *motion) {
    return &motion->loader->scratch;
}

static span target_place(const struct motion *motion, const struct ir_track *track) {
    const uint32_t row = (uint32_t)schema_key_row(&SCHEMA_TRACK);
    const struct ir_row_origin *place = ir_origin_row(origin(motion), &track->head, row);
    return place ? place->value : ir_place_label(origin(motion), &track->head);
}

// ---- values

static bool wrong_count(const struct motion *motion, const struct moving *m, span at, uint32_t count) {
    diag_add(sink(motion), DIAG_TRACK_VALUE, at, "%u number%s for %.*s; it must be %.*s", count,
             count == 1 ? "" : "s", STR_ARG(say_subject(scratch(motion), m->subject)),
             STR_ARG(say_expected_of(scratch(motion), m->subject)));
    return false;
}

static bool bad_value(const struct motion *motion, span at, str text, const struct expression_fault *fault,
                      int32_t frame) {
    const char *suffix = frame > 0 ? arena_format(scratch(motion), ", in frame %d", (int)frame).ptr : "";
    const struct evaluation *e = motion->evaluation;
    const struct diag_expression expression = {.text = text,
                                               .at = at,
                                               .suffix = suffix,
                                               .names = e ? e->names : NULL,
                                               .name_count = e ? e->count : 0};
    struct expression_fault told = *fault;
    if (fault->problem == EXPRESSION_UNKNOWN_NUMBER && !fault->help && motion->evaluation)
        told.help = evaluation_help(motion->evaluation, str_slice(text, fault->begin, fault->end));
    diag_expression_fault(sink(motion), motion->loader->input->sources, DIAG_TRACK_VALUE, &expression, &told);
    return false;
}

static bool not_a_number(const struct motion *motion, span at, str text, enum expression_type type) {
    const struct diag_expression expression = {.text = text, .at = at};
    diag_add(sink(motion), DIAG_TRACK_VALUE,
             diag_expression_part(motion->loader->input->sources, &expression, 0, text.len),
             "this is %s; it must be a number", expression_type_name(type));
    return false;
}

static bool is_of_frame(const struct motion *motion, str text, span at) {
    const struct diag_expression expression = {.text = text, .at = at};
    size_t end = 0;
    str name;
    while (expression_next_name(text, &end, &name)) {
        if (!str_map_find(&motion->evaluation->by_name, name))
            continue;
        diag_add(sink(motion), DIAG_TRACK_VALUE,
                 diag_expression_part(motion->loader->input->sources, &expression, end - name.len, end),
                 "what moves a parameter cannot use the parameter '%.*s', which may be computed from it",
                 STR_ARG(name));
        diag_help(sink(motion),
                  "without the track, an expression of frame or time in the parameter itself can");
        return false;
    }
    return true;
}

static bool compile(const struct motion *motion, const struct moving *m, str text, span at, int32_t frame,
                    struct moving_text *out) {
    // What moves a parameter is not computed from others, which may be computed from it.
    const struct expression_scope *scope =
        motion->evaluation && !m->parameter ? &motion->evaluation->scope : NULL;
    bool all_numbers = true;
    str rest = text;
    *out = (struct moving_text){0};
    if (m->parameter && !is_of_frame(motion, text, at))
        return false;
    uint32_t hex;
    if (m->color && mend_hex_color(text, &hex)) {
        srgb_of_hex(hex, motion->scene->image.transfer == IR_TRANSFER_SRGB, out->constant);
        return true;
    }
    for (; out->count < CURVE_WIDTH_MOST && ir_values_next(&rest, &out->parts[out->count]); out->count++) {
        struct expression_fault fault;
        const str part = out->parts[out->count];
        if (!expression_compile(part, scope, scratch(motion), &out->values[out->count], &fault))
            return bad_value(motion, at, part, &fault, frame);
        all_numbers = all_numbers && out->values[out->count].type == EXPRESSION_NUMBER;
    }
    if (out->count == 1 && out->values[0].type == EXPRESSION_TRIPLE && m->width == 3)
        return true;
    for (uint32_t i = 0; i < out->count && !all_numbers; i++)
        if (out->values[i].type != EXPRESSION_NUMBER)
            return not_a_number(motion, at, out->parts[i], out->values[i].type);
    return out->count == m->width || (out->count == 1 && m->fills) || wrong_count(motion, m, at, out->count);
}

static bool evaluate(const struct motion *motion, const struct moving *m, const struct moving_text *text,
                     span at, int32_t frame, double out[CURVE_WIDTH_MOST]) {
    struct evaluation *e = motion->evaluation;
    const struct expression_at when = {.frame = frame,
                                       .time = frame / motion->animation->rate,
                                       .decodes = motion->scene->image.transfer == IR_TRANSFER_SRGB,
                                       .values = e ? e->values : NULL};
    if (e && !m->parameter && e->at.frame != frame)
        evaluation_set_frame(e, when.frame, when.time);
    struct expression_fault fault;
    if (text->count == 0)
        memcpy(out, text->constant, sizeof text->constant);
    for (uint32_t i = 0; i < text->count; i++) {
        double value[EXPRESSION_WIDTH];
        if (!expression_at(&text->values[i], &when, value, &fault))
            return bad_value(motion, at, text->parts[i], &fault, frame);
        if (text->values[i].type == EXPRESSION_TRIPLE) {
            memcpy(out, value, m->width * sizeof *value);
            return true;
        }
        out[i] = value[0];
    }
    for (uint32_t i = text->count; text->count == 1 && i < m->width; i++)
        out[i] = out[0];
    return true;
}

static span value_place(const struct motion *motion, const struct ir_track *track) {
    return ir_place_value(origin(motion), &track->head, &SCHEMA_TRACK, "value");
}

static span key_place(const struct motion *motion, const struct ir_keyframe *key, const char *row) {
    return ir_place_value(origin(motion), &key->head, &SCHEMA_KEYFRAME, row);
}

span moving_place(const struct motion *motion, const struct moving *m, int32_t frame) {
    if (m->curve.count == 0)
        return value_place(motion, m->track);
    return key_place(motion, &m->track->keys.items[curve_key(&m->curve, frame)], "value");
}

bool moving_value(const struct motion *motion, const struct moving *m, int32_t frame,
                  double out[CURVE_WIDTH_MOST]) {
    if (m->curve.count == 0)
        return evaluate(motion, m, &m->text, value_place(motion, m->track), frame, out);
    curve_at(&m->curve, frame, out);
    return true;
}

bool moving_fits(const struct motion *motion, const struct moving *m, int32_t frame,
                 const double value[CURVE_WIDTH_MOST]) {
    char digits[NUMBER_FORMAT_MAX];
    for (uint32_t i = 0; i < m->width; i++) {
        if (schema_in_range(m->row->range, value[i]))
            continue;
        struct bind_subject subject = m->subject;
        if (m->width > 1)
            subject.component = schema_components(m->row->kind)[i];
        const size_t length = number_format(value[i], digits);
        diag_add(sink(motion), DIAG_TRACK_RANGE, moving_place(motion, m, frame),
                 "%.*s is %.*s in frame %d; it must be %s%s", STR_ARG(say_subject(scratch(motion), subject)),
                 (int)length, digits, (int)frame, schema_range_info(m->row->range)->text, say_unit(m->row));
        if (m->curve.count && m->curve.way == CURVE_SMOOTH)
            diag_help(sink(motion), "a smooth curve goes beyond its keys; 'ease' and 'linear' do not");
        return false;
    }
    return true;
}

// ---- keys

static bool are_in_order(const struct motion *motion, const struct ir_track *track) {
    for (uint32_t i = 1; i < track->keys.count; i++) {
        const struct ir_keyframe *before = &track->keys.items[i - 1], *key = &track->keys.items[i];
        if (key->frame > before->frame)
            continue;
        diag_add(sink(motion), DIAG_KEY_ORDER, key_place(motion, key, "frame"),
                 key->frame == before->frame ? "two keys are at frame %d"
                                             : "the key at frame %d is out of order",
                 (int)key->frame);
        diag_note(sink(motion), key_place(motion, before, "frame"), "the key before it is at frame %d",
                  (int)before->frame);
        diag_help(sink(motion), "write keys in the order of their frames, one at each");
        return false;
    }
    return true;
}

static void look_beyond(const struct motion *motion, const struct ir_track *track) {
    for (uint32_t i = 0; i < track->keys.count; i++) {
        const struct ir_keyframe *key = &track->keys.items[i];
        if (key->frame <= motion->animation->frames)
            continue;
        diag_add(sink(motion), DIAG_KEY_BEYOND, key_place(motion, key, "frame"),
                 "the key at frame %d is after the end: the animation has %d frames, 0 to %d",
                 (int)key->frame, (int)motion->animation->frames, (int)motion->animation->frames - 1);
        return;
    }
}

static bool take_keys(const struct motion *motion, struct moving *m) {
    static const enum curve_way ways[] = {[IR_INTERPOLATION_LINEAR] = CURVE_LINEAR,
                                          [IR_INTERPOLATION_SMOOTH] = CURVE_SMOOTH,
                                          [IR_INTERPOLATION_EASE] = CURVE_EASE,
                                          [IR_INTERPOLATION_STEP] = CURVE_STEP};
    static const enum curve_loop loops[] = {
        [IR_LOOP_NONE] = CURVE_ONCE, [IR_LOOP_REPEAT] = CURVE_REPEAT, [IR_LOOP_MIRROR] = CURVE_MIRROR};
    const struct ir_keyframes *keys = &m->track->keys;
    struct arena *arena = motion->loader->input->arena;
    double *frames = ARENA_ARRAY(arena, double, keys->count);
    double *values = ARENA_ARRAY(arena, double, heap_times(keys->count, m->width));
    bool good = true;
    for (uint32_t i = 0; i < keys->count; i++) {
        const struct ir_keyframe *key = &keys->items[i];
        double value[CURVE_WIDTH_MOST];
        struct moving_text text;
        if (key->head.poisoned)
            return false;
        frames[i] = key->frame;
        const span at = key_place(motion, key, "value");
        good = compile(motion, m, key->value, at, key->frame, &text) &&
               evaluate(motion, m, &text, at, key->frame, value) && good;
        for (uint32_t k = 0; k < m->width; k++)
            values[(size_t)i * m->width + k] = good ? value[k] : 0;
    }
    m->curve = (struct curve){
        frames, values, keys->count, m->width, ways[m->track->interpolation], loops[m->track->loop]};
    m->cost = CURVE_COST * (uint64_t)m->width;
    return good && are_in_order(motion, m->track);
}

static bool has_one_form(const struct motion *motion, const struct ir_track *track) {
    const bool has_value = track->value.len > 0, has_keys = track->keys.count > 0;
    if (track->head.poisoned)
        return false;
    if (has_value && has_keys) {
        diag_add(sink(motion), DIAG_EXCLUSIVE, value_place(motion, track),
                 "a track has either keys or a value, not both");
        return false;
    }
    if (has_value || has_keys)
        return true;
    diag_add(sink(motion), DIAG_CHOICE_MISSING, ir_place_label(origin(motion), &track->head),
             "a track needs keys, or a value");
    diag_help(sink(motion),
              "for example keys: [{frame: 0, value: 0}, {frame: 50, value: 1}], or a value such "
              "as 90*time");
    return false;
}

// A number in a list that several files add to is another entry's once one of them changes.
static void tell_counted(const struct motion *motion, const struct override *path) {
    bool single;
    const int number = schema_find_yaml(&SCHEMA_SCENE, path->steps[0].text, &single);
    const struct schema_row *row = number < 0 ? NULL : &SCHEMA_SCENE.rows[number];
    if (!row || row->many != SCHEMA_SEQUENCE || path->step_count < 2 || path->steps[1].kind != OVERRIDE_INDEX)
        return;
    const struct ir_any_list list = ir_walk_list(row, path->scene);
    const struct ir_origin *places = origin(motion);
    const uint32_t last = list.count - 1;
    if (ir_place_label(places, ir_walk_item(row, list, 0)).source ==
        ir_place_label(places, ir_walk_item(row, list, last)).source)
        return;
    const int name_row = visit_name_row(row->child);
    const void *item = ir_walk_item(row, list, path->steps[1].index);
    const str name =
        name_row < 0 ? STR("") : *(const str *)schema_field_const(&row->child->rows[name_row], item);
    diag_add(
        sink(motion), DIAG_TRACK_COUNTED, path->steps[1].at,
        "'%s[%u]' is counted over several files: where one of them gets another entry, something else moves",
        schema_yaml_key(row), path->steps[1].index);
    diag_note(sink(motion), ir_place_label(places, item), "now it is this one");
    if (name.len) {
        diag_help(sink(motion), "write %s[%.*s]", schema_yaml_key(row), STR_ARG(name));
        diag_fix(sink(motion), true, path->steps[1].at,
                 arena_format(scratch(motion), "[%.*s]", STR_ARG(name)));
    } else {
        diag_help(sink(motion), "give it a name, and write the name in the brackets");
    }
}

static bool read_track(struct motion *motion, const struct ir_track *track) {
    struct loader *loader = motion->loader;
    struct override *path = ARENA_NEW(scratch(motion), struct override);
    struct override_target target;
    struct moving moving, *m = &moving;
    *path =
        (struct override){.loader = loader,
                          .scene = motion->evaluation ? copies_written(motion->evaluation) : motion->scene,
                          .text = track->target,
                          .index = &motion->index,
                          .is_track = true};
    path->track = target_place(motion, track);
    path->source = path->track.source;
    *m = (struct moving){.track = track, .path = path};
    if (!has_one_form(motion, track) || !override_parse_path(path) || !override_walk(path, &target) ||
        !moving_take_target(motion, m, &target))
        return false;
    tell_counted(motion, path);
    if (track->keys.count ? !take_keys(motion, m)
                          : !compile(motion, m, track->value, value_place(motion, track), 0, &m->text))
        return false;
    for (uint32_t i = 0; i < m->text.count && !track->keys.count; i++)
        m->cost += m->text.values[i].cost;
    return moving_push_all(motion, m);
}

// ---- two tracks for one value

static int compare_fields(const void *a, const void *b) {
    const struct moving *const *x = a, *const *y = b;
    if ((*x)->field != (*y)->field)
        return (*x)->field < (*y)->field ? -1 : 1;
    return (*x)->track < (*y)->track ? -1 : (*x)->track > (*y)->track;
}

static void find_twice(const struct motion *motion) {
    struct moving **sorted = ARENA_ARRAY(scratch(motion), struct moving *, motion->count);
    for (uint32_t i = 0; i < motion->count; i++)
        sorted[i] = &motion->items[i];
    if (motion->count)
        qsort(sorted, motion->count, sizeof(struct moving *), compare_fields);
    for (uint32_t i = 1; i < motion->count; i++) {
        const struct moving *first = sorted[i - 1], *second = sorted[i];
        if (first->field + first->width <= second->field || first->track == second->track)
            continue;
        if (first->track > second->track)
            first = sorted[i], second = sorted[i - 1];
        diag_add(sink(motion), DIAG_TRACK_TWICE, second->path->path, "two tracks move %.*s",
                 STR_ARG(say_subject(scratch(motion), second->subject)));
        diag_note(sink(motion), first->path->path, "the other one is here");
    }
}

void motion_find(struct motion *motion) {
    const struct ir_tracks *tracks = &motion->animation->tracks;
    for (uint32_t i = 0; i < tracks->count; i++) {
        look_beyond(motion, &tracks->items[i]);
        read_track(motion, &tracks->items[i]);
    }
    find_twice(motion);
}
