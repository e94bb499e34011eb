// Bands on several devices of one host: each takes the next one that nobody has. Private to cli/bands.
//
// A band's bytes are those of its device, so only devices of one name and driver share a picture. Thread
// safety: bands_claim and bands_keep may be called by any device's thread; the others by the job's.
#ifndef GLINT_CLI_COMMANDS_BANDS_BAND_DEVICES_H
#define GLINT_CLI_COMMANDS_BANDS_BAND_DEVICES_H

#include "cli/commands/bands/bands_run.h"

// Whether --device names several: 'all', or numbers with commas between them.
bool bands_spread(const struct cli *cli);
// A band that is not there and that nobody works on; the number of bands: none is left, or a signal came.
uint32_t bands_claim(struct bands_run *run);
// Aims settings at a band.
void bands_aim(const struct bands_run *run, uint32_t band, struct render_settings *settings);
// Writes a band that was made with these settings.
bool bands_keep(struct bands_run *run, uint32_t band, const float *rgb,
                const struct render_settings *settings, const struct render_statistics *made);

struct band_devices;
// The devices besides the job's, at work: CLI_OK, or an exit code with an error printed. NULL where there are
// none.
int bands_begin_devices(struct bands_run *run, struct band_devices **devices);
// Waits until they have nothing left to do, and closes them. CLI_OK, CLI_STOPPED, or CLI_DEVICE with an error
// printed. NULL does nothing.
int bands_end_devices(struct bands_run *run, struct band_devices *devices);

#endif
