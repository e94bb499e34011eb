// The header of a PLY file (Greg Turk, "The PLY Polygon File Format", 1994): which data follows it, in which
// form.
//
// Lines end with \n, \r\n or \r, as the first one does. Types have their original names (uchar, float) or
// those with sizes (uint8, float32). Elements and properties may have any name and any order. Errors: faults
// at their line, counted in file->errors; a header that announces more than the file has bytes for is a
// fault, so nobody allocates that much. Ownership: lists are in the arena, names in the text. Thread safety:
// one call belongs to one thread.
#ifndef GLINT_ASSETS_PLY_PLY_HEADER_H
#define GLINT_ASSETS_PLY_PLY_HEADER_H

#include "assets/file/asset_file.h"

enum ply_type {
    PLY_NONE, // as a count's type: the property is not a list
    PLY_INT8,
    PLY_UINT8,
    PLY_INT16,
    PLY_UINT16,
    PLY_INT32,
    PLY_UINT32,
    PLY_INT64,
    PLY_UINT64,
    PLY_FLOAT32,
    PLY_FLOAT64,
    PLY_TYPES
};
static inline bool ply_is_whole(enum ply_type type) {
    return type > PLY_NONE && type < PLY_FLOAT32;
}

struct ply_property {
    str name;
    enum ply_type type;  // of the value, or of each item of a list
    enum ply_type count; // of a list
};

struct ply_element {
    str name;
    size_t at, end; // its line in the header, bytes
    uint32_t count;
    uint32_t bytes_least; // of one of them
    bool has_lists;
    struct {
        struct ply_property *items;
        uint32_t count, capacity;
    } properties;
};

enum ply_form {
    PLY_TEXT,
    PLY_LITTLE,
    PLY_BIG
};

struct ply_header {
    enum ply_form form;
    size_t bytes;   // of the header
    uint32_t lines; // of the header
    struct {
        struct ply_element *items;
        uint32_t count, capacity;
    } elements;
};

#define PLY_ABSENT UINT32_MAX

extern const unsigned char ply_type_bytes[PLY_TYPES];

// Reads the header of file->text, and sets file->is_binary and file->head_bytes. false: a fault was reported.
bool ply_read_header(struct asset_file *file, struct arena *arena, struct ply_header *out);
// The first element of this name; NULL: none.
const struct ply_element *ply_find_element(const struct ply_header *header, const char *name);
// The first property that has one of the names, which end with NULL; PLY_ABSENT: none.
uint32_t ply_find_property(const struct ply_element *element, const char *const *names);

#endif
