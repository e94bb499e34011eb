// libyaml allocates by itself; where it got no memory, that is said as everywhere else (core/heap.h), and not
// as a mistake of the text.
//
// Ownership: the parser is the caller's, to be deleted by yaml_parser_delete. Errors: as heap.h; where that
// has no handler, false. Thread safety: one call belongs to one thread.
#ifndef GLINT_PARSER_YAML_YAML_MEMORY_H
#define GLINT_PARSER_YAML_YAML_MEMORY_H

#include <stdbool.h>
#include <yaml.h>

// A new parser. false: there is not enough memory.
bool yaml_memory_begin(yaml_parser_t *parser);
// What a call of libyaml returned; asks why if it failed.
bool yaml_memory_check(const yaml_parser_t *parser, int good);

#endif
