// A film, written frame by frame: Y4M by glint, other kinds by ffmpeg, which reads the frames from a pipe.
//
// Y4M has one luma and two chroma values for each pixel (4:4:4), of 8 bits in the limited range of BT.709
// (ITU-R BT.709-6, item 4.6): Y from 16 to 235, the others from 16 to 240. ffmpeg gets bytes of red, green
// and blue, and converts them by the same matrix. The film's file appears when it is whole: it is written
// under a temporary name. Errors: an exit code, printed. Ownership: film_end frees all, whatever happened
// before. Thread safety: film_pixels is pure; else as cli.h.
#ifndef GLINT_CLI_COMMANDS_BATCH_FILM_H
#define GLINT_CLI_COMMANDS_BATCH_FILM_H

#include "cli/commands/batch/batch_job.h"
#include "files/output.h"

#include <sys/types.h>

struct film {
    struct cli *cli;
    enum batch_film kind;
    const char *path;
    double fps;
    uint32_t width, height; // 0: no frame was written
    struct output output;   // of Y4M
    bool is_open;
    char *temporary; // what ffmpeg writes
    struct temporary entry;
    pid_t child;    // 0: none
    int pipe, said; // to ffmpeg, and the file of what it said; -1: none
    bool is_deaf;   // it reads no more
};

// Whether the film can be made at all: ffmpeg, if used, must be installed.
int film_begin(struct film *film, struct cli *cli, const char *path, enum batch_film kind, double fps);
// A frame's bytes as `kind` has them, appended to `out`. May run on another thread.
void film_pixels(enum batch_film kind, const struct image *image, struct image_display display,
                 struct strbuf *out);
// The first frame sets the size of all.
int film_frame(struct film *film, uint32_t width, uint32_t height, str bytes);
// CLI_OK: the file is there. `whole` false: the film is given up, and an old file stays as it was.
int film_end(struct film *film, bool whole);

#endif
