// A picture that is being rendered, as a file of bands: what is finished lies there, and another process can
// go on.
//
// The file begins with lines of text, as a part does (part_file.h), but `glint checkpoint 1`, and then
//
//     bands 128                 rows of each, but the last, which may have fewer
//     seal 3f0c...              XXH64 of the lines before
//
// filled up with line ends to BANDS_HEAD_BYTES. Bands follow at places that do not depend on each other: rows
// of three floats a pixel in this machine's format, what was wrong in them, and an XXH64 of both. A band with
// a wrong seal counts as missing. So however the process ends, each band is there or missing; and two
// processes that render the same picture by mistake write the same bytes to the same places.
//
// Errors: false, with a sentence about it that begins with a verb; empty: there is no memory. Ownership:
// bands_finish closes and frees; the file stays until bands_remove. Thread safety: one thread.
#ifndef GLINT_RENDER_PARTS_BANDS_H
#define GLINT_RENDER_PARTS_BANDS_H

#include "files/spool.h"
#include "render/parts/part_file.h"

#define BANDS_ENDING ".checkpoint"

enum {
    BANDS_HEAD_BYTES = 8192,
    BANDS_FAULTS = 2,
    BANDS_FAULT_WORDS = 7,
};

// What was wrong in a band, as its maker encodes it; zeros: nothing.
struct bands_faults {
    uint32_t words[BANDS_FAULTS][BANDS_FAULT_WORDS];
};

struct bands {
    struct part part;     // the picture; its region is all that the file will hold
    uint32_t rows, count; // rows of each band but the last; number of bands
    bool *done;           // by band
    uint32_t done_count;
    bool is_judged; // each band was looked at
    struct spool spool;
    struct bands_faults *faults; // by band
};

// A new file, with no band. `rows` is more than 0.
bool bands_create(struct bands *bands, const char *path, const struct part *part, uint32_t rows,
                  struct strbuf *error);
// Opens an existing file and reads each of its bands to see whether it is whole. Calls `goes_on`, unless
// NULL, between them; if that returns false, the rest stays unjudged. *missing: there is no such file, which
// is not an error.
bool bands_open(struct bands *bands, const char *path, bool (*goes_on)(void *context), void *context,
                bool *missing, struct strbuf *error);
// How the file's picture differs from `part`, as words before "this one"; NULL: it does not.
const char *bands_difference(const struct bands *bands, const struct part *part);
// Rows of a band, counted from the first one of the region.
uint32_t bands_begin(const struct bands *bands, uint32_t band);
uint32_t bands_rows(const struct bands *bands, uint32_t band);
// Writes a band. false: bands->spool.error says why.
bool bands_put(struct bands *bands, uint32_t band, const float *rgb, const struct bands_faults *faults);
// Reads rows of the region; those that are not there are black. false: as above.
bool bands_take(struct bands *bands, uint32_t y, uint32_t count, float *rgb);
void bands_finish(struct bands *bands);
void bands_remove(struct bands *bands);

#endif
