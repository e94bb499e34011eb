#include "load/check.h"
#include "diag/codes/rule.h"

#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"
#include "load/check_allow.h"
#include "load/check_path.h"

#include <stdlib.h>

// ---- judging

struct judge {
    const struct diag_policy *policy;
    const bool *ignored; // by source
    uint32_t sources;
};

static bool keeps(void *context, struct diag *item) {
    const struct judge *judge = context;
    bool ignored = item->at.source < judge->sources && judge->ignored[item->at.source];
    return diag_policy_keeps(judge->policy, item, ignored);
}

static void apply_policy(void *context) {
    struct session *session = context;
    uint32_t count = session->sources.count;
    bool *ignored = ARENA_ARRAY(&session->arena, bool, count);
    for (uint32_t i = 0; i < count && session->policy.ignored.count; i++) {
        const struct source *source = &session->sources.items[i];
        ignored[i] = source->kind == SOURCE_KIND_FILE &&
                     diag_policy_ignores(&session->policy, files_canonical(&session->files, source->path));
    }
    struct judge judge = {&session->policy, ignored, count};
    diag_filter(&session->sink, keeps, &judge);
}

// Whether a file only holds things for others to use: it has no body and no background, so its picture would
// show nothing, but it defines materials, objects, cameras or lights.
bool check_is_library(const struct ir_scene *scene) {
    const uint32_t objects = scene->copies ? scene->copies->objects.count : 0;
    return ir_body_count(scene) == 0 && !scene->background.head.written &&
           scene->materials.count + scene->cameras.count + scene->lights.count + objects > 0;
}

static bool is_not_about_view(void *context, struct diag *item) {
    (void)context;
    return item->code != DIAG_DEFAULT_CAMERA && item->code != DIAG_DEFAULT_LIGHT;
}

// Notes what replaces a missing camera or light. A library gets no notes: it uses those of other files.
static void note_view(struct session *session) {
    struct view view;
    if (session->state != SESSION_LOADED || session->sink.errors)
        return;
    if (!session_view(session, 0, &view))
        session_no_memory(session, "the view"); // as rendering says
    if (check_is_library(session->scene))
        diag_filter(&session->sink, is_not_about_view, NULL);
}

enum session_state check_scene(struct session *session, const struct session_options *options,
                               struct asset_store *store) {
    struct session_options judged = *options;
    judged.judged = true;
    judged.pixels = options->pixels == ASSETS_SKIP_PIXELS ? ASSETS_SKIP_PIXELS : ASSETS_CHECK_PIXELS;
    judged.lint = options->skip_lint ? LINT_NONE : LINT_ALL;
    session_load(session, &judged, store);
    note_view(session);
    check_allow(session, !options->skip_lint);
    arena_guarded(&session->arena, apply_policy, session);
    diag_sort(&session->sink);
    return session->state;
}

bool check_failed(const struct session *session) {
    return session->state == SESSION_UNREADABLE || diag_policy_fails(&session->policy, &session->sink);
}

// ---- the record

// Of the whole scene: what it includes has been merged into it.
static void count_lists(struct report_scene *out, const struct ir_scene *scene) {
    struct report_assets *a = &out->assets;
    a->counts = ARENA_ARRAY(&out->arena, struct report_count, SCHEMA_SCENE.row_count);
    for (uint32_t i = 0; i < SCHEMA_SCENE.row_count; i++) {
        const struct schema_row *row = &SCHEMA_SCENE.rows[i];
        if (row->kind == SCHEMA_LIST && row->child != &SCHEMA_INCLUDE && row->child != &SCHEMA_OBJECT)
            a->counts[a->count_count++] =
                (struct report_count){schema_yaml_key(row), ir_walk_list(row, scene).count};
    }
}

struct filling {
    struct report_scene *out;
    const struct session *session;
    const char *root;
};

static int compare_paths(const void *a, const void *b) {
    return str_compare(((const struct report_file *)a)->path, ((const struct report_file *)b)->path);
}

static void fill_assets(void *context) {
    const struct filling *filling = context;
    struct report_scene *out = filling->out;
    const struct session *session = filling->session;
    const struct ir_scene *scene = session->scene;
    struct report_assets *a = &out->assets;
    count_lists(out, scene);
    a->triangles = session->assets.triangle_count;
    if (session->assets.background) {
        a->image_width = session->assets.background->width;
        a->image_height = session->assets.background->height;
    }
    a->files = ARENA_ARRAY(&out->arena, struct report_file, session->files.log.count);
    for (uint32_t i = 0; i < session->files.log.count; i++) {
        const struct file_read *read = &session->files.log.items[i];
        str path = arena_copy(&out->arena, report_path(&out->arena, filling->root, read->path));
        a->files[a->file_count++] = (struct report_file){path, read->size_bytes};
    }
    // The order in which meshes are read depends on the number of processors.
    qsort(a->files, a->file_count, sizeof *a->files, compare_paths);
    out->has_assets = true;
}

static str find_path(void *context, struct arena *arena, span at) {
    return check_scene_path(context, arena, at);
}

static enum report_state state_of(const struct session *session) {
    if (session->state == SESSION_IGNORED)
        return session->sink.errors ? REPORT_FAILED : REPORT_IGNORED;
    if (session->state == SESSION_UNREADABLE)
        return REPORT_UNREADABLE;
    return check_failed(session) ? REPORT_FAILED : REPORT_PASSED;
}

bool check_report(struct report_scene *out, struct session *session, const char *root) {
    struct report_input input = {.sink = &session->sink,
                                 .sources = &session->sources,
                                 .root = root,
                                 .most = (uint32_t)session->options.limits.value[LIMIT_MESSAGES],
                                 .find_path = find_path,
                                 .context = session};
    struct filling filling = {out, session, root};
    out->state = state_of(session);
    if (!report_scene_add(out, &input))
        return false;
    return !session->scene || arena_guarded(&out->arena, fill_assets, &filling) == ARENA_FAULT_NONE;
}
