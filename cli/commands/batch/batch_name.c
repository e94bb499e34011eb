// What the pictures of a batch are called.
#include "cli/commands/batch/batch_job.h"
#include "cli/commands/rendering.h"
#include "cli/made.h"
#include "core/heap.h"
#include "files/files.h"
#include "render/frames/frame_name.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static str scene_name(str path) {
    const str base = path_base(path);
    size_t end = 1;
    while (end < base.len && base.ptr[end] != '.')
        end++;
    return str_slice(base, 0, end);
}

// Adds only what a file's name may contain.
static void add_safe(struct strbuf *out, str text) {
    for (size_t i = 0; i < text.len; i++)
        strbuf_char(out, strchr("/\\ \t\"'[]{}*?", text.ptr[i]) ? '-' : text.ptr[i]);
}

// The words that follow '%'; digits before 'd' are its width. Returns what is after it; NULL: none has
// this name.
static const char *add_word(const struct batch_job *job, const char *p, struct strbuf *out) {
    if (*p == '%')
        strbuf_char(out, '%');
    else if (*p == 's')
        add_safe(out, scene_name(str_from(job->scene)));
    else if (*p == 'c')
        add_safe(out, job->camera.len ? job->camera : STR("main"));
    else if (*p == 'v')
        add_safe(out, job->values);
    else
        return frame_name_number(p, job->has_frame ? job->frame : (int32_t)job->number, out);
    return p + 1;
}

static bool add_path(const struct batch_job *job, const char *pattern, struct strbuf *out) {
    for (const char *p = pattern; p && *p;) {
        if (*p != '%') {
            strbuf_char(out, *p++);
            continue;
        }
        p = add_word(job, p + 1, out);
        if (!p)
            return false;
    }
    return true;
}

static bool has_word(const char *pattern, char word) {
    for (const char *p = strchr(pattern, '%'); p && p[1]; p = strchr(p + 2, '%')) {
        const char *q = p + 1;
        while (word == 'd' && *q >= '0' && *q <= '9')
            q++;
        if (*q == word)
            return true;
    }
    return false;
}

static const char *with(struct cli *cli, const char *pattern, const char *more) {
    const char *dot = strrchr(pattern, '.');
    const int stem = dot && !strchr(dot, '/') ? (int)(dot - pattern) : (int)strlen(pattern);
    return arena_format(&cli->arena, "%.*s%s%s", stem, pattern, more, pattern + stem).ptr;
}

// Without -o the name has everything that differs; --camera all adds the camera's name, as for one picture.
static const char *pattern_of(const struct batch *batch, const struct cli_output *output) {
    const struct cli_batch *b = &batch->cli->options.batch;
    const struct cli_part *tile = &batch->cli->options.part;
    const char *pattern = output->arg ? output->path : "%s.png";
    if (!output->arg && b->sweeps.count)
        pattern = with(batch->cli, pattern, ".%v");
    if (!output->arg && b->has_frames)
        pattern = with(batch->cli, pattern, ".%04d");
    if (!output->arg && tile->tiles)
        pattern = with(batch->cli, pattern,
                       arena_format(&batch->cli->arena, ".%u-of-%u", tile->tile, tile->tiles).ptr);
    if (str_equal(batch->cli->options.camera, STR("all")) && !has_word(pattern, 'c'))
        pattern = with(batch->cli, pattern, ".%c");
    return pattern;
}

static int compare(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static int refuse_twice(struct batch *batch, const struct cli_output *output, const char *path) {
    struct cli *cli = batch->cli;
    const int status =
        cli_usage(cli, output->arg ? output->arg : cli_operand_place(cli, 0),
                  "%u pictures, and more than one of them would be '%s'", batch->jobs.count, path);
    diag_help(&cli->sink,
              "let -o tell them apart: %%04d is the frame, or the picture's number; %%v the sweep's "
              "values, %%s the scene, %%c the camera");
    return status;
}

static int judge_names(struct batch *batch, uint32_t output_count) {
    struct cli *cli = batch->cli;
    const uint32_t count = batch->jobs.count * output_count;
    const char **all = heap_array(count ? count : 1, sizeof *all);
    const char *twice = NULL;
    uint32_t n = 0;
    int status = CLI_OK;
    if (!all)
        return CLI_FILE;
    for (uint32_t i = 0; i < batch->jobs.count; i++)
        for (uint32_t k = 0; k < output_count; k++) {
            all[n] = batch->jobs.items[i].paths[k];
            if (status == CLI_OK)
                status = cli_judge_made(cli, render_typed(&cli->options.outputs.items[k]), all[n]);
            n++;
        }
    qsort(all, n, sizeof *all, compare);
    for (uint32_t i = 1; i < n && !twice; i++)
        twice = strcmp(all[i - 1], all[i]) == 0 ? all[i] : NULL;
    free(all);
    return twice ? refuse_twice(batch, &cli->options.outputs.items[0], twice) : status;
}

int batch_name(struct batch *batch) {
    struct cli *cli = batch->cli;
    const struct cli_outputs *outputs = &cli->options.outputs;
    struct strbuf path;
    bool good = true;
    strbuf_init(&path);
    for (uint32_t i = 0; i < batch->jobs.count && good; i++) {
        struct batch_job *job = &batch->jobs.items[i];
        job->paths = ARENA_ARRAY(&cli->arena, const char *, outputs->count);
        for (uint32_t k = 0; k < outputs->count && good; k++) {
            strbuf_clear(&path);
            good = add_path(job, pattern_of(batch, &outputs->items[k]), &path);
            job->paths[k] = arena_copy(&cli->arena, strbuf_view(&path)).ptr;
            if (!good) {
                cli_usage(cli, outputs->items[k].arg, "'%%' in '%s' is followed by no word that is known",
                          outputs->items[k].path);
                diag_help(&cli->sink,
                          "%%d or %%04d is the frame or number, %%s the scene, %%c the camera, %%v the "
                          "sweep's values, and %%%% a percent sign");
            }
        }
    }
    strbuf_finish(&path);
    return good ? judge_names(batch, outputs->count) : CLI_USAGE;
}
