// The device that --device, else GLINT_DEVICE, asks for; and glint devices: what can render here. The number
// or a part of the name goes to --device.
#include "cli/device.h"

#include "core/clock.h"
#include "core/heap.h"
#include "core/parallel.h"
#include "core/timeline.h"
#include "diag/codes/device.h"
#include "files/folder_store.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    DEVICES_MAX = 32
};

// ---- what there is

static const char *kind_name(enum gpu_kind kind) {
    switch (kind) {
    case GPU_DISCRETE:
        return "GPU";
    case GPU_INTEGRATED:
        return "integrated GPU";
    case GPU_VIRTUAL:
        return "virtual GPU";
    case GPU_CPU:
        return "processor";
    }
    return "device";
}

static void describe(struct strbuf *text, const struct gpu_device_info *d) {
    strbuf_format(text, "%u  %s (%s, %llu MiB%s%s)", d->number, d->name, kind_name(d->kind),
                  (unsigned long long)(d->memory_bytes >> 20), d->driver[0] ? ", " : "", d->driver);
}

// The loader looks only there.
static const char *driver_variable(void) {
    static const char *const names[] = {"VK_DRIVER_FILES", "VK_ICD_FILENAMES", NULL};
    for (const char *const *name = names; *name; name++)
        if (getenv(*name))
            return *name;
    return NULL;
}

// This package is meant to have no devices; another package has them.
static int no_devices(struct cli *cli, const char *place, const char *error) {
    cli_error(cli, DIAG_NO_VULKAN, place,
              "the package 'glint' draws on devices; 'glint render --device reference' needs none", "%s",
              error);
    return CLI_DEVICE;
}

static int no_vulkan(struct cli *cli, const char *place, const char *error) {
    const char *variable = driver_variable();
    struct strbuf help;
    strbuf_init(&help);
    if (variable)
        strbuf_format(&help, "glint looks only for the driver that %s names, '%s': correct it, or unset it",
                      variable, getenv(variable));
    else
        strbuf_cstr(&help,
                    "on Debian: apt-get install libvulkan1 mesa-vulkan-drivers; for a driver elsewhere, set "
                    "VK_DRIVER_FILES to its .json file");
    strbuf_cstr(&help, ". 'glint render --device reference' needs no driver\n");
    cli_error(cli, DIAG_NO_VULKAN, place, arena_copy(&cli->arena, str_trim(strbuf_view(&help))).ptr, "%s",
              error);
    strbuf_finish(&help);
    return CLI_DEVICE;
}

