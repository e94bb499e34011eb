// JSON text, written from front to back into a buffer.
//
// Commas, line ends and indentation are added by the writer; below `flat_depth` open brackets a value is on
// one line, so that a list of records has a line for each. Text that is not UTF-8 becomes U+FFFD, so that the
// output is always JSON. Ownership: the buffer is the caller's, its `failed` flag is set when memory runs
// out. Thread safety: one writer belongs to one thread.
#ifndef GLINT_CORE_JSON_WRITE_H
#define GLINT_CORE_JSON_WRITE_H

#include "core/strbuf.h"

enum {
    JSON_WRITE_DEPTH_MAX = 32 // as a `flat_depth`: every value has a line
};

struct json_writer {
    struct strbuf *out;
    unsigned flat_depth; // from this depth on all is on one line
    unsigned depth;
    bool filled[JSON_WRITE_DEPTH_MAX]; // the list or object already has an item
};

void json_writer_init(struct json_writer *writer, struct strbuf *out, unsigned flat_depth);
// Begins and ends a report: an object that names itself ("glint pick") and the version of its format.
// docs/reports.md says what a version promises.
void json_report_begin(struct json_writer *writer, struct strbuf *out, unsigned flat_depth, const char *name,
                       unsigned version);
void json_report_end(struct json_writer *writer);
// `key` NULL: an item of a list, or the root.
void json_open_object(struct json_writer *writer, const char *key);
void json_close_object(struct json_writer *writer);
void json_open_list(struct json_writer *writer, const char *key);
void json_close_list(struct json_writer *writer);
void json_write_text(struct json_writer *writer, const char *key, str value);
// A value that is JSON already.
void json_write_literal(struct json_writer *writer, const char *key, str value);
void json_write_integer(struct json_writer *writer, const char *key, uint64_t value);
// null if it is infinite or not a number; else the fewest digits that read back to the same double.
void json_write_real(struct json_writer *writer, const char *key, double value);
void json_write_boolean(struct json_writer *writer, const char *key, bool value);
void json_write_null(struct json_writer *writer, const char *key);
// A line end after the whole.
void json_end(struct json_writer *writer);

#endif
