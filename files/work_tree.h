// Where a scene's files may be if no settings say so: in the git work tree around it.
//
// Ownership: paths go into the arena of `files`, which must be guarded. Thread safety: as files.h.
#ifndef GLINT_FILES_WORK_TREE_H
#define GLINT_FILES_WORK_TREE_H

#include "files/files.h"

// The top of the git work tree around a file, absolute, links resolved; the empty string if there is none. It
// is the nearest folder at or above the file's that holds `.git`, a repository's folder or the file that
// leads to one (in a submodule, or a further work tree). As git does, it counts only if the folder and its
// `.git` belong to the user who runs this, or, for root, to the one who called sudo; and folders of
// GIT_CEILING_DIRECTORIES, and those above them, are not looked in.
str files_work_tree(struct files *files, str path);
struct files_marker {
    str path; // of the settings to create; empty: none would help, or none should be there
    bool is_certain;
};
// What to do where a scene names a file outside its root (FILE_OUTSIDE): `path` as written, `target` where it
// led. Where there are neither settings nor a work tree, settings in the folder that holds both would allow
// it: *marker. That folder never is the whole file system or the home folder, nor one that only a link leads
// to. It is certain if it is the current folder or below it: whoever runs glint there is working on it.
str files_outside_advice(struct files *files, str path, str target, struct files_marker *marker);
// The contents of those settings.
#define FILES_MARKER_TEXT "# The scenes below this folder may read the files in it.\n"

#endif