int cli_list_devices(struct cli *cli) {
    struct gpu_device_info *items = ARENA_ARRAY(&cli->arena, struct gpu_device_info, DEVICES_MAX);
    char error[GPU_ERROR_BYTES] = "";
    uint32_t count = 0;
    const enum gpu_status found = gpu_list(items, DEVICES_MAX, &count, error);
    if (found != GPU_OK)
        return found == GPU_LEFT_OUT ? no_devices(cli, "devices", error) : no_vulkan(cli, "devices", error);
    struct strbuf text;
    strbuf_init(&text);
    for (uint32_t i = 0; i < count && i < DEVICES_MAX; i++) {
        strbuf_format(&text, "%c ", items[i].preferred ? '*' : ' ');
        describe(&text, &items[i]);
        strbuf_char(&text, '\n');
    }
    int status = cli_print(cli, strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}

// ---- what is asked for

const char *cli_device_wanted(const struct cli *cli) {
    return cli->options.device ? cli->options.device : getenv("GLINT_DEVICE");
}

bool cli_device_is_reference(const struct cli *cli) {
    const char *wanted = cli_device_wanted(cli);
    return wanted && strcmp(wanted, "reference") == 0;
}

static void no_device(struct cli *cli, const char *place, const char *error) {
    struct gpu_device_info *items = ARENA_ARRAY(&cli->arena, struct gpu_device_info, DEVICES_MAX);
    char ignored[GPU_ERROR_BYTES] = "";
    uint32_t count = 0;
    struct strbuf help;
    strbuf_init(&help);
    if (gpu_list(items, DEVICES_MAX, &count, ignored) != GPU_OK)
        count = 0;
    strbuf_cstr(&help, count ? "there is: " : "'glint devices' lists the devices");
    for (uint32_t i = 0; i < count && i < DEVICES_MAX; i++) {
        strbuf_cstr(&help, i ? "; " : "");
        describe(&help, &items[i]);
    }
    cli_error(cli, DIAG_NO_DEVICE, place, arena_copy(&cli->arena, strbuf_view(&help)).ptr, "%s", error);
    strbuf_finish(&help);
}

static int report_opening(struct cli *cli, enum gpu_status status, const char *error) {
    const char *wanted = cli_device_wanted(cli);
    const char *asked = cli->options.device ? "--device" : wanted ? "GLINT_DEVICE" : "device";
    if (CLI_HAS_DEVICES && status == GPU_OK)
        return CLI_OK;
    if (status == GPU_LEFT_OUT)
        no_devices(cli, "device", error);
    else if (status == GPU_NO_DEVICE)
        no_device(cli, asked, error);
    else if (status == GPU_NO_LOADER || status == GPU_NO_DRIVER)
        no_vulkan(cli, "device", error);
    else
        cli_error(cli, DIAG_DEVICE_FAILED, "device", NULL, "%s", error);
    return CLI_DEVICE;
}

// ---- compiled kernels

enum {
    KERNEL_BYTES = 16 << 20,
    KERNELS_BYTES = 128 << 20,
    KERNELS_VERSION = 1,
    NAME_BYTES = 33
};

static struct folder_seal seal_of(const uint64_t key[2]) {
    return (struct folder_seal){.magic = "glintVK", .version = KERNELS_VERSION, .key = {key[0], key[1]}};
}

static void name_of(const uint64_t key[2], char name[NAME_BYTES]) {
    snprintf(name, NAME_BYTES, "%016" PRIx64 "%016" PRIx64, key[0], key[1]);
}

static void *read_kernel(void *context, const uint64_t key[2], size_t *count) {
    const struct folder_seal seal = seal_of(key);
    char name[NAME_BYTES];
    name_of(key, name);
    return folder_store_open(context, name, &seal, KERNEL_BYTES, count);
}

static void write_kernel(void *context, const uint64_t key[2], const void *bytes, size_t count) {
    const struct folder_seal seal = seal_of(key);
    const struct folder_store_part part = {bytes, count};
    char name[NAME_BYTES];
    name_of(key, name);
    if (count <= KERNEL_BYTES)
        folder_store_seal(context, name, &seal, &part, 1);
}

struct gpu_options cli_device_options(struct cli *cli) {
    struct folder_store *store = ARENA_NEW(&cli->arena, struct folder_store);
    char *path = folder_store_path("kernels");
    if (path)
        *store = (struct folder_store){arena_copy(&cli->arena, str_from(path)).ptr, KERNELS_BYTES};
    free(path);
    // Of several devices this is the first: cli/commands/bands opens the others.
    const char *wanted = cli_device_wanted(cli);
    if (cli->options.part.spreads)
        wanted = strcmp(wanted, "all") == 0
                     ? NULL
                     : arena_copy(&cli->arena, (str){wanted, strcspn(wanted, ",")}).ptr;
    return (struct gpu_options){.device = wanted,
                                .keep = {.read = read_kernel, .write = write_kernel, .context = store}};
}

int cli_open_device(struct cli *cli, struct gpu **gpu) {
    char error[GPU_ERROR_BYTES] = "";
    const struct gpu_options options = cli_device_options(cli);
    return report_opening(cli, gpu_create(&options, gpu, error), error);
}

int cli_left_out(struct cli *cli, const char *what) {
    struct gpu *gpu = NULL;
    if (cli_has_option(cli->command, "device") && cli_open_device(cli, &gpu) != CLI_OK)
        return CLI_DEVICE;
    cli_close_device(cli, gpu);
    cli_usage(cli, 1, "this build of glint has no %s", what);
    diag_help(&cli->sink, "the installed glint has that: docs/install.md");
    return CLI_USAGE;
}

int cli_open_named(struct cli *cli, const char *name, struct gpu **gpu) {
    char error[GPU_ERROR_BYTES] = "";
    struct gpu_options options = cli_device_options(cli);
    options.device = name;
    return report_opening(cli, gpu_create(&options, gpu, error), error);
}

int cli_open_screen_device(struct cli *cli, const char *const *extensions, uint32_t count, struct gpu **gpu) {
    char error[GPU_ERROR_BYTES] = "";
    struct gpu_options options = cli_device_options(cli);
    options.screen_extensions = extensions;
    options.screen_extension_count = count;
    return report_opening(cli, gpu_create(&options, gpu, error), error);
}

struct cli_opening {
    struct parallel_task task;
    struct gpu_options options;
    struct timeline *timeline;
    struct gpu *gpu;
    enum gpu_status status;
    char error[GPU_ERROR_BYTES];
    double seconds;
};

static void open_beside(void *context) {
    struct cli_opening *opening = context;
    const double start = clock_seconds();
    opening->status = gpu_create(&opening->options, &opening->gpu, opening->error);
    opening->seconds = clock_seconds() - start;
    timeline_add(opening->timeline, "device", STR(""), start);
}

struct cli_opening *cli_begin_opening(struct cli *cli, struct timeline *timeline) {
    struct cli_opening *opening = heap_zeroed(1, sizeof *opening);
    if (!opening)
        return NULL;
    opening->options = cli_device_options(cli);
    opening->timeline = timeline;
    parallel_start(&opening->task, open_beside, opening);
    return opening;
}

bool cli_opening_is_good(struct cli_opening *opening) {
    if (opening)
        parallel_wait(&opening->task);
    return CLI_HAS_DEVICES && opening && opening->status == GPU_OK;
}

int cli_end_opening(struct cli *cli, struct cli_opening **opening, struct gpu **gpu, double *seconds) {
    struct cli_opening *o = *opening;
    const double start = clock_seconds();
    int status;
    *opening = NULL;
    if (o) {
        parallel_wait(&o->task);
        *gpu = o->gpu;
        status = report_opening(cli, o->status, o->error);
    } else {
        status = cli_open_device(cli, gpu);
    }
    *seconds = o ? o->seconds : clock_seconds() - start;
    free(o);
    return status;
}

// A thread that is still at work keeps its data; the program then ends while it runs (main.c).
void cli_drop_opening(struct cli *cli, struct cli_opening *opening) {
    if (!opening)
        return;
    if (!parallel_is_over(&opening->task)) {
        cli->stuck = true;
        return;
    }
    parallel_wait(&opening->task);
    cli_close_device(cli, opening->gpu);
    free(opening);
}

void cli_close_device(struct cli *cli, struct gpu *gpu) {
    cli->stuck |= !gpu_destroy(gpu);
}

int cli_device_failed(struct cli *cli, const struct gpu *gpu) {
    bool memory = gpu_last_status(gpu) == GPU_NO_MEMORY;
    cli_error(cli, memory ? DIAG_DEVICE_MEMORY : DIAG_DEVICE_FAILED, cli->operands[0],
              memory ? "use a smaller scene or background, or another device" : NULL, "%s", gpu_error(gpu));
    return CLI_DEVICE;
}
