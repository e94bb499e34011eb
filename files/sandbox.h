// What the process may still do once it works with files that nobody trusts: read below some folders, write
// below others, start no program, and take so much time and memory.
//
// The door (door.h, files.h) refuses by itself what a file names outside of its folder. This is the wall
// behind it: on Linux 5.13 and later the kernel (Landlock) refuses whatever else the process, a library or a
// driver would open, any program, and any connection. Elsewhere the door is all there is, and programs are
// not started. It belongs to the process, and to threads that begin later; there is no way out. Thread
// safety: sandbox_enter belongs to the only thread there is; the others are safe.
#ifndef GLINT_FILES_SANDBOX_H
#define GLINT_FILES_SANDBOX_H

#include <stdbool.h>
#include <stdint.h>

struct sandbox_path {
    const char *path; // a file or folder; what is not there is left out
    bool writes;      // files may be made and replaced, or a device written to and asked
};

struct sandbox {
    const struct sandbox_path *paths;
    uint32_t count;
    unsigned seconds;      // of processor time; then the system sends SIGXCPU
    uint64_t memory_bytes; // more than there is now
};

// The version of Landlock; 0: the system has none.
int sandbox_landlock(void);
// Returns 0, or the errno of what a system that has Landlock did not do.
int sandbox_enter(const struct sandbox *sandbox);
bool sandbox_entered(void);
// For a process that is about to become another program, which is to read only: it starts no process, writes
// no file and makes no connection by TCP, as far as the system can refuse these, and takes so much time and
// memory. Not for this program, whose threads would be none the wiser.
void sandbox_only_read(const struct sandbox *limits);
// Notes that something was refused, once the sandbox is entered; and whether that was so.
void sandbox_refuse(void);
bool sandbox_refused(void);

#endif
