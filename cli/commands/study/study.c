#include "cli/commands/study.h"

#include "cli/device.h"
#include "cli/progress.h"
#include "core/hash128.h"
#include "core/nearest.h"
#include "core/number.h"
#include "diag/codes/command.h"
#include "diag/codes/limit.h"
#include "grammar/ir.h"
#include "load/session_precision.h"
#include "measure/tradeoff/report/report.h"
#include "measure/tradeoff/study/study_store.h"
#include "reference/cache.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Share of --time that a search may take.
static const double SEARCH_TIME_SHARE = 0.5;

static bool read_max_error(struct cli *cli, struct tradeoff_options *options) {
    const struct cli_measure *m = &cli->options.measure;
    const char *text = m->max_error, *equals = strchr(text, '=');
    const str name = {text, equals ? (size_t)(equals - text) : strlen(text)};
    options->metric = metric_find(name);
    if (options->metric == METRIC_COUNT) {
        struct nearest search = nearest_begin(name);
        for (int i = 0; i < METRIC_COUNT; i++)
            nearest_offer(&search, str_from(metric_infos[i].name));
        cli_usage(cli, cli_option_place(cli, "max-error"), "--max-error does not know the metric '%.*s'",
                  STR_ARG(name));
        cli_did_you_mean(
            cli, &search,
            "write METRIC=X, where METRIC is one of mae, rmse, relmse, largest, psnr, ssim, flip, share");
        return false;
    }
    if (equals && number_parse(str_from(equals + 1), &options->max_error) == NUMBER_OK &&
        (options->max_error >= 0 || metric_infos[options->metric].higher_is_better))
        return true;
    cli_usage(cli, cli_option_place(cli, "max-error"), "--max-error takes METRIC=X, such as %s=%s, not '%s'",
              metric_infos[options->metric].name,
              metric_infos[options->metric].higher_is_better ? "0.95" : "0.01", text);
    return false;
}

bool cli_study_options(struct cli *cli, struct tradeoff_options *options) {
    const struct cli_measure *m = &cli->options.measure;
    const struct measure_options standard = measure_options_default();
    *options = (struct tradeoff_options){.metric = METRIC_FLIP,
                                         .max_error = (double)NAN,
                                         .max_time_ms = m->max_time_ms > 0 ? m->max_time_ms : (double)NAN,
                                         .budget_s = m->budget_s,
                                         .threshold = m->has_threshold ? m->threshold : standard.threshold,
                                         .ppd = m->pixels_per_degree > 0 ? m->pixels_per_degree
                                                                         : standard.pixels_per_degree};
    return !m->max_error || read_max_error(cli, options);
}

static bool report_progress(void *context, double fraction, const char *what) {
    struct progress *bar = context;
    const struct render_progress progress = progress_callback(bar);
    bar->what = what;
    return progress.report(progress.context, fraction);
}

static int failed(struct cli *cli, struct session *session, struct gpu *gpu, enum tradeoff_status status) {
    switch (status) {
    case TRADEOFF_DONE:
        return CLI_OK;
    case TRADEOFF_CANCELLED:
        return cli_interrupted(cli);
    case TRADEOFF_SCENE:
        return cli_report(cli, session, !cli->options.quiet);
    case TRADEOFF_DEVICE:
        return cli_device_failed(cli, gpu);
    case TRADEOFF_MEMORY:
        break;
    }
    cli_error(cli, DIAG_OUT_OF_MEMORY, cli->operands[0], NULL, "not enough memory for the study");
    return CLI_SCENE;
}

