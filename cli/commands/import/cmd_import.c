// glint import MESH -o SCENE: a scene to edit, and beside it the images that it needs.
#include "cli/commands/commands.h"
#include "cli/made.h"
#include "diag/codes/command.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "edit/convert.h"
#include "grammar/mesh_format.h"
#include "grammar/schema.h"
#include "load/import/plan.h"
#include "load/import/scene_text.h"

#include <string.h>
#include <sys/stat.h>

struct import_job {
    struct cli *cli;
    struct session *session;
    struct asset_store *store;
    struct assets around; // what was loaded to look around it
    const char *out;
    enum import_spelling spelling;
    struct gltf_document *document;
    struct import_plan plan;
    struct strbuf text;
    bool good;
};

static bool is_mistaken(struct cli *cli) {
    enum convert_spelling spelling;
    const str mesh = str_from(cli->operands[0]);
    if (mesh_format_of_path(mesh) != MESH_FORMAT_GLTF) {
        cli_usage(cli, cli_operand_place(cli, 0), "'%s' is not a glTF file (.glb, .gltf)", cli->operands[0]);
        diag_help(&cli->sink, "a mesh of another format is named in a scene: models: [{mesh: %s}]",
                  cli->operands[0]);
        return true;
    }
    const char *out = cli->options.output;
    if (!out || strcmp(out, "-") == 0 || convert_spelling_of(str_from(out), &spelling))
        return false;
    cli_usage(cli, cli_option_place(cli, "output"), "the output '%s' must end in %s", out,
              schema_file_words(SCHEMA_FILE_SCENE, &cli->arena).ptr);
    diag_help(&cli->sink, "the ending says in which spelling the scene is written");
    return true;
}

// The glTF file's name in the current folder.
static const char *default_output(struct cli *cli) {
    const str base = path_base(str_from(cli->operands[0]));
    size_t end = base.len;
    while (end > 1 && base.ptr[end - 1] != '.')
        end--;
    return arena_format(&cli->arena, "%.*sglint.yaml", STR_ARG(str_slice(base, 0, end))).ptr;
}

// ---- making

// A mesh that the scene could not read from its folder.
static void warn_beyond(struct import_job *job) {
    struct session *session = job->session;
    struct files there;
    const str out = str_from(job->out);
    str found;
    files_init(&there, &session->arena);
    files_add_scene_root(&there, out);
    for (uint32_t i = 0; i < session->options.asset_path_count; i++)
        files_add_root(&there, session->options.asset_paths[i]);
    if (files_resolve(&there, out, job->plan.mesh, &found) != FILE_OUTSIDE)
        return;
    diag_add(&session->sink, DIAG_FILE_BEYOND, SPAN_NONE,
             "the scene '%s' names '%.*s', which is outside the folder that it may read", job->out,
             STR_ARG(job->plan.mesh));
    diag_help(&session->sink,
              "copy the file beside the scene, use the scene with --asset-path %.*s, or put an empty "
              ".glintrc.yaml in a "
              "folder above both",
              STR_ARG(files_canonical(&session->files, path_folder(session->options.path))));
}

// What is wrong with the file was reported when it was loaded as a scene.
static void make(void *context) {
    struct import_job *job = context;
    struct diag_sink quiet = {0};
    struct assets_input input = session_assets_input(job->session);
    input.sink = &quiet;
    const struct import_source source = {&input, job->store, &job->around, 0, 0};
    job->document = import_open(&input, job->session->options.path);
    const struct ir_scene *around = job->document ? import_around(&source, job->document) : NULL;
    const str out = strcmp(job->out, "-") == 0 ? STR("") : str_from(job->out);
    job->good = job->document && import_plan_make(job->document, around, out, &job->plan);
    if (job->good)
        import_plan_write(&job->plan, job->spelling, &job->text);
    job->good = job->good && !job->text.failed;
    if (job->good && out.len)
        warn_beyond(job);
    diag_sink_finish(&quiet);
}

// ---- writing

static bool is_there(struct cli *cli, const char *path) {
    struct stat info;
    if (cli->options.force || strcmp(path, "-") == 0 || lstat(path, &info) != 0)
        return false;
    cli_error(cli, DIAG_OUTPUT, path, "choose another name with -o, or add --force to overwrite it",
              "the file exists");
    return true;
}

static void tell(struct cli *cli, const char *path) {
    if (!cli->options.quiet)
        cli_write_error(arena_format(&cli->arena, "glint: wrote %s\n", path));
}

// Writes nothing if one of the files is there already.
static int write_all(struct import_job *job) {
    bool found = is_there(job->cli, job->out);
    for (uint32_t i = 0; i < job->plan.images.count; i++)
        found |= is_there(job->cli, job->plan.images.items[i].path.ptr);
    if (found)
        return CLI_FILE;
    for (uint32_t i = 0; i < job->plan.images.count; i++) {
        const int status = cli_judge_made(job->cli, job->out, job->plan.images.items[i].path.ptr);
        if (status != CLI_OK)
            return status;
    }
    for (uint32_t i = 0; i < job->plan.images.count; i++) {
        const struct import_file *file = &job->plan.images.items[i];
        const int status = cli_write(job->cli, file->path.ptr, file->bytes);
        if (status != CLI_OK)
            return status;
        tell(job->cli, file->path.ptr);
    }
    const int status = cli_write(job->cli, job->out, strbuf_view(&job->text));
    if (status == CLI_OK && strcmp(job->out, "-") != 0)
        tell(job->cli, job->out);
    return status;
}

static int import(struct import_job *job) {
    strbuf_init(&job->text);
    const enum arena_fault fault = arena_guarded(&job->session->arena, make, job);
    if (fault || !job->good)
        diag_add(&job->session->sink, DIAG_OUT_OF_MEMORY, SPAN_NONE, "not enough memory to import this file");
    int status = cli_report(job->cli, job->session, false);
    if (status == CLI_OK)
        status = write_all(job);
    gltf_documents_finish(job->document);
    assets_finish(&job->around);
    strbuf_finish(&job->text);
    return status;
}

int cmd_import(struct cli *cli) {
    struct session session;
    enum convert_spelling spelling = CONVERT_YAML;
    if (is_mistaken(cli))
        return CLI_USAGE;
    struct import_job job = {.cli = cli, .session = &session};
    job.out = cli->options.output ? cli->options.output : default_output(cli);
    const int named = cli->options.output ? CLI_OK : cli_judge_made(cli, "", job.out);
    if (named != CLI_OK)
        return named;
    convert_spelling_of(str_from(job.out), &spelling);
    job.spelling = spelling == CONVERT_XML    ? IMPORT_XML
                   : spelling == CONVERT_JSON ? IMPORT_JSON
                                              : IMPORT_YAML;
    struct session_options options = cli_session_options(cli, cli->operands[0]);
    options.pixels = ASSETS_CHECK_PIXELS;
    struct asset_store *store = asset_store_create();
    session_load(&session, &options, store);
    const bool good = session.state == SESSION_LOADED && session.sink.errors == 0;
    job.store = store;
    const int status = good ? import(&job) : cli_report(cli, &session, false);
    session_finish(&session);
    asset_store_destroy(store);
    return status;
}
