// glint compare A B: how far one picture is from another, and whether that is near enough.
#include "cli/commands/commands.h"
#include "core/heap.h"

#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "files/files.h"
#include "grammar/schema.h"
#include "picture/metrics/compare_report.h"
#include "picture/metrics/heatmap.h"
#include "picture/metrics/picture_file.h"

#include <stdlib.h>
#include <string.h>

struct comparison {
    struct cli *cli;
    int format, status;
    struct files files;
    struct arena arena; // of the files' bytes
    struct picture_file pictures[2];
    struct measure_options options;
    struct measure_result result;
    float *map;    // a value per pixel, for the heat map; NULL if there is none
    float *linear; // the float picture as its file has it, if the other holds bytes; else NULL
};

static int cannot_read(struct comparison *c, const char *path, diag_code code, const char *why) {
    cli_error(c->cli, code, path, NULL, "%s", why);
    return CLI_FILE;
}

static int read_picture(struct comparison *c, int which) {
    const char *path = c->cli->operands[which];
    const struct limits *limits = &c->cli->options.limits;
    str bytes;
    enum file_status status =
        files_read_given(&c->files, str_from(path), limits->value[LIMIT_IMAGE_BYTES], &c->arena, &bytes);
    if (status != FILE_OK)
        return cannot_read(c, path, session_file_code(status), file_status_text(&c->files, status));
    bool unknown;
    const char *fault =
        picture_file_decode(bytes, limits->value[LIMIT_IMAGE_MEMORY], &c->pictures[which], &unknown);
    return fault ? cannot_read(c, path, unknown ? DIAG_IMAGE_KIND : DIAG_IMAGE_BROKEN, fault) : CLI_OK;
}

static int no_memory(struct comparison *c) {
    cli_error(c->cli, DIAG_OUT_OF_MEMORY, c->cli->operands[0], NULL,
              "not enough memory to compare the pictures");
    return CLI_SCENE;
}

static bool keep_linear(struct comparison *c, int which) {
    const struct picture_file *p = &c->pictures[which];
    const size_t size = heap_times(heap_times(p->width, p->height), 3 * sizeof *c->linear);
    c->linear = heap_alloc(size);
    if (c->linear)
        memcpy(c->linear, p->rgb, size);
    return c->linear;
}

// A float picture does not say how the byte picture was toned. If another way than the assumed one brings
// them much nearer, help names that way.
static bool offer_display(struct comparison *c) {
    const char *const *tones = schema_words(&SCHEMA_IMAGE, "tone");
    const char *const *transfers = schema_words(&SCHEMA_IMAGE, "transfer");
    struct picture_file *p = c->pictures;
    float *shown = p[p[0].space == MEASURE_LINEAR ? 0 : 1].rgb; // no longer needed
    struct measure_options options = c->options;
    struct measure_result result;
    double best = c->result.value[METRIC_MAE] / 2;
    options.metrics = 1 << METRIC_MAE;
    for (unsigned tone = 0, transfer = 0; tones[tone]; transfer = !transfer, tone += !transfer) {
        const struct image_display display = {.tone = tone, .transfer = transfer};
        image_to_displayed(c->linear, (size_t)p[0].width * p[0].height, display, shown);
        if (!measure_pictures(p[0].width, p[0].height, p[0].rgb, p[1].rgb, &options, &result, NULL, NULL))
            return false;
        if (result.value[METRIC_MAE] < best) {
            best = result.value[METRIC_MAE];
            options.display = display;
        }
    }
    if (best < c->result.value[METRIC_MAE] / 2) {
        struct strbuf text;
        strbuf_init(&text);
        strbuf_format(
            &text,
            "glint: the pictures are closer with '--tone %s --transfer %s': mae %.3g instead of %.3g\n",
            tones[options.display.tone], transfers[options.display.transfer], best,
            c->result.value[METRIC_MAE]);
        cli_write_error(strbuf_view(&text));
        strbuf_finish(&text);
    }
    return true;
}

