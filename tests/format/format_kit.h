// Texts through the formatter, for the tests of this folder.
#ifndef GLINT_TESTS_FORMAT_KIT_H
#define GLINT_TESTS_FORMAT_KIT_H

#include "parser/format/format.h"

// A text as the reader gives it.
struct reading {
    struct arena arena;
    struct source_set sources;
    struct diag_sink sink;
    struct limits limits;
    struct reader_context context;
};

void reading_init(struct reading *r);
// false: it cannot be read.
bool reading_run(struct reading *r, const char *path, str text, struct tree *tree);
void reading_finish(struct reading *r);

// Formats `text` as a file of that name; `out` begins empty.
enum format_status format_text(const char *path, str text, const struct upgrade_table *upgrade,
                               struct strbuf *out);

// Fails unless the text can be formatted, keeps its IR and every character but white space, keeps each
// comment at its entry, and is left as it is by formatting it again. `out`: the formatted text.
void assert_formats(const char *path, str text, struct strbuf *out);

// The text of a valid scene, laid out at random, with comments at random places.
void add_noise(uint64_t seed, bool xml, str text, struct strbuf *out);

#endif
