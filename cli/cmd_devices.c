// glint devices: what can render here. The number or a part of the name goes to --device.
#include "cli/cli.h"

#include "tracer/gpu/gpu.h"

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

int cmd_devices(struct cli *cli) {
    enum {
        DEVICES_MAX = 32
    };
    struct gpu_device_info *items = ARENA_ARRAY(&cli->arena, struct gpu_device_info, DEVICES_MAX);
    char error[GPU_ERROR_BYTES] = "";
    uint32_t count = 0;
    if (gpu_list(items, DEVICES_MAX, &count, error) != GPU_OK) {
        cli_error(cli, DIAG_NO_VULKAN, "devices", "on Debian: apt-get install libvulkan1 mesa-vulkan-drivers",
                  "%s", error);
        return CLI_DEVICE;
    }
    struct strbuf text;
    strbuf_init(&text);
    for (uint32_t i = 0; i < count && i < DEVICES_MAX; i++) {
        const struct gpu_device_info *d = &items[i];
        strbuf_format(&text, "%c %u  %s (%s, %llu MiB%s%s)\n", d->preferred ? '*' : ' ', d->number, d->name,
                      kind_name(d->kind), (unsigned long long)(d->memory_bytes >> 20),
                      d->driver[0] ? ", " : "", d->driver);
    }
    int status = cli_print(cli, strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}
