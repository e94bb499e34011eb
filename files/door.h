// Opens a path that something other than the user has named, so that no link is followed on the way.
//
// Whoever wants to read or write below a folder makes the path canonical (absolute, links resolved), checks
// it, and opens it here: the checked file is the one opened, since a link that has meanwhile replaced any
// part of the path is refused. So between check and opening, the file cannot be exchanged for one elsewhere.
// A pipe that nobody writes to is not waited for. Output: a descriptor, the caller's to close; -1: errno,
// which is ELOOP where there is a link now. Thread safety: pure.
#ifndef GLINT_FILES_DOOR_H
#define GLINT_FILES_DOOR_H

// `flags` as for open(2), without O_CREAT.
int door_open(const char *canonical, int flags);
// A folder, for the *at calls: names in it may be opened without following links.
int door_folder(const char *canonical);

#endif
