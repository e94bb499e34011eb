// The words of diagnostics about values: a thing's name, what it must be, how it is written.
//
// The words are the same for both spellings; only examples differ. All text is in `arena`.
// Thread safety: pure except for the arena.
#ifndef GLINT_PARSER_BIND_SAY_H
#define GLINT_PARSER_BIND_SAY_H

#include "grammar/concept.h"
#include "parser/bind/bind.h"

// "sphere 'ball'", "this sphere", "the image", "the scene".
str say_owner(struct arena *arena, const struct bind_frame *frame);
// "'radius' of this sphere", "'image.width'"; the element itself if the subject has no row.
str say_subject(struct arena *arena, struct bind_subject subject);
// "a sphere", "the scene", "'diffuse_color'": a kind of element, for messages about what it may hold.
str say_kind(struct arena *arena, const struct bind_frame *frame);
str say_article(struct arena *arena, const char *word);
// Text from a file, prepared for a message: clipped, without control characters.
str say_text(struct arena *arena, str text);
// "one number", "three numbers x, y, z": what a value of this row must be.
str say_expected(struct arena *arena, const struct schema_row *row);
// The same for one value, which may be a component of the row, or one of a fixed number.
str say_expected_of(struct arena *arena, struct bind_subject subject);
// "'clip' or 'normalize'".
str say_words(struct arena *arena, const char *const *words);
// How the row is written, with the table's example: "radius: 1", `<Center x="0" y="1" z="-5"/>`.
str say_example(struct arena *arena, const struct schema_row *row, bool is_xml);
// The same for a value, which may be in short form: then for the row that holds the element.
str say_subject_example(struct arena *arena, struct bind_subject subject, bool is_xml);
// What glint has instead of a feature of other tools, with an example.
str say_concept(struct arena *arena, const struct concept *concept, bool is_xml);
// The XML element of a vector, colour or weights with these numbers ("1, 2, 3").
str say_components(struct arena *arena, struct bind_subject subject, str numbers);
// " degrees", " pixels" or "".
const char *say_unit(const struct schema_row *row);
// A sentence of the table as a clause: first letter small, no full stop.
str say_doc(struct arena *arena, const char *doc);

#endif
