#include "load/session_precision.h"
#include "diag/codes/device.h"
#include "diag/codes/limit.h"
#include "diag/codes/rule.h"

#include "grammar/ir.h"
#include "grammar/schema.h"
#include "load/where.h"

static const char *const feature_words[PRECISION_FEATURES] = {
    [PRECISION_EDGE] = "shortest edge",
    [PRECISION_SIZE] = "smallest body",
    [PRECISION_GAP] = "smallest gap",
    [PRECISION_HEIGHT] = "lowest camera",
};

const char *precision_feature_words(enum precision_feature feature) {
    return feature_words[feature];
}

const char *precision_setting_word(unsigned setting) {
    static const char *const words[] = {"auto", "single", "double"};
    return words[setting];
}

static void put_body(const struct session *session, uint32_t body, uint32_t triangle, struct strbuf *out) {
    struct where where;
    bool found = where_find(session, body, triangle, &where);
    where_body_words(found ? &where : NULL, out);
    if (!found || span_is_none(where.at))
        return;
    // Line maps are made on first use.
    struct source_place place = source_locate((struct source_set *)&session->sources, where.at);
    strbuf_format(out, " (%.*s:%u:%u)", STR_ARG(place.path), place.line, place.column);
}

// "0.02 at a distance of 300: 1118 steps; model 'dragon' (scene.yaml:3:5), line 12 of dragon.obj"
static void put_measure(const struct session *session, enum precision_feature feature,
                        const struct precision_measure *m, struct strbuf *out) {
    const char *against = feature == PRECISION_HEIGHT || m->part == PRECISION_HEIGHT_PART
                              ? "against a surface as long as"
                              : "at a distance of";
    strbuf_format(out, "%.3g %s %.3g: %.3g steps; ", m->length, against, m->distance, m->steps);
    put_body(session, m->body, m->triangle, out);
    if (feature == PRECISION_GAP) {
        strbuf_cstr(out, " and ");
        put_body(session, m->other, 0, out);
    }
    struct where where;
    if ((feature == PRECISION_EDGE || feature == PRECISION_HEIGHT) &&
        where_find(session, m->body, m->triangle, &where) && where.mesh_line)
        strbuf_format(out, ", %s %u of %.*s", where.mesh_word, where.mesh_line, STR_ARG(where.mesh));
}

static void put_trial(const struct precision_choice *choice, struct strbuf *out) {
    if (choice->traced)
        strbuf_format(out, "%u of %u pixels traced in both precisions differ\n", choice->off, choice->pixels);
    else if (choice->report.suffices)
        strbuf_cstr(out, "single precision suffices\n");
    else
        strbuf_format(out, "single precision does not suffice: the %s decides\n",
                      feature_words[choice->report.decides]);
}

void precision_words(const struct session *session, const struct precision_choice *choice,
                     struct strbuf *out) {
    const char *setting = precision_setting_word(session->scene->trace.precision);
    const struct precision_report *report = &choice->report;
    strbuf_format(out, "precision   %s", precision_is_double(session->scene, choice) ? "double" : "single");
    strbuf_format(out, ", the setting is %s; ", setting);
    put_trial(choice, out);
    for (int i = 0; i < PRECISION_FEATURES; i++) {
        if (!report->least[i].any)
            continue;
        strbuf_format(out, "  %-17s", feature_words[i]);
        put_measure(session, (enum precision_feature)i, &report->least[i], out);
        strbuf_char(out, '\n');
    }
    strbuf_format(out, "  a step is 2^-24 of the distance\n");
    if (!report->all_pairs)
        strbuf_cstr(out, "  there are too many bodies close together to look for gaps between all of them\n");
}

// What decides the precision, as a note to the preceding warning.
static void note_measure(struct session *session, const struct precision_choice *choice) {
    const struct precision_report *report = &choice->report;
    struct strbuf words;
    if (choice->traced)
        diag_note(&session->sink, SPAN_NONE, "%u of %u pixels traced in both precisions differ", choice->off,
                  choice->pixels);
    const struct precision_measure *least = &report->least[report->decides];
    if (!least->any || least->steps >= PRECISION_STEPS)
        return;
    strbuf_init(&words);
    put_measure(session, report->decides, &report->least[report->decides], &words);
    diag_note(&session->sink, SPAN_NONE, "%s %.*s", feature_words[report->decides],
              STR_ARG(strbuf_view(&words)));
    strbuf_finish(&words);
}

