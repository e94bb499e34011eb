// From path and options to a loaded session: the stages one after the other.
#include "core/clock.h"
#include "core/heap.h"
#include "core/ranges.h"
#include "core/strbuf.h"
#include "core/timeline.h"
#include "diag/codes/command.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "diag/codes/rule.h"
#include "grammar/ir.h"
#include "grammar/ir_print_text.h"
#include "grammar/mesh_format.h"
#include "load/around/around.h"
#include "load/check_allow.h"
#include "load/import/scene_text.h"
#include "load/session_kept.h"
#include "load/what_file.h"
#include "parser/parser.h"
#include "parser/tree/reader.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

diag_code session_file_code(enum file_status status) {
    switch (status) {
    case FILE_MISSING:
        return DIAG_FILE_MISSING;
    case FILE_OUTSIDE:
        return DIAG_FILE_OUTSIDE;
    case FILE_NOT_REGULAR:
        return DIAG_FILE_NOT_REGULAR;
    case FILE_TOO_LARGE:
        return DIAG_LIMIT;
    case FILE_NO_MEMORY:
        return DIAG_OUT_OF_MEMORY;
    default:
        return DIAG_FILE_UNREADABLE;
    }
}

static enum session_state unreadable(struct session *session, str path, enum file_status status) {
    uint32_t source = source_add(&session->sources, SOURCE_KIND_FILE, path, STR(""));
    diag_add(&session->sink, session_file_code(status), (span){source, 0, 0}, "the scene file %s",
             file_status_text(&session->files, status));
    if (status == FILE_TOO_LARGE)
        diag_help(&session->sink, "raise the limit with --limit %s=BYTES",
                  limit_info(LIMIT_SCENE_BYTES)->name);
    if (status == FILE_OUTSIDE && !session->options.names_scene)
        diag_help(&session->sink, "it is a link; to read what it leads to, name the file itself");
    return SESSION_UNREADABLE;
}

// Reading it would only report mistakes in a language that it is not written in.
static bool is_another_kind(struct session *session, str path, str text) {
    struct what_file what;
    if (!what_file(path, text, &session->arena, &what))
        return false;
    uint32_t source = source_add(&session->sources, SOURCE_KIND_FILE, path, STR(""));
    diag_add(&session->sink, DIAG_FILE_KIND, (span){source, 0, 0}, "this is %.*s, not a scene",
             STR_ARG(what.what));
    diag_help(&session->sink, "%.*s", STR_ARG(what.advice));
    return true;
}

static str finished_text(struct session *session, struct strbuf *text) {
    str copy = arena_copy(&session->arena, strbuf_view(text));
    strbuf_finish(text);
    return copy;
}

// A mesh becomes a scene around it, which nobody wrote.
static str scene_around_mesh(struct session *session, struct asset_store *store, str path) {
    const struct assets_input input = session_assets_input(session);
    struct strbuf text;
    str name = path_base(path), around = STR("");
    const struct import_source source = {&input, store, &session->assets, session->options.width,
                                         session->options.height};
    strbuf_init(&text);
    const bool may_read = store && !session->options.text_only;
    const bool is_scene =
        may_read && mesh_format_of_path(path) == MESH_FORMAT_GLTF && import_scene_text(&source, path, &text);
    if (!is_scene && may_read)
        around = around_text(store, &input, path, session->options.width, session->options.height,
                             &session->assets);
    assets_finish(&session->assets);
    if (is_scene)
        return finished_text(session, &text);
    if (around.len)
        return around;
    strbuf_cstr(&text, "glint: 1\nmodels:\n  - mesh: ");
    if (utf8_first_error(name) == name.len)
        print_yaml_text(&text, name, false);
    else
        strbuf_str(&text, name); // the reader says what is wrong with it
    strbuf_char(&text, '\n');
    return finished_text(session, &text);
}

static struct config_input config_input(struct session *session) {
    return (struct config_input){.files = &session->files,
                                 .sources = &session->sources,
                                 .sink = &session->sink,
                                 .arena = &session->arena,
                                 .runner = &session->options.limits};
}

