// glint.preview: a picture of the open text, for editors to show beside it.
//
// One picture is drawn at a time, while everything else is answered. At most one more waits, and the next
// request replaces it: while one types, only the newest text is worth a picture.
#include "lsp/server_private.h"

#include "core/heap.h"
#include "core/parallel.h"
#include "grammar/ir.h"
#include "render/preview/preview.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    FINDINGS_MOST = 100,
};

// A request of the client. `id` NULL: none.
struct asked {
    json_t *id, *params;
};

struct server_preview {
    struct preview *preview;
    int wake[2];                 // pipe that gets a byte for each drawn picture; -1: none can be sent
    struct asked drawn, waiting; // `drawn` with id NULL: nobody waits for it any more
    // What is being drawn, and what drawing it needs.
    bool is_busy;
    struct parallel_task task;
    struct arena arena;
    struct file_overlay *overlays;
    struct preview_wish wish;
    json_int_t version; // of the document
    atomic_bool cancelled;
    struct preview_picture picture;
    enum preview_state state;
};

static void forget(struct asked *asked) {
    json_decref(asked->id);
    json_decref(asked->params);
    *asked = (struct asked){0};
}

static void refuse(struct server *server, struct asked *asked, enum rpc_error_code code, const char *why) {
    if (asked->id)
        rpc_refuse(&server->rpc, asked->id, code, why);
    forget(asked);
}

// ---- beginning and end

struct server_preview *server_preview_create(const struct preview_devices *devices) {
    struct server_preview *p = heap_zeroed(1, sizeof *p);
    if (!p)
        return NULL;
    p->preview = preview_create(devices);
    if (!p->preview || pipe(p->wake) != 0)
        p->wake[0] = p->wake[1] = -1;
    for (int i = 0; i < 2 && p->wake[i] >= 0; i++)
        fcntl(p->wake[i], F_SETFD, FD_CLOEXEC);
    if (p->wake[0] >= 0)
        fcntl(p->wake[0], F_SETFL, O_NONBLOCK);
    if (p->preview)
        return p;
    free(p);
    return NULL;
}

int server_preview_woken(const struct server_preview *p) {
    return p ? p->wake[0] : -1;
}

static void forget_texts(struct server_preview *p) {
    free(p->overlays);
    p->overlays = NULL;
    arena_finish(&p->arena);
}

static void end_drawing(struct server_preview *p) {
    char byte;
    parallel_wait(&p->task);
    while (p->wake[0] >= 0 && read(p->wake[0], &byte, 1) < 0 && errno == EINTR)
        continue;
    p->is_busy = false;
}

void server_preview_drop(struct server *server) {
    struct server_preview *p = server->preview;
    if (!p)
        return;
    p->cancelled = true;
    refuse(server, &p->waiting, RPC_REQUEST_CANCELLED, "the server was shut down");
    refuse(server, &p->drawn, RPC_REQUEST_CANCELLED, "the server was shut down");
}

void server_preview_destroy(struct server_preview *p) {
    if (!p)
        return;
    p->cancelled = true;
    if (p->is_busy) {
        end_drawing(p);
        preview_picture_finish(&p->picture);
        forget_texts(p);
    }
    forget(&p->waiting);
    forget(&p->drawn);
    preview_destroy(p->preview);
    for (int i = 0; i < 2; i++)
        if (p->wake[i] >= 0)
            close(p->wake[i]);
    free(p);
}

// ---- which camera

struct looking {
    const struct session *session;
    uint32_t source, first, last; // lines of the source, from 1
    uint32_t line;
};

static bool covers(struct looking *l, span at) {
    struct source_set *sources = (struct source_set *)&l->session->sources;
    if (at.source != l->source || span_is_none(at))
        return false;
    const uint32_t first = source_locate(sources, (span){at.source, at.begin, at.begin}).line;
    const uint32_t last = source_locate(sources, (span){at.source, at.end, at.end}).line;
    l->first = first < l->first ? first : l->first;
    l->last = last > l->last ? last : l->last;
    return true;
}

