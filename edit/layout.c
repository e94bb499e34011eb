#include "edit/layout.h"
#include "diag/codes/command.h"
#include "diag/codes/limit.h"

#include "load/session.h"
#include "parser/format/format.h"

struct job {
    struct layout *layout;
    str path, found_in;
    const struct limits *limits;
    bool upgrade;
    bool from_file;
};

static enum layout_status unreadable(struct job *job, enum file_status status) {
    struct layout *layout = job->layout;
    uint32_t source = source_add(&layout->sources, SOURCE_KIND_FILE, job->path, STR(""));
    diag_add(&layout->sink, session_file_code(status), (span){source, 0, 0}, "the scene file %s",
             file_status_text(&layout->files, status));
    if (status == FILE_OUTSIDE)
        diag_help(&layout->sink, "it is a link; to format what it leads to, name the file itself");
    return LAYOUT_UNREADABLE;
}

static enum layout_status failed(struct layout *layout, uint32_t source) {
    if (layout->result.failed)
        diag_add(&layout->sink, DIAG_OUT_OF_MEMORY, (span){source, 0, 0},
                 "not enough memory to format the file");
    else
        diag_add(&layout->sink, DIAG_FORMAT_UNSAFE, (span){source, 0, 0},
                 "in its new layout the file would have another meaning");
    return LAYOUT_FAILED;
}

static enum file_status read_file(struct job *job) {
    struct layout *layout = job->layout;
    const uint64_t most = job->limits->value[LIMIT_SCENE_BYTES];
    if (!job->found_in.len)
        return files_read_given(&layout->files, job->path, most, &layout->arena, &layout->text);
    files_add_scene_root(&layout->files, job->path);
    return files_read_found(&layout->files, job->path, job->found_in, most, &layout->arena, &layout->text);
}

static enum layout_status run(struct job *job) {
    struct layout *layout = job->layout;
    source_set_init(&layout->sources, &layout->arena);
    files_init(&layout->files, &layout->arena);
    if (job->from_file) {
        enum file_status status = read_file(job);
        if (status != FILE_OK)
            return unreadable(job, status);
    }
    uint32_t source = source_add(&layout->sources, SOURCE_KIND_FILE, job->path, layout->text);
    struct reader_context context = {
        .sources = &layout->sources, .sink = &layout->sink, .limits = job->limits, .arena = &layout->arena};
    enum format_status status =
        format_source(&context, source, job->upgrade ? &UPGRADE_STANDARD : NULL, &layout->result);
    if (status == FORMAT_REFUSED)
        return LAYOUT_REFUSED;
    if (status == FORMAT_UNSAFE || layout->result.failed)
        return failed(layout, source);
    return str_equal(layout->text, strbuf_view(&layout->result)) ? LAYOUT_SAME : LAYOUT_CHANGED;
}

static void run_job(void *context) {
    struct job *job = context;
    job->layout->status = run(job);
}

static enum layout_status guarded(struct job *job) {
    struct layout *layout = job->layout;
    diag_sink_init(&layout->sink);
    strbuf_init(&layout->result);
    arena_init(&layout->arena, limits_size(job->limits, LIMIT_SCENE_MEMORY));
    enum arena_fault fault = arena_guarded(&layout->arena, run_job, job);
    if (fault) {
        diag_add(&layout->sink, fault == ARENA_FAULT_CAP ? DIAG_LIMIT : DIAG_OUT_OF_MEMORY, SPAN_NONE,
                 "the scene needs more memory than %s",
                 fault == ARENA_FAULT_CAP ? "the limit" : "is available");
        diag_help(&layout->sink, "raise the limit with --limit %s=BYTES",
                  limit_info(LIMIT_SCENE_MEMORY)->name);
        layout->status = LAYOUT_FAILED;
    }
    diag_sort(&layout->sink);
    return layout->status;
}

enum layout_status layout_text(struct layout *layout, str path, str text, const struct limits *limits,
                               bool upgrade) {
    struct job job = {.layout = layout, .path = path, .limits = limits, .upgrade = upgrade};
    *layout = (struct layout){.text = text};
    return guarded(&job);
}

enum layout_status layout_file(struct layout *layout, str path, str found_in, const struct limits *limits,
                               bool upgrade) {
    struct job job = {layout, path, found_in, limits, upgrade, true};
    *layout = (struct layout){.text = STR("")};
    return guarded(&job);
}

void layout_finish(struct layout *layout) {
    strbuf_finish(&layout->result);
    diag_sink_finish(&layout->sink);
    arena_finish(&layout->arena);
}