static void load_config(struct session *session) {
    struct config_input input = config_input(session);
    config_load(&input, session->options.path, &session->config);
    session->config_failed = session->sink.errors > 0;
    limits_fill(&session->options.limits, &session->config.limits);
    diag_sink_keep(&session->sink, (uint32_t)session->options.limits.value[LIMIT_MESSAGES]);
    session->arena.cap_bytes = limits_size(&session->options.limits, LIMIT_SCENE_MEMORY);
    session->policy = session->config.policy;
    if (session->options.policy)
        diag_policy_overlay(&session->policy, &session->arena, session->options.policy);
}

// If the scene may not be read, nothing beside it is looked at: no settings, no folder.
static enum file_status judge_place(struct session *session) {
    return session->options.names_scene
               ? files_confine(&session->files, session->options.path, session->options.named_in)
               : FILE_OK;
}

static enum file_status read_scene(struct session *session, str *text) {
    const struct session_options *o = &session->options;
    const uint64_t most = o->limits.value[LIMIT_SCENE_BYTES];
    struct files alone;
    if (!o->names_scene)
        return o->found_in.len
                   ? files_read_found(&session->files, o->path, o->found_in, most, &session->arena, text)
                   : files_read_given(&session->files, o->path, most, &session->arena, text);
    files_init(&alone, &session->arena); // its own root does not count
    alone.overlays = session->files.overlays;
    const enum file_status status =
        files_read_found(&alone, o->path, o->named_in, most, &session->arena, text);
    session->files.system_error = alone.system_error;
    if (status == FILE_OK)
        files_identify(&session->files, o->path, &(struct file_read){0}); // it is a file that was read
    return status;
}

// false: it was reported.
static bool add_asset_path(struct session *session, uint32_t at) {
    const struct session_options *o = &session->options;
    const str folder = o->asset_paths[at];
    str within = STR(""), rest;
    if (at >= o->asset_path_count - o->named_asset_path_count)
        within = files_canonical(&session->files, o->named_in);
    const uint32_t before = session->files.roots.count;
    const enum file_status status = files_add_root(&session->files, folder);
    const bool is_new = session->files.roots.count > before;
    if (status == FILE_OK &&
        (!within.len || !is_new || path_is_below(session->files.roots.items[before], within, &rest)))
        return true;
    if (within.len) {
        session->files.roots.count = before;
        diag_add(&session->sink, DIAG_FILE_OUTSIDE, SPAN_NONE,
                 "the folder that --asset-path names is not a folder below the one that may be read");
    } else {
        diag_add(&session->sink, DIAG_USAGE, SPAN_NONE, "--asset-path %.*s is not a folder", STR_ARG(folder));
    }
    return false;
}

static enum session_state open_source(struct session *session, struct asset_store *store, uint32_t *source) {
    str path = session->options.path;
    str text = STR("");
    enum file_status status = judge_place(session);
    if (status != FILE_OK)
        return unreadable(session, path, status);
    load_config(session);
    if (session->options.judged &&
        diag_policy_ignores(&session->policy, files_canonical(&session->files, path)))
        return SESSION_IGNORED;
    status = files_add_scene_root(&session->files, path);
    if (status != FILE_OK)
        return unreadable(session, path, status);
    for (uint32_t i = 0; i < session->options.asset_path_count; i++) {
        if (!add_asset_path(session, i))
            return SESSION_UNREADABLE;
    }
    for (uint32_t i = 0; i < session->config.asset_paths.count; i++)
        files_add_root(&session->files, session->config.asset_paths.items[i]);
    status = session->options.found_in.len ? files_confine(&session->files, path, session->options.found_in)
                                           : FILE_OK;
    if (status != FILE_OK)
        return unreadable(session, path, status);
    if (assets_is_mesh_path(path)) {
        struct file_read identity;
        status = files_identify(&session->files, path, &identity);
        if (status != FILE_OK)
            return unreadable(session, path, status);
        text = scene_around_mesh(session, store, path);
        *source = source_add(&session->sources, SOURCE_KIND_GENERATED, path, text);
        return SESSION_LOADED;
    }
    status = read_scene(session, &text);
    if (status != FILE_OK)
        return unreadable(session, path, status);
    if (is_another_kind(session, path, text))
        return SESSION_UNREADABLE;
    *source = source_add(&session->sources, SOURCE_KIND_FILE, path, text);
    return SESSION_LOADED;
}

