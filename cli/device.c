// The device that --device, else GLINT_DEVICE, asks for.
#include "cli/device.h"

#include <stdlib.h>
#include <string.h>

const char *cli_device_wanted(const struct cli *cli) {
    return cli->options.device ? cli->options.device : getenv("GLINT_DEVICE");
}

bool cli_device_is_reference(const struct cli *cli) {
    const char *wanted = cli_device_wanted(cli);
    return wanted && strcmp(wanted, "reference") == 0;
}

int cli_open_device(struct cli *cli, struct gpu **gpu) {
    char error[GPU_ERROR_BYTES] = "";
    struct gpu_options options = {.device = cli_device_wanted(cli)};
    enum gpu_status status = gpu_create(&options, gpu, error);
    if (status == GPU_OK)
        return CLI_OK;
    const char *asked = cli->options.device ? "--device" : options.device ? "GLINT_DEVICE" : "device";
    if (status == GPU_NO_DEVICE)
        cli_error(cli, DIAG_NO_DEVICE, asked, "'glint devices' lists the devices", "%s", error);
    else if (status == GPU_NO_LOADER || status == GPU_NO_DRIVER)
        cli_error(cli, DIAG_NO_VULKAN, "device", "on Debian: apt-get install libvulkan1 mesa-vulkan-drivers",
                  "%s", error);
    else
        cli_error(cli, DIAG_DEVICE_FAILED, "device", NULL, "%s", error);
    return CLI_DEVICE;
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