// Linear floats can be displayed exactly, but not the reverse: pictures of two kinds are compared as
// displayed.
static int choose_space(struct comparison *c) {
    const struct cli_measure *m = &c->cli->options.measure;
    const bool linear = c->pictures[0].space == MEASURE_LINEAR && c->pictures[1].space == MEASURE_LINEAR;
    if (m->space == CLI_SPACE_LINEAR && !linear) {
        cli_usage(c->cli, cli_option_place(c->cli, "space"), "an 8-bit picture has only displayed values");
        diag_help(&c->cli->sink, "compare two .pfm or .hdr pictures, or leave '--space linear' out");
        return CLI_USAGE;
    }
    c->options = measure_options_default();
    c->options.space = linear && m->space != CLI_SPACE_DISPLAYED ? MEASURE_LINEAR : MEASURE_DISPLAYED;
    c->options.threshold = m->has_threshold ? m->threshold : c->options.threshold;
    c->options.pixels_per_degree =
        m->pixels_per_degree > 0 ? m->pixels_per_degree : c->options.pixels_per_degree;
    c->options.display = m->display;
    for (int i = 0; i < 2; i++)
        if (c->pictures[i].space == MEASURE_LINEAR && c->pictures[1 - i].space != MEASURE_LINEAR &&
            !m->has_display && !keep_linear(c, i))
            return no_memory(c);
    for (int i = 0; i < 2; i++)
        if (c->options.space == MEASURE_DISPLAYED && c->pictures[i].space == MEASURE_LINEAR)
            image_to_displayed(c->pictures[i].rgb, (size_t)c->pictures[i].width * c->pictures[i].height,
                               m->display, c->pictures[i].rgb);
    return CLI_OK;
}

static int check_sizes(struct comparison *c) {
    const struct picture_file *p = c->pictures;
    if (p[0].width == p[1].width && p[0].height == p[1].height)
        return CLI_OK;
    return cli_usage(c->cli, cli_operand_place(c->cli, 1),
                     "the pictures differ in size: %u x %u and %u x %u pixels", p[0].width, p[0].height,
                     p[1].width, p[1].height);
}

static int write_heatmap(struct comparison *c) {
    const struct cli_measure *m = &c->cli->options.measure;
    struct strbuf png;
    strbuf_init(&png);
    heatmap_png(c->pictures[0].width, c->pictures[0].height, c->map,
                m->heatmap_flip ? HEATMAP_LINEAR : HEATMAP_LOGARITHMIC, &png);
    const int status = cli_write_made(c->cli, m->heatmap, &png, "the heat map");
    strbuf_finish(&png);
    return status;
}

static int report(struct comparison *c) {
    struct cli *cli = c->cli;
    const struct compare_report report = {.path = {cli->operands[0], cli->operands[1]},
                                          .kind = {c->pictures[0].kind, c->pictures[1].kind},
                                          .width = c->pictures[0].width,
                                          .height = c->pictures[0].height,
                                          .options = &c->options,
                                          .result = &c->result,
                                          .bounds = &cli->options.measure.bounds};
    struct strbuf text;
    strbuf_init(&text);
    if (c->format == 1)
        compare_json(&report, &text);
    else
        compare_text(&report, &text);
    const int status = cli_write_made(cli, "-", &text, "the report");
    strbuf_finish(&text);
    return status == CLI_OK && !compare_keeps_bounds(&report) ? CLI_SCENE : status;
}

static int compare(struct comparison *c) {
    const struct cli_measure *m = &c->cli->options.measure;
    int status = CLI_OK;
    for (int i = 0; i < 2 && status == CLI_OK; i++)
        status = read_picture(c, i);
    if (status == CLI_OK)
        status = check_sizes(c);
    if (status == CLI_OK)
        status = choose_space(c);
    if (status != CLI_OK)
        return status;
    const struct picture_file *p = c->pictures;
    if (m->heatmap)
        c->map = heap_array(heap_times(p[0].width, p[0].height), sizeof *c->map);
    if ((m->heatmap && !c->map) ||
        !measure_pictures(p[0].width, p[0].height, p[0].rgb, p[1].rgb, &c->options, &c->result,
                          m->heatmap_flip ? NULL : c->map, m->heatmap_flip ? c->map : NULL))
        return no_memory(c);
    if (m->heatmap && (status = write_heatmap(c)) != CLI_OK)
        return status;
    status = report(c);
    return c->linear && !offer_display(c) ? no_memory(c) : status;
}

static void run(void *context) {
    struct comparison *c = context;
    files_init(&c->files, &c->arena);
    c->status = compare(c);
}

int cmd_compare(struct cli *cli) {
    static const char *const formats[] = {"text", "json", NULL};
    int format;
    if (!cli_format(cli, formats, &format))
        return CLI_USAGE;
    struct comparison *c = heap_zeroed(1, sizeof *c);
    if (!c) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, cli->operands[0], NULL, "not enough memory");
        return CLI_SCENE;
    }
    *c = (struct comparison){.cli = cli, .format = format, .status = CLI_SCENE};
    arena_init(&c->arena, SIZE_MAX / 2);
    if (arena_guarded(&c->arena, run, c) != ARENA_FAULT_NONE)
        cli_error(cli, DIAG_OUT_OF_MEMORY, cli->operands[0], NULL, "not enough memory for the pictures");
    for (int i = 0; i < 2; i++)
        picture_file_finish(&c->pictures[i]);
    free(c->map);
    free(c->linear);
    arena_finish(&c->arena);
    int status = c->status;
    free(c);
    return status;
}
