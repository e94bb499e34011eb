#include "grammar/mesh_format.h"

#define ITEMS(...) __VA_ARGS__
#define LIST(items)                                                                                          \
    (const char *const[]) {                                                                                  \
        ITEMS items NULL                                                                                     \
    }

const struct mesh_format mesh_formats[MESH_FORMAT_COUNT] = {
#define MESH_FORMAT(id, readers, name, called, endings, magic, traits)                                       \
    [MESH_FORMAT_##id] = {name, called, LIST(endings), LIST(magic), traits},
#include "grammar/mesh_formats.def"
#undef MESH_FORMAT
};

const char *const mesh_format_endings[] = {
#define MESH_FORMAT(id, readers, name, called, endings, magic, traits) ITEMS endings
#include "grammar/mesh_formats.def"
#undef MESH_FORMAT
    NULL};

enum mesh_format_id mesh_format_of_path(str path) {
    for (enum mesh_format_id id = 0; id < MESH_FORMAT_COUNT; id++)
        for (const char *const *ending = mesh_formats[id].endings; *ending; ending++)
            if (str_ends_with_nocase(path, *ending))
                return id;
    return MESH_FORMAT_COUNT;
}

enum mesh_format_id mesh_format_of_text(str text) {
    for (enum mesh_format_id id = 0; id < MESH_FORMAT_COUNT; id++)
        for (const char *const *magic = mesh_formats[id].magic; *magic; magic++)
            if (str_starts_with(text, str_from(*magic)))
                return id;
    return MESH_FORMAT_COUNT;
}

str mesh_format_words(struct arena *arena) {
    str words = STR("");
    for (enum mesh_format_id id = 0; id < MESH_FORMAT_COUNT; id++) {
        const struct mesh_format *format = &mesh_formats[id];
        const char *joint = id == 0 ? "" : id + 1 < MESH_FORMAT_COUNT ? ", " : " or ";
        words = arena_format(arena, "%.*s%s%s (", STR_ARG(words), joint, format->name);
        for (const char *const *ending = format->endings; *ending; ending++)
            words = arena_format(arena, "%.*s%s%s", STR_ARG(words), ending == format->endings ? "" : ", ",
                                 *ending);
        words = arena_format(arena, "%.*s)", STR_ARG(words));
    }
    return words;
}
