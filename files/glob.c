#include "files/glob.h"

#include <string.h>

enum {
    PATTERN_MAX = 1024 // bytes; a longer pattern matches nothing
};

// All places in the pattern that the part of the path read so far may have reached. So the time is at most
// the product of both lengths, whatever the pattern.
struct places {
    str pattern;
    bool here[PATTERN_MAX + 1];
};

static bool at_double(str pattern, size_t i) {
    return i + 1 < pattern.len && pattern.ptr[i] == '*' && pattern.ptr[i + 1] == '*';
}

// Stars may match nothing; "**/" matches no folder at the start of a name.
static void skip_stars(struct places *p, bool name_begins) {
    for (size_t i = 0; i < p->pattern.len; i++) {
        if (!p->here[i] || p->pattern.ptr[i] != '*')
            continue;
        bool twice = at_double(p->pattern, i);
        bool folders = twice && i + 2 < p->pattern.len && p->pattern.ptr[i + 2] == '/';
        if (!folders)
            p->here[i + (twice ? 2 : 1)] = true;
        else if (name_begins)
            p->here[i + 3] = true;
    }
}

static void take(struct places *p, char c) {
    bool next[PATTERN_MAX + 1] = {false};
    for (size_t i = 0; i < p->pattern.len; i++) {
        if (!p->here[i])
            continue;
        char wanted = p->pattern.ptr[i];
        if (wanted == '*')
            next[i] = next[i] || at_double(p->pattern, i) || c != '/';
        else if (wanted == c || (wanted == '?' && c != '/'))
            next[i + 1] = true;
    }
    memcpy(p->here, next, p->pattern.len + 1);
}

bool glob_match(str pattern, str path) {
    while (pattern.len && pattern.ptr[pattern.len - 1] == '/')
        pattern.len--;
    bool tied = pattern.len && memchr(pattern.ptr, '/', pattern.len);
    if (pattern.len && pattern.ptr[0] == '/')
        pattern = str_slice(pattern, 1, pattern.len);
    if (pattern.len == 0 || pattern.len > PATTERN_MAX)
        return false;
    struct places p = {.pattern = pattern};
    for (size_t at = 0; at <= path.len; at++) {
        bool name_begins = at == 0 || path.ptr[at - 1] == '/';
        p.here[0] = p.here[0] || (name_begins && (at == 0 || !tied));
        skip_stars(&p, name_begins);
        bool name_ends = at == path.len || path.ptr[at] == '/';
        if (at > 0 && name_ends && p.here[pattern.len])
            return true;
        if (at < path.len)
            take(&p, path.ptr[at]);
    }
    return false;
}
