// What render writes: its pictures.
#include "cli/commands/render_job.h"
#include "cli/device.h"
#include "core/clock.h"
#include "core/timeline.h"
#include "grammar/ir.h"
#include "render/record/provenance.h"

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
static const char *camera_output(struct render_job *job, str path, str camera) {
    const str stem = render_stem_of(path);
    return arena_format(&job->cli->arena, "%.*s.%.*s%s", STR_ARG(stem), STR_ARG(camera), path.ptr + stem.len)
        .ptr;
}

const char *render_output_of(struct render_job *job, const struct cli_output *output, uint32_t camera) {
    return job->all_cameras
               ? camera_output(job, str_from(output->path), job->session.scene->cameras.items[camera].name)
               : output->path;
}

static bool is_stdout(const struct cli_output *output) {
    return strcmp(output->path, "-") == 0;
}

const char *render_typed(const struct cli_output *output) {
    return output->arg ? output->path : "";
}

bool render_uses_stdout(const struct render_job *job) {
    bool uses = false;
    for (uint32_t i = 0; i < job->output_count; i++)
        uses |= is_stdout(&job->outputs[i]);
    return uses;
}

// ---- the command line

static int needs_output(struct cli *cli) {
    int status = cli_usage(cli, cli_operand_place(cli, 0),
                           "a picture of standard input has no name: say where to write it");
    diag_help(&cli->sink, "for example -o picture.png, or '-o -' for standard output");
    return status;
}

static int judge_output(struct render_job *job, struct cli_output *output) {
    struct cli *cli = job->cli;
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
    for (const struct cli_output *first = job->outputs; first < output; first++)
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

// An option that no output can follow is a mistake.
static int judge_coding(struct render_job *job) {
    struct cli *cli = job->cli;
    bool depth = cli->options.depth == 0, quality = false, compression = false;
    for (uint32_t i = 0; i < job->output_count; i++) {
        const struct image_format_info *info = image_format_info(job->outputs[i].format);
        if (job->outputs[i].is_part)
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
int render_judge_size(struct render_job *job) {
    const struct cli_measure *m = &job->cli->options.measure;
    const bool scaled = m->scale_width != 0;
    const uint32_t width = scaled ? m->scale_width : job->image.width;
    const uint32_t height = scaled ? m->scale_height : job->image.height;
    for (uint32_t i = 0; i < job->output_count; i++) {
        const struct image_format_info *info = image_format_info(job->outputs[i].format);
        if (!job->outputs[i].is_part && info->side_max &&
            (width > info->side_max || height > info->side_max)) {
            const int status = cli_usage(job->cli, job->outputs[i].arg,
                                         "a %s picture has at most %u pixels in a row or column, not %u x %u",
                                         info->words, info->side_max, width, height);
            diag_help(&job->cli->sink, "choose another ending, or a smaller --size");
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

int render_take_outputs(struct render_job *job) {
    struct cli *cli = job->cli;
    struct cli_outputs *outputs = &cli->options.outputs;
    int status = CLI_OK;
    if (outputs->count == 0 && cli_is_stream(cli, cli->operands[0]))
        return needs_output(cli);
    if (outputs->count == 0)
        *(struct cli_output *)ARENA_PUSH(&cli->arena, outputs) =
            (struct cli_output){.path = cli_default_picture(cli, cli->operands[0])};
    job->outputs = outputs->items;
    job->output_count = outputs->count;
    for (uint32_t i = 0; i < outputs->count && status == CLI_OK; i++)
        status = judge_output(job, &outputs->items[i]);
    return status == CLI_OK ? judge_coding(job) : status;
}

// ---- pictures

static int write_made(struct render_job *job, const char *path, const struct strbuf *file) {
    if (file->failed) {
        cli_error(job->cli, DIAG_OUT_OF_MEMORY, path, NULL, "not enough memory to encode the picture");
        return CLI_FILE;
    }
    const double start = clock_seconds();
    const int status = cli_write(job->cli, path, strbuf_view(file));
    timeline_add(job->timeline, "write", str_from(path), start);
    return status;
}

void render_encode(struct render_job *job, enum image_format format, struct strbuf *out) {
    const struct image_display display = {job->session.image->tone, job->session.image->transfer};
    const struct cli_options *options = &job->cli->options;
    const bool is_scaled = options->measure.scale_width != 0;
    const bool by_reference = cli_device_is_reference(job->cli);
    const struct provenance made = {.session = &job->session,
                                    .gpu = by_reference ? NULL : job->gpu,
                                    .camera = job->camera,
                                    .is_double = by_reference || job->shot.flat.is_double,
                                    .as_file = options->as_file,
                                    .audits = job->stats.has_audit,
                                    .max_off = options->has_max_off ? options->max_off : -1,
                                    .scaled_width = is_scaled ? job->image.width : 0,
                                    .scaled_height = is_scaled ? job->image.height : 0,
                                    .format = format,
                                    .coding = render_coding(options, format)};
    job->display = display;
    job->image.coding = made.coding;
    // Parts are joined without a session, and no part of a picture is made by the command of all of it.
    job->image.texts = job->session.scene && !job->is_part ? provenance_texts(&made, &job->cli->arena)
                                                           : (struct image_texts){0};
    if (job->record)
        job->image.texts = provenance_of_line(job->record, format, made.coding, &job->cli->arena);
    image_encode(&job->image, format, display, out);
}

static int write_picture(struct render_job *job, const struct cli_output *output, const char *path) {
    struct strbuf file;
    strbuf_init(&file);
    const double start = clock_seconds();
    if (output->is_part)
        render_encode_part(job, &file);
    else
        render_encode(job, output->format, job->kept ? job->kept : &file);
    job->stats.encode_seconds += clock_seconds() - start;
    timeline_add(job->timeline, "encode", str_from(path), start);
    const int status = job->kept ? CLI_OK : write_made(job, path, &file);
    strbuf_finish(&file);
    return status;
}

int render_write_pictures(struct render_job *job, uint32_t camera) {
    int status = CLI_OK;
    job->stats.encode_seconds = 0;
    job->camera = camera;
    for (uint32_t i = 0; i < job->output_count && status == CLI_OK; i++)
        status = write_picture(job, &job->outputs[i], render_output_of(job, &job->outputs[i], camera));
    job->written = clock_seconds();
    return status;
}

void render_tell_written(struct render_job *job, uint32_t camera) {
    for (uint32_t i = 0; i < job->output_count; i++)
        if (!is_stdout(&job->outputs[i]))
            fprintf(stderr, "glint: wrote %s, %u x %u\n", render_output_of(job, &job->outputs[i], camera),
                    job->image.width, job->image.height);
}

// ---- what is known of where pixels ended

const struct render_estimate *render_estimate_of(const struct render_job *job) {
    return job->shot.settings.error > 0 ? renderer_estimate(job->shot.renderer) : NULL;
}
