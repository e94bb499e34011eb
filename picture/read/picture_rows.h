// Where a decoder puts the rows that it makes: each in its place, or all in one. Private to picture/read.
//
// Rows are as struct picture keeps them. With a stride of 0 there is one row, which each row overwrites: what
// is in it when a row begins is then that of another row, and zeros at first.
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
