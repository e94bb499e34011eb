// Waits until one of some files changes, appears or goes.
//
// What counts is a file's size and time of change, compared with those that it had when it was read: no
// change is lost between reading and watching. inotify on the folders only says when to look, so that it does
// not matter how an editor saves: in place, or by a new file that takes the old one's name. Without inotify,
// and for folders of other machines, it looks by itself from time to time.
//
// Input: paths, as the process opens them. Errors: a watch that cannot be made is NULL; a folder that cannot
// be watched is looked at from time to time. Ownership: watch_destroy frees all and takes NULL. Times in
// seconds. Thread safety: one thread at a time for a watch.
#ifndef GLINT_FILES_WATCH_H
#define GLINT_FILES_WATCH_H

#include "files/files.h"

#define WATCH_POLL_SECONDS 0.1 // between two looks, without inotify
#define WATCH_SLOW_SECONDS 1.0 // and with it

struct watch;

// `polls`: without inotify, even where there is one. NULL: no memory.
struct watch *watch_create(bool polls);
void watch_destroy(struct watch *watch);
// Whether it has inotify: else it looks WATCH_POLL_SECONDS after it did.
bool watch_is_told(const struct watch *watch);
// Forgets all files. The next ones are those that are watched.
void watch_begin(struct watch *watch);
// A file as it was when it was read, or one that was not there. false: no memory.
bool watch_add(struct watch *watch, const struct file_read *read);
bool watch_add_missing(struct watch *watch, str path);
// The same for one of which nothing is known: as it is now.
bool watch_add_now(struct watch *watch, str path);
// Whether any of them is not as it was added, now.
bool watch_differs(const struct watch *watch);
// The same, for one who asks all the time: files are looked at only if something has changed since the last
// look, or that is WATCH_SLOW_SECONDS ago (without inotify WATCH_POLL_SECONDS). A change is not lost, but
// found once.
bool watch_look(struct watch *watch);
// Waits until any is, or `seconds` are over, or a signal comes: watch_differs.
bool watch_wait(struct watch *watch, double seconds);
// After watch_wait: waits until nothing has changed for `seconds`, so that a file that is being written is
// whole; at most ten times as long. false: a signal came.
bool watch_settle(struct watch *watch, double seconds);

#endif
