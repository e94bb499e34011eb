#include "assets/file/asset_file.h"

#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "diag/diag_outside.h"
#include "grammar/schema.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum {
    MESSAGE_MAX = 1024,
    KEPT_TEXT_MAX = 256 << 20, // bytes of a file kept to show its lines
};

// Words of a broken file may contain anything: bytes that are not text are shown as '?'.
__attribute__((format(printf, 2, 0))) static void format_message(char message[MESSAGE_MAX],
                                                                 const char *format, va_list args) {
    vsnprintf(message, MESSAGE_MAX, format, args);
    str text = str_from(message);
    for (size_t at = 0; at < text.len;) {
        size_t length = utf8_sequence_length(text, at);
        unsigned char c = (unsigned char)message[at];
        if (length == 0 || c < 0x20 || c == 0x7F)
            message[at] = '?';
        at += length ? length : 1;
    }
}

// The file's text, kept for as long as the sources are; the empty string if it is too large for that.
static str keep_text(const struct asset_file *file) {
    const struct assets_input *input = file->input;
    struct arena *arena = input->sources->arena;
    str text = file->is_binary ? str_slice(file->text, 0, file->head_bytes) : file->text;
    if (text.len > KEPT_TEXT_MAX || (file->is_binary && text.len == 0))
        return STR("");
    if (text.len == 0) {
        uint64_t most = input->limits->value[file->limit];
        most = most < KEPT_TEXT_MAX ? most : KEPT_TEXT_MAX;
        return files_read(input->files, file->path, most, arena, &text) == FILE_OK ? text : STR("");
    }
    char *copy = arena_try_alloc(arena, text.len + 1);
    if (!copy)
        return STR("");
    memcpy(copy, text.ptr, text.len);
    return (str){copy, text.len};
}

static uint32_t source_of(struct asset_file *file) {
    if (file->source == SOURCE_DEFAULT)
        file->source = source_add(file->input->sources, SOURCE_KIND_FILE, file->path, keep_text(file));
    return file->source;
}

static bool is_line_end(str text, size_t at) {
    return text.ptr[at] == '\n' || (text.ptr[at] == '\r' && !(at + 1 < text.len && text.ptr[at + 1] == '\n'));
}

static span whole_file(struct asset_file *file) {
    const bool is_shown = file->source != SOURCE_DEFAULT && !file->is_binary;
    if (!is_shown && file->bare_source == SOURCE_DEFAULT)
        file->bare_source = source_add(file->input->sources, SOURCE_KIND_FILE, file->path, STR(""));
    return (span){is_shown ? file->source : file->bare_source, 0, 0};
}

span asset_line(struct asset_file *file, uint32_t line) {
    if (line == 0 || file->is_binary)
        return whole_file(file);
    struct source_set *sources = file->input->sources;
    span at = source_line_span(sources, source_of(file), line);
    str text = sources->items[at.source].text;
    while (at.begin < at.end && (text.ptr[at.begin] == ' ' || text.ptr[at.begin] == '\t'))
        at.begin++;
    while (at.end > at.begin && (text.ptr[at.end - 1] == ' ' || text.ptr[at.end - 1] == '\t'))
        at.end--;
    return at;
}

struct asset_file *asset_keep(struct asset_file *file) {
    struct asset_file *kept = ARENA_NEW(file->input->arena, struct asset_file);
    if (file->named_in && !file->named_in->is_binary)
        source_of(file->named_in);
    *kept = *file;
    kept->text = STR("");
    kept->document = NULL;
    kept->named_in = file->named_in ? asset_keep(file->named_in) : NULL;
    return kept;
}

static span named_place(struct asset_file *file) {
    return file->named_in ? asset_line(file->named_in, file->named_line) : file->named_at;
}

static void add_named_notes(struct asset_file *file) {
    for (struct asset_file *f = file; f; f = f->named_in)
        if (f->named_in || (f->named_at.source != SOURCE_DEFAULT &&
                            f->input->sources->items[f->named_at.source].kind != SOURCE_KIND_GENERATED))
            diag_note(f->input->sink, named_place(f), "the %s is named here", f->what);
}

static void add_named(struct asset_file *file, diag_code code, const char *message) {
    diag_add(file->input->sink, code, named_place(file), "%s", message);
    file->errors += diag_info(code)->severity == DIAG_ERROR;
    if (file->named_in)
        add_named_notes(file->named_in);
}

void asset_report_named(struct asset_file *file, diag_code code, const char *format, ...) {
    char message[MESSAGE_MAX];
    va_list args;
    va_start(args, format);
    format_message(message, format, args);
    va_end(args);
    add_named(file, code, message);
}

void asset_report_part(struct asset_file *file, const char *format, ...) {
    char message[MESSAGE_MAX];
    va_list args;
    va_start(args, format);
    format_message(message, format, args);
    va_end(args);
    diag_add(file->input->sink, DIAG_UNKNOWN_PART, file->part_at, "%s", message);
    file->errors++;
}

