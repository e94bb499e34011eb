// Path patterns as in .gitignore: '*' and '?' stay within one folder, '**' crosses folders.
//
// Thread safety: pure.
#ifndef GLINT_FILES_GLOB_H
#define GLINT_FILES_GLOB_H

#include "core/str.h"

// Whether the pattern matches the path or a folder above it. Both are relative to the same folder, with '/'
// between folders. A pattern without '/' (except at its end) may begin at any folder; a leading '/' ties it
// to the first.
bool glob_match(str pattern, str path);

#endif
