// A dictionary for libFuzzer (tests/fuzz/glint.dict), made from the table: the words of both spellings.
//
// Errors: none but memory; ask `out->failed`. Thread safety: pure but for `out`.
#ifndef GLINT_TESTS_GENERATE_DICTIONARY_H
#define GLINT_TESTS_GENERATE_DICTIONARY_H

#include "core/strbuf.h"

void dictionary_write(struct strbuf *out);

#endif