// The camera in whose lines the cursor is; else the first, whose name is empty.
static str camera_at(const struct request *request) {
    struct session *session = request->session;
    const struct ir_cameras *cameras = &session->scene->cameras;
    struct looking l = {.session = session, .source = locate_source(session, request->document->path)};
    if (l.source == SOURCE_DEFAULT)
        return STR("");
    const uint32_t offset = (uint32_t)request->offset;
    l.line = source_locate(&session->sources, (span){l.source, offset, offset}).line;
    for (uint32_t i = 0; i < cameras->count; i++) {
        const uint32_t origin = cameras->items[i].head.origin;
        if (origin == 0 || origin >= session->origin.elements.count)
            continue;
        const struct ir_element_origin *element = &session->origin.elements.items[origin];
        l.first = UINT32_MAX;
        l.last = 0;
        covers(&l, element->label);
        covers(&l, element->at);
        if (l.first <= l.line && l.line <= l.last)
            return cameras->items[i].name;
    }
    return STR("");
}

// ---- findings

struct collecting {
    struct server *server;
    struct session *session;
    struct arena arena;
    json_t *list;
};

static void collect(void *context) {
    struct collecting *c = context;
    struct session *session = c->session;
    diag_sort(&session->sink);
    for (uint32_t i = 0; i < session->sink.count && json_array_size(c->list) < FINDINGS_MOST; i++) {
        const struct diag *diag = &session->sink.items[i];
        json_t *location = server_location(c->server, session, &c->arena, diag->at);
        json_t *finding = server_diagnostic(c->server, session, &c->arena, diag);
        json_t *uri = json_object_get(location, "uri");
        json_object_set_new(finding, "uri", uri ? json_incref(uri) : json_null());
        json_array_append_new(c->list, finding);
        json_decref(location);
    }
}

static json_t *findings_of(struct server *server, struct session *session) {
    struct collecting c = {.server = server, .session = session, .list = json_array()};
    if (!session)
        return c.list;
    struct arena *arenas[] = {&c.arena, &session->arena, NULL};
    struct arena *paths = session->files.arena;
    server_forget(server);
    arena_init(&c.arena, SIZE_MAX / 2);
    session->files.arena = &c.arena;
    arena_guarded_all(arenas, collect, &c);
    session->files.arena = paths;
    arena_finish(&c.arena);
    server_forget(server);
    return c.list;
}

static json_t *no_picture(struct server *server, struct session *session) {
    return json_pack("{s:n, s:o}", "image", "findings", findings_of(server, session));
}

// ---- a picture

static json_t *picture_of(const struct server_preview *p) {
    const struct preview_picture *picture = &p->picture;
    struct strbuf uri;
    strbuf_init(&uri);
    strbuf_cstr(&uri, "data:image/png;base64,");
    strbuf_base64(&uri, strbuf_view(&picture->png));
    json_t *text = uri.failed ? NULL : json_stringn_nocheck(uri.data, uri.len);
    strbuf_finish(&uri);
    if (!text)
        return NULL;
    const str camera = p->wish.camera;
    return json_pack(
        "{s:o, s:I, s:I, s:I, s:o, s:o, s:I, s:[]}", "image", text, "width", (json_int_t)picture->width,
        "height", (json_int_t)picture->height, "samples", (json_int_t)picture->samples, "camera",
        camera.len ? position_string(camera) : json_null(), "device",
        position_string(str_from(preview_device(p->preview))), "version", p->version, "findings");
}

static void draw(void *context) {
    struct server_preview *p = context;
    const char byte = 0;
    p->state = preview_draw(p->preview, &p->wish, &p->cancelled, &p->picture);
    while (p->wake[1] >= 0 && write(p->wake[1], &byte, 1) < 0 && errno == EINTR)
        continue;
}

