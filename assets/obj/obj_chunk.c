#include "assets/obj/obj_chunk.h"

#include "assets/obj/obj_lex.h"

#include <math.h>
#include <string.h>

enum {
    WITH_COLOR = 6,    // numbers of a vertex
    DIGITS_MOST = 15,  // digits of a number read here: an integer below 2^53 over a power of ten
    INTEGER_MOST = 10, // digits of an index
};

static const double powers_of_ten[DIGITS_MOST + 1] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                      1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};

static inline bool ends_word(const char *p, const char *end) {
    return p == end || char_is_space(*p);
}

// Whether every \r comes before a \n, and no backslash before either.
static bool has_plain_lines(const char *begin, const char *end) {
    for (const char *p = begin; (p = memchr(p, '\r', (size_t)(end - p))); p++)
        if (p + 1 == end || p[1] != '\n')
            return false;
    for (const char *p = begin; (p = memchr(p, '\\', (size_t)(end - p))); p++)
        if (p + 1 < end && (p[1] == '\n' || p[1] == '\r'))
            return false;
    return true;
}

// ---- lines

enum line_kind {
    LINE_NOTHING, // empty, a comment, or without effect
    LINE_VERTEX,
    LINE_NORMAL,
    LINE_FACE,
    LINE_OTHER,
};

// The kind of the line whose first word begins at `p`.
static inline enum line_kind kind_of(const char *p, const char *end) {
    if (p == end || *p == '\n' || *p == '\r' || *p == '#')
        return LINE_NOTHING;
    if (ends_word(p + 1, end)) {
        switch (*p) {
        case 'v':
            return LINE_VERTEX;
        case 'f':
            return LINE_FACE;
        case 'g':
        case 'o':
        case 's':
            return LINE_NOTHING;
        default:
            return LINE_OTHER;
        }
    }
    if (*p != 'v' || !ends_word(p + 2, end))
        return LINE_OTHER;
    return p[1] == 'n' ? LINE_NORMAL : p[1] == 't' ? LINE_NOTHING : LINE_OTHER;
}

static inline const char *skip_spaces(const char *p, const char *end) {
    while (p < end && char_is_blank(*p))
        p++;
    return p;
}

// The place after the line end, or `end`.
static const char *next_line(const char *p, const char *end, uint32_t *lines) {
    const char *found = memchr(p, '\n', (size_t)(end - p));
    if (!found)
        return end;
    ++*lines;
    return found + 1;
}

// Counts the words up to the line's end or comment; `p` is at the end of a word.
static const char *count_words(const char *p, const char *end, uint32_t *words) {
    bool in_word = true;
    for (; p < end && *p != '\n' && *p != '\r'; p++) {
        const bool is_word = !char_is_blank(*p);
        if (is_word && !in_word) {
            if (*p == '#')
                break;
            ++*words;
        }
        in_word = is_word;
    }
    return p;
}

void obj_chunk_count(struct obj_chunk *chunk) {
    const char *end = chunk->end;
    struct obj_counts counts = {0};
    chunk->is_ordinary = has_plain_lines(chunk->begin, end);
    for (const char *p = chunk->begin; chunk->is_ordinary && p < end;) {
        p = skip_spaces(p, end);
        switch (kind_of(p, end)) {
        case LINE_NOTHING:
            break;
        case LINE_VERTEX:
            counts.vertices++;
            break;
        case LINE_NORMAL:
            counts.normals++;
            break;
        case LINE_FACE:
            counts.faces++;
            p = count_words(p + 1, end, &counts.corners);
            break;
        case LINE_OTHER:
            counts.others++;
            break;
        }
        p = next_line(p, end, &counts.lines);
    }
    chunk->here = counts;
}

// ---- words

struct quick {
    const char *at, *end;
    struct obj_chunk *chunk;
    struct polygons *obj;
    struct obj_counts done; // of this chunk
};

// Moves to the next word of the line; false if there is none.
static inline bool more(struct quick *q) {
    q->at = skip_spaces(q->at, q->end);
    return q->at < q->end && *q->at != '\n' && *q->at != '\r' && *q->at != '#';
}

// Adds the digits at `p` to a number; returns their end.
static inline const char *take_digits(const char *p, const char *end, uint64_t *number) {
    uint64_t value = *number;
    for (; p < end; p++) {
        const unsigned digit = (unsigned char)*p - (unsigned)'0';
        if (digit > 9)
            break;
        value = value * 10 + digit;
    }
    *number = value;
    return p;
}

// As obj_lex_number reads it. Most numbers are short: an integer over a power of ten, both doubles, so that
// one division rounds once (Clinger 1990, section 3).
static bool take_number(struct quick *q, double *value) {
    const char *p = q->at;
    const bool negative = p < q->end && *p == '-';
    uint64_t digits = 0;
    const char *first = p + (negative || (p < q->end && *p == '+'));
    p = take_digits(first, q->end, &digits);
    ptrdiff_t count = p - first;
    ptrdiff_t decimals = 0;
    if (p < q->end && *p == '.') {
        const char *fraction = p + 1;
        p = take_digits(fraction, q->end, &digits);
        decimals = p - fraction;
        count += decimals;
    }
    if (count > 0 && count <= DIGITS_MOST && ends_word(p, q->end)) {
        const double size = (double)(int64_t)digits / powers_of_ten[decimals];
        *value = negative && digits ? -size : size;
        q->at = p;
        return true;
    }
    struct obj_lex lex = {.begin = q->at, .end = q->end, .at = q->at, .line = 1};
    const enum number_status status = obj_lex_number(&lex, value);
    q->at = lex.at;
    return status == NUMBER_OK && fabs(*value) <= MESH_COORDINATE_MAX;
}

