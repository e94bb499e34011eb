// Names: each is used once, and references find what they name.
#include "core/str_map.h"
#include "diag/codes/reference.h"
#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"
#include "parser/bind/bind.h"
#include "parser/bind/say.h"
#include "parser/bind/visit.h"
#include "parser/stages/loader.h"
#include "parser/tree/mend.h"
#include "parser/tree/reader_text.h"

#include <stdlib.h>
#include <string.h>

struct named {
    str name;
    uint64_t order; // of appearance: files in the order of their entries
    const struct schema_element *schema;
    const struct ir_head *head;
    uint32_t index; // in its list
};

struct named_list {
    struct named *items;
    uint32_t count;
    struct str_map by_name; // 1 + the place of the first item of a name
};

static int compare(const void *left, const void *right) {
    const struct named *a = left;
    const struct named *b = right;
    int names = str_compare(a->name, b->name);
    return names ? names : a->order < b->order ? -1 : a->order > b->order;
}

static span place_of(const struct loader *loader, const struct named *named) {
    const char *row = named->schema->rows[visit_name_row(named->schema)].name;
    return ir_place_value(&loader->output->origin, named->head, named->schema, row);
}

static uint64_t order_of(const struct loader *loader, const struct named *named) {
    span at = place_of(loader, named);
    uint64_t rank = 0;
    while (rank < loader->order.count && loader->files.items[loader->order.items[rank]].source != at.source)
        rank++;
    return rank << 32 | at.begin;
}

// Those of 'for'; none where an element has no copies.
static struct ir_any_list variables_of(const struct schema_element *schema, const void *memory) {
    const int row = schema_find_row(schema, STR("for"));
    return row < 0 ? (struct ir_any_list){0} : ir_walk_list(&schema->rows[row], memory);
}

static uint32_t count_names(const struct schema_row *row, void *holder) {
    void *field = schema_field(row, holder);
    int name_row = visit_name_row(row->child);
    uint32_t count = 0;
    for (uint32_t i = 0; name_row >= 0 && i < bind_list_count(field); i++) {
        const void *item = bind_list_item(field, i, row->child->size);
        count += ((const str *)schema_field_const(&row->child->rows[name_row], item))->len > 0;
    }
    return count;
}

static void add_names(const struct loader *loader, struct named_list *list, const struct schema_row *row,
                      void *holder) {
    void *field = schema_field(row, holder);
    int name_row = visit_name_row(row->child);
    for (uint32_t i = 0; name_row >= 0 && i < bind_list_count(field); i++) {
        const void *item = bind_list_item(field, i, row->child->size);
        // A name in typographic quotes is not valid and was reported, but its meaning is clear.
        str name = mend_quotes(*(const str *)schema_field_const(&row->child->rows[name_row], item));
        if (name.len == 0)
            continue;
        struct named *named = &list->items[list->count++];
        *named = (struct named){.name = name, .schema = row->child, .head = item, .index = i};
        named->order = order_of(loader, named);
    }
}

// The names of one row of the scene or of an object, or of all rows that are lists without keys: bodies,
// lights and instances share their names.
static struct named_list collect(struct loader *loader, const struct schema_element *schema, void *holder,
                                 const struct schema_row *only) {
    uint32_t most = 0;
    for (uint32_t i = 0; i < schema->row_count; i++)
        if (schema->rows[i].kind == SCHEMA_LIST)
            most += count_names(&schema->rows[i], holder);
    struct named_list list = {.items = ARENA_ARRAY(&loader->scratch, struct named, most)};
    str_map_init(&list.by_name, &loader->scratch);
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        if (only ? row == only : row->kind == SCHEMA_LIST && row->many == SCHEMA_SEQUENCE)
            add_names(loader, &list, row, holder);
    }
    if (list.count)
        qsort(list.items, list.count, sizeof *list.items, compare);
    return list;
}

static const struct schema_row *home_of(const struct schema_element *schema) {
    return &SCHEMA_SCENE.rows[bind_home_row(schema)];
}

