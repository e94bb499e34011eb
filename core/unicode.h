// What glint needs to know about a code point: whether it may be in a name, and how wide it is on screen.
//
// From the Unicode 14 character database; code points that it does not assign are treated as their
// neighbours are, so that letters added later to a script count as letters. Thread safety: pure.
#ifndef GLINT_CORE_UNICODE_H
#define GLINT_CORE_UNICODE_H

#include <stdbool.h>
#include <stdint.h>

// A letter, letter number or combining mark of any script (categories L, Nl, M), except those that are
// invisible: fillers and variation selectors.
bool unicode_is_letter(uint32_t c);
// A decimal digit of any script (category Nd).
bool unicode_is_digit(uint32_t c);
// Columns of a terminal: 0 for combining marks and format characters, 2 for wide and full-width ones
// (UAX 11), else 1.
unsigned unicode_width(uint32_t c);
// A character that a terminal might obey rather than show: C0 and C1 controls, line and paragraph
// separators, and those that change the direction of the text around them.
bool unicode_is_control(uint32_t c);

#endif
