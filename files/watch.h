// Waits until one of some files changes, appears or goes.
//
// A file's size and time of change are compared with those it had when it was read: no change is lost between
// reading and watching. inotify on the folders only says when to look, so it does not matter how an editor
// saves: in place, or by a new file that takes the old name. Without inotify, and for folders of other
// machines, it polls.
//
// Input: paths, as the process opens them. Errors: a watch that cannot be made is NULL; a folder that cannot
// be watched is polled. Ownership: watch_destroy frees all and takes NULL. Times in seconds. Thread safety:
// one thread at a time for a watch.
#ifndef GLINT_FILES_WATCH_H
#define GLINT_FILES_WATCH_H

#include "files/files.h"

#define WATCH_POLL_SECONDS 0.1 // between two looks, without inotify
#define WATCH_SLOW_SECONDS 1.0 // and with it

struct watch;

// `polls`: without inotify, even where there is one. NULL: no memory.
struct watch *watch_create(bool polls);
void watch_destroy(struct watch *watch);
// Whether it has inotify: else it looks every WATCH_POLL_SECONDS.
bool watch_is_told(const struct watch *watch);
// Forgets all files. The files added next are those that are watched.
void watch_begin(struct watch *watch);
// A file as it was when it was read, or one that was not there. false: no memory.
bool watch_add(struct watch *watch, const struct file_read *read);
bool watch_add_missing(struct watch *watch, str path);
// The same for a file of which nothing is known: its present state counts.
bool watch_add_now(struct watch *watch, str path);
// Whether any of them now differs from when it was added.
bool watch_differs(const struct watch *watch);
// The same, for a caller that asks all the time: files are checked only if something has changed since the
// last check, or if that was WATCH_SLOW_SECONDS ago (without inotify WATCH_POLL_SECONDS). A change is never
// lost, but found only once.
bool watch_look(struct watch *watch);
// Waits until one has changed, `seconds` are over, or a signal comes; returns watch_differs.
bool watch_wait(struct watch *watch, double seconds);
// After watch_wait: waits until nothing has changed for `seconds`, so that a file being written is complete;
// at most ten times as long. false: a signal came.
bool watch_settle(struct watch *watch, double seconds);

#endif
