// glint deps SCENE...: every file that the scenes read.
#include "cli/cli.h"

#include "app/inventory.h"
#include "core/strbuf.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

enum form {
    FORM_TEXT,
    FORM_JSON,
    FORM_MAKE,
};

// The files of all scenes so far, for text: each is told once.
struct listing {
    struct cli *cli;
    enum form form;
    struct strbuf out;
    json_t *scenes;
    struct {
        str *items;
        uint32_t count, capacity;
    } told;
};

// What make takes apart in a list of files is escaped, with the backslashes before it (GNU make 4.3, "Rule
// Syntax", "Pattern Intro", "Wildcards"). Nothing can be written for ';', a pair of parentheses and a
// backslash at the end.
static void make_name(struct strbuf *out, str path, bool is_target) {
    size_t backslashes = 0;
    if (path.len && path.ptr[0] == '~')
        strbuf_cstr(out, "./");
    for (size_t i = 0; i < path.len; i++) {
        char c = path.ptr[i];
        if (c == '=') {
            strbuf_cstr(out, "$(subst x,=,x)"); // or it would be an assignment
        } else if (c == '$') {
            strbuf_cstr(out, "$$");
        } else {
            if (strchr(" \t#:*?[]", c) || c == (is_target ? '%' : '|'))
                strbuf_repeat(out, '\\', backslashes + 1);
            strbuf_char(out, c);
        }
        backslashes = c == '\\' ? backslashes + 1 : 0;
    }
}

static bool is_told(struct listing *listing, str canonical) {
    for (uint32_t i = 0; i < listing->told.count; i++)
        if (str_equal(listing->told.items[i], canonical))
            return true;
    *ARENA_PUSH(&listing->cli->arena, &listing->told) = arena_copy(&listing->cli->arena, canonical);
    return false;
}

static void add_text(struct listing *listing, const struct inventory *inventory) {
    for (uint32_t i = 0; i < inventory->count; i++) {
        if (is_told(listing, inventory->items[i].canonical))
            continue;
        strbuf_str(&listing->out, inventory->items[i].path);
        strbuf_char(&listing->out, '\n');
    }
}

static void add_make(struct listing *listing, const struct inventory *inventory, const char *scene) {
    make_name(&listing->out, str_from(cli_default_picture(listing->cli, scene)), true);
    strbuf_char(&listing->out, ':');
    for (uint32_t i = 0; i < inventory->count; i++) {
        if (inventory_is_repeat(inventory, i))
            continue;
        strbuf_cstr(&listing->out, " \\\n  ");
        make_name(&listing->out, inventory->items[i].path, false);
    }
    strbuf_char(&listing->out, '\n');
}

// The place that names a file, as an object.
static json_t *place(struct session *session, const struct inventory_use *use) {
    json_t *object = json_object();
    if (use->named_in.len) {
        json_object_set_new(object, "file", json_stringn(use->named_in.ptr, use->named_in.len));
        json_object_set_new(object, "line", json_integer(use->named_line));
    } else {
        struct source_place at = source_locate(&session->sources, use->at);
        json_object_set_new(object, "file", json_stringn(at.path.ptr, at.path.len));
        json_object_set_new(object, "line", json_integer(at.line));
        json_object_set_new(object, "column", json_integer(at.column));
    }
    json_object_set_new(object, "as", json_stringn(use->named.ptr, use->named.len));
    return object;
}

static json_t *file_object(struct session *session, const struct inventory *inventory, uint32_t first) {
    const struct inventory_use *use = &inventory->items[first];
    json_t *object = json_object();
    json_t *places = json_array();
    json_object_set_new(object, "path", json_stringn(use->path.ptr, use->path.len));
    json_object_set_new(object, "role", json_string(inventory_role_name(use->role)));
    json_object_set_new(object, "bytes", json_integer((json_int_t)use->size_bytes));
    for (uint32_t i = first; i < inventory->count; i++) {
        const struct inventory_use *other = &inventory->items[i];
        if (other->named.len && str_equal(other->canonical, use->canonical))
            json_array_append_new(places, place(session, other));
    }
    json_object_set_new(object, "named", places);
    return object;
}

static void add_json(struct listing *listing, struct session *session, const struct inventory *inventory,
                     const char *scene) {
    json_t *object = json_object();
    json_t *files = json_array();
    json_object_set_new(object, "scene", json_string(scene));
    json_object_set_new(object, "complete", json_boolean(session->sink.errors == 0));
    for (uint32_t i = 0; i < inventory->count; i++)
        if (!inventory_is_repeat(inventory, i))
            json_array_append_new(files, file_object(session, inventory, i));
    json_object_set_new(object, "files", files);
    json_array_append_new(listing->scenes, object);
}

static int list_scene(struct listing *listing, struct asset_store *store, const char *path) {
    struct session session;
    struct inventory inventory = {0};
    struct session_options options = cli_session_options(listing->cli, path);
    options.skip_pixels = true;
    session_load(&session, &options, store);
    if (!inventory_make(&session, &inventory))
        diag_add(&session.sink, DIAG_OUT_OF_MEMORY, SPAN_NONE,
                 "there is not enough memory to list the files");
    if (listing->form == FORM_JSON)
        add_json(listing, &session, &inventory, path);
    else if (listing->form == FORM_MAKE)
        add_make(listing, &inventory, path);
    else
        add_text(listing, &inventory);
    int status = cli_report(listing->cli, &session, false);
    session_finish(&session);
    return status;
}

static int print_listing(struct listing *listing) {
    if (listing->form != FORM_JSON)
        return cli_print(listing->cli, strbuf_view(&listing->out));
    char *text = json_dumps(listing->scenes, JSON_INDENT(2));
    if (text)
        strbuf_format(&listing->out, "%s\n", text);
    free(text);
    return cli_print(listing->cli, strbuf_view(&listing->out));
}

int cmd_deps(struct cli *cli) {
    static const char *const forms[] = {"text", "json", "make", NULL};
    int form = 0;
    if (!cli_format(cli, forms, &form))
        return CLI_USAGE;
    struct listing listing = {.cli = cli, .form = (enum form)form, .scenes = json_array()};
    struct asset_store *store = asset_store_create();
    int worst = CLI_OK;
    strbuf_init(&listing.out);
    for (int i = 0; i < cli->operand_count; i++) {
        int status = list_scene(&listing, store, cli->operands[i]);
        worst = status > worst ? status : worst;
    }
    int printed = print_listing(&listing);
    worst = printed > worst ? printed : worst;
    json_decref(listing.scenes);
    strbuf_finish(&listing.out);
    asset_store_destroy(store);
    return worst;
}
