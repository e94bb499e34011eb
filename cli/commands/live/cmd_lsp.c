// glint lsp: the language server, over standard input and output.
#include "cli/commands/commands.h"
#include "cli/device.h"
#include "diag/codes/command.h"
#include "diag/codes/file.h"
#include "lsp/server.h"
#include "render/preview/preview.h"

#include <string.h>
#include <unistd.h>

// ---- what previews are drawn by

struct device_choice {
    struct cli *cli;
    struct gpu_options options; // taken before threads were started
};

// If there is no device, or not the one asked for, the reference draws: an editor shows pictures, and `glint
// render` reports what is wrong with devices.
static struct gpu *open_device(void *context) {
    const struct device_choice *choice = context;
    char error[GPU_ERROR_BYTES];
    struct gpu *gpu = NULL;
    return gpu_create(&choice->options, &gpu, error) == GPU_OK ? gpu : NULL;
}

static void close_device(void *context, struct gpu *gpu) {
    const struct device_choice *choice = context;
    cli_close_device(choice->cli, gpu);
}

int cmd_lsp(struct cli *cli) {
    struct lsp_fault fault;
    struct session_options settings = cli_session_options(cli, NULL);
    struct device_choice choice = {cli, cli_device_options(cli)};
    const struct preview_devices devices = {open_device, close_device, &choice};
    int status = lsp_serve(STDIN_FILENO, STDOUT_FILENO, GLINT_VERSION, &settings,
                           cli_device_is_reference(cli) ? NULL : &devices, &fault);
    if (!fault.error)
        return status;
    cli_error(cli, fault.is_input ? DIAG_FILE_UNREADABLE : DIAG_OUTPUT,
              fault.is_input ? "standard input" : "standard output", NULL, "cannot be %s: %s",
              fault.is_input ? "read" : "written", strerror(fault.error));
    return CLI_FILE;
}
