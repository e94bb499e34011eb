// What was probably meant: mended numbers, booleans and names, and the nearest of several words.
// Thread safety: pure except for the arena.
#ifndef GLINT_PARSER_TREE_MEND_H
#define GLINT_PARSER_TREE_MEND_H

#include "core/arena.h"
#include "core/nearest.h"
#include "core/number.h"
#include "diag/diag.h"

// The number that a wrong spelling means, or the empty string.
str mend_number(struct arena *arena, enum number_status status, str text);
// Whether the text is several numbers with spaces or commas between them.
bool mend_is_numbers(str text);
// Exactly `count` such numbers as "1, 2, 3"; the empty string if there are not that many.
str mend_numbers(struct arena *arena, str text, uint32_t count);
// The text without surrounding spaces and typographic quotes.
str mend_quotes(str text);
// "true" or "false" for yes, On, TRUE, 1 ...; the empty string if it is neither.
str mend_boolean(str text);
// The colour, as "#rrggbb", that the text means in other programs: #rgb, 0xrrggbb, rgb(...), "red"; the empty
// string if it is not one. *safe: nothing else can be meant.
str mend_color(struct arena *arena, str text, bool *safe);
// false: not only hexadecimal digits.
bool mend_hex_digits(str digits, uint32_t *value);
// The same of #rrggbb.
bool mend_hex_color(str text, uint32_t *value);
// Characters that are not allowed in a name become '_'; a leading digit gets a '_' before it.
str mend_name(struct arena *arena, str text);
// `replacement` in the same quotes as `written`, the text of the file.
str mend_like(struct arena *arena, str written, str replacement);
// "DiffuseColor", "diffuseColor", "diffuse-color" as diffuse_color.
str mend_snake(struct arena *arena, str text);

// The nearest of several candidates, compared in snake_case; ties are counted. The beginning of a candidate,
// of three letters and more, is near too. The total cost of all searches of one sink is limited; candidates
// that differ in style alone are always found, if they are no longer than 128 bytes.
struct mend_search {
    struct arena *arena;
    str word; // as written
    str snake;
    struct nearest near;
    const char *best; // NULL: none is near enough
    int best_id;
    unsigned distance; // 0: only case or style differ
    unsigned ties;     // other candidates that are as near
};
struct mend_search mend_begin(struct diag_sink *sink, struct arena *arena, str word);
void mend_offer(struct mend_search *search, const char *candidate, int id);
void mend_offer_str(struct mend_search *search, str candidate, int id);
// Whether the best candidate is surely what was meant: only the style differs, or a letter or two does
// and no other candidate is as near.
bool mend_is_safe(const struct mend_search *search);

#endif
