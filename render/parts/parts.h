// Parts that make one picture, and that picture: the same bytes as if it had been rendered whole.
//
// Errors: false, with a sentence about it and which parts it is about. Thread safety: plain data.
#ifndef GLINT_RENDER_PARTS_PARTS_H
#define GLINT_RENDER_PARTS_PARTS_H

#include "render/parts/part_file.h"

#define PARTS_NONE UINT32_MAX

// What is wrong with a set of parts.
struct parts_fault {
    struct strbuf text;
    uint32_t part, other; // numbers of the parts; PARTS_NONE: none
};

// Whether the parts are of one picture, and cover all its pixels and samples once. Their heads are enough.
// `order` gets their numbers in the order in which they must be added. false: fault->text says why; where
// that is empty, there is no memory.
bool parts_fit(const struct part *parts, uint32_t count, uint32_t *order, struct parts_fault *fault);
// How two parts differ that should be of one picture, as words that stand between their names ("is of another
// scene than"); NULL: they do not.
const char *parts_difference(const struct part *a, const struct part *b);
// Adds a part with its floats to the image of the whole picture, which begins black.
void parts_add(const struct part *part, struct image *image);

// Part `number`, from 1, of `count`: rows of tiles, 8 pixels high, shared out as evenly as possible. false:
// there are fewer rows of tiles than parts.
bool parts_cut(uint32_t width, uint32_t height, uint32_t number, uint32_t count, struct part_region *region);
// The most parts that a picture of this height can have.
uint32_t parts_most(uint32_t height);

#endif
