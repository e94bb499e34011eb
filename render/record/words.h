// A command as one line of words, quoted as a shell of POSIX reads them, and read back. Private to
// render/record.
//
// Words of plain characters are bare, others in single quotes; one with control characters or without valid
// UTF-8 is $'...' with \xNN, as bash, zsh and ksh read it. Thread safety: pure.
#ifndef GLINT_RENDER_RECORD_WORDS_H
#define GLINT_RENDER_RECORD_WORDS_H

#include "core/arena.h"
#include "core/str.h"
#include "core/strbuf.h"

// Appends a word, after a space unless it is the first.
void words_add(struct strbuf *line, str word);
// Takes the next word off `line`. false: there is none, or it is not quoted as words_add quotes.
bool words_take(str *line, struct arena *arena, str *word);

#endif
