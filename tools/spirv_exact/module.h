// A SPIR-V module in a file, for the tools of this folder.
//
// Errors: NULL or false, with a line on stderr. Ownership: the words are the caller's, to be freed by `free`.
#ifndef GLINT_TOOLS_MODULE_H
#define GLINT_TOOLS_MODULE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// A sound module of `*words` words.
uint32_t *module_read(const char *path, size_t *words);
// false: it cannot be written.
bool module_write(const char *path, const uint32_t *module, size_t words);

#endif
