// A scene, loaded: path and options in; sources, IR, places, assets, view and diagnostics out.
//
// The one place that joins the stages; command line, viewer and language server call it. Nothing here
// prints or exits: diagnostics are in `sink`, sorted by session_load.
// Ownership: session_finish frees everything except the store, which outlives sessions.
// Thread safety: a session belongs to one thread; once loaded it is immutable and may be read by many.
#ifndef GLINT_LOAD_SESSION_H
#define GLINT_LOAD_SESSION_H

#include "assets/assets.h"
#include "core/limits.h"
#include "diag/diag.h"
#include "diag/diag_policy.h"
#include "files/files.h"
#include "grammar/ir_origin.h"
#include "lint/lint.h"
#include "load/settings/config.h"
#include "scene/scene.h"
#include "scene/view.h"

struct ir_image;
struct ir_scene;
struct parser_kept;
struct timeline;
struct session_kept;

struct session_options {
    str path;     // of the scene, or of a mesh, which is then a scene with that one model
    str found_in; // the searched folder that it was found in: links must not lead out of what it may read;
                  // empty: the user named the scene
    str named_in; // the folder that paths not named by the user must be below: the scene, if names_scene, and
                  // the last asset path
    bool names_scene;
    const str *asset_paths;
    uint32_t asset_path_count;
    uint32_t named_asset_path_count;
    const str *sets; // PATH=VALUE
    uint32_t set_count;
    struct limits limits;
    const struct file_overlay *overlays; // text that replaces files; it is copied
    uint32_t overlay_count;
    bool text_only;                   // neither meshes nor images are opened
    enum assets_pixels pixels;        // of the background
    int32_t width, height;            // 0: as the scene says
    int32_t samples;                  // 0: as the scene says
    double error;                     // at which a pixel ends; 0: as the scene says; below 0: none ends by it
    enum lint_level lint;             // rules about light that run if the scene has no error; check_scene
                                      // runs all, unless skip_lint
    const struct diag_policy *policy; // laid over that of the folder's configuration; NULL: nothing
    struct baseline_found
        *found;     // for check_scene: takes all findings that a baseline can hold; NULL: not asked
    bool skip_lint; // for check_scene: leaves the rules about light out, and the use of comments unjudged
    // Called once the text is read without errors, before the files that it names are opened: for work that
    // may run in parallel. NULL: nothing.
    void (*on_text)(void *context);
    void *on_text_context;
    bool whole_picture;        // all its pixels are needed at once: more than RANGE_PIXELS_MOST are an error
    bool pixels_later;         // session_load need not wait for the background's pixels: session_settle does
    struct timeline *timeline; // may be NULL
    bool unnamed; // only its beginning is read: the file begins as a scene does, but has another name
    struct session_kept *kept; // of this scene: its files are not read again (session_kept.h). NULL: they are
    bool keeps_written;        // origin.written is the scene as it is written
    bool judged; // the caller judges the findings by policy and comments (load/check.h): they are not yet
                 // sorted
};

// Most samples per pixel if session_options.error is given and neither scene nor options allow enough.
#define SESSION_SAMPLES_MOST 1024

enum session_state {
    SESSION_LOADED,     // there is a scene; the sink may still hold errors
    SESSION_NO_SCENE,   // the text could not be understood at all
    SESSION_UNREADABLE, // the file named on the command line could not be read
    SESSION_IGNORED,    // the policy leaves the file out (where findings are judged)
};

struct session {
    struct session_options options; // with the configuration's limits if none were given
    struct config config;
    bool config_failed;        // errors are in it
    struct diag_policy policy; // the configuration's and, over it, the options'
    struct arena arena;
    struct source_set sources;
    struct files files;
    struct diag_sink sink;
    struct ir_scene *scene;
    struct ir_origin origin;
    span unread;                  // the first include that could not be read; SPAN_NONE: all were
    const struct ir_image *image; // the scene's, with the options' size and samples
    double unused_error;          // the scene's, if no pixel ends by it; 0: it has none, or pixels do
    struct assets assets;
    struct assets unshown; // of objects that nothing shows, while they are judged
    struct scene resolved; // what scene and assets mean together; without assets: nothing
    bool unsettled;        // pixels are still being decoded, and nothing has failed so far
    enum session_state state;
    double read_seconds, assets_seconds, lint_seconds;
    struct parser_kept *parser; // of one whose text is kept (session_kept.h)
};

// Loads `options->path`. Always leaves a session that session_finish accepts, whatever the result.
enum session_state session_load(struct session *session, const struct session_options *options,
                                struct asset_store *store);
void session_finish(struct session *session);
// Completes a session_load that did not wait for pixels, and reports what that finds. Does nothing after one
// that waited. If the caller replaced the sink meanwhile, the original must be back.
void session_settle(struct session *session);
// Reports that there is no memory for `what`.
void session_no_memory(struct session *session, const char *what);
// Reports that the picture has more pixels than can be held at once.
void session_report_pixels(struct session *session);
// The code that is reported for a scene file that cannot be read.
diag_code session_file_code(enum file_status status);
// The input for reading meshes and images of the loaded scene; it points into the session.
struct assets_input session_assets_input(struct session *session);
// The last step of session_load, as options.lint says.
void session_lint(struct session *session);

// Index of the camera of this name, or IR_NO_INDEX with a diagnostic E302. An empty name is the first
// (0, also if the scene has none).
uint32_t session_camera(struct session *session, str name);
// The view through a camera; its lights live in the session. Notes about automatic lights go to the sink.
// false: no memory.
bool session_view(struct session *session, uint32_t camera, struct view *view);
// The origin for flattening: the position of the first camera, or of `view` if the scene has none.
vec3 session_origin(const struct session *session, const struct view *view);

// Changes the paths of a loaded file so that it can be written to `out`, in any folder; warns about files
// that it may not read from there. false: no memory.
bool session_rebase(struct session *session, str out);

// Only one file, for `convert`: no includes, no assets. The IR is origin.files[0].scene too.
enum session_state session_load_text(struct session *session, const struct session_options *options);
// `.glintrc.yaml` by itself: a session without a scene (SESSION_NO_SCENE).
enum session_state session_load_settings(struct session *session, const struct session_options *options);

#endif