static inline bool take_integer(struct quick *q, int64_t *value) {
    const char *p = q->at;
    const bool negative = p < q->end && *p == '-';
    const char *first = p + (negative || (p < q->end && *p == '+'));
    uint64_t n = 0;
    p = take_digits(first, q->end, &n);
    if (p == first || p - first > INTEGER_MOST)
        return false;
    *value = negative ? -(int64_t)n : (int64_t)n;
    q->at = p;
    return true;
}

// ---- elements

static bool take_point(struct quick *q, vec3 *point, int *numbers) {
    double value[3] = {0};
    int count = 0;
    for (; more(q); count++) {
        double v;
        if (!take_number(q, &v))
            return false;
        if (count < 3)
            value[count] = v;
    }
    *point = (vec3){value[0], value[1], value[2]};
    *numbers = count;
    return count >= 3;
}

static bool take_vertex(struct quick *q) {
    const uint32_t number = q->chunk->before.vertices + q->done.vertices++;
    int numbers;
    q->at++;
    if (!take_point(q, &q->obj->vertices.items[number], &numbers))
        return false;
    if (numbers >= WITH_COLOR && q->chunk->colors.count++ == 0)
        q->chunk->colors.line = q->chunk->before.lines + q->done.lines + 1;
    return true;
}

static bool take_normal(struct quick *q) {
    const uint32_t number = q->chunk->before.normals + q->done.normals++;
    int numbers;
    q->at += 2;
    return take_point(q, &q->obj->normals.items[number], &numbers);
}

// An index at the cursor, converted to start from 0; `count` things are defined so far.
static bool take_index(struct quick *q, uint32_t count, uint32_t *out) {
    int64_t index;
    if (!take_integer(q, &index))
        return false;
    const int64_t absolute = index < 0 ? (int64_t)count + index : index - 1;
    if (absolute < 0 || absolute >= (int64_t)IR_NO_INDEX)
        return false;
    *out = (uint32_t)absolute;
    q->chunk->refers_forward |= absolute >= (int64_t)count;
    return true;
}

static bool take_slash(struct quick *q) {
    if (q->at == q->end || *q->at != '/')
        return false;
    q->at++;
    return true;
}

static bool take_corner(struct quick *q, struct polygon_corner *corner) {
    const struct obj_counts *before = &q->chunk->before;
    corner->normal = IR_NO_INDEX;
    if (!take_index(q, before->vertices + q->done.vertices, &corner->vertex))
        return false;
    if (take_slash(q)) {
        int64_t texture;
        const bool textured = take_integer(q, &texture);
        if (take_slash(q)) {
            if (!ends_word(q->at, q->end) &&
                !take_index(q, before->normals + q->done.normals, &corner->normal))
                return false;
        } else if (!textured && !ends_word(q->at, q->end)) {
            return false;
        }
    }
    return ends_word(q->at, q->end);
}

static bool take_face(struct quick *q, uint64_t corners_most) {
    struct obj_chunk *chunk = q->chunk;
    const uint32_t first = q->done.corners;
    const uint32_t number = chunk->before.faces + q->done.faces++;
    struct polygon_corner *corners = q->obj->corners.items + chunk->before.corners;
    q->at++;
    while (more(q))
        if (q->done.corners == chunk->here.corners || !take_corner(q, &corners[q->done.corners++]))
            return false;
    const uint32_t count = q->done.corners - first;
    if (count < 3 || count > corners_most)
        return false;
    chunk->triangles += count - 2;
    q->obj->faces.items[number] = (struct polygon_face){.first = chunk->before.corners + first,
                                                        .line = chunk->before.lines + q->done.lines + 1};
    return true;
}

static void note_other(struct quick *q, struct obj_other *others) {
    const struct obj_counts *before = &q->chunk->before;
    others[before->others + q->done.others++] =
        (struct obj_other){q->at, before->lines + q->done.lines + 1, before->faces + q->done.faces};
}

void obj_chunk_read(struct obj_chunk *chunk, uint64_t corners_most, struct polygons *obj,
                    struct obj_other *others) {
    struct quick q = {.at = chunk->begin, .end = chunk->end, .chunk = chunk, .obj = obj};
    while (chunk->is_ordinary && q.at < q.end) {
        q.at = skip_spaces(q.at, q.end);
        switch (kind_of(q.at, q.end)) {
        case LINE_NOTHING:
            break;
        case LINE_VERTEX:
            chunk->is_ordinary = take_vertex(&q);
            break;
        case LINE_NORMAL:
            chunk->is_ordinary = take_normal(&q);
            break;
        case LINE_FACE:
            chunk->is_ordinary = take_face(&q, corners_most);
            break;
        case LINE_OTHER:
            note_other(&q, others);
            break;
        }
        q.at = next_line(q.at, q.end, &q.done.lines);
    }
}
