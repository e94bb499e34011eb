// The device that --device, else GLINT_DEVICE, asks for, and what is reported if it fails.
//
// Thread safety: as cli.h.
#ifndef GLINT_CLI_DEVICE_H
#define GLINT_CLI_DEVICE_H

#include "cli/cli.h"
#include "tracer/gpu/gpu.h"

// NULL: none in particular.
const char *cli_device_wanted(const struct cli *cli);
// Whether that is the reference.
bool cli_device_is_reference(const struct cli *cli);
// CLI_OK, or CLI_DEVICE with an error printed. *gpu is the caller's to destroy.
int cli_open_device(struct cli *cli, struct gpu **gpu);
// Destroys it; notes in cli->stuck whether it may still be at work. NULL does nothing.
void cli_close_device(struct cli *cli, struct gpu *gpu);
// Prints what failed last; returns CLI_DEVICE.
int cli_device_failed(struct cli *cli, const struct gpu *gpu);

#endif
