#include "load/scope/changed.h"
#include "diag/codes/binding.h"
#include "diag/codes/file.h"

#include "files/files_walk.h"
#include "load/inventory.h"

void changed_init(struct changed *changed, struct arena *arena) {
    *changed = (struct changed){.arena = arena};
    files_init(&changed->files, arena);
    str_map_init(&changed->paths, arena);
}

void changed_add(struct changed *changed, str path) {
    struct arena *arena = changed->arena;
    str known = arena_copy(arena, path); // ends with a zero byte
    str canonical = arena_copy(arena, files_canonical(&changed->files, known));
    if (!files_exist(known))
        *ARENA_PUSH(arena, &changed->gone) = canonical;
    else if (files_is_folder(known))
        *ARENA_PUSH(arena, &changed->folders) = canonical;
    else
        *str_map_at(&changed->paths, canonical) = 1;
}

// Whether a finding may have hidden a file of the scene from glint. Errors may, except those of references
// and rules, found after every file has been read, and those of values that cannot be a path. A material file
// that is missing is only a warning.
static bool hides_files(const struct diag *item) {
    const char stage = diag_info(item->code)->code[1];
    switch (item->code) {
    case DIAG_MTL_MISSING:
        return true;
    case DIAG_MISSING:
    case DIAG_BAD_NUMBER:
    case DIAG_OUT_OF_RANGE:
    case DIAG_BAD_CHOICE:
    case DIAG_BAD_BOOLEAN:
    case DIAG_WRONG_COUNT:
    case DIAG_MISSING_COMPONENT:
    case DIAG_BAD_NAME:
    case DIAG_BAD_COLOR:
        return false;
    default:
        return item->severity == DIAG_ERROR && stage != '3' && stage != '4';
    }
}

static bool is_complete(const struct session *session) {
    if (session->state != SESSION_LOADED || session->sink.dropped)
        return false;
    for (uint32_t i = 0; i < session->sink.count; i++)
        if (hides_files(&session->sink.items[i]))
            return false;
    return true;
}

bool changed_holds(const struct changed *changed, str canonical) {
    str rest;
    for (uint32_t i = 0; i < changed->folders.count; i++)
        if (path_is_below(canonical, changed->folders.items[i], &rest))
            return true;
    return str_map_find(&changed->paths, canonical) != 0;
}

static bool is_changed(const struct changed *changed, const struct inventory_use *use) {
    if (changed_holds(changed, use->canonical))
        return true;
    for (uint32_t i = 0; i < changed->gone.count; i++)
        if (str_equal(path_base(changed->gone.items[i]), path_base(use->canonical)))
            return true;
    return false;
}

// Removed settings applied to everything below their folder.
static bool lost_settings(const struct changed *changed, str scene) {
    str rest;
    for (uint32_t i = 0; i < changed->gone.count; i++)
        if (str_equal_cstr(path_base(changed->gone.items[i]), FILES_CONFIG_NAME) &&
            path_is_below(scene, path_folder(changed->gone.items[i]), &rest))
            return true;
    return false;
}

bool changed_affects(const struct changed *changed, struct session *session) {
    struct inventory inventory;
    if (!is_complete(session) || !inventory_make(session, &inventory))
        return true;
    for (uint32_t i = 0; i < inventory.count; i++)
        if (is_changed(changed, &inventory.items[i]) || lost_settings(changed, inventory.items[i].canonical))
            return true;
    return false;
}
