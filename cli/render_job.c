#include "cli/render_job.h"

#include "cli/device.h"
#include "core/clock.h"
#include "grammar/ir.h"

#include <stdio.h>

// OUT.NAME.png for OUT.png.
static const char *camera_output(struct render_job *job, str camera) {
    str path = str_from(job->output);
    size_t dot = path.len;
    while (dot > 0 && path.ptr[dot - 1] != '.')
        dot--;
    str stem = str_slice(path, 0, dot ? dot - 1 : path.len);
    return arena_format(&job->cli->arena, "%.*s.%.*s%s", STR_ARG(stem), STR_ARG(camera), path.ptr + stem.len)
        .ptr;
}

const char *render_output_of(struct render_job *job, uint32_t camera) {
    return job->all_cameras ? camera_output(job, job->session.scene->cameras.items[camera].name)
                            : job->output;
}

int render_interrupted(struct render_job *job) {
    progress_end(&job->progress);
    return cli_interrupted(job->cli);
}

int render_failed(struct render_job *job, enum shot_status status) {
    progress_end(&job->progress);
    if (status == SHOT_CANCELLED)
        return render_interrupted(job);
    if (status == SHOT_SCENE)
        return cli_report(job->cli, &job->session, !job->cli->options.quiet);
    return cli_device_failed(job->cli, job->gpu);
}

int render_write_picture(struct render_job *job, const char *path) {
    struct strbuf file;
    struct image_display display = {job->session.image->tone, job->session.image->transfer};
    strbuf_init(&file);
    double start = clock_seconds();
    image_encode(&job->image, job->format, display, &file);
    job->stats.encode_seconds = clock_seconds() - start;
    int status = CLI_OK;
    if (file.failed) {
        cli_error(job->cli, DIAG_OUT_OF_MEMORY, path, NULL, "not enough memory to encode the picture");
        status = CLI_FILE;
    } else {
        status = cli_write(job->cli, path, strbuf_view(&file));
    }
    job->written = clock_seconds();
    strbuf_finish(&file);
    return status;
}

// ---- a picture states its own error: --audit, --max-off and --stats

bool render_wants_audit(const struct cli_options *options) {
    return options->audit || options->has_max_off || options->stats;
}

int render_audit(struct render_job *job) {
    strbuf_clear(&job->note);
    job->image.note = NULL;
    job->stats.has_audit = render_wants_audit(&job->cli->options);
    if (!job->stats.has_audit)
        return CLI_OK;
    struct audit *audit = &job->stats.audit;
    struct render_progress callback = progress_callback(&job->progress);
    const enum shot_status status = audit_take(&job->session, &job->shot.view, &job->image, &callback, audit);
    if (status != SHOT_OK)
        return render_failed(job, status);
    audit_words(audit, &job->note);
    job->image.note = job->note.data;
    return CLI_OK;
}

int render_tell_audit(const struct render_job *job) {
    const struct cli_options *options = &job->cli->options;
    const struct audit *audit = &job->stats.audit;
    if (!job->stats.has_audit)
        return CLI_OK;
    const bool broken = options->has_max_off && audit->bound > options->max_off;
    if ((options->audit || options->has_max_off) && (broken || !options->quiet)) {
        fprintf(stderr, "glint: %.*s", STR_ARG(strbuf_view(&job->note)));
        if (audit->off)
            fprintf(stderr, ", the first at %u,%u", audit->x, audit->y);
        if (broken)
            fprintf(stderr, "; more than %g %%", 100 * options->max_off);
        fputc('\n', stderr);
    }
    return broken ? CLI_SCENE : CLI_OK;
}
