// What the process may still do once it works with untrusted files: read below some folders, write below
// others, start no program, and use limited time and memory.
//
// The door (door.h, files.h) already refuses what a file names outside its folder. This is the wall behind
// it: on Linux 5.13 and later the kernel (Landlock) refuses whatever else the process, a library or a driver
// would open, any program, and any connection. Elsewhere there is only the door, and programs are not
// started. The sandbox applies to the process and to threads that begin later; there is no way out. Thread
// safety: call sandbox_enter while there is only one thread; the other calls are safe.
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
    uint64_t memory_bytes; // beyond what is in use now
};

// The version of Landlock; 0: the system has none.
int sandbox_landlock(void);
// Returns 0, or the errno of the step that failed on a system with Landlock.
int sandbox_enter(const struct sandbox *sandbox);
bool sandbox_entered(void);
// For a process that is about to become another program, which may only read: it starts no process, writes no
// file and makes no TCP connection, as far as the system can refuse these, and uses limited time and memory.
// Not for this program: its other threads would not be restricted.
void sandbox_only_read(const struct sandbox *limits);
// Notes, once the sandbox is entered, that something was refused; and returns whether anything was.
void sandbox_refuse(void);
bool sandbox_refused(void);

#endif
