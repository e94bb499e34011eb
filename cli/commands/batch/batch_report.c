// What a batch says at its end.
#include "cli/commands/batch/batch_run.h"
#include "core/clock.h"
#include "core/json_write.h"

#include <stdio.h>
#include <string.h>

static const char *plural(uint32_t count) {
    return count == 1 ? "" : "s";
}

static const char *place_of(const struct batch_run *run, const struct batch_job *job) {
    return run->batch.film || run->cli->options.batch.montage ? run->outputs.outputs[0].path : job->paths[0];
}

// "scene.yaml, frame 7, at 1.3, camera side"
static void put_job(const struct batch_run *run, const struct batch_job *job) {
    fprintf(stderr, "%s", job->scene);
    if (job->has_frame)
        fprintf(stderr, ", frame %d", (int)job->frame);
    if (job->values.len)
        fprintf(stderr, ", at %.*s", STR_ARG(job->values));
    if (str_equal(run->cli->options.camera, STR("all")) && job->camera.len)
        fprintf(stderr, ", camera %.*s", STR_ARG(job->camera));
}

void batch_tell_failure(const struct batch_run *run, const struct batch_job *job) {
    fprintf(stderr, "glint: failed: ");
    put_job(run, job);
    fputc('\n', stderr);
}

static void tell_failures(const struct batch_run *run) {
    const struct batch_counts *c = &run->counts;
    fprintf(stderr, "glint: %u of %u pictures failed", c->failed, run->batch.jobs.count);
    if (c->failed > 1) {
        fprintf(stderr, ", the first: ");
        put_job(run, run->first_failed);
    }
    if (c->begun < run->batch.jobs.count)
        fprintf(stderr, "; %u were not begun", run->batch.jobs.count - c->begun);
    fputc('\n', stderr);
}

void batch_tell(const struct batch_run *run) {
    const struct batch_counts *c = &run->counts;
    const uint32_t count = run->batch.jobs.count;
    const double seconds = clock_seconds() - run->cli->begun;
    if (c->failed)
        tell_failures(run);
    if (c->skipped && !run->cli->options.quiet)
        fprintf(stderr, "glint: %u of %u pictures %s done already\n", c->skipped, count,
                c->skipped == 1 ? "is" : "are");
    if (run->cli->options.quiet || c->written == 0 || count == 0 || (run->batch.film && c->failed))
        return;
    const char *first = place_of(run, &run->batch.jobs.items[0]);
    const char *last = place_of(run, &run->batch.jobs.items[count - 1]);
    fprintf(stderr, "glint: wrote ");
    if (run->cli->options.batch.montage)
        fprintf(stderr, "%s, %u pictures in rows of %u, in %.1f s\n", first, c->written, run->batch.columns,
                seconds);
    else if (c->written < count)
        fprintf(stderr, "%u of %u pictures in %.1f s\n", c->written, count, seconds);
    else if (first == last)
        fprintf(stderr, "%s, %u picture%s, in %.1f s\n", strcmp(first, "-") == 0 ? "standard output" : first,
                c->written, plural(c->written), seconds);
    else
        fprintf(stderr, "%u pictures, %s to %s, in %.1f s\n", c->written, first, last, seconds);
}

static void put_text(const struct batch_run *run, struct strbuf *out) {
    const struct batch_counts *c = &run->counts;
    strbuf_format(out, "%u picture%s written, %u failed, %u done already, from %u load%s\n", c->written,
                  plural(c->written), c->failed, c->skipped, c->loads, plural(c->loads));
    if (c->precision_asked)
        strbuf_format(out, "  precision asked for %u picture%s\n", c->precision_asked,
                      plural(c->precision_asked));
    strbuf_format(out, "  %u mesh%s and %u image%s read, %u tree%s built and %u kept, %u pipeline%s made\n",
                  c->meshes_read, c->meshes_read == 1 ? "" : "es", c->images_read, plural(c->images_read),
                  c->trees_built, plural(c->trees_built), c->trees_kept, c->pipelines_made,
                  plural(c->pipelines_made));
    strbuf_format(out, "  frames %.3f s, device open after %.3f s, all %.3f s\n", c->trace_seconds,
                  c->device_seconds, clock_seconds() - run->cli->begun);
}

static void put_json(const struct batch_run *run, struct strbuf *out) {
    const struct batch_counts *c = &run->counts;
    struct json_writer w;
    json_report_begin(&w, out, 0, "glint render of many", 1);
    json_write_integer(&w, "pictures", run->batch.jobs.count);
    json_write_integer(&w, "written", c->written);
    json_write_integer(&w, "failed", c->failed);
    json_write_integer(&w, "skipped", c->skipped);
    json_write_integer(&w, "loads", c->loads);
    json_write_integer(&w, "meshes_read", c->meshes_read);
    json_write_integer(&w, "images_read", c->images_read);
    json_write_integer(&w, "trees_built", c->trees_built);
    json_write_integer(&w, "trees_kept", c->trees_kept);
    json_write_integer(&w, "pipelines_made", c->pipelines_made);
    json_write_integer(&w, "precision_asked", c->precision_asked);
    json_open_object(&w, "times");
    json_write_real(&w, "frames_s", c->trace_seconds);
    json_write_real(&w, "device_s", c->device_seconds);
    json_write_real(&w, "total_s", clock_seconds() - run->cli->begun);
    json_close_object(&w);
    json_report_end(&w);
}

int batch_stats(const struct batch_run *run) {
    const bool json = run->cli->options.stats == CLI_STATS_JSON;
    struct strbuf text;
    int status = CLI_OK;
    if (!run->cli->options.stats)
        return CLI_OK;
    strbuf_init(&text);
    (json ? put_json : put_text)(run, &text);
    if (json && !render_uses_stdout(&run->outputs))
        status = cli_print(run->cli, strbuf_view(&text));
    else
        cli_write_error(strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}
