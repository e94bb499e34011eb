// A file that the scene (or a mesh) names: finding it, and diagnostics inside it.
//
// A file that is missing, refused or too large is a diagnostic where it is named. A fault inside it is
// placed in the file, with notes "named here" up to the scene; the file's text becomes a source when the
// first such diagnostic needs it. If the sink is full, further ones are only counted. Ownership: text that
// becomes a source is copied into the arena of the source set, which the caller of assets_load has guarded;
// other functions' results say so.
// Thread safety: one thread loads.
#ifndef GLINT_ASSETS_FILE_ASSET_FILE_H
#define GLINT_ASSETS_FILE_ASSET_FILE_H

#include "assets/file/asset_input.h"

struct gltf_document;

struct asset_file {
    const struct assets_input *input;
    str path;                             // to open, and as shown
    const char *what;                     // "mesh", "material file", "image"
    str text;                             // the text while it is in memory; else empty
    uint32_t source;                      // the source with the text; SOURCE_DEFAULT until needed
    uint32_t bare_source;                 // a source without text: for faults of the whole file
    enum limit limit;                     // the limit on its size
    span named_at;                        // where the scene names it
    struct asset_file *named_in;          // the mesh that names it; NULL: the scene
    uint32_t named_line;                  // in named_in
    uint32_t counted_line, counted_bytes; // where the line count last stopped, in a text that is not kept
    uint32_t errors;
    bool is_binary;      // it has no lines: a "line" is the number of a face, from 1
    uint32_t head_bytes; // of a binary file: lines at its beginning, which can be shown
    struct gltf_document
        *document; // of a glTF mesh, which all models of the file share; NULL: of another format
    str part;      // part of the mesh, as the model names it; empty: all
    span part_at;  // where the model names the part
};

// The file that contains a value: paths are relative to it. Values of options belong to the scene's file.
str asset_base(const struct assets_input *input, span at);
// Finds the file that `base_path` (a file) names `path`. On success file->path is set and *identity filled;
// else adds a diagnostic where the file is named. `file` has its other members set. If `missing` is not NULL,
// a missing file only sets *missing, without a diagnostic.
bool asset_find(struct asset_file *file, str base_path, str path, struct file_read *identity, bool *missing);
// Adds to the uses a file found before that another place of the scene names. The strings are the caller's,
// and live as long as the arena.
void asset_note_again(const struct asset_file *file, span at, str named, str canonical, uint64_t size_bytes);
// Reads the found file into `arena`; if that fails, adds a diagnostic where it is named.
bool asset_read(struct asset_file *file, struct arena *arena);

// Adds a diagnostic for bytes [begin, end) of the file's text, with its "named here" notes. false: it was
// only counted, and neither help nor notes must be added.
bool asset_report(struct asset_file *file, diag_code code, size_t begin, size_t end, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
// The same for a whole line (from 1; 0 means the whole file).
bool asset_report_line(struct asset_file *file, diag_code code, uint32_t line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
// The same at a byte of a binary file, from 0.
bool asset_report_byte(struct asset_file *file, diag_code code, uint64_t byte, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
// Whether a further fault of this code is only counted; if so, counts it. For callers to which finding the
// place takes time.
bool asset_only_counts(struct asset_file *file, diag_code code);
// The place of a line of the file.
span asset_line(struct asset_file *file, uint32_t line);
// A copy in the input's arena, for reports at the place that names the file, made after it and the files that
// name it are closed.
struct asset_file *asset_keep(struct asset_file *file);
// Adds a diagnostic where the file is named.
void asset_report_named(struct asset_file *file, diag_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
// The same at the place where the model names the part: the mesh has no part of that name, or no parts. Help
// may follow.
void asset_report_part(struct asset_file *file, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Reports that a limit is too low: E501 at the given bytes, with the option that raises it.
void asset_report_limit(struct asset_file *file, enum limit limit, size_t begin, size_t end, uint64_t needed);
// Reports the fault of an arena that was used for the file (E501 or E502) where the file is named.
void asset_report_memory(struct asset_file *file, enum arena_fault fault);

enum {
    ASSET_IMAGE_GROWTH = 200, // bytes of memory that images may take per byte of their files
};

// Whether images may take that much memory: image-growth, or as their files allow.
bool asset_fits_growth(const struct assets_input *input, uint64_t bytes, uint64_t file_bytes);

#endif