bool asset_only_counts(struct asset_file *file, diag_code code) {
    struct diag_sink *sink = file->input->sink;
    if (!diag_is_full(sink))
        return false;
    diag_add(sink, code, SPAN_NONE, " ");
    file->errors += diag_info(code)->severity == DIAG_ERROR;
    return true;
}

// `line` is the line of the place, for files whose text is not kept; 0 is the whole file.
__attribute__((format(printf, 5, 0))) static void report(struct asset_file *file, diag_code code, span at,
                                                         uint32_t line, const char *format, va_list args) {
    const struct assets_input *input = file->input;
    char message[MESSAGE_MAX];
    format_message(message, format, args);
    if (line > 0 && (file->is_binary || input->sources->items[at.source].text.len == 0))
        diag_add(input->sink, code, at, "%s %u: %s", file->is_binary ? "face" : "line", line, message);
    else
        diag_add(input->sink, code, at, "%s", message);
    file->errors += diag_info(code)->severity == DIAG_ERROR;
    add_named_notes(file);
}

// The line of a place in a text that is not kept as a source; 0 for others, which know their lines. Places
// mostly come in order, so lines are counted from the last one.
static uint32_t line_if_not_kept(struct asset_file *file, size_t offset) {
    if (file->is_binary || file->input->sources->items[source_of(file)].text.len)
        return 0;
    if (offset < file->counted_bytes || file->counted_line == 0) {
        file->counted_bytes = 0;
        file->counted_line = 1;
    }
    for (; file->counted_bytes < offset && file->counted_bytes < file->text.len; file->counted_bytes++)
        file->counted_line += is_line_end(file->text, file->counted_bytes);
    return file->counted_line;
}

bool asset_report(struct asset_file *file, diag_code code, size_t begin, size_t end, const char *format,
                  ...) {
    if (asset_only_counts(file, code))
        return false;
    va_list args;
    va_start(args, format);
    span at = {source_of(file), (uint32_t)begin, (uint32_t)end};
    report(file, code, at, line_if_not_kept(file, begin), format, args);
    va_end(args);
    return true;
}

bool asset_report_line(struct asset_file *file, diag_code code, uint32_t line, const char *format, ...) {
    if (asset_only_counts(file, code))
        return false;
    va_list args;
    va_start(args, format);
    report(file, code, asset_line(file, line), line, format, args);
    va_end(args);
    return true;
}

bool asset_report_byte(struct asset_file *file, diag_code code, uint64_t byte, const char *format, ...) {
    if (asset_only_counts(file, code))
        return false;
    char message[MESSAGE_MAX];
    va_list args;
    va_start(args, format);
    format_message(message, format, args);
    va_end(args);
    diag_add(file->input->sink, code, whole_file(file), "byte %llu: %s", (unsigned long long)byte, message);
    file->errors += diag_info(code)->severity == DIAG_ERROR;
    add_named_notes(file);
    return true;
}

void asset_report_limit(struct asset_file *file, enum limit limit, size_t begin, size_t end,
                        uint64_t needed) {
    const struct limit_info *info = limit_info(limit);
    uint64_t value = file->input->limits->value[limit];
    if (!asset_report(file, DIAG_LIMIT, begin, end, "the %s exceeds the limit %s of %llu", file->what,
                      info->name, (unsigned long long)value))
        return;
    if (needed <= info->greatest)
        diag_help(file->input->sink, "if the file is right, raise the limit: --limit %s=%llu", info->name,
                  (unsigned long long)needed);
}

bool asset_fits_growth(const struct assets_input *input, uint64_t bytes, uint64_t file_bytes) {
    return bytes <= input->limits->value[LIMIT_IMAGE_GROWTH] || bytes / ASSET_IMAGE_GROWTH < file_bytes;
}

void asset_report_memory(struct asset_file *file, enum arena_fault fault) {
    if (fault == ARENA_FAULT_CAP) {
        asset_report_named(file, DIAG_LIMIT,
                           "the %s '%.*s' needs more memory than the limit %s of %llu bytes", file->what,
                           STR_ARG(file->path), limit_info(LIMIT_MESH_MEMORY)->name,
                           (unsigned long long)file->input->limits->value[LIMIT_MESH_MEMORY]);
        diag_help(file->input->sink, "raise the limit with --limit %s=BYTES",
                  limit_info(LIMIT_MESH_MEMORY)->name);
    } else {
        asset_report_named(file, DIAG_OUT_OF_MEMORY, "there is not enough memory for the %s '%.*s'",
                           file->what, STR_ARG(file->path));
    }
}

str asset_base(const struct assets_input *input, span at) {
    uint32_t source = at.source;
    const struct source *s = &input->sources->items[source < input->sources->count ? source : SOURCE_DEFAULT];
    if ((s->kind == SOURCE_KIND_OPTION || s->kind == SOURCE_KIND_DEFAULT) && input->origin->files.count)
        s = &input->sources->items[input->origin->files.items[0].source];
    bool is_file =
        s->kind == SOURCE_KIND_FILE || s->kind == SOURCE_KIND_OVERLAY || s->kind == SOURCE_KIND_GENERATED;
    return is_file ? s->path : STR("");
}