static void load_assets(struct session *session, struct asset_store *store) {
    double start = clock_seconds();
    struct assets_input input = session_assets_input(session);
    assets_load(store, &input, session->options.pixels, &session->assets);
    scene_build(session->scene, &session->assets, &session->arena, &session->resolved);
    scene_check_places(&session->resolved, &session->sink);
    scene_check_reach(&session->resolved, &session->sink);
    scene_check_triangles(&session->resolved, &session->options.limits, &session->sink);
    session->assets_seconds = clock_seconds() - start;
}

// The same for objects that nothing shows.
static void judge_unshown(struct session *session, struct asset_store *store,
                          const struct parser_output *unshown) {
    struct assets_input input = session_assets_input(session);
    struct scene *scene = ARENA_NEW(&session->arena, struct scene);
    input.scene = unshown->scene;
    input.origin = &unshown->origin;
    input.pixels_later = false;
    assets_load(store, &input, ASSETS_SKIP_PIXELS, &session->unshown);
    scene_build(unshown->scene, &session->unshown, &session->arena, scene);
    scene_check_places(scene, &session->sink);
    scene_check_reach(scene, &session->sink);
    assets_finish(&session->unshown);
}

// The steps that need the background's pixels.
static void finish_load(void *context) {
    struct session *session = context;
    const double start = clock_seconds();
    assets_settle(&session->assets);
    session->assets_seconds += clock_seconds() - start;
    session_lint(session);
}

void session_no_memory(struct session *session, const char *what) {
    diag_add(&session->sink, DIAG_OUT_OF_MEMORY, ir_place_label(&session->origin, &session->scene->head),
             "not enough memory for %s", what);
}

void session_report_pixels(struct session *session) {
    const struct ir_image *scene = &session->scene->image, *image = session->image;
    const bool is_written = image->width == scene->width && image->height == scene->height;
    diag_add(&session->sink, DIAG_TOO_MANY_PIXELS,
             is_written ? ir_place_label(&session->origin, &scene->head) : SPAN_NONE,
             "the picture has %d x %d, that is %lld pixels; at most %d can be held at once", image->width,
             image->height, (long long)image->width * image->height, RANGE_PIXELS_MOST);
    diag_help(&session->sink,
              image->error > 0 ? "give all pixels the same samples, without 'error', or choose a smaller size"
                               : "choose a smaller size; 'glint render' writes large pictures in bands");
}

// Pictures are rendered in bands unless all pixels are needed at once: by the caller, or because pixels end
// by their error, which is stated for the whole picture.
static void check_pixels(struct session *session) {
    const struct ir_image *scene = &session->scene->image, *image = session->image;
    const int64_t pixels = (int64_t)image->width * image->height;
    const bool is_told = scene->error > 0 && (int64_t)scene->width * scene->height > RANGE_PIXELS_MOST;
    if (pixels > RANGE_PIXELS_MOST && !is_told && (session->options.whole_picture || image->error > 0))
        session_report_pixels(session);
}

static void take_image_options(struct session *session) {
    struct ir_image *image = ARENA_NEW(&session->arena, struct ir_image);
    *image = session->scene->image;
    if (session->options.width)
        image->width = session->options.width;
    if (session->options.height)
        image->height = session->options.height;
    if (session->options.samples)
        image->samples = session->options.samples;
    if (session->options.error > 0 && !session->options.samples && image->samples <= image->min_samples)
        image->samples = SESSION_SAMPLES_MOST;
    if (session->options.error != 0)
        image->error = fmax(session->options.error, 0);
    // With fewer samples no pixel could end before the others.
    if (image->samples <= image->min_samples)
        image->error = 0;
    session->unused_error = image->error > 0 ? 0 : session->scene->image.error;
    session->image = image;
    check_pixels(session);
}

// What is loaded from the path.
enum extent {
    EXTENT_SCENE,
    EXTENT_FILE,     // without includes and assets
    EXTENT_KEPT,     // only what does not depend on --set
    EXTENT_SETTINGS, // it is a configuration
    EXTENT_NAME,     // only reports that its name is not a scene's
};

