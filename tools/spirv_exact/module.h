// A SPIR-V module in a file, for the tools of this folder.
//
// Errors: NULL, with a line on stderr. Ownership: the words are the caller's, to be freed by `free`.
#ifndef GLINT_TOOLS_MODULE_H
#define GLINT_TOOLS_MODULE_H

#include <stddef.h>
#include <stdint.h>

// A sound module of `*words` words.
uint32_t *module_read(const char *path, size_t *words);

#endif
