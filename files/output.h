// Outputs that are complete or absent: written to a temporary name beside the target, then renamed.
//
// A failed or abandoned run leaves the old file as it was. Permissions are kept, and links: their target is
// replaced. A target that exists and is not a regular file (a device, a pipe) is written to directly; "-" is
// standard output. The program ignores SIGPIPE and SIGXFSZ, so that they come back as errors here. A call
// that a signal interrupts is made again, and a partial write continues with the rest. An open output stays
// where it is (temporary.h). Thread safety: one output belongs to one thread. After an error every later call
// does nothing.
#ifndef GLINT_FILES_OUTPUT_H
#define GLINT_FILES_OUTPUT_H

#include "core/str.h"
#include "files/temporary.h"

struct output {
    int fd;     // -1: closed
    int folder; // the open folder that contains the file, or AT_FDCWD
    char *path;
    char *temporary; // NULL if the target is written directly
    struct temporary entry;
    int error; // errno of the first failure, 0 if none
};

// Opens the temporary file. false: output.error says why; nothing else needs to be called.
bool output_open(struct output *output, const char *path);
// The same for the file with the path's name in an open folder, which then belongs to the output. Only a
// regular file is replaced, and no link is followed (ELOOP, ENXIO, EISDIR).
bool output_open_in(struct output *output, int folder, const char *path);
// The same, but the file replaces anything of that name except a folder.
bool output_open_over(struct output *output, int folder, const char *path);
void output_write(struct output *output, const void *bytes, size_t count);
// Tells and sets where the next byte goes: for formats whose beginning is written last. Only for files.
uint64_t output_place(struct output *output);
void output_move(struct output *output, uint64_t place);
// Flushes, closes and renames. false: output.error says why; the old file is as it was.
bool output_commit(struct output *output);
// Removes the temporary file. Does nothing after output_commit.
void output_abandon(struct output *output);
// All of the above at once, for bytes that are already complete; 0 or an errno.
int output_whole(const char *path, const void *bytes, size_t count);
// A new file in a folder that is temporary itself: written in place, without waiting until it is on the disk,
// which takes milliseconds each. 0 or an errno.
int output_part(const char *path, const void *bytes, size_t count);
// Writes all bytes to an open descriptor. 0 or an errno.
int output_descriptor(int fd, const void *bytes, size_t count);

#endif
