// The elements of a PLY file, row by row: where each begins, and its values, from text and from both binary
// orders.
//
// In text a row is a line; empty lines are passed over. ply_walk finds an element's rows, and reads only what
// it needs for that; a binary row that was walked over is completely in the text. Errors: those of the walk
// are reported, those of values returned. Ownership: starts are in the arena. Thread safety: a cursor belongs
// to one thread; what was walked is constant.
#ifndef GLINT_ASSETS_PLY_PLY_ROWS_H
#define GLINT_ASSETS_PLY_PLY_ROWS_H

#include "assets/ply/ply_header.h"
#include "core/number.h"

enum {
    PLY_PIECE = 1 << 14, // rows that one thread reads
};

struct ply_cursor {
    const char *at, *end;
    uint32_t line; // of `at`, in text
    enum ply_form form;
};

// Where the rows of an element are.
struct ply_extent {
    const struct ply_element *element;
    struct ply_cursor begin; // of the first row
    struct ply_start {
        const char *at;
        uint32_t line;
        uint32_t items;  // items of the list in all rows before
    } * starts;          // one for each PLY_PIECE rows
    uint64_t items;      // items of the list `list`, in all rows
    uint32_t items_most; // most in one row
    uint32_t list;       // the property whose items are counted; PLY_ABSENT: none
};

enum ply_status {
    PLY_OK,
    PLY_ENDS, // the line or the file ends before
    PLY_BAD,  // not a number: ply_number says why
};

// Finds the rows of extent->element from the cursor on, counts the items of its list `extent->list`, and
// moves the cursor past the rows. false: the file ends within them, or a count is invalid; it was reported.
bool ply_walk(struct asset_file *file, struct arena *arena, struct ply_cursor *cursor,
              struct ply_extent *extent);
// The cursor at the first row of a piece.
struct ply_cursor ply_piece(const struct ply_extent *extent, size_t piece);
// At the beginning of a row: passes over empty lines.
void ply_begin_row(struct ply_cursor *cursor);
// At the end of a row: moves past the end of the line. false: words are left in it.
bool ply_end_row(struct ply_cursor *cursor);
// The next value; in text, *why is why it is bad.
enum ply_status ply_number(struct ply_cursor *cursor, enum ply_type type, double *value,
                           enum number_status *why);
// The number of a list's items. PLY_BAD: it is not a whole number of at least 0.
enum ply_status ply_count(struct ply_cursor *cursor, enum ply_type type, uint32_t *count);
// Passes over `count` values; false: there are fewer.
bool ply_skip(struct ply_cursor *cursor, enum ply_type type, uint64_t count);

#endif
