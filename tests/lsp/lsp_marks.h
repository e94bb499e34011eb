// Requests about places of a text, which a mark of it shows: '|' is before the character. In the text the
// mark is once, without its '|'.
#ifndef GLINT_TESTS_LSP_MARKS_H
#define GLINT_TESTS_LSP_MARKS_H

#include "lsp_kit.h"

// The parameters of a request.
json_t *at_mark(struct lsp_client *client, const char *name, const char *text, const char *mark);
// "3:11-12 3:27-28": lines from 0, characters in units of UTF-16.
void write_ranges(const json_t *list, char *out, size_t size);

void expect_hover(struct lsp_client *client, const char *name, const char *text, const char *mark,
                  const char *wanted);
json_t *rename_at(struct lsp_client *client, const char *name, const char *text, const char *mark,
                  const char *to, json_t **error);
void expect_refusal(struct lsp_client *client, const char *name, const char *text, const char *mark,
                    const char *to, const char *why);
// What a rename changes in the file, and that it changes no other.
void expect_rename(struct lsp_client *client, const char *name, const char *text, const char *mark,
                   const char *wanted);
// The ranges that a request gives for a place.
void expect_places(struct lsp_client *client, const char *method, const char *name, const char *text,
                   const char *mark, const char *wanted);

#endif
