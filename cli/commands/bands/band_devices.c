// The devices that share a picture's bands, as --device names them.
#include "cli/commands/bands/bands_run.h"
#include "cli/device.h"
#include "diag/codes/limit.h"

#include <stdio.h>
#include <string.h>

// ---- which

bool bands_spread(const struct cli *cli) {
    const char *wanted = cli_device_wanted(cli);
    if (!wanted || !CLI_HAS_DEVICES)
        return false;
    return strcmp(wanted, "all") == 0 ||
           (strchr(wanted, ',') && wanted[strspn(wanted, "0123456789,")] == '\0');
}

// ---- a device besides the job's

static bool is_equal(const struct gpu_device_info *a, const struct gpu_device_info *b) {
    return strcmp(a->name, b->name) == 0 && strcmp(a->driver, b->driver) == 0;
}

static int begin(struct bands_run *run, const char *number) {
    struct cli *cli = run->r->cli;
    const struct gpu_device_info *first = gpu_info(run->r->job.gpu);
    struct progress *progress = &run->progress[run->gpu_count];
    struct gpu **gpu = &run->gpus[run->gpu_count];
    const int status = cli_open_named(cli, number, gpu);
    if (status != CLI_OK)
        return status;
    run->gpu_count++;
    if (!is_equal(first, gpu_info(*gpu))) {
        const int unequal =
            cli_usage(cli, cli_option_place(cli, "device"),
                      "the devices are different: '%s' and '%s' would not give the same bytes", first->name,
                      gpu_info(*gpu)->name);
        diag_help(&cli->sink, "name equal ones; '--device all' takes those that are equal to the first");
        return unequal;
    }
    progress_begin(progress, true);
    progress->patience = PROGRESS_PATIENCE;
    if (job_bands_add_device(&run->work, *gpu, progress_callback(progress)))
        return CLI_OK;
    cli_error(cli, DIAG_OUT_OF_MEMORY, run->path, NULL, "not enough memory for a band");
    return CLI_SCENE;
}

// Begins the devices after the first in the list of numbers, or all that equal the job's, except that one.
static int begin_all(struct bands_run *run) {
    struct cli *cli = run->r->cli;
    const char *wanted = cli_device_wanted(cli);
    const struct gpu_device_info *first = gpu_info(run->r->job.gpu);
    int status = CLI_OK;
    for (const char *p = strchr(wanted, ','); p && status == CLI_OK; p = strchr(p + 1, ',')) {
        const size_t length = strcspn(p + 1, ",");
        if (length && run->gpu_count < JOB_BAND_DEVICES_MOST)
            status = begin(run, arena_copy(&cli->arena, (str){p + 1, length}).ptr);
    }
    if (strcmp(wanted, "all") != 0)
        return status;
    struct gpu_device_info *items = ARENA_ARRAY(&cli->arena, struct gpu_device_info, JOB_BAND_DEVICES_MOST);
    char error[GPU_ERROR_BYTES] = "";
    uint32_t count = 0;
    if (gpu_list(items, JOB_BAND_DEVICES_MOST, &count, error) != GPU_OK)
        count = 0;
    for (uint32_t i = 0; i < count && i < JOB_BAND_DEVICES_MOST && status == CLI_OK; i++)
        if (items[i].number != first->number && is_equal(first, &items[i]))
            status = begin(run, arena_format(&cli->arena, "%u", items[i].number).ptr);
    return status;
}

int bands_begin_devices(struct bands_run *run) {
    if (!bands_spread(run->r->cli))
        return CLI_OK;
    const int status = begin_all(run);
    if (status == CLI_OK && !run->r->cli->options.quiet)
        fprintf(stderr, "glint: bands on %u device%s\n", run->gpu_count + 1, run->gpu_count ? "s" : "");
    return status;
}
