#include "scene/sky.h"

#include "core/angle.h"
#include "core/float_bits.h"
#include "core/heap.h"
#include "core/parallel.h"
#include "core/srgb.h"
#include "grammar/ir.h"

#include <math.h>
#include <stdlib.h>

enum {
    PIECE_ROWS = 16,
};

struct filling {
    const struct picture *picture; // NULL: one colour
    double *decoded;               // by stored value; NULL: values are linear
    struct sky_size size;
    uint32_t *numbers;
    double *totals; // by row, in light
};

struct sky_size sky_size(const struct scene *scene) {
    const struct scene_background *background = &scene->background;
    const struct picture *picture = background->picture;
    if (!background->lights || (picture && !picture->pixels))
        return (struct sky_size){0, 0, 0};
    if (!picture)
        return (struct sky_size){1, 1, 4};
    return (struct sky_size){picture->width, picture->height + 1, (picture->width + 3) / 4 * 4};
}

// ---- rows

// A place at the polar angle `angle` lies 1 - |y| from the nearer pole; computed this way to keep digits near
// it.
static double gap_of(double angle, bool above) {
    const double half = above ? sin(angle / 2) : cos(angle / 2);
    return 2 * half * half;
}

// The polar angle at which a row of cells begins.
static double angle_of(const struct filling *f, uint32_t row) {
    if (row == 0)
        return 0;
    return row == f->size.rows ? PI : PI * (row - 0.5) / (f->size.rows - 1);
}

// Writes the row's share of the sphere down and returns it.
static double put_place(const struct filling *f, uint32_t row) {
    const double begin = angle_of(f, row), end = angle_of(f, row + 1);
    const bool above = begin + end < PI || f->size.rows == 1;
    const float gap = (float)gap_of(begin, above);
    const float step = (float)(gap_of(end, above) - gap_of(begin, above));
    uint32_t *record = f->numbers + (size_t)SKY_ROW_WORDS * row;
    record[1] = float_bits(gap);
    record[2] = float_bits(step);
    return fabs((double)step) / 2;
}

// ---- cells

static double brightness(const struct filling *f, size_t texel) {
    double sum = 0;
    for (size_t c = 0; c < 3; c++)
        sum += f->decoded ? f->decoded[picture_stored(f->picture, texel, c)]
                          : (double)picture_linear(f->picture, texel, c);
    return sum;
}

// The sum over the four texels around a cell.
static double cell(const struct filling *f, uint32_t row, uint32_t column) {
    if (!f->picture)
        return 1;
    const size_t width = f->picture->width, left = column, right = (left + 1) % width;
    const size_t top = row ? row - 1 : 0, bottom = row < f->picture->height ? row : row - 1;
    return brightness(f, top * width + left) + brightness(f, top * width + right) +
           brightness(f, bottom * width + left) + brightness(f, bottom * width + right);
}

// Where each of `count` values' share of 2^32 begins; values other than 0 get a share above 0. The last one
// gets slightly more than its due.
static void put_shares(const double *values, uint32_t count, double total, uint32_t *begin, size_t apart) {
    const double scale = total > 0 ? (0x1p32 - 1 - count) / total : 0;
    uint32_t sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        begin[i * apart] = sum;
        if (values[i] > 0)
            sum += (uint32_t)fmax(values[i] * scale, 1);
    }
}

struct rows {
    const struct filling *filling;
    double *values; // of a row each
};

static void put_rows(void *context, size_t begin, size_t end) {
    const struct rows *rows = context;
    const struct filling *f = rows->filling;
    const uint32_t width = f->size.width;
    double *values = rows->values + begin / PIECE_ROWS * width;
    for (size_t row = begin; row < end; row++) {
        double total = 0;
        for (uint32_t i = 0; i < width; i++)
            total += values[i] = cell(f, (uint32_t)row, i);
        uint32_t *cells = f->numbers + (size_t)SKY_ROW_WORDS * f->size.rows + row * f->size.stride;
        put_shares(values, width, total, cells, 1);
        f->totals[row] = total * put_place(f, (uint32_t)row);
    }
}

static double *decoding(const struct scene *scene) {
    const struct picture *picture = scene->background.picture;
    const bool is_srgb = scene->ir->image.transfer == IR_TRANSFER_SRGB;
    const size_t greatest = picture_greatest(picture->depth);
    double *decoded = heap_array(greatest + 1, sizeof *decoded);
    for (size_t i = 0; decoded && i <= greatest; i++) {
        const double value = (double)i / (double)greatest;
        decoded[i] = is_srgb ? srgb_decode(value) : value;
    }
    return decoded;
}

bool sky_fill(const struct scene *scene, struct sky_size size, uint32_t *numbers, bool *is_black) {
    struct filling f = {.picture = scene->background.picture, .size = size, .numbers = numbers};
    const size_t pieces = ((size_t)size.rows + PIECE_ROWS - 1) / PIECE_ROWS;
    const bool decodes = f.picture && f.picture->depth != PICTURE_RGBE;
    struct rows rows = {&f, heap_array(heap_times(pieces, size.width), sizeof *rows.values)};
    f.totals = heap_array(size.rows, sizeof *f.totals);
    f.decoded = decodes ? decoding(scene) : NULL;
    const bool made = rows.values && f.totals && (f.decoded || !decodes);
    *is_black = true;
    if (made) {
        double total = 0;
        parallel_for(size.rows, PIECE_ROWS, put_rows, &rows);
        for (uint32_t row = 0; row < size.rows; row++)
            total += f.totals[row];
        put_shares(f.totals, size.rows, total, numbers, SKY_ROW_WORDS);
        *is_black = !(total > 0);
    }
    free(f.decoded);
    free(f.totals);
    free(rows.values);
    return made;
}