static void report_name(struct session *session, uint32_t source) {
    const str base = path_base(session->options.path);
    size_t dot = base.len;
    while (dot > 0 && base.ptr[dot - 1] != '.')
        dot--;
    if (str_ends_with_nocase(str_slice(base, 0, dot), ".glint."))
        dot -= strlen("glint.");
    diag_add(&session->sink, DIAG_SCENE_NAME, (span){source, 0, 0},
             "this begins as a scene does, and was left out, because its name is not that of a scene");
    diag_help(&session->sink, "rename it to '%.*sglint.%s', or name it on the command line", (int)dot,
              base.ptr,
              reader_is_xml(session->options.path, session->sources.items[source].text) ? "xml" : "yaml");
}

struct session_kept {
    _Atomic uint32_t holders;
    struct session_options options; // as they were given
    struct session text;
};

static struct parser_input parser_input(struct session *session) {
    return (struct parser_input){.sources = &session->sources,
                                 .files = &session->files,
                                 .sink = &session->sink,
                                 .limits = &session->options.limits,
                                 .arena = &session->arena,
                                 .sets = session->options.sets,
                                 .set_count = session->options.set_count,
                                 .keeps_written = session->options.keeps_written,
                                 .judges_objects = true,
                                 .timeline = session->options.timeline};
}

// Takes over the parser's result, and loads all that it names.
static enum session_state take_scene(struct session *session, struct asset_store *store,
                                     const struct parser_output *output, bool alone) {
    session->scene = output->scene;
    session->origin = output->origin;
    session->unread = output->unread;
    take_image_options(session);
    if (alone || session->options.text_only)
        return SESSION_LOADED;
    if (session->options.on_text && session->sink.errors == 0)
        session->options.on_text(session->options.on_text_context);
    load_assets(session, store);
    if (output->unshown)
        judge_unshown(session, store, output->unshown);
    session->unsettled = session->assets.pixels_later && session->sink.errors == 0;
    if (!session->unsettled)
        finish_load(session);
    return SESSION_LOADED;
}

static enum session_state load_stages(struct session *session, struct asset_store *store,
                                      enum extent extent) {
    uint32_t source = 0;
    const double start = clock_seconds();
    if (extent == EXTENT_SETTINGS) {
        struct config_input settings = config_input(session);
        config_read_file(&settings, session->options.path, session->options.path, &session->config);
        return SESSION_NO_SCENE;
    }
    enum session_state state = open_source(session, store, &source);
    timeline_add(session->options.timeline, "read", session->options.path, start);
    if (state != SESSION_LOADED)
        return state;
    if (extent == EXTENT_NAME) {
        report_name(session, source);
        return SESSION_NO_SCENE;
    }
    const struct parser_input input = parser_input(session);
    struct parser_output output = {0};
    if (extent == EXTENT_KEPT) {
        session->parser = session->sink.count == 0 ? parser_keep(&input, source) : NULL;
        return SESSION_NO_SCENE;
    }
    const bool alone = extent == EXTENT_FILE;
    const bool found =
        alone ? parser_load_file(&input, source, &output) : parser_load(&input, source, &output);
    session->read_seconds = clock_seconds() - start;
    return found ? take_scene(session, store, &output, alone) : SESSION_NO_SCENE;
}

// The same, from kept text.
static enum session_state load_kept(struct session *session, struct asset_store *store) {
    const struct session *text = &session->options.kept->text;
    const double start = clock_seconds();
    struct parser_output output = {0};
    session->options.limits = text->options.limits;
    session->config = text->config;
    session->policy = text->policy;
    diag_sink_keep(&session->sink, (uint32_t)session->options.limits.value[LIMIT_MESSAGES]);
    session->arena.cap_bytes = limits_size(&session->options.limits, LIMIT_SCENE_MEMORY);
    source_set_copy(&text->sources, &session->arena, &session->sources);
    files_copy(&text->files, &session->arena, &session->files);
    const struct parser_input input = parser_input(session);
    const bool found = parser_load_kept(text->parser, &input, &output);
    session->read_seconds = clock_seconds() - start;
    return found ? take_scene(session, store, &output, false) : SESSION_NO_SCENE;
}

struct loading {
    struct session *session;
    struct asset_store *store;
    enum extent extent;
};

static void load(void *context) {
    const struct loading *l = context;
    struct session *session = l->session;
    const struct session_options *options = &session->options;
    if (options->kept) {
        session->state = load_kept(session, l->store);
        return;
    }
    source_set_init(&session->sources, &session->arena);
    files_init(&session->files, &session->arena);
    for (uint32_t i = 0; i < options->overlay_count; i++)
        files_add_overlay(&session->files, options->overlays[i].path, options->overlays[i].text);
    session->state = load_stages(session, l->store, l->extent);
}

