// What render writes: its pictures.
#include "cli/commands/rendering.h"
#include "core/clock.h"
#include "core/timeline.h"
#include "diag/codes/limit.h"
#include "grammar/ir.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// ---- names

str render_stem_of(str path) {
    size_t dot = path.len;
    while (dot > 0 && path.ptr[dot - 1] != '.')
        dot--;
    return str_slice(path, 0, dot ? dot - 1 : path.len);
}

// OUT.NAME.png for OUT.png.
static const char *camera_output(struct rendering *r, str path, str camera) {
    const str stem = render_stem_of(path);
    return arena_format(&r->cli->arena, "%.*s.%.*s%s", STR_ARG(stem), STR_ARG(camera), path.ptr + stem.len)
        .ptr;
}

const char *render_output_of(struct rendering *r, const struct cli_output *output, uint32_t camera) {
    return r->all_cameras
               ? camera_output(r, str_from(output->path), r->job.session->scene->cameras.items[camera].name)
               : output->path;
}

static bool is_stdout(const struct cli_output *output) {
    return strcmp(output->path, "-") == 0;
}

const char *render_typed(const struct cli_output *output) {
    return output->arg ? output->path : "";
}

bool render_uses_stdout(const struct rendering *r) {
    bool uses = false;
    for (uint32_t i = 0; i < r->output_count; i++)
        uses |= is_stdout(&r->outputs[i]);
    return uses;
}

// ---- the command line

static int needs_output(struct cli *cli) {
    int status = cli_usage(cli, cli_operand_place(cli, 0),
                           "a picture of standard input has no name: say where to write it");
    diag_help(&cli->sink, "for example -o picture.png, or '-o -' for standard output");
    return status;
}

static int judge_output(struct rendering *r, struct cli_output *output) {
    struct cli *cli = r->cli;
    output->format = IMAGE_PNG;
    output->is_part = str_ends_with_nocase(str_from(output->path), PART_ENDING);
    if (!output->is_part && !is_stdout(output) && strncmp(output->path, "/dev/", 5) != 0 &&
        !image_format_of_path(str_from(output->path), IMAGE_WRITTEN, &output->format))
        return cli_usage(cli, output->arg, "the output '%s' must end in %s", output->path,
                         IMAGE_WRITTEN_ENDINGS);
    if (image_format_missing(output->format)) {
        const int status = cli_usage(cli, output->arg, "the output '%s' cannot be written: %s", output->path,
                                     image_format_missing(output->format));
        diag_help(&cli->sink, "install the package and build glint again, or choose another ending");
        return status;
    }
    if (is_stdout(output) && str_equal(cli->options.camera, STR("all"))) {
        const int status = cli_usage(cli, output->arg, "'--camera all' writes a file for each camera");
        diag_help(&cli->sink, "name a file; only one picture can go to '-'");
        return status;
    }
    for (const struct cli_output *first = r->outputs; first < output; first++)
        if (strcmp(first->path, output->path) == 0) {
            const int status = cli_usage(cli, output->arg, "the output '%s' is named twice", output->path);
            diag_note(&cli->sink, cli_place(cli, first->arg), "the first one is here");
            diag_help(&cli->sink, "leave one of them out, or give it another name");
            return status;
        }
    return CLI_OK;
}

static bool has_bits(const struct image_format_info *info, int32_t bits) {
    for (const unsigned *b = info->bits; *b; b++)
        if ((int32_t)*b == bits)
            return true;
    return false;
}

// A coding option that no output can use is a mistake.
static int judge_coding(struct rendering *r) {
    struct cli *cli = r->cli;
    bool depth = cli->options.depth == 0, quality = false, compression = false;
    for (uint32_t i = 0; i < r->output_count; i++) {
        const struct image_format_info *info = image_format_info(r->outputs[i].format);
        if (r->outputs[i].is_part)
            continue;
        depth |= has_bits(info, cli->options.depth);
        quality |= info->has_quality;
        compression |= info->has_compression;
    }
    if (!depth)
        return cli_usage(cli, cli_option_place(cli, "depth"), "no output can have %d bits per channel",
                         cli->options.depth);
    if ((!quality && cli_has_no_effect(cli, "quality", "no output is JPEG or WebP")) ||
        (!compression && cli_has_no_effect(cli, "compression", "no output is OpenEXR")))
        return CLI_USAGE;
    return CLI_OK;
}

// Once the scene has said how large it is.
int render_judge_size(struct rendering *r) {
    const struct cli_measure *m = &r->cli->options.measure;
    const bool scaled = m->scale_width != 0;
    const uint32_t width = scaled ? m->scale_width : r->job.image.width;
    const uint32_t height = scaled ? m->scale_height : r->job.image.height;
    for (uint32_t i = 0; i < r->output_count; i++) {
        const struct image_format_info *info = image_format_info(r->outputs[i].format);
        if (!r->outputs[i].is_part && info->side_max && (width > info->side_max || height > info->side_max)) {
            const int status = cli_usage(r->cli, r->outputs[i].arg,
                                         "a %s picture has at most %u pixels in a row or column, not %u x %u",
                                         info->words, info->side_max, width, height);
            diag_help(&r->cli->sink, "choose another ending, or a smaller --size");
            return status;
        }
    }
    return CLI_OK;
}

