// glint deps SCENE...: every file that the scenes read.
#include "cli/commands/commands.h"

#include "core/json_write.h"
#include "diag/codes/limit.h"
#include "load/inventory.h"

#include <string.h>

enum form {
    FORM_TEXT,
    FORM_JSON,
    FORM_MAKE,
};

// The files of all scenes so far, for text: each is listed once.
struct listing {
    struct cli *cli;
    enum form form;
    struct strbuf out;
    struct json_writer json; // into `out`
    struct {
        str *items;
        uint32_t count, capacity;
    } told;
};

// Escapes characters at which make would split a list of files, and the backslashes before them (GNU make
// 4.3, "Rule Syntax", "Pattern Intro", "Wildcards"). ';', a pair of parentheses and a backslash at the end
// cannot be escaped.
static void make_name(struct strbuf *out, str path, bool is_target) {
    size_t backslashes = 0;
    if (path.len && path.ptr[0] == '~')
        strbuf_cstr(out, "./");
    for (size_t i = 0; i < path.len; i++) {
        char c = path.ptr[i];
        if (c == '=') {
            strbuf_cstr(out, "$(subst x,=,x)"); // a plain '=' would make it an assignment
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
        if (str_equal(inventory->items[i].canonical, listing->cli->stream.overlay.path) ||
            is_told(listing, inventory->items[i].canonical))
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

// The place that names a file.
static void add_place(struct json_writer *w, struct session *session, const struct inventory_use *use) {
    json_open_object(w, NULL);
    if (use->named_in.len) {
        json_write_text(w, "file", use->named_in);
        json_write_integer(w, "line", use->named_line);
    } else {
        struct source_place at = source_locate(&session->sources, use->at);
        json_write_text(w, "file", at.path);
        json_write_integer(w, "line", at.line);
        json_write_integer(w, "column", at.column);
    }
    json_write_text(w, "as", use->named);
    json_close_object(w);
}

static void add_file(struct json_writer *w, struct session *session, const struct inventory *inventory,
                     uint32_t first) {
    const struct inventory_use *use = &inventory->items[first];
    json_open_object(w, NULL);
    json_write_text(w, "path", use->path);
    json_write_text(w, "role", str_from(inventory_role_name(use->role)));
    json_write_integer(w, "bytes", use->size_bytes);
    json_open_list(w, "named");
    for (uint32_t i = first; i < inventory->count; i++) {
        const struct inventory_use *other = &inventory->items[i];
        if (other->named.len && str_equal(other->canonical, use->canonical))
            add_place(w, session, other);
    }
    json_close_list(w);
    json_close_object(w);
}

static void add_json(struct json_writer *w, struct session *session, const struct inventory *inventory,
                     const char *scene) {
    json_open_object(w, NULL);
    json_write_text(w, "scene", str_from(scene));
    json_write_boolean(w, "complete", session->sink.errors == 0);
    json_open_list(w, "files");
    for (uint32_t i = 0; i < inventory->count; i++)
        if (!inventory_is_repeat(inventory, i))
            add_file(w, session, inventory, i);
    json_close_list(w);
    json_close_object(w);
}

static int list_scene(struct listing *listing, struct asset_store *store, const char *path) {
    struct session session;
    struct inventory inventory = {0};
    struct session_options options = cli_session_options(listing->cli, path);
    options.pixels = ASSETS_SKIP_PIXELS;
    session_load(&session, &options, store);
    if (!inventory_make(&session, &inventory))
        diag_add(&session.sink, DIAG_OUT_OF_MEMORY, SPAN_NONE, "not enough memory to list the files");
    if (listing->form == FORM_JSON)
        add_json(&listing->json, &session, &inventory, path);
    else if (listing->form == FORM_MAKE)
        add_make(listing, &inventory, path);
    else
        add_text(listing, &inventory);
    int status = cli_report(listing->cli, &session, false);
    session_finish(&session);
    return status;
}

static int print_listing(struct listing *listing) {
    struct cli *cli = listing->cli;
    if (!listing->out.failed)
        return cli_print(cli, strbuf_view(&listing->out));
    cli_error(cli, DIAG_OUT_OF_MEMORY, cli->operands[0], NULL, "not enough memory for the list");
    return CLI_FILE;
}

int cmd_deps(struct cli *cli) {
    static const char *const forms[] = {"text", "json", "make", NULL};
    int form = 0;
    if (!cli_format(cli, forms, &form))
        return CLI_USAGE;
    struct listing listing = {.cli = cli, .form = (enum form)form};
    if (listing.form == FORM_MAKE && cli->stream.path.len)
        return cli_usage(cli, cli_option_place(cli, "format"),
                         "a rule needs the scene's name, and standard input has none: name a file");
    struct asset_store *store = asset_store_create();
    int worst = CLI_OK;
    strbuf_init(&listing.out);
    json_writer_init(&listing.json, &listing.out, JSON_WRITE_DEPTH_MAX);
    if (listing.form == FORM_JSON)
        json_open_list(&listing.json, NULL);
    for (int i = 0; i < cli->operand_count; i++) {
        int status = list_scene(&listing, store, cli->operands[i]);
        worst = status > worst ? status : worst;
    }
    if (listing.form == FORM_JSON) {
        json_close_list(&listing.json);
        json_end(&listing.json);
    }
    int printed = print_listing(&listing);
    worst = printed > worst ? printed : worst;
    strbuf_finish(&listing.out);
    asset_store_destroy(store);
    return worst;
}
