// Opens a path that something other than the user has named, so that no link is followed on the way.
//
// Who wants to read or write beneath a folder makes the path canonical (absolute, links resolved), judges it,
// and opens it here: what was judged is what is opened, as a link that takes the place of any part of the
// path meanwhile is refused. So there is no moment between the look and the opening in which the file could
// be exchanged for one elsewhere. A pipe that nobody writes to is not waited for. Output: a descriptor, the
// caller's to close; -1: errno, which is ELOOP where there is a link now. Thread safety: pure.
#ifndef GLINT_FILES_DOOR_H
#define GLINT_FILES_DOOR_H

// `flags` as for open(2), but for O_CREAT.
int door_open(const char *canonical, int flags);
// A folder, for the *at calls: names in it may be opened without following links.
int door_folder(const char *canonical);

#endif
