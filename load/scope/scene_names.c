#include "load/scope/scene_names.h"

#include "core/strbuf.h"
#include "files/stream.h"
#include "grammar/schema.h"

#include <string.h>

enum {
    HEAD_BYTES = 8192,           // of a file, to see how it begins,
    HEAD_MOST = 2 * 1024 * 1024, // and of one that begins with a long comment
    WORDS_BYTES = 1024,          // <Scene and its attributes, to glint=
    SHOWN = 3,
};

const char *const scene_name_endings[] = {".glint.yaml", ".glint.yml", ".glint.xml", NULL};

static bool ends_with_one(str path, const char *const *endings) {
    for (; *endings; endings++) {
        const str ending = str_from(*endings);
        if (path.len > ending.len && str_equal(str_slice(path, path.len - ending.len, path.len), ending))
            return true;
    }
    return false;
}

bool scene_name_fits(str path) {
    return ends_with_one(path, scene_name_endings);
}

// ---- how a scene begins

static bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static str skip_space(str text) {
    size_t at = 0;
    while (at < text.len && is_space(text.ptr[at]))
        at++;
    return str_slice(text, at, text.len);
}

// What follows the first `end` in the text; empty if it is not there.
static str skip_past(str text, const char *end) {
    const size_t length = strlen(end);
    for (size_t at = 0; at + length <= text.len; at++)
        if (memcmp(text.ptr + at, end, length) == 0)
            return str_slice(text, at + length, text.len);
    return STR("");
}

static bool take(str *text, const char *word) {
    if (!str_starts_with(*text, str_from(word)))
        return false;
    *text = str_slice(*text, strlen(word), text->len);
    return true;
}

static str skip_before_xml(str text) {
    while (str_starts_with(text, STR("<?")) || str_starts_with(text, STR("<!")))
        text = skip_space(str_starts_with(text, STR("<!--")) ? skip_past(text, "-->")
                          : str_starts_with(text, STR("<?")) ? skip_past(text, "?>")
                                                             : skip_past(text, ">"));
    return text;
}

static str skip_before_yaml(str text) {
    for (;;) {
        text = skip_space(text);
        if (str_starts_with(text, STR("#")) || str_starts_with(text, STR("%")))
            text = skip_past(text, "\n");
        else if (!take(&text, "---"))
            return text;
    }
}

static bool begins_as_xml(str text) {
    if (!take(&text, "<Scene") || !text.len || !is_space(text.ptr[0]))
        return false;
    for (size_t at = 0; at < text.len && text.ptr[at] != '>'; at++) {
        str rest = str_slice(text, at + 1, text.len);
        if (is_space(text.ptr[at]) && take(&rest, "glint") && skip_space(rest).len &&
            skip_space(rest).ptr[0] == '=')
            return true;
    }
    return false;
}

static bool begins_as_yaml(str text) {
    take(&text, "{"); // JSON
    text = skip_space(text);
    const bool is_key = take(&text, "glint") || take(&text, "\"glint\"") || take(&text, "'glint'");
    text = skip_space(text);
    return is_key && text.len && text.ptr[0] == ':';
}

// What follows the comments, and whatever else may be before the first word.
static str skip_before(str text) {
    text = skip_space(str_slice(text, str_skip_mark(text), text.len));
    return str_starts_with(text, STR("<")) ? skip_before_xml(text) : skip_before_yaml(text);
}

// Whether a text begins as a scene does: with 'glint:', or with <Scene glint=.
static bool scene_text_fits(str text) {
    text = skip_before(text);
    return str_starts_with(text, STR("<")) ? begins_as_xml(text) : begins_as_yaml(text);
}

// ---- in folders

static bool file_begins_as_scene(const char *path) {
    struct strbuf head;
    strbuf_init(&head);
    size_t most = HEAD_BYTES;
    int error = stream_read_file(path, most, &head);
    // The first word is near the end of what was read, or after it.
    while (!error && head.len == most && most < HEAD_MOST &&
           skip_before(strbuf_view(&head)).len < WORDS_BYTES) {
        most *= 16;
        strbuf_clear(&head);
        error = stream_read_file(path, most, &head);
    }
    const bool fits = error == 0 && scene_text_fits(strbuf_view(&head));
    strbuf_finish(&head);
    return fits;
}

enum file_status scene_names_find(struct scene_names *names, struct arena *arena, str folder) {
    struct files_found found = {.arena = arena, .endings = schema_file_endings(SCHEMA_FILE_SCENE)};
    const enum file_status status = files_walk(&found, folder);
    names->unreadable = found.unreadable;
    for (uint32_t i = 0; i < found.paths.count && status == FILE_OK; i++) {
        const str path = found.paths.items[i];
        if (scene_name_fits(path))
            *ARENA_PUSH(arena, &names->paths) = path;
        else if (file_begins_as_scene(path.ptr))
            *ARENA_PUSH(arena, &names->others) = (struct scene_other){path, folder};
    }
    return status;
}

void scene_names_add(struct scene_names *names, struct arena *arena, str path) {
    if (file_begins_as_scene(path.ptr))
        *ARENA_PUSH(arena, &names->others) = (struct scene_other){path, STR("")};
}

void scene_names_end(struct scene_names *names, struct arena *arena) {
    struct files files;
    files_init(&files, arena);
    str_map_init(&names->known, arena);
    names->read = ARENA_ARRAY(arena, _Atomic bool, names->others.count + 1);
    for (uint32_t i = 0; i < names->others.count; i++) {
        uint32_t *place = str_map_at(&names->known, files_canonical(&files, names->others.items[i].path));
        if (*place) // the first one of its path stands for both
            names->read[i] = true;
        else
            *place = i + 1;
    }
}

void scene_names_note(struct scene_names *names, const struct session *session) {
    for (uint32_t i = 0; i < session->files.log.count && names->others.count; i++) {
        const uint32_t number = str_map_find(&names->known, session->files.log.items[i].path);
        if (number)
            atomic_store(&names->read[number - 1], true);
    }
}

str scene_names_advice(const struct scene_names *names, struct arena *arena) {
    str list = STR("");
    const uint32_t count = names->others.count;
    for (uint32_t i = 0; i < count && i < SHOWN; i++)
        list = arena_format(arena, "%.*s%s%.*s", STR_ARG(list), i ? ", " : "",
                            STR_ARG(names->others.items[i].path));
    if (count > SHOWN)
        list = arena_format(arena, "%.*s and %u more", STR_ARG(list), count - SHOWN);
    if (!count)
        return STR(SCENE_NAMES_HELP);
    return arena_format(
        arena, SCENE_NAMES_HELP "; %.*s begin%s as scenes do: rename %s, or name %s on the command line",
        STR_ARG(list), count == 1 ? "s" : "", count == 1 ? "it" : "them", count == 1 ? "it" : "them");
}
