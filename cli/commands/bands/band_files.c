// From bands on the disk to the files of their picture.
#include "cli/commands/bands/bands_run.h"
#include "cli/commands/pictures/row_files.h"
#include "cli/made.h"
#include "core/clock.h"

#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "grammar/ir.h"

#include <stdio.h>
#include <string.h>

// One file on its way.
struct writing {
    struct bands_run *run;
    bool heeds; // signals
};

static bool take(void *context, uint32_t y, uint32_t count, float *rgb) {
    const struct writing *w = context;
    return !(w->heeds && interrupt_signal()) && bands_take(&w->run->work.bands, y, count, rgb);
}

static int cannot_read(struct bands_run *run) {
    cli_error(run->r->cli, DIAG_FILE_UNREADABLE, run->path, NULL, "cannot be read: %s",
              strerror(run->work.bands.spool.error));
    return CLI_FILE;
}

static struct image_texts texts_of(struct bands_run *run, enum image_format format) {
    struct rendering *r = run->r;
    const struct provenance made = job_provenance(&r->job, format, render_coding(&r->cli->options, format));
    return r->job.is_part ? (struct image_texts){0} : provenance_texts(&made, &r->cli->arena);
}

// `texts`: for the file's head; NULL: those of the whole picture.
static int write_file(struct bands_run *run, const struct cli_output *output, const char *path,
                      const struct image_texts *texts) {
    const struct ir_image *image = run->r->job.session->image;
    struct writing w = {run, !texts};
    const struct image_rows rows = {.width = run->work.bands.part.region.width,
                                    .height = run->work.bands.part.region.height,
                                    .take = take,
                                    .context = &w,
                                    .texts = texts ? *texts : texts_of(run, output->format),
                                    .coding = render_coding(&run->r->cli->options, output->format)};
    const struct image_display display = image_display_of(image);
    bool ended;
    const int status = row_file_write(run->r->cli, path, &rows, output->format, display,
                                      output->is_part ? &run->work.bands.part : NULL, &ended);
    if (!ended)
        return status;
    return run->work.bands.spool.error ? cannot_read(run) : CLI_STOPPED;
}

static bool is_streamed(const struct cli_output *output) {
    return output->is_part || image_rows_can(output->format);
}

static bool are_streamed(const struct rendering *r) {
    bool all = true;
    for (uint32_t i = 0; i < r->output_count; i++)
        all = all && is_streamed(&r->outputs[i]);
    return all;
}

// Some of the files need all pixels at once, so all files are written that way.
static int write_at_once(struct bands_run *run) {
    struct rendering *r = run->r;
    const struct part_region *region = &run->work.bands.part.region;
    if (!image_init(&r->job.image, region->width, region->height)) {
        cli_error(r->cli, DIAG_OUT_OF_MEMORY, r->outputs[0].path, NULL, "not enough memory for the picture");
        return CLI_SCENE;
    }
    if (!bands_take(&run->work.bands, 0, region->height, r->job.image.rgb))
        return cannot_read(run);
    return render_write_pictures(r, run->camera);
}

int bands_write(struct bands_run *run) {
    struct rendering *r = run->r;
    int status = CLI_OK;
    const double start = clock_seconds();
    if (!are_streamed(r))
        return write_at_once(run);
    for (uint32_t i = 0; i < r->output_count && status == CLI_OK; i++)
        status = write_file(run, &r->outputs[i], render_output_of(r, &r->outputs[i], run->camera), NULL);
    r->written = clock_seconds();
    r->job.stats.encode_seconds = r->written - start;
    return status;
}

// NULL: this output has none.
static const char *partial_of(struct rendering *r, const struct cli_output *output, uint32_t camera) {
    const str path = str_from(render_output_of(r, output, camera)), stem = render_stem_of(path);
    if (output->is_part || !is_streamed(output) || stem.len == 0)
        return NULL;
    return arena_format(&r->cli->arena, "%.*s.partial%s", STR_ARG(stem), path.ptr + stem.len).ptr;
}

int render_judge_partial(struct rendering *r, uint32_t camera) {
    int status = CLI_OK;
    for (uint32_t i = 0; i < r->output_count && status == CLI_OK && r->cli->options.part.partial; i++) {
        const char *partial = partial_of(r, &r->outputs[i], camera);
        if (partial)
            status = cli_judge_made(r->cli, render_typed(&r->outputs[i]), partial);
    }
    return status;
}

int bands_write_partial(struct bands_run *run) {
    struct rendering *r = run->r;
    const struct bands *bands = &run->work.bands;
    int status = CLI_OK;
    struct image_text text = {"Partial", arena_format(&r->cli->arena, "%u of %u bands, the others are black",
                                                      bands->done_count, bands->count)
                                             .ptr};
    const struct image_texts texts = {&text, 1};
    for (uint32_t i = 0; i < r->output_count && status == CLI_OK; i++) {
        const struct cli_output *output = &r->outputs[i];
        const char *partial = partial_of(r, output, run->camera);
        if (!partial)
            continue;
        status = write_file(run, output, partial, &texts);
        if (status == CLI_OK && !r->cli->options.quiet)
            fprintf(stderr, "glint: wrote %s, %u of %u bands\n", partial, bands->done_count, bands->count);
    }
    return status;
}
