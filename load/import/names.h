// Names of a glTF file as names of the language: letters, digits, '_' and '-', each once.
//
// Thread safety: one thread.
#ifndef GLINT_LOAD_IMPORT_NAMES_H
#define GLINT_LOAD_IMPORT_NAMES_H

#include "core/str_map.h"

// A name that the map does not have yet: the given one, mended, else `kind`; with a number where it is taken.
str import_name(struct str_map *taken, str own, const char *kind);

#endif