// Runs work that allocates from the session's arena.
static void run_guarded(struct session *session, arena_work *work, void *context) {
    const enum arena_fault fault = arena_guarded(&session->arena, work, context);
    if (!fault)
        return;
    diag_add(&session->sink, fault == ARENA_FAULT_CAP ? DIAG_LIMIT : DIAG_OUT_OF_MEMORY, SPAN_NONE,
             "the scene needs more memory than %s", fault == ARENA_FAULT_CAP ? "the limit" : "is available");
    diag_help(&session->sink, "raise the limit with --limit %s=BYTES", limit_info(LIMIT_SCENE_MEMORY)->name);
    session->unsettled = false;
    session->state = SESSION_NO_SCENE;
}

static void put_in_order(struct session *session) {
    if (session->options.judged || session->unsettled)
        return;
    check_silence(session);
    diag_sort(&session->sink);
}

static enum session_state guarded_load(struct session *session, const struct session_options *options,
                                       struct asset_store *store, enum extent extent) {
    struct loading loading = {session, store, extent};
    *session = (struct session){.options = *options};
    if (options->kept)
        options->kept->holders++;
    diag_sink_init(&session->sink);
    arena_init(&session->arena, limits_size(&options->limits, LIMIT_SCENE_MEMORY));
    run_guarded(session, load, &loading);
    put_in_order(session);
    return session->state;
}

void session_settle(struct session *session) {
    if (!session->unsettled)
        return;
    session->unsettled = false;
    run_guarded(session, finish_load, session);
    put_in_order(session);
}

enum session_state session_load(struct session *session, const struct session_options *options,
                                struct asset_store *store) {
    return guarded_load(session, options, store, options->unnamed ? EXTENT_NAME : EXTENT_SCENE);
}

enum session_state session_load_text(struct session *session, const struct session_options *options) {
    // The text around a mesh depends on it.
    struct asset_store *store = assets_is_mesh_path(options->path) ? asset_store_create() : NULL;
    const enum session_state state = guarded_load(session, options, store, EXTENT_FILE);
    assets_finish(&session->assets);
    asset_store_destroy(store);
    return state;
}

enum session_state session_load_settings(struct session *session, const struct session_options *options) {
    return guarded_load(session, options, NULL, EXTENT_SETTINGS);
}

void session_finish(struct session *session) {
    if (!session)
        return;
    assets_finish(&session->assets);
    assets_finish(&session->unshown);
    diag_sink_finish(&session->sink);
    arena_finish(&session->arena);
    session_kept_release(session->options.kept);
}

// ---- text that is kept

struct session_kept *session_keep(const struct session_options *options) {
    if (options->overlay_count || options->text_only || options->unnamed ||
        assets_is_mesh_path(options->path))
        return NULL;
    struct session_kept *kept = heap_zeroed(1, sizeof *kept);
    if (!kept)
        return NULL;
    kept->options = *options;
    kept->holders = 1;
    guarded_load(&kept->text, options, NULL, EXTENT_KEPT);
    if (kept->text.parser)
        return kept;
    session_kept_release(kept);
    return NULL;
}

bool session_kept_fits(const struct session_kept *kept, const struct session_options *options) {
    const struct session_options *own = &kept->options;
    return str_equal(own->path, options->path) && str_equal(own->found_in, options->found_in) &&
           str_equal(own->named_in, options->named_in) && own->names_scene == options->names_scene &&
           own->asset_paths == options->asset_paths && own->asset_path_count == options->asset_path_count &&
           own->named_asset_path_count == options->named_asset_path_count &&
           own->overlay_count == options->overlay_count && own->policy == options->policy &&
           own->judged == options->judged && own->text_only == options->text_only &&
           own->unnamed == options->unnamed &&
           memcmp(&own->limits, &options->limits, sizeof own->limits) == 0 &&
           files_are_same(&kept->text.files);
}

void session_kept_release(struct session_kept *kept) {
    if (!kept || --kept->holders > 0)
        return;
    parser_drop(kept->text.parser);
    session_finish(&kept->text);
    free(kept);
}
