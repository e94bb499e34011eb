// Tells what a file is that was named as a scene but is not one: by its first bytes, else by its ending.
//
// Input: its path and its text. Output: what it is and what to do with it, in words that live as long as the
// arena; false where it may be a scene. Thread safety: that of the arena.
#ifndef GLINT_LOAD_WHAT_FILE_H
#define GLINT_LOAD_WHAT_FILE_H

#include "core/arena.h"
#include "core/str.h"

struct what_file {
    str what;   // "a ZIP archive"
    str advice; // what to do
};

bool what_file(str path, str text, struct arena *arena, struct what_file *out);

#endif