static void answer(struct server *server) {
    struct server_preview *p = server->preview;
    json_t *result = NULL;
    switch (p->state) {
    case PREVIEW_DRAWN:
        result = picture_of(p);
        break;
    case PREVIEW_BROKEN:
        result = no_picture(server, preview_findings(p->preview));
        break;
    case PREVIEW_SLOW:
        refuse(server, &p->drawn, RPC_REQUEST_FAILED,
               "there was no time even for a picture of few pixels; ask for a smaller size, or for more "
               "seconds");
        return;
    case PREVIEW_CANCELLED:
        refuse(server, &p->drawn, RPC_REQUEST_CANCELLED, "the preview was cancelled");
        return;
    case PREVIEW_NO_MEMORY:
        break;
    }
    if (!result) {
        refuse(server, &p->drawn, RPC_REQUEST_FAILED, "there is not enough memory");
        return;
    }
    rpc_reply(&server->rpc, p->drawn.id, result);
    forget(&p->drawn);
}

// ---- requests

// Takes a number from the command's argument; `standard` if it has none. false: it is not in the range.
static bool take_number(const json_t *argument, const char *key, int standard, int least, int most,
                        int *out) {
    const json_t *value = json_object_get(argument, key);
    *out = standard;
    if (!value || json_is_null(value))
        return true;
    if (!json_is_integer(value) || json_integer_value(value) < least || json_integer_value(value) > most)
        return false;
    *out = (int)json_integer_value(value);
    return true;
}

static bool take_seconds(const json_t *argument, double *out) {
    const json_t *value = json_object_get(argument, "seconds");
    const bool has = value && !json_is_null(value);
    *out = has ? json_number_value(value) : PREVIEW_SECONDS;
    return !has || (*out >= PREVIEW_SECONDS_LEAST && *out <= PREVIEW_SECONDS_MOST);
}

// Keeps the scene's proportions.
static void choose_size(const struct ir_image *image, int longest, struct session_options *options) {
    const double larger = image->width > image->height ? image->width : image->height;
    options->width = (int32_t)fmax(floor(image->width * (longest / larger) + 0.5), 1);
    options->height = (int32_t)fmax(floor(image->height * (longest / larger) + 0.5), 1);
}

struct preparing {
    struct server *server;
    struct request request;
    int size, samples;
    double seconds;
};

// Copies everything that drawing needs into memory that the editor's next changes do not touch.
static void prepare(void *context) {
    struct preparing *c = context;
    struct server_preview *p = c->server->preview;
    struct preview_wish *wish = &p->wish;
    const struct documents *documents = &c->server->documents;
    *wish = (struct preview_wish){.session = c->server->scenes.settings, .seconds = c->seconds};
    wish->camera = arena_copy(&p->arena, camera_at(&c->request));
    choose_size(c->request.session->image, c->size, &wish->session);
    wish->session.samples = c->samples;
    wish->session.error = -1;
    wish->session.pixels = ASSETS_KEEP_PIXELS;
    wish->session.lint = LINT_NONE;
    wish->session.path = arena_copy(&p->arena, c->request.scene->path);
    for (uint32_t i = 0; p->overlays && i < documents->count; i++)
        p->overlays[i] = (struct file_overlay){arena_copy(&p->arena, documents->items[i].path),
                                               arena_copy(&p->arena, document_text(&documents->items[i]))};
    wish->session.overlays = p->overlays;
    wish->session.overlay_count = p->overlays ? documents->count : 0;
    p->version = c->request.document->version;
}

// The scene of a text that cannot be understood; NULL: the document is not a scene's.
static struct session *broken_scene(struct server *server, const struct document *document) {
    for (uint32_t i = 0; i < server->scenes.count; i++) {
        struct lsp_scene *scene = server->scenes.items[i];
        if (scene->loaded &&
            (str_equal(scene->path, document->path) || lsp_scene_has_file(scene, document->path)))
            return &scene->session;
    }
    return NULL;
}