static void report_duplicates(struct loader *loader, const struct named_list *list) {
    struct diag_sink *sink = loader->input->sink;
    const struct named *first = NULL;
    for (uint32_t i = 0; i < list->count; i++) {
        const struct named *named = &list->items[i];
        if (!first || !str_equal(first->name, named->name)) {
            first = named;
            continue;
        }
        str name = say_text(&loader->scratch, named->name);
        if (first->schema == named->schema)
            diag_add(sink, DIAG_DUPLICATE_NAME, place_of(loader, named), "two %s have the name '%.*s'",
                     schema_yaml_key(home_of(named->schema)), STR_ARG(name));
        else
            diag_add(sink, DIAG_DUPLICATE_NAME, place_of(loader, named), "%.*s and %.*s have the name '%.*s'",
                     STR_ARG(say_article(&loader->scratch, first->schema->name)),
                     STR_ARG(say_article(&loader->scratch, named->schema->name)), STR_ARG(name));
        diag_note(sink, place_of(loader, first), "the first one is here");
        const struct schema_row *home = home_of(named->schema);
        if (home->single && str_equal_cstr(named->name, home->single))
            diag_help(sink, "a %s without a name is called '%s'; name one of the two", named->schema->name,
                      home->single);
        else
            diag_help(sink, "rename one of the two");
    }
}

static const struct named *find(const struct named_list *list, str name) {
    uint32_t found = str_map_find(&list->by_name, name);
    return found ? &list->items[found - 1] : NULL;
}

static void number_names(struct named_list *list) {
    for (uint32_t i = 0; i < list->count; i++)
        if (i == 0 || !str_equal(list->items[i].name, list->items[i - 1].name))
            *str_map_at(&list->by_name, list->items[i].name) = i + 1;
}

// pawn[3] is the name of a copy, where pawn is written with 'for'.
static void report_copies_names(struct loader *loader, const struct named_list *list) {
    for (uint32_t i = 0; i < list->count; i++) {
        const str base = ir_copies_base(list->items[i].name);
        const struct named *entry = base.len < list->items[i].name.len ? find(list, base) : NULL;
        if (!entry || !variables_of(entry->schema, entry->head).count)
            continue;
        const str name = say_text(&loader->scratch, list->items[i].name);
        diag_add(loader->input->sink, DIAG_DUPLICATE_NAME, place_of(loader, &list->items[i]),
                 "'%.*s' is the name of a copy of '%.*s'", STR_ARG(name), STR_ARG(base));
        diag_note(loader->input->sink, place_of(loader, entry), "its copies are made here");
        diag_help(loader->input->sink, "rename one of the two");
    }
}

// References.

enum {
    SEARCHES_MAX = 50, // names compared with all others, as many as are reported one by one
};

struct resolving {
    struct loader *loader;
    const struct ir_scene *scene;
    struct named_list *by_row; // sorted names of the scene's rows that references can mean
    struct mend_search searches[SEARCHES_MAX];
    uint32_t search_count, focus_searches;
    struct str_map searched; // 1 + index in `searches`, by name
    struct str_map unread;   // names that may be in an include that could not be read
};

enum {
    UNREAD_SHOWN = 5,
};

// A name unlike any in the files that were read is probably in the file that was not: a note says so, once
// per name.
static void note_may_be_unread(struct resolving *resolving, const char *what, span at, str name) {
    struct loader *loader = resolving->loader;
    if (resolving->unread.count > UNREAD_SHOWN || str_map_find(&resolving->unread, name))
        return;
    *str_map_at(&resolving->unread, name) = 1;
    const bool is_last = resolving->unread.count > UNREAD_SHOWN;
    resolve_note_unread(loader, at,
                        arena_format(&loader->scratch,
                                     is_last ? "so are others from here on"
                                             : "the %s '%.*s' is not in the files that were read",
                                     what, STR_ARG(say_text(&loader->scratch, name))));
}

static void list_names(struct loader *loader, const struct named_list *list, const char *what, str name,
                       bool is_preset) {
    enum {
        SHOWN = 8
    };
    str names = STR("");
    for (uint32_t i = 0; i < list->count && i < SHOWN; i++)
        names = arena_format(&loader->scratch, "%.*s%s%.*s", STR_ARG(names), i ? ", " : "",
                             STR_ARG(say_text(&loader->scratch, list->items[i].name)));
    if (is_preset)
        diag_help(loader->input->sink, "a material that is known by its name is a preset: {preset: %.*s}",
                  STR_ARG(name));
    else if (list->count == 0)
        diag_help(loader->input->sink, "the scene defines no %s", what);
    else
        diag_help(loader->input->sink, "there %s: %.*s%s", list->count == 1 ? "is" : "are", STR_ARG(names),
                  list->count > SHOWN ? ", ..." : "");
}

