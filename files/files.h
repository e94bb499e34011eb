// The one door to the file system, for reading. What a file names may only be read below allowed folders
// (roots), links followed, and only if it is a regular file; the file that is checked is the one that is
// opened (door.h). Files are read whole into memory, never mapped.
//
// Ownership: the caller owns `struct files`; contents go into the caller's arena. Paths go into the arena
// given to `files_init`, which must be guarded while these functions run.
// Thread safety: resolving and reading may run in several threads as long as none adds roots or
// overlays; for the log of reads, the caller must read files from one thread at a time.
#ifndef GLINT_FILES_FILES_H
#define GLINT_FILES_FILES_H

#include "core/arena.h"
#include "core/str.h"

enum file_status {
    FILE_OK,
    FILE_MISSING,
    FILE_OUTSIDE,     // resolves to a place outside every root
    FILE_NOT_REGULAR, // a folder, a pipe, a device
    FILE_UNREADABLE,  // the system refused; files.system_error says why
    FILE_TOO_LARGE,   // larger than the given cap
    FILE_NO_MEMORY,
};

struct file_read {
    str path; // absolute, links resolved
    uint64_t size_bytes;
    int64_t modified_ns; // since 1970
};

struct file_overlay {
    str path; // absolute
    str text;
};

struct files {
    struct arena *arena; // for paths and the log
    struct {
        str *items;
        uint32_t count, capacity;
    } roots; // absolute, links resolved; first the scene's
    struct {
        str *items;
        uint32_t count, capacity;
    } given; // files that the user named, links resolved; may be read again
    struct {
        struct file_overlay *items;
        uint32_t count, capacity;
    } overlays;
    struct {
        struct file_read *items;
        uint32_t count, capacity;
    } log; // every file that was read, once
    struct {
        str *items;
        uint32_t count, capacity;
    } missed;         // the first paths where files_resolve found nothing, links resolved
    int system_error; // errno of the last FILE_UNREADABLE
};

void files_init(struct files *files, struct arena *arena);
// The same folders and log in an arena of their own; their texts are shared.
void files_copy(const struct files *from, struct arena *arena, struct files *out);
// Whether all files of the log are unchanged and none of the missed ones exists now.
bool files_are_same(const struct files *files);
// Makes `directory` an allowed folder. FILE_MISSING or FILE_NOT_REGULAR if it is not a folder.
enum file_status files_add_root(struct files *files, str directory);
// Text from memory in place of the file at `path` (which need not exist); copied. The newest text for a path
// counts.
void files_add_overlay(struct files *files, str path, str text);
#define FILES_CONFIG_NAME ".glintrc.yaml"
// The scene's root: the folder of the nearest `.glintrc.yaml` at or above the scene's folder, else the top of
// the git work tree around it (work_tree.h), else the scene's folder. `scene_path` is as given by the user.
str files_scene_root(struct files *files, str scene_path);
// On FILE_OK that root has been added.
enum file_status files_add_scene_root(struct files *files, str scene_path);

// The nearest `.glintrc.yaml` at or above the folder of `scene_path`, absolute; the empty string if there is
// none.
str files_find_config(struct files *files, str scene_path);

// Finds the file that `base_path` (a file) names `path`: relative paths are tried beside base_path,
// then below each root after the first, in order. On FILE_OK *out is the path to open, as readable text;
// for FILE_OUTSIDE *out is where it led. A path that exists but is outside is FILE_OUTSIDE; a device or pipe
// there is FILE_NOT_REGULAR, since no root could allow it.
enum file_status files_resolve(struct files *files, str base_path, str path, str *out);
// Whether a file that was found in a folder without being named may be read: with links followed, it must be
// below a root or below that `folder`. FILE_OUTSIDE if it is not.
enum file_status files_confine(struct files *files, str path, str folder);
// Reads a file below a root, or one that was given; others are FILE_OUTSIDE. A NUL byte follows the contents,
// not counted. `cap_bytes` is checked before memory is taken.
enum file_status files_read(struct files *files, str path, uint64_t cap_bytes, struct arena *into,
                            str *contents);
// The same for a file that files_confine allows.
enum file_status files_read_found(struct files *files, str path, str folder, uint64_t cap_bytes,
                                  struct arena *into, str *contents);
// The same for a file that the user named, wherever it is.
enum file_status files_read_given(struct files *files, str path, uint64_t cap_bytes, struct arena *into,
                                  str *contents);
// Whether a path, whose last parts need not exist, is below a root, links followed; *root is that root.
enum file_status files_place(struct files *files, str path, str *root);
struct output;
// Opens an output that something other than the user named, below a root; missing folders are created.
// FILE_NOT_REGULAR: something other than a file has this name.
enum file_status files_write(struct files *files, str path, struct output *output);
// For caches: the canonical path, size and time of a regular file (or overlay: its time is a hash of its
// text) without reading it; logged as a read.
enum file_status files_identify(struct files *files, str path, struct file_read *out);
// The name in the folder of `path` that is nearest to its last part, for "did you mean", among those with one
// of the endings (NULL at their end; NULL itself: any); the empty string if none is near or the folder is
// outside the roots.
str files_suggest(struct files *files, str path, const char *const *endings);
// What is wrong with a path that only another system or a shell would understand, and what to write ("write
// 'a/b.obj': ..."); the empty string for all others.
str files_advice(struct arena *arena, str path);
// What a file that will be at `to_file` must write to name the file that `from_file` names `path`: the path
// unchanged if it is absolute, if both are in one folder, or if there is no such file beside from_file.
str files_rebase(struct files *files, str path, str from_file, str to_file);
// An absolute path with links followed, also if only its last part does not exist; else the path itself.
str files_canonical(struct files *files, str path);
// The folder part of a path ("." if it has none) and the part after the last '/'.
str path_folder(str path);
str path_base(str path);
// `path` unchanged if it is absolute or the folder is ".", else appended to the folder.
str path_join(struct arena *arena, str folder, str path);
// Whether `path` is `folder` or is below it, both absolute; *rest is what follows the folder: "a/b", or
// nothing.
bool path_is_below(str path, str folder, str *rest);
// What went wrong, as words: "does not exist", ...; system errors with strerror's text.
const char *file_status_text(const struct files *files, enum file_status status);

#endif
