// glint render --device reference: the same files as a device makes, by the tracer in double precision.
#include "cli/commands/rendering.h"
#include "core/json_write.h"
#include "render/reference_shot.h"

#include <stdio.h>
#include <string.h>

// Adapts the progress bar, which takes a render_progress: both callbacks answer whether to continue.
static bool report(void *context, double fraction) {
    const struct render_progress *progress = context;
    return progress->report(progress->context, fraction);
}

#define RAY_COUNTS(X)                                                                                        \
    X("primary", "primary", s->primary)                                                                      \
    X("reflected", "reflected", s->reflected)                                                                \
    X("refracted", "refracted", s->refracted)                                                                \
    X("shadow", "shadow", s->shadow)                                                                         \
    X("total reflections", "total_reflections", s->total_reflections)                                        \
    X("unseen crossings", "unseen_crossings", s->unseen)                                                     \
    X("cut by depth", "cut_by_depth", s->cut_by_depth)                                                       \
    X("cut by weight", "cut_by_weight", s->cut_by_weight)                                                    \
    X("cut by segments", "cut_by_segments", s->cut_by_segments)                                              \
    X("deepest level", "deepest", s->deepest)

static void text_of(const struct reference_shot *shot, const struct reference_statistics *s,
                    struct strbuf *out) {
    const struct reference_settings *settings = &shot->settings;
    strbuf_format(
        out, "device: reference, double precision%s\npicture: %u x %u, %u sample%s, computed in %.3f s\n",
        shot->source.found ? ", from its cache" : "", settings->width, settings->height, settings->samples,
        settings->samples == 1 ? "" : "s", s->seconds);
    strbuf_cstr(out, "rays\n");
#define WORDS(words, name, value) strbuf_format(out, "  %-18s %12llu\n", words, (unsigned long long)(value));
    RAY_COUNTS(WORDS)
#undef WORDS
    strbuf_format(
        out,
        "weight of the rays not followed\n  worst pixel        %12.3g\n  mean               %12.3g\n"
        "  brightest in view  %12.3g\n  could add at most  %12.3g\n",
        s->left_weight_most, s->left_weight_mean, s->brightest, s->bound);
}

static void json_of(const struct reference_shot *shot, const struct reference_statistics *s,
                    struct strbuf *out) {
    const struct reference_settings *settings = &shot->settings;
    const double unused_error = shot->session->unused_error;
    struct json_writer w;
    json_report_begin(&w, out, JSON_WRITE_DEPTH_MAX, "glint render --device reference", 1);
    json_write_text(&w, "device", STR("reference"));
    json_write_text(&w, "camera", shot->view.camera.name);
    json_write_boolean(&w, "as_file", settings->as_file);
    json_write_boolean(&w, "cached", shot->source.found > 0);
    json_write_integer(&w, "width", settings->width);
    json_write_integer(&w, "height", settings->height);
    json_write_integer(&w, "samples", settings->samples);
    if (unused_error > 0)
        json_write_real(&w, "unused_error", unused_error);
    json_write_real(&w, "seconds", s->seconds);
    json_open_object(&w, "rays");
#define JSON(words, name, value) json_write_integer(&w, name, value);
    RAY_COUNTS(JSON)
#undef JSON
    json_close_object(&w);
    json_open_object(&w, "left");
    json_write_real(&w, "worst_pixel", s->left_weight_most);
    json_write_real(&w, "mean", s->left_weight_mean);
    json_write_real(&w, "brightest", s->brightest);
    json_write_real(&w, "bound", s->bound);
    json_close_object(&w);
    json_report_end(&w);
}

static int tell_statistics(struct rendering *r, const struct reference_shot *shot,
                           const struct reference_statistics *statistics) {
    struct strbuf text;
    strbuf_init(&text);
    (r->cli->options.stats == CLI_STATS_JSON ? json_of : text_of)(shot, statistics, &text);
    int status = render_tell_stats(r, strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}

static void tell_end(struct rendering *r, const struct reference_shot *shot, uint32_t camera,
                     const struct reference_statistics *statistics) {
    if (r->cli->options.quiet)
        return;
    render_tell_unused_error(r);
    fprintf(stderr,
            "glint: the reference left out at most %.3g of a pixel's weight, which could add %.3g%s\n",
            statistics->left_weight_most, statistics->bound,
            shot->source.found ? " (picture from its cache)" : "");
    render_tell_written(r, camera);
}

static int render_camera(struct rendering *r, uint32_t camera) {
    const struct cli_options *options = &r->cli->options;
    struct reference_shot shot;
    struct reference_statistics statistics;
    struct render_progress callback = progress_callback(&r->progress);
    struct reference_progress progress = {report, &callback};
    enum shot_status taken = reference_shot_open(
        &shot, &r->session, camera, (struct reference_shot_options){options->as_file, options->no_cache});
    progress_begin(&r->progress, options->quiet);
    if (taken == SHOT_OK)
        taken = reference_shot_take(&shot, &r->image, NULL, &progress, &statistics);
    int status = taken == SHOT_OK ? CLI_OK : taken == SHOT_CANCELLED ? render_interrupted(r) : CLI_SCENE;
    if (status == CLI_OK)
        status = render_make_aovs(r, &shot);
    progress_end(&r->progress);
    if (status == CLI_OK)
        status = render_write_pictures(r, camera);
    if (status == CLI_OK)
        status = render_write_aovs(r, camera);
    render_drop_aovs(r);
    if (status == CLI_OK && options->stats)
        status = tell_statistics(r, &shot, &statistics);
    if (status == CLI_OK)
        tell_end(r, &shot, camera, &statistics);
    reference_shot_close(&shot);
    return status;
}

int render_by_reference(struct rendering *r, uint32_t first, uint32_t end) {
    int status = CLI_OK;
    for (uint32_t i = first; i < end && status == CLI_OK; i++)
        status = r->done && r->done[i] ? CLI_OK : render_camera(r, i);
    int reported = cli_report(r->cli, &r->session, !r->cli->options.quiet);
    return status != CLI_OK ? status : reported;
}