// What a name that does not exist may mean. Many uses of one name cost one search, and many names at most
// SEARCHES_MAX; after that, NULL.
static const struct mend_search *search_for(struct resolving *resolving, const struct named_list *list,
                                            str name) {
    uint32_t *number = str_map_at(&resolving->searched, name);
    if (*number)
        return &resolving->searches[*number - 1];
    if (resolving->search_count == SEARCHES_MAX)
        return NULL;
    struct mend_search *search = &resolving->searches[resolving->search_count++];
    *search = mend_begin(resolving->loader->input->sink, &resolving->loader->scratch, name);
    for (uint32_t i = 0; i < list->count; i++)
        mend_offer_str(search, list->items[i].name, (int)i);
    *number = resolving->search_count;
    return search;
}

static bool is_variable(struct visit_place place, str name) {
    const struct ir_any_list list = variables_of(place.schema, place.memory);
    for (uint32_t i = 0; i < list.count; i++)
        if (str_equal(((const struct ir_variable *)list.items)[i].name, name))
            return true;
    return false;
}

static void report_unknown(struct resolving *resolving, const struct named_list *list,
                           struct visit_place place, str name) {
    struct loader *loader = resolving->loader;
    struct diag_sink *sink = loader->input->sink;
    const struct schema_row *row = &place.schema->rows[place.row];
    span at = ir_place_value(&loader->output->origin, place.memory, place.schema, row->name);
    const span unread = loader->output->unread;
    const struct mend_search *search = diag_is_full(sink) ? NULL : search_for(resolving, list, name);
    if (!span_is_none(unread) && (!search || !search->best)) {
        note_may_be_unread(resolving, row->child->name, at, name);
        return;
    }
    diag_add(sink,
             row->child == &SCHEMA_MATERIAL ? DIAG_UNKNOWN_MATERIAL
             : row->child == &SCHEMA_OBJECT ? DIAG_UNKNOWN_OBJECT
                                            : DIAG_UNKNOWN_MESH,
             at, "there is no %s '%.*s'", row->child->name, STR_ARG(say_text(&loader->scratch, name)));
    if (row->file != SCHEMA_FILE_NONE)
        diag_note(sink, SPAN_NONE, "the name of a file has an ending: %.*s",
                  STR_ARG(schema_file_words(row->file, &loader->scratch)));
    if (diag_is_full(sink))
        return;
    if (is_variable(place, name)) {
        diag_help(sink, "a name cannot be computed; write an entry for each %s, with 'if'", row->child->name);
        return;
    }
    if (!search || !search->best) {
        list_names(loader, list, row->child->name, name,
                   row->child == &SCHEMA_MATERIAL &&
                       schema_word(schema_words(row->child, "preset"), name) > 0);
        return;
    }
    if (!span_is_none(unread))
        diag_note(sink, unread, "unless it is in this file, which could not be read");
    diag_help(sink, "did you mean '%s'?", search->best);
    str written = source_text(loader->input->sources, at);
    diag_fix(sink, mend_is_safe(search) && span_is_none(unread), at,
             mend_like(&loader->scratch, written, str_from(search->best)));
}

static void resolve(void *context, struct visit_place place, struct ir_reference *reference) {
    struct resolving *resolving = context;
    const struct ir_head *head = place.memory;
    if (reference->name.len == 0 || (head->poisoned & bind_bit(place.row)) ||
        ir_walk_path(&place.schema->rows[place.row], place.memory))
        return;
    uint32_t home = bind_home_row(place.schema->rows[place.row].child);
    const struct named_list *list = &resolving->by_row[home];
    const struct named *named = find(list, reference->name);
    reference->index = named ? named->index : IR_NO_INDEX;
    // The name may be in a file that could not be read.
    bool incomplete = resolving->loader->incomplete || (resolving->scene->head.poisoned & bind_bit(home));
    if (!named && !incomplete)
        report_unknown(resolving, list, place, reference->name);
}

