// The device that --device, else GLINT_DEVICE, asks for, and what is reported if it fails.
//
// Thread safety: as cli.h.
#ifndef GLINT_CLI_DEVICE_H
#define GLINT_CLI_DEVICE_H

#include "cli/cli.h"
#include "tracer/gpu/gpu.h"

struct timeline;

// glint devices: prints the devices there are, one per line, as --device names them.
int cli_list_devices(struct cli *cli);
// The device that was asked for; NULL: none in particular.
const char *cli_device_wanted(const struct cli *cli);
// Whether that is the reference.
bool cli_device_is_reference(const struct cli *cli);
// Options for gpu_create, when nothing is printed if it fails. What they point to lives as long as `cli`.
struct gpu_options cli_device_options(struct cli *cli);
// Reports that this build leaves out `what`, a part of the running command; returns the exit code. If the
// command draws on a device, the reason given is that there is none.
int cli_left_out(struct cli *cli, const char *what);
// CLI_OK, or CLI_DEVICE with an error printed. *gpu is the caller's to destroy.
int cli_open_device(struct cli *cli, struct gpu **gpu);
// The same for a device by its number or name, whatever --device says.
int cli_open_named(struct cli *cli, const char *name, struct gpu **gpu);
// The same for one that shows pictures in a window, which needs these extensions of Vulkan's instance.
int cli_open_screen_device(struct cli *cli, const char *const *extensions, uint32_t count, struct gpu **gpu);
// The same in parallel to other work: begun, and later awaited; errors are printed only then.
struct cli_opening;
// NULL: no memory, and cli_end_opening opens it.
struct cli_opening *cli_begin_opening(struct cli *cli, struct timeline *timeline);
// Waits, and says whether cli_end_opening will be CLI_OK; false for NULL.
bool cli_opening_is_good(struct cli_opening *opening);
// As cli_open_device; *opening (may be NULL) is gone. *seconds is how long it took.
int cli_end_opening(struct cli *cli, struct cli_opening **opening, struct gpu **gpu, double *seconds);
// Drops a device that is no longer wanted, without waiting for it to open. NULL does nothing.
void cli_drop_opening(struct cli *cli, struct cli_opening *opening);
// Destroys it; notes in cli->stuck whether it may still be at work. NULL does nothing.
void cli_close_device(struct cli *cli, struct gpu *gpu);
// Prints what failed last; returns CLI_DEVICE.
int cli_device_failed(struct cli *cli, const struct gpu *gpu);

#endif