// Begins to draw for `waiting`, or answers it at once.
static void begin(struct server *server) {
    struct server_preview *p = server->preview;
    const json_t *argument = json_array_get(json_object_get(p->waiting.params, "arguments"), 0);
    const json_t *text_document = json_object_get(argument, "textDocument");
    const char *uri = json_string_value(json_object_get(text_document, "uri"));
    struct document *document = uri ? documents_find(&server->documents, uri) : NULL;
    struct preparing c = {.server = server};
    server_refresh(server, SCENES_QUICK);
    if (!uri ||
        !take_number(argument, "size", PREVIEW_SIZE, PREVIEW_SIZE_LEAST, PREVIEW_SIZE_MOST, &c.size) ||
        !take_number(argument, "samples", PREVIEW_SAMPLES, 1, PREVIEW_SAMPLES_MOST, &c.samples) ||
        !take_seconds(argument, &c.seconds)) {
        refuse(server, &p->waiting, RPC_INVALID_PARAMS,
               "glint.preview takes {textDocument: {uri}, position, size: 16 to 1024, samples: 1 to 256, "
               "seconds: 0.1 to 60}");
        return;
    }
    if (!document) {
        refuse(server, &p->waiting, RPC_REQUEST_FAILED, "this document is not open");
        return;
    }
    struct lsp_scene *scene = scenes_of(&server->scenes, document->path);
    if (!scene) {
        struct session *broken = broken_scene(server, document);
        if (broken)
            rpc_reply(&server->rpc, p->waiting.id, no_picture(server, broken));
        else
            refuse(server, &p->waiting, RPC_REQUEST_FAILED, "this document is not a scene's");
        forget(&p->waiting);
        return;
    }
    c.request =
        (struct request){.server = server, .document = document, .scene = scene, .session = &scene->session};
    c.request.offset =
        position_read(document_text(document), server->encoding, json_object_get(argument, "position"), NULL);
    p->drawn = p->waiting;
    p->waiting = (struct asked){0};
    p->overlays = heap_zeroed(server->documents.count + 1, sizeof *p->overlays);
    arena_init(&p->arena, SIZE_MAX / 2);
    struct arena *arenas[] = {&p->arena, &scene->session.arena, NULL};
    p->cancelled = false;
    if (arena_guarded_all(arenas, prepare, &c) != ARENA_FAULT_NONE) {
        refuse(server, &p->drawn, RPC_REQUEST_FAILED, "there is not enough memory");
        forget_texts(p);
        return;
    }
    p->is_busy = true;
    parallel_start(&p->task, draw, p);
    // Without a thread or a pipe it cannot be drawn in parallel.
    if (!p->task.has_thread || p->wake[0] < 0)
        parallel_wait(&p->task);
}

void server_preview_ask(struct server *server, json_t *id, const json_t *params) {
    struct server_preview *p = server->preview;
    refuse(server, &p->waiting, RPC_CONTENT_MODIFIED, "a newer preview was asked for");
    p->waiting = (struct asked){json_incref(id), json_incref((json_t *)params)};
    server_preview_step(server);
}

void server_preview_cancel(struct server *server, const json_t *id) {
    struct server_preview *p = server->preview;
    if (!p || !id)
        return;
    if (p->waiting.id && json_equal(p->waiting.id, id)) {
        refuse(server, &p->waiting, RPC_REQUEST_CANCELLED, "the preview was cancelled");
    } else if (p->drawn.id && json_equal(p->drawn.id, id)) {
        p->cancelled = true;
        refuse(server, &p->drawn, RPC_REQUEST_CANCELLED, "the preview was cancelled");
    }
}

// The picture is done, or has failed.
static void finish(struct server *server) {
    struct server_preview *p = server->preview;
    end_drawing(p);
    if (p->drawn.id)
        answer(server);
    preview_picture_finish(&p->picture);
    forget_texts(p);
}

bool server_preview_step(struct server *server) {
    struct server_preview *p = server->preview;
    while (p && (p->is_busy ? parallel_is_over(&p->task) : p->waiting.id != NULL)) {
        if (p->is_busy)
            finish(server);
        else
            begin(server);
    }
    return p && p->is_busy;
}
