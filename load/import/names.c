#include "load/import/names.h"

enum {
    LENGTH_MOST = 100
};

static bool is_plain(unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

static str mended(struct arena *arena, str own, const char *kind) {
    if (own.len == 0)
        return str_from(kind);
    if (own.len <= LENGTH_MOST && str_is_name(own))
        return own;
    const str cut = str_slice(own, 0, LENGTH_MOST);
    const bool is_digit = cut.ptr[0] >= '0' && cut.ptr[0] <= '9';
    const str name = arena_format(arena, "%s%.*s", is_digit || cut.ptr[0] == '-' ? "_" : "", STR_ARG(cut));
    for (size_t i = 0; i < name.len; i++)
        if (!is_plain((unsigned char)name.ptr[i]))
            ((char *)name.ptr)[i] = '_';
    return str_is_name(name) ? name : str_from(kind);
}

str import_name(struct str_map *taken, str own, const char *kind) {
    struct arena *arena = taken->arena;
    const str wanted = mended(arena, own, kind);
    // The value of a name is how often it was asked for, so a thousand nodes of one name do not take a
    // million tries.
    uint32_t number = (*str_map_at(taken, wanted))++;
    for (str name = wanted;; number++) {
        if (number > 0)
            name = arena_format(arena, "%.*s_%u", STR_ARG(wanted), number + 1);
        if (number == 0 || (*str_map_at(taken, name))++ == 0)
            return name;
    }
}