static void warn(struct session *session, const struct precision_choice *choice) {
    const struct precision_measure *m = &choice->report.least[choice->report.decides];
    struct where where;
    bool found = m->any && where_find(session, m->body, m->triangle, &where);
    diag_add(&session->sink, DIAG_SINGLE_ONLY, found ? where.at : SPAN_NONE,
             "the device computes only in single precision, but this scene needs double");
    note_measure(session, choice);
}

static void report_no_memory(struct session *session) {
    diag_add(&session->sink, DIAG_OUT_OF_MEMORY, SPAN_NONE,
             "there is not enough memory to measure the scene");
}

// The least number of samples that a pixel gets.
static uint32_t samples_of(const struct session *session) {
    const struct ir_image *image = session->image;
    const bool fewer = image->error > 0 && image->min_samples < image->samples;
    return (uint32_t)(fewer ? image->min_samples : image->samples);
}

// A trial without a device.
static bool forecast(const struct session *session, const struct flat_input *input,
                     struct precision_choice *out) {
    const struct precision_trial trial = {.input = input,
                                          .width = (uint32_t)session->image->width,
                                          .height = (uint32_t)session->image->height,
                                          .samples = samples_of(session)};
    return precision_try(&trial, out, NULL) == PRECISION_DONE;
}

void precision_check(struct session *session) {
    const struct ir_trace *trace = &session->scene->trace;
    if (trace->precision != IR_PRECISION_SINGLE)
        return;
    struct view view;
    view_build(&session->resolved, 0, session->image->width, session->image->height, &session->arena, NULL,
               &view);
    struct flat_input input = precision_input(session, &view);
    struct precision_choice choice;
    if (!forecast(session, &input, &choice) || !choice.needs_double)
        return;
    diag_add(&session->sink, DIAG_SINGLE_PRECISION,
             ir_place_value(&session->origin, &trace->head, &SCHEMA_TRACE, "precision"),
             "'trace.precision' is 'single', but this scene needs double");
    note_measure(session, &choice);
    diag_help(&session->sink,
              "leave 'precision' out: 'auto' computes in double precision when that is needed");
}

struct flat_input precision_input(struct session *session, const struct view *view) {
    return (struct flat_input){.scene = &session->resolved,
                               .view = view,
                               .origin = session_origin(session, view),
                               .limits = &session->options.limits,
                               .sink = &session->sink,
                               .timeline = session->options.timeline};
}

bool precision_forecast(struct session *session, const struct flat_input *input,
                        struct precision_choice *out) {
    if (forecast(session, input, out))
        return true;
    report_no_memory(session);
    return false;
}

static enum precision_status choose(struct session *session, struct flat_input *input, struct gpu *gpu,
                                    bool has_double, struct precision_wish wish,
                                    struct precision_gains *gains) {
    const struct precision_trial trial = {.input = input,
                                          .width = (uint32_t)session->image->width,
                                          .height = (uint32_t)session->image->height,
                                          .samples = samples_of(session),
                                          .gpu = gpu,
                                          .reference = wish.reference,
                                          .ready = wish.ready,
                                          .ready_context = wish.ready_context};
    struct precision_choice choice;
    const enum precision_status status = precision_try(&trial, &choice, gains);
    if (status == PRECISION_MEMORY)
        report_no_memory(session);
    if (status != PRECISION_DONE)
        return status;
    if (wish.choice)
        *wish.choice = choice;
    if (choice.needs_double && !has_double)
        warn(session, &choice);
    input->is_double = choice.needs_double && has_double;
    return PRECISION_DONE;
}

enum precision_status precision_choose(struct session *session, struct flat_input *input, struct gpu *gpu,
                                       bool has_double, struct precision_wish wish,
                                       struct precision_gains *gains) {
    const struct ir_trace *trace = &session->scene->trace;
    if (gains)
        *gains = (struct precision_gains){0};
    input->is_double = trace->precision == IR_PRECISION_DOUBLE;
    if (input->is_double && !has_double) {
        diag_add(&session->sink, DIAG_NO_DOUBLE,
                 ir_place_value(&session->origin, &trace->head, &SCHEMA_TRACE, "precision"),
                 "'trace.precision' is 'double', but the device cannot compute in double precision");
        return PRECISION_SCENE;
    }
    return trace->precision == IR_PRECISION_AUTO ? choose(session, input, gpu, has_double, wish, gains)
                                                 : PRECISION_DONE;
}
