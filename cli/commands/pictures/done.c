// --skip-done: what a rendering would write, and which of it is there already.
#include "cli/commands/rendering.h"
#include "cli/device.h"
#include "render/job/job_done.h"

#include <stdio.h>
#include <string.h>

// ---- the command line

static const char *why_not(const struct cli_output *output, bool is_part) {
    if (strcmp(output->path, "-") == 0 || strncmp(output->path, "/dev/", 5) == 0)
        return "what was written there is gone";
    if (is_part && !output->is_part)
        return "a part says which part it is only as a file that ends in " PART_ENDING;
    if (!output->is_part && (output->format == IMAGE_PFM || output->format == IMAGE_WEBP))
        return "a PFM or WebP picture does not say how it was made: write another format beside it, or "
               "instead";
    return NULL;
}

int render_judge_done(const struct rendering *r) {
    struct cli *cli = r->cli;
    const struct cli_output *outputs = r->outputs;
    const bool is_part = render_wants_part(r);
    static const char *const options[] = {"audit",     "max-off",  "aov",    "time",    "repeat",
                                          "max-error", "max-time", "budget", "montage", "watch"};
    if (!cli->options.batch.skip_done)
        return CLI_OK;
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (cli_option_place(cli, options[i]))
            return cli_usage(cli, cli_option_place(cli, options[i]),
                             "'--%s' needs a picture that is rendered now: it does not go with '--skip-done'",
                             options[i]);
    for (uint32_t i = 0; i < r->output_count; i++) {
        const char *why = why_not(&outputs[i], is_part);
        if (why)
            return cli_usage(cli, outputs[i].arg ? outputs[i].arg : cli_option_place(cli, "skip-done"),
                             "'--skip-done' cannot know whether '%s' is done: %s", outputs[i].path, why);
    }
    return CLI_OK;
}

// ---- files

bool render_output_is_done(const struct rendering *r, const struct cli_output *output, const char *path) {
    return output->is_part ? job_part_is_done(&r->job, path)
                           : job_picture_is_done(&r->job, path, output->format,
                                                 render_coding(&r->cli->options, output->format));
}

// ---- one render

// Whether everything that would be written for a camera is there.
static bool is_done(struct rendering *r, uint32_t camera) {
    bool done = true;
    r->job.camera = camera;
    for (uint32_t i = 0; i < r->output_count && done; i++)
        done = render_output_is_done(r, &r->outputs[i], render_output_of(r, &r->outputs[i], camera));
    for (uint32_t i = 0; i < r->output_count && done && !r->cli->options.quiet; i++)
        fprintf(stderr, "glint: %s is done already\n", render_output_of(r, &r->outputs[i], camera));
    return done;
}

void render_find_done(struct rendering *r, uint32_t *first, uint32_t end) {
    r->done = ARENA_ARRAY(&r->cli->arena, bool, (size_t)end + 1);
    for (uint32_t i = *first; i < end; i++)
        r->done[i] = is_done(r, i);
    while (*first < end && r->done[*first])
        ++*first;
}