static int run(struct cli *cli, struct session *session, struct gpu *gpu, const struct view *view,
               const struct tradeoff_options *options, struct tradeoff *study) {
    struct flat_input flat = precision_input(session, view);
    const enum precision_status tried =
        precision_choose(session, &flat, gpu, gpu_info(gpu)->has_double, (struct precision_wish){0}, NULL);
    if (tried != PRECISION_DONE)
        return failed(cli, session, gpu, tried == PRECISION_DEVICE ? TRADEOFF_DEVICE : TRADEOFF_SCENE);
    char *store = cli->options.no_cache ? NULL : folder_store_path(REFERENCE_CACHE_NAME);
    const struct tradeoff_input input = {.scene = &session->resolved,
                                         .view = view,
                                         .image = session->image,
                                         .origin = flat.origin,
                                         .limits = &session->options.limits,
                                         .sink = &session->sink,
                                         .gpu = gpu,
                                         .store = {store, REFERENCE_CACHE_BYTES},
                                         .is_double = flat.is_double};
    struct progress bar;
    progress_begin(&bar, cli->options.quiet);
    const struct tradeoff_progress progress = {report_progress, &bar};
    const enum tradeoff_status status = tradeoff_run(study, &input, options, &progress);
    progress_end(&bar);
    free(store);
    return failed(cli, session, gpu, status);
}

// A hash of what a search depends on: the scene with its files, the view, the question, the device and its
// driver, and this version of glint.
static void study_key(const struct session *session, const struct view *view, const struct gpu *gpu,
                      const struct tradeoff_options *options, uint64_t key[2]) {
    const struct reference_input input = {.scene = &session->resolved, .view = view};
    const struct gpu_device_info *info = gpu_info(gpu);
    struct hash128 h;
    uint64_t scene[2];
    reference_input_key(&input, scene);
    hash128_begin(&h);
    hash128_whole(&h, scene[0]);
    hash128_whole(&h, scene[1]);
    hash128_whole(&h, (uint64_t)session->image->width);
    hash128_whole(&h, (uint64_t)session->image->height);
    hash128_whole(&h, (uint64_t)session->image->samples);
    for (int i = 0; i < LIMIT_COUNT; i++)
        hash128_whole(&h, session->options.limits.value[i]);
    hash128_whole(&h, options->metric);
    hash128_number(&h, options->max_error);
    hash128_number(&h, options->max_time_ms);
    hash128_number(&h, options->threshold);
    hash128_number(&h, options->ppd);
    hash128_whole(&h, options->allow_resolution);
    hash128_number(&h, options->levels);
    hash128_text(&h, str_from(info->name));
    hash128_text(&h, str_from(info->driver));
    hash128_text(&h, STR(GLINT_VERSION));
    hash128_end(&h, key);
}

// Searches are cached; whole studies are measured each time.
static int run_or_recall(struct cli *cli, struct session *session, struct gpu *gpu, const struct view *view,
                         const struct tradeoff_options *options, struct tradeoff *study) {
    if (!options->search || cli->options.no_cache)
        return run(cli, session, gpu, view, options, study);
    char *path = folder_store_path(STUDY_CACHE_NAME);
    const struct folder_store store = {path, STUDY_CACHE_BYTES};
    uint64_t key[2];
    study_key(session, view, gpu, options, key);
    const bool known = study_recall(&store, key, study);
    const int status = known ? CLI_OK : run(cli, session, gpu, view, options, study);
    study->is_recalled = known;
    // A search that was cut short may find more with more time.
    if (status == CLI_OK && !known && !study->cut_short)
        study_keep(&store, key, study);
    free(path);
    return status;
}

int cli_study(struct cli *cli, struct session *session, const struct tradeoff_options *options,
              struct gpu **gpu, struct tradeoff *study) {
    struct view view;
    const uint32_t camera = session_camera(session, cli->options.camera);
    *study = (struct tradeoff){0};
    if (camera == IR_NO_INDEX)
        return cli_report(cli, session, !cli->options.quiet);
    int status = cli_try_output(cli, cli->options.output);
    if (status == CLI_OK)
        status = cli_open_device(cli, gpu);
    if (status == CLI_OK && !session_view(session, camera, &view))
        status = failed(cli, session, *gpu, TRADEOFF_MEMORY);
    return status == CLI_OK ? run_or_recall(cli, session, *gpu, &view, options, study) : status;
}

// ---- for render

static void tell_search(const struct cli *cli, const struct tradeoff *study) {
    struct strbuf text;
    if (cli->options.quiet)
        return;
    strbuf_init(&text);
    tradeoff_search_notes(study, &text);
    tradeoff_answers(study, &text);
    fwrite(text.data ? text.data : "", 1, text.len, stderr);
    strbuf_finish(&text);
}

