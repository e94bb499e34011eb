// Where a decoder puts its rows: each in its own place, or all in the same one. Private to picture/read.
//
// Rows are as struct picture keeps them. With a stride of 0 there is one row, which each row overwrites: when
// a row begins, it still has the contents of another row, or zeros at first.
// Ownership: the memory is the caller's. Thread safety: as the caller's.
#ifndef GLINT_PICTURE_READ_PICTURE_ROWS_H
#define GLINT_PICTURE_READ_PICTURE_ROWS_H

#include <stddef.h>
#include <stdint.h>

struct picture_rows {
    unsigned char *first;
    size_t stride; // from row to row, in bytes; 0: they are not kept
};

static inline unsigned char *picture_row(const struct picture_rows *rows, uint32_t y) {
    return rows->first + y * rows->stride;
}

#endif