struct image_coding render_coding(const struct cli_options *o, enum image_format format) {
    const struct image_format_info *info = image_format_info(format);
    return (struct image_coding){.bits = has_bits(info, o->depth) ? (unsigned)o->depth : info->bits[0],
                                 .quality = (unsigned)o->quality,
                                 .compression = (unsigned)o->compression};
}

int render_take_outputs(struct rendering *r) {
    struct cli *cli = r->cli;
    struct cli_outputs *outputs = &cli->options.outputs;
    int status = CLI_OK;
    if (outputs->count == 0 && cli_is_stream(cli, cli->operands[0]))
        return needs_output(cli);
    if (outputs->count == 0)
        *(struct cli_output *)ARENA_PUSH(&cli->arena, outputs) =
            (struct cli_output){.path = cli_default_picture(cli, cli->operands[0])};
    r->outputs = outputs->items;
    r->output_count = outputs->count;
    for (uint32_t i = 0; i < outputs->count && status == CLI_OK; i++)
        status = judge_output(r, &outputs->items[i]);
    return status == CLI_OK ? judge_coding(r) : status;
}

// ---- pictures

static int write_made(struct rendering *r, const char *path, const struct strbuf *file) {
    if (file->failed) {
        cli_error(r->cli, DIAG_OUT_OF_MEMORY, path, NULL, "not enough memory to encode the picture");
        return CLI_FILE;
    }
    const double start = clock_seconds();
    const int status = cli_write(r->cli, path, strbuf_view(file));
    timeline_add(r->job.wish.timeline, "write", str_from(path), start);
    return status;
}

void render_encode(struct rendering *r, enum image_format format, struct strbuf *out) {
    struct job *job = &r->job;
    const struct image_coding coding = render_coding(&r->cli->options, format);
    job->image.coding = coding;
    job->image.texts = (struct image_texts){0};
    if (r->record)
        job->image.texts = provenance_of_line(r->record, format, coding, job->arena);
    else if (job->session->scene && !job->is_part) {
        // Parts are joined without a scene, and the command of the whole picture does not make a part.
        const struct provenance made = job_provenance(job, format, coding);
        job->image.texts = provenance_texts(&made, job->arena);
    }
    image_encode(&job->image, format, job_display(job), out);
}

static int write_picture(struct rendering *r, const struct cli_output *output, const char *path) {
    struct strbuf file;
    strbuf_init(&file);
    const double start = clock_seconds();
    if (CLI_HAS_DEVICES && output->is_part)
        render_encode_part(r, &file);
    else
        render_encode(r, output->format, &file);
    r->job.stats.encode_seconds += clock_seconds() - start;
    timeline_add(r->job.wish.timeline, "encode", str_from(path), start);
    const int status = write_made(r, path, &file);
    strbuf_finish(&file);
    return status;
}

int render_write_pictures(struct rendering *r, uint32_t camera) {
    int status = CLI_OK;
    r->job.stats.encode_seconds = 0;
    r->job.camera = camera;
    for (uint32_t i = 0; i < r->output_count && status == CLI_OK; i++)
        status = write_picture(r, &r->outputs[i], render_output_of(r, &r->outputs[i], camera));
    r->written = clock_seconds();
    return status;
}

// More than this share of a picture cut off is said.
#define CLIPPED_MOST 0.05

static void tell_clipped(const struct rendering *r) {
    const struct image_display display = job_display(&r->job);
    double exposure = display.exposure;
    const double share = image_clipped(&r->job.image, display, CLIPPED_MOST, &exposure);
    if (share == 0)
        return;
    // Towards the darker, so that the number that is read holds.
    fprintf(
        stderr,
        "glint: %.0f %% of the picture is brighter than it can show: image.exposure: %g shows 99.5 %% of it, "
        "image.tone: neutral all of it\n",
        100 * share, floor(exposure * 20) / 20 + 0.0);
}

void render_tell_written(struct rendering *r, uint32_t camera) {
    bool is_shown = false;
    for (uint32_t i = 0; i < r->output_count; i++)
        is_shown =
            is_shown || (!r->outputs[i].is_part && !image_format_info(r->outputs[i].format)->is_linear);
    for (uint32_t i = 0; i < r->output_count; i++)
        if (!is_stdout(&r->outputs[i]))
            fprintf(stderr, "glint: wrote %s, %u x %u\n", render_output_of(r, &r->outputs[i], camera),
                    r->job.image.width, r->job.image.height);
    if (is_shown)
        tell_clipped(r);
}
