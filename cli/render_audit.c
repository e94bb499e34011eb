// A picture states its own error: --audit, --max-off and --stats.
#include "cli/render_job.h"

#include <stdio.h>

static bool is_wanted(const struct cli_options *options) {
    return options->audit || options->has_max_off || options->stats;
}

int render_audit(struct render_job *job) {
    strbuf_clear(&job->note);
    job->image.note = NULL;
    job->stats.has_audit = is_wanted(&job->cli->options);
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
