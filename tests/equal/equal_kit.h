// Scenes loaded from text in memory or from files, for the tests of this folder.
#ifndef GLINT_TESTS_EQUAL_KIT_H
#define GLINT_TESTS_EQUAL_KIT_H

#include "core/strbuf.h"
#include "files/files.h"
#include "grammar/print/ir_print.h"
#include "grammar/schema.h"
#include "parser/parser.h"

struct loaded {
    struct arena arena; // paths and sources
    struct arena scene_arena;
    struct source_set sources;
    struct files files;
    struct diag_sink sink;
    struct limits limits;
    uint32_t main_source;
    bool is_there;
    struct parser_output output;
};

// One file alone, without includes; `path` decides nothing but the ending.
void load_text(struct loaded *loaded, const char *path, str text);
// A file and all that it includes.
// All stages, without any file beside it.
void load_whole_text(struct loaded *loaded, const char *path, str text);
void load_path(struct loaded *loaded, const char *path);
void loaded_finish(struct loaded *loaded);

// Fails the test with all diagnostics where there is an error.
void assert_no_errors(struct loaded *loaded, const char *what);
// The main file alone, written; the caller finishes `out`.
void write_loaded(const struct loaded *loaded, bool xml, struct strbuf *out);
// Which rows some scene wrote, by the element's place in schema_elements.
enum {
    ELEMENTS_MAX = 64
};
// Adds what `element`, of the table's element `schema`, and all below it wrote.
void note_written(const struct schema_element *schema, const void *element, uint64_t used[ELEMENTS_MAX]);
// Fails with the rows that nobody wrote.
void assert_all_written(const uint64_t used[ELEMENTS_MAX], const char *complaint);
// Fails with both texts around the first line that differs.
void assert_same_text(const char *what, const struct strbuf *a, const struct strbuf *b);

#endif
