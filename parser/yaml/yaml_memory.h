// libyaml allocates by itself; if it gets no memory, that is reported as everywhere else (core/heap.h), not
// as a mistake in the text.
//
// Ownership: the parser is the caller's, to be deleted by yaml_parser_delete. Errors: as heap.h; false if
// that has no handler. Thread safety: one call belongs to one thread.
#ifndef GLINT_PARSER_YAML_YAML_MEMORY_H
#define GLINT_PARSER_YAML_YAML_MEMORY_H

#include <stdbool.h>
#include <yaml.h>

// A new parser. false: there is not enough memory.
bool yaml_memory_begin(yaml_parser_t *parser);
// Passes on what a libyaml call returned; if it failed, finds out why.
bool yaml_memory_check(const yaml_parser_t *parser, int good);

#endif
