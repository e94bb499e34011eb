// glint verify: what is compared, and how it is reported. Private to cli/verify.
//
// Ownership: text lies in cli->arena or in the pictures' bytes. Thread safety: as cli.h.
#ifndef GLINT_CLI_COMMANDS_VERIFY_VERIFY_H
#define GLINT_CLI_COMMANDS_VERIFY_VERIFY_H

#include "cli/cli.h"
#include "picture/metrics/picture_file.h"
#include "render/record/record.h"

// Between devices and versions, of displayed values (docs/accuracy.md, "Other devices"): the largest share of
// pixels off by more than VERIFY_OFF in a channel, and the largest mean over all channels.
#define VERIFY_OFF   (2.0 / 255)
#define VERIFY_SHARE 0.005
#define VERIFY_MEAN  (0.1 / 255)

struct verify_pixels {
    uint64_t count, differ; // pixels; pixels that differ in a channel
    struct measure_place worst;
    double share, mean; // as displayed, of VERIFY_OFF
};

struct verify {
    struct cli *cli;
    const char *path, *scene;
    int format;
    str bytes;
    struct record_read was, is; // as the file says, and as it is now
    struct record_command command;
    struct picture_file pictures[2]; // the file's, and the one rendered now
    struct strbuf made;              // the file that render would write now
    struct image_display display;    // its own
    struct verify_pixels pixels;
    char scene_hash[40];
    int status;
};

// Whether everything holds: what the exit status says.
bool verify_holds(const struct verify *v);

// verify_report.c
void verify_text(const struct verify *v, struct strbuf *out);
void verify_json(const struct verify *v, struct strbuf *out);

#endif
