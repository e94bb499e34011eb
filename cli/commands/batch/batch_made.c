// Pictures of a batch after tracing: encoded and written while the next one is traced.
#include "cli/commands/batch/batch_run.h"
#include "cli/made.h"
#include "diag/codes/command.h"
#include "diag/codes/limit.h"

#include <string.h>

static bool has_film(const struct batch_run *run) {
    return run->batch.film != BATCH_NO_FILM;
}

static bool has_sheet(const struct batch_run *run) {
    return run->cli->options.batch.montage;
}

static void encode(void *context) {
    struct batch_made *made = context;
    const struct batch_run *run = made->run;
    if (has_film(run)) {
        film_pixels(run->batch.film, &made->image, made->display, &made->files[0]);
        return;
    }
    for (uint32_t i = 0; i < run->outputs.output_count && !has_sheet(run); i++) {
        const enum image_format format = run->outputs.outputs[i].format;
        const bool is_part = run->outputs.outputs[i].is_part;
        made->image.coding = render_coding(&run->cli->options, format);
        made->image.texts = made->texts[i];
        if (is_part)
            part_encode(&made->part, &made->files[i]);
        else
            image_encode(&made->image, format, made->display, &made->files[i]);
        // The disk takes milliseconds per file, which must not delay the next picture.
        const str file = strbuf_view(&made->files[i]);
        made->errors[i] = made->files[i].failed ? 0 : cli_put_output(run->cli, made->job->paths[i], file);
    }
    batch_note_written(made);
}

// Call this while the session is still that of this picture.
static struct image_texts texts_of(struct batch_run *run, enum image_format format) {
    const struct job *job = &run->outputs.job;
    const struct provenance made = job_provenance(job, format, render_coding(&run->cli->options, format));
    return has_film(run) || has_sheet(run) || job->is_part ? (struct image_texts){0}
                                                           : provenance_texts(&made, &run->cli->arena);
}

void batch_encode(struct batch_run *run, struct batch_made *made) {
    made->run = run;
    batch_note_scene(run, made);
    made->part = run->outputs.job.part;
    made->part.rgb = made->image.rgb;
    if (run->outputs.job.is_part)
        job_describe_part(&run->outputs.job, &made->part);
    for (uint32_t i = 0; i < run->outputs.output_count; i++) {
        strbuf_clear(&made->files[i]);
        made->texts[i] = texts_of(run, run->outputs.outputs[i].format);
    }
    parallel_start(&made->task, encode, made);
}

// ---- a sheet

static int no_memory(struct batch_run *run, const char *what) {
    cli_error(run->cli, DIAG_OUT_OF_MEMORY, run->outputs.outputs[0].path, NULL, "not enough memory for %s",
              what);
    return CLI_FILE;
}

static int begin_sheet(struct batch_run *run, const struct batch_made *made) {
    const uint64_t columns = run->batch.columns, rows = (run->batch.jobs.count + columns - 1) / columns;
    const uint64_t width = columns * made->image.width, height = rows * made->image.height;
    const uint32_t most = image_format_info(run->outputs.outputs[0].format)->side_max;
    run->sheet_display = made->display;
    if (width > 65535 || height > 65535 || (most && (width > most || height > most)))
        return cli_usage(
            run->cli, cli_option_place(run->cli, "montage"),
            "the sheet would have %llu x %llu pixels, which is too large: choose a smaller --size",
            (unsigned long long)width, (unsigned long long)height);
    return image_init(&run->sheet, (uint32_t)width, (uint32_t)height) ? CLI_OK : no_memory(run, "the sheet");
}

static int add_to_sheet(struct batch_run *run, const struct batch_made *made) {
    const struct image *cell = &made->image;
    const uint32_t columns = run->batch.columns, n = made->job->number;
    const int status = run->sheet.rgb ? CLI_OK : begin_sheet(run, made);
    if (status != CLI_OK)
        return status;
    const uint32_t rows = (run->batch.jobs.count + columns - 1) / columns;
    if ((uint64_t)cell->width * columns != run->sheet.width ||
        (uint64_t)cell->height * rows != run->sheet.height) {
        cli_error(run->cli, DIAG_OUTPUT, made->job->scene, "give all pictures one size with --size WxH",
                  "this picture has another size than the others of the sheet");
        return CLI_SCENE;
    }
    const size_t x = (size_t)(n % columns) * cell->width, y = (size_t)(n / columns) * cell->height;
    for (size_t row = 0; row < cell->height; row++)
        memcpy(run->sheet.rgb + 3 * ((y + row) * run->sheet.width + x), cell->rgb + 3 * row * cell->width,
               3 * (size_t)cell->width * sizeof(float));
    return CLI_OK;
}

int batch_write_sheet(struct batch_run *run) {
    int status = CLI_OK;
    for (uint32_t i = 0; i < run->outputs.output_count && run->sheet.rgb && status == CLI_OK; i++) {
        struct strbuf file;
        strbuf_init(&file);
        run->sheet.coding = render_coding(&run->cli->options, run->outputs.outputs[i].format);
        image_encode(&run->sheet, run->outputs.outputs[i].format, run->sheet_display, &file);
        status = cli_write_made(run->cli, run->outputs.outputs[i].path, &file, "the sheet");
        strbuf_finish(&file);
    }
    return status;
}

// ---- at the end of a picture

static int judge_files(struct batch_run *run, const struct batch_made *made) {
    int status = CLI_OK;
    for (uint32_t i = 0; i < run->outputs.output_count; i++) {
        if (made->files[i].failed)
            status = no_memory(run, "the picture");
        if (made->errors[i])
            status = cli_not_written(run->cli, made->job->paths[i], made->errors[i]);
    }
    return status;
}

int batch_write(struct batch_run *run, struct batch_made *made) {
    if (!made->job)
        return CLI_OK;
    parallel_wait(&made->task);
    const struct strbuf *first = &made->files[0];
    int status = has_sheet(run)                   ? add_to_sheet(run, made)
                 : has_film(run) && first->failed ? no_memory(run, "a frame of the film")
                 : has_film(run)
                     ? film_frame(&run->film, made->image.width, made->image.height, strbuf_view(first))
                     : judge_files(run, made);
    if (status == CLI_OK) {
        run->counts.written++;
        run->counts.faulty += made->is_faulty;
        status = batch_judge_checkpoint(run);
    }
    made->job = NULL;
    return status;
}