// Says what would keep the bound, or why nothing does; false: that is not known.
static bool put_verdict(const struct tradeoff *study, char *out, size_t capacity) {
    const struct search_verdict *v = &study->verdict;
    const struct metric_info *metric = &metric_infos[study->options.metric];
    const double value = metric->higher_is_better ? -v->value : v->value;
    if (v->kind == SEARCH_SAMPLES)
        snprintf(out, capacity, "about %.3g samples would keep it%s: %.3g s by the clock of the device",
                 v->samples, v->samples > SEARCH_SAMPLES_MOST ? ", more than a picture may have" : "",
                 v->seconds);
    else if (v->kind == SEARCH_FORMAT)
        snprintf(
            out, capacity,
            "rounding to %.0f steps alone has %s %.3g: write a .pfm or an .exr, or a .png with --depth 16",
            study->options.levels, metric->name, value);
    else if (v->kind == SEARCH_REMAINS)
        snprintf(out, capacity, "%s %.3g remains, however many samples there are", metric->name, value);
    return v->kind != SEARCH_UNKNOWN;
}

static void tell_nothing_fits(struct cli *cli, const struct tradeoff *study) {
    char verdict[200];
    const char *help =
        put_verdict(study, verdict, sizeof verdict) ? verdict
        : study->cut_short
            ? "the time ended the search: with more, by --budget or --time, others may be found"
            : "'glint tradeoff' tries more settings, and shows all of them";
    cli_error(cli, DIAG_NOTHING_FITS, cli->operands[0], help,
              study->cut_short
                  ? "the time for the search ended before any settings stayed within the bounds of "
                    "--max-error and --max-time"
                  : "no settings that were tried stay within the bounds of --max-error and "
                    "--max-time");
}

static int take_choice(struct cli *cli, const struct tradeoff *study) {
    const uint32_t row = tradeoff_choice(study)->row;
    tell_search(cli, study);
    if (row == CHOICE_NONE) {
        tell_nothing_fits(cli, study);
        return CLI_SCENE;
    }
    char assignment[80];
    const struct setting *s = &study->rows[row].setting, *base = &study->base;
    for (uint32_t i = 0; setting_assignment(s, base, i, assignment, sizeof assignment); i++) {
        str *set = ARENA_PUSH(&cli->arena, &cli->options.sets);
        *set = arena_copy(&cli->arena, str_from(assignment));
    }
    // The choice includes the sizes: else those of the command line would override it.
    if (s->width != base->width || s->height != base->height) {
        cli->options.measure.scale_width = base->width;
        cli->options.measure.scale_height = base->height;
        cli->options.width = (int32_t)s->width;
        cli->options.height = (int32_t)s->height;
    }
    if (cli->options.samples)
        cli->options.samples = (int32_t)s->samples;
    return CLI_OK;
}

static int study_session(struct cli *cli, struct session *session, const struct tradeoff_options *options,
                         struct gpu **gpu) {
    struct tradeoff study;
    int status = cli_study(cli, session, options, gpu, &study);
    if (status == CLI_OK)
        status = take_choice(cli, &study);
    tradeoff_finish(&study);
    return status;
}

int cli_choose_settings(struct cli *cli, double levels, struct asset_store *store, struct gpu **gpu) {
    struct tradeoff_options options;
    struct session session;
    if (!cli_study_options(cli, &options))
        return CLI_USAGE;
    if (cli_device_is_reference(cli) || str_equal(cli->options.camera, STR("all")))
        return cli_usage(cli, cli_option_place(cli, "max-error"),
                         "--max-error and --max-time work for one camera, on a device");
    options.search = true;
    options.levels = levels;
    // The picture needs the rest of the time.
    if (cli->options.measure.time_s > 0)
        options.end = cli->begun + SEARCH_TIME_SHARE * cli->options.measure.time_s;
    options.allow_resolution = cli->options.measure.allow_resolution;
    struct session_options load = cli_session_options(cli, cli->operands[0]);
    load.whole_picture = true;
    session_load(&session, &load, store);
    const bool good = session.state == SESSION_LOADED && session.sink.errors == 0;
    // If the scene has errors, the rendering itself reports them.
    const int status = good ? study_session(cli, &session, &options, gpu) : CLI_OK;
    session_finish(&session);
    return status;
}