static void report_missing(struct asset_file *file, str path) {
    asset_report_named(file, DIAG_FILE_MISSING, "the %s '%.*s' does not exist", file->what, STR_ARG(path));
    const enum schema_file kind = file->limit == LIMIT_IMAGE_BYTES  ? SCHEMA_FILE_IMAGE
                                  : file->limit == LIMIT_FONT_BYTES ? SCHEMA_FILE_FONT
                                                                    : SCHEMA_FILE_MESH;
    str near = files_suggest(file->input->files, file->path, schema_file_endings(kind));
    str folder = str_slice(path, 0, path.len - path_base(path).len);
    str advice = files_advice(file->input->files->arena, path);
    if (advice.len) {
        diag_help(file->input->sink, "%.*s", STR_ARG(advice));
    } else if (near.len) {
        diag_help(file->input->sink, "did you mean '%.*s%.*s'?", STR_ARG(folder), STR_ARG(near));
        diag_fix_part(file->input->sink, file->input->sources, false, path_base(path), near);
    } else {
        diag_help(file->input->sink, "glint looked for '%.*s'; --asset-path DIR adds a folder to look in",
                  STR_ARG(file->path));
    }
}

// Reports why the file named `path` is not read.
static void refuse(struct asset_file *file, str path, enum file_status status, uint64_t size) {
    const struct assets_input *input = file->input;
    switch (status) {
    case FILE_MISSING:
        report_missing(file, path);
        return;
    case FILE_OUTSIDE:
        asset_report_named(file, DIAG_FILE_OUTSIDE, "the %s '%.*s' lies outside the scene's folder: '%.*s'",
                           file->what, STR_ARG(path), STR_ARG(file->path));
        diag_outside(input->sink, input->files, path, file->path);
        return;
    case FILE_NOT_REGULAR:
        asset_report_named(file, DIAG_FILE_NOT_REGULAR, "the %s '%.*s' is not a regular file", file->what,
                           STR_ARG(path));
        return;
    case FILE_TOO_LARGE:
        asset_report_named(file, DIAG_LIMIT, "the %s '%.*s' has %llu bytes; the limit %s is %llu", file->what,
                           STR_ARG(path), (unsigned long long)size, limit_info(file->limit)->name,
                           (unsigned long long)input->limits->value[file->limit]);
        if (size <= limit_info(file->limit)->greatest)
            diag_help(input->sink, "if the file is right, raise the limit: --limit %s=%llu",
                      limit_info(file->limit)->name, (unsigned long long)size);
        return;
    case FILE_NO_MEMORY:
        asset_report_memory(file, size ? ARENA_FAULT_CAP : ARENA_FAULT_SYSTEM);
        return;
    default:
        asset_report_named(file, DIAG_FILE_UNREADABLE, "the %s '%.*s' cannot be read: %s", file->what,
                           STR_ARG(path), file_status_text(input->files, status));
    }
}

void asset_note_again(const struct asset_file *file, span at, str named, str canonical, uint64_t size_bytes) {
    const struct assets_input *input = file->input;
    if (input->uses)
        *ARENA_PUSH(input->arena, input->uses) = (struct asset_use){.what = file->what,
                                                                    .named = named,
                                                                    .path = file->path,
                                                                    .canonical = canonical,
                                                                    .size_bytes = size_bytes,
                                                                    .at = at,
                                                                    .named_in = STR("")};
}

static void note_use(const struct asset_file *file, str named, const struct file_read *identity) {
    const struct assets_input *input = file->input;
    if (!input->uses)
        return;
    *ARENA_PUSH(input->arena, input->uses) =
        (struct asset_use){.what = file->what,
                           .named = arena_copy(input->arena, named),
                           .path = file->path,
                           .canonical = arena_copy(input->arena, identity->path),
                           .size_bytes = identity->size_bytes,
                           .at = file->named_in ? file->named_in->named_at : file->named_at,
                           .named_in = file->named_in ? file->named_in->path : STR(""),
                           .named_line = file->named_line};
}

bool asset_find(struct asset_file *file, str base_path, str path, struct file_read *identity, bool *missing) {
    struct files *files = file->input->files;
    enum file_status status = files_resolve(files, base_path, path, &file->path);
    if (missing)
        *missing = status == FILE_MISSING;
    if (status == FILE_MISSING && missing)
        return false;
    if (status == FILE_OK)
        status = files_identify(files, file->path, identity);
    if (status == FILE_OK && identity->size_bytes > file->input->limits->value[file->limit])
        status = FILE_TOO_LARGE;
    if (status == FILE_OK)
        note_use(file, path, identity);
    else
        refuse(file, path, status, status == FILE_TOO_LARGE ? identity->size_bytes : 0);
    return status == FILE_OK;
}

bool asset_read(struct asset_file *file, struct arena *arena) {
    const struct assets_input *input = file->input;
    uint64_t cap = input->limits->value[file->limit];
    enum file_status status = files_read(input->files, file->path, cap, arena, &file->text);
    if (status == FILE_OK)
        return true;
    refuse(file, file->path, status, status == FILE_NO_MEMORY && arena->cap_bytes <= cap);
    return false;
}