static bool is_body(const struct named *named) {
    return named && named->schema != &SCHEMA_LIGHT;
}

static void report_focus(struct resolving *resolving, struct named_list *things, span at, str name) {
    struct loader *loader = resolving->loader;
    struct diag_sink *sink = loader->input->sink;
    const span unread = loader->output->unread;
    const bool is_light = find(things, name) != NULL;
    struct mend_search search = mend_begin(sink, &loader->scratch, name);
    for (uint32_t k = 0; k < things->count && resolving->focus_searches < SEARCHES_MAX; k++)
        if (is_body(&things->items[k]))
            mend_offer_str(&search, things->items[k].name, (int)k);
    resolving->focus_searches++;
    if (!span_is_none(unread) && !is_light && !search.best) {
        note_may_be_unread(resolving, "body", at, name);
        return;
    }
    diag_add(sink, DIAG_UNKNOWN_BODY, at,
             is_light ? "'%.*s' is a light, not a body" : "there is no body '%.*s'",
             STR_ARG(say_text(&loader->scratch, name)));
    if (!span_is_none(unread) && !is_light)
        diag_note(sink, unread, "unless it is in this file, which could not be read");
    if (search.best) {
        diag_help(sink, "did you mean '%s'?", search.best);
        const str written = source_text(loader->input->sources, at);
        diag_fix(sink, mend_is_safe(&search) && span_is_none(unread), at,
                 mend_like(&loader->scratch, written, str_from(search.best)));
    } else {
        diag_help(sink, "give the body this name, or write 'focus_at', a point");
    }
}

// Bodies on which cameras are focused.
static void find_focus(struct resolving *resolving, struct named_list *things) {
    const struct ir_scene *scene = resolving->scene;
    const struct ir_origin *origin = &resolving->loader->output->origin;
    const int row = schema_find_row(&SCHEMA_CAMERA, STR("focus_on"));
    bool incomplete = resolving->loader->incomplete || scene->head.poisoned != 0;
    for (uint32_t i = 0; i < scene->cameras.count && !incomplete; i++) {
        const struct ir_camera *camera = &scene->cameras.items[i];
        const str name = camera->focus_on;
        if (name.len && memchr(name.ptr, '/', name.len)) // in an object: copies_finish.c looks for it
            continue;
        if (name.len && !(camera->head.poisoned & bind_bit((uint32_t)row)) && !is_body(find(things, name)) &&
            !is_body(find(things, ir_copies_base(name)))) // copies_finish.c looks for a copy
            report_focus(resolving, things, ir_place_value(origin, &camera->head, &SCHEMA_CAMERA, "focus_on"),
                         name);
    }
}

static struct named_list check_things(struct loader *loader, const struct schema_element *schema,
                                      void *holder) {
    struct named_list things = collect(loader, schema, holder, NULL);
    report_duplicates(loader, &things);
    number_names(&things);
    report_copies_names(loader, &things);
    return things;
}

void names_resolve(struct loader *loader, struct ir_scene *scene) {
    struct resolving resolving = {
        .loader = loader,
        .scene = scene,
        .by_row = ARENA_ARRAY(&loader->scratch, struct named_list, SCHEMA_SCENE.row_count)};
    str_map_init(&resolving.searched, &loader->scratch);
    str_map_init(&resolving.unread, &loader->scratch);
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        if (row->kind != SCHEMA_LIST || row->many != SCHEMA_NAMED_MAP)
            continue;
        resolving.by_row[i] = collect(loader, &SCHEMA_SCENE, scene, row);
        report_duplicates(loader, &resolving.by_row[i]);
        number_names(&resolving.by_row[i]);
    }
    struct named_list things = check_things(loader, &SCHEMA_SCENE, scene);
    for (uint32_t i = 0; i < scene->objects.count; i++)
        check_things(loader, &SCHEMA_OBJECT, &scene->objects.items[i]);
    find_focus(&resolving, &things);
    visit_references(&SCHEMA_SCENE, scene, resolve, &resolving);
    arena_finish(&loader->scratch);
}
