#include "diag/diag_report.h"

#include "core/heap.h"
#include "diag/source.h"
#include "files/files.h"

#include <stdlib.h>
#include <string.h>

enum {
    SCENE_BYTES_MAX = 256 * 1024 * 1024,
    FINDING_BYTES = 550, // average per kept finding in the longest format: 100 stay below 64 KB
    FINDING_OVERHEAD = 430,
    NOTE_OVERHEAD = 300,
    VALUE_OVERHEAD = 10,
    FIX_OVERHEAD = 400,
    LINE_BYTES_MAX = 400,
};

void report_scene_init(struct report_scene *scene, str path) {
    *scene = (struct report_scene){.path = path};
    arena_init(&scene->arena, SCENE_BYTES_MAX);
}

void report_scene_finish(struct report_scene *scene) {
    if (scene)
        arena_finish(&scene->arena);
}

// ---- paths

// Writes `path` without "." and with ".." resolved, where there is a folder to remove; returns its length.
static size_t tidy(char *out, str path) {
    size_t length = 0;
    size_t floor = 0; // what ".." cannot remove
    bool absolute = path.len && path.ptr[0] == '/';
    if (absolute)
        out[length++] = '/';
    floor = length;
    for (size_t at = 0; at < path.len;) {
        size_t end = at;
        while (end < path.len && path.ptr[end] != '/')
            end++;
        str part = str_slice(path, at, end);
        at = end + 1;
        if (part.len == 0 || str_equal_cstr(part, "."))
            continue;
        if (str_equal_cstr(part, "..") && length > floor) {
            while (length > floor && out[length - 1] != '/')
                length--;
            length -= length > floor;
            continue;
        }
        if (str_equal_cstr(part, "..") && absolute)
            continue;
        if (length > 0 && out[length - 1] != '/')
            out[length++] = '/';
        memcpy(out + length, part.ptr, part.len);
        length += part.len;
        floor = str_equal_cstr(part, "..") ? length : floor;
    }
    return length;
}

str report_path(struct arena *arena, const char *root, str path) {
    char *text = arena_alloc(arena, path.len + 2);
    str tidied = {text, tidy(text, path)};
    str rest;
    if (root && root[0] == '/' && path_is_below(tidied, str_from(root), &rest) && rest.len)
        return rest;
    return tidied.len ? tidied : STR(".");
}

// ---- findings

struct adder {
    struct report_scene *scene;
    const struct report_input *input;
    size_t bytes; // of the kept texts
    bool error_kept;
};

static struct report_place place_of(struct adder *adder, struct source_place place) {
    struct report_place out = {.line = place.line,
                               .column = place.column,
                               .end_line = place.end_line,
                               .end_column = place.end_column};
    out.path = report_path(&adder->scene->arena, adder->input->root, place.path);
    return out;
}

static void add_notes(struct adder *adder, struct report_finding *finding, const struct diag *d) {
    struct arena *arena = &adder->scene->arena;
    for (const struct diag_related *n = d->notes; n; n = n->next)
        finding->note_count++;
    finding->notes = ARENA_ARRAY(arena, struct report_note, finding->note_count);
    struct report_note *note = finding->notes;
    for (const struct diag_related *n = d->notes; n; n = n->next, note++) {
        if (!span_is_none(n->at))
            note->at = place_of(adder, source_locate(adder->input->sources, n->at));
        note->message = arena_copy(arena, n->message);
        adder->bytes += NOTE_OVERHEAD + note->message.len + note->at.path.len;
    }
}

static void add_values(struct adder *adder, struct report_finding *finding, const struct diag *d) {
    struct arena *arena = &adder->scene->arena;
    struct diag_value **end = &finding->with;
    for (const struct diag_value *v = d->with; v; v = v->next, end = &(*end)->next) {
        *end = ARENA_NEW(arena, struct diag_value);
        **end = (struct diag_value){.name = arena_copy(arena, v->name), .value = arena_copy(arena, v->value)};
        adder->bytes += VALUE_OVERHEAD + v->name.len + v->value.len;
    }
    finding->copies = d->copies;
}

// If the finding itself is not in a scene, the place that names its file is.
static str scene_path_of(struct adder *adder, const struct diag *d) {
    const struct report_input *input = adder->input;
    if (!input->find_path)
        return STR("");
    str path = input->find_path(input->context, &adder->scene->arena, d->at);
    for (const struct diag_related *n = d->notes; n && path.len == 0; n = n->next)
        if (n->at.source != d->at.source && !span_is_none(n->at))
            path = input->find_path(input->context, &adder->scene->arena, n->at);
    return path;
}

// Whether a place is in a file: an option has no line that a reader of reports could open.
static bool is_in_file(const struct adder *adder, span at) {
    const struct source_set *sources = adder->input->sources;
    enum source_kind kind = at.source < sources->count ? sources->items[at.source].kind : SOURCE_KIND_DEFAULT;
    return kind != SOURCE_KIND_DEFAULT && kind != SOURCE_KIND_OPTION;
}

// Puts a finding that is not in a file at the beginning of the scene, and says where it is.
static void place_in_scene(struct adder *adder, struct report_finding *finding, struct source_place place) {
    struct arena *arena = &adder->scene->arena;
    if (place.line_text.len)
        finding->message = arena_format(arena, "%.*s (in %.*s %.*s)", STR_ARG(finding->message),
                                        STR_ARG(place.path), STR_ARG(finding->line_text));
    str path = report_path(arena, adder->input->root, adder->scene->path);
    finding->at = (struct report_place){path, 1, 1, 1, 1};
    finding->has_fix = false;
}

static void add_finding(struct adder *adder, const struct diag *d) {
    struct report_scene *scene = adder->scene;
    struct arena *arena = &scene->arena;
    struct source_place place = source_locate(adder->input->sources, d->at);
    str line = str_trim(str_slice(place.line_text, 0, LINE_BYTES_MAX));
    struct report_finding finding = {.code = d->code,
                                     .severity = d->severity,
                                     .at = place_of(adder, place),
                                     .message = arena_copy(arena, d->message),
                                     .help = arena_copy(arena, d->help),
                                     .line_text = arena_copy(arena, line),
                                     .has_fix = d->has_fix,
                                     .fix_is_safe = d->fix_is_safe};
    if (!is_in_file(adder, d->at))
        place_in_scene(adder, &finding, place);
    finding.scene_path = scene_path_of(adder, d);
    add_notes(adder, &finding, d);
    add_values(adder, &finding, d);
    if (finding.has_fix) {
        finding.fix_at = place_of(adder, source_locate(adder->input->sources, d->fix_at));
        finding.fix_text = arena_copy(arena, d->fix_text);
    }
    adder->bytes += FINDING_OVERHEAD + finding.message.len + finding.help.len + finding.at.path.len;
    adder->bytes += finding.has_fix ? FIX_OVERHEAD + finding.fix_text.len : 0;
    *ARENA_PUSH(arena, &scene->findings) = finding;
}

static void add_all(void *context) {
    struct adder *adder = context;
    const struct report_input *input = adder->input;
    struct diag_hidden *left_out = &adder->scene->left_out;
    struct diag_share share = diag_share_begin(input->sink, input->most, 0, true);
    bool bounded = input->most <= diag_share_standard();
    diag_hide_dropped(left_out, input->sink, true);
    for (uint32_t i = 0; i < input->sink->count; i++) {
        const struct diag *d = &input->sink->items[i];
        bool first_error = d->severity == DIAG_ERROR && !adder->error_kept;
        bool full = bounded && adder->bytes >= (size_t)input->most * FINDING_BYTES;
        if ((full && !first_error) || !diag_share_takes(&share, d, first_error)) {
            diag_hide(left_out, d->code, 1);
            continue;
        }
        adder->error_kept = adder->error_kept || first_error;
        add_finding(adder, d);
    }
}

bool report_scene_add(struct report_scene *scene, const struct report_input *input) {
    struct adder adder = {.scene = scene, .input = input};
    scene->errors = input->sink->errors;
    scene->warnings = input->sink->warnings;
    scene->notes = input->sink->notes;
    if (input->most > diag_share_standard())
        scene->arena.cap_bytes = SIZE_MAX / 2; // the user asked for that many
    return arena_guarded(&scene->arena, add_all, &adder) == ARENA_FAULT_NONE;
}

uint32_t report_needed(const struct report_scene *scene) {
    return diag_share_needed(scene->findings.count + scene->left_out.count);
}

// ---- one list

static uint64_t mix(uint64_t h, str text) {
    return (h ^ str_hash(text)) * UINT64_C(0x9E3779B97F4A7C15) + 1;
}

// A number for a finding that stays the same when lines before it change: a hash of its code, file, message
// and line.
static uint64_t report_fingerprint(const struct report_finding *finding) {
    uint64_t h = mix(0, str_from(diag_info(finding->code)->code));
    h = mix(h, finding->at.path);
    h = mix(h, finding->message);
    h = mix(h, finding->line_text);
    return h ^ h >> 31;
}

static bool same_place(const struct report_finding *a, const struct report_finding *b) {
    return a->code == b->code && a->at.line == b->at.line && a->at.column == b->at.column &&
           str_equal(a->at.path, b->at.path) && str_equal(a->message, b->message);
}

struct slots {
    uint32_t *items; // 1 + index in the list
    size_t count;    // a power of two
};

static uint64_t place_hash(uint64_t fingerprint, const struct report_finding *finding) {
    uint64_t h = (fingerprint ^ finding->at.line) * UINT64_C(0x9E3779B97F4A7C15);
    h = (h ^ finding->at.column) * UINT64_C(0x9E3779B97F4A7C15);
    return h ^ h >> 29;
}

// Adds the finding unless another scene has already added it. `places` finds the findings of one place,
// `lines` the last one with a fingerprint: thousands may share it, so they are not searched one by one.
static void add_item(struct report_list *list, struct slots places, struct slots lines,
                     const struct report_finding *finding, uint32_t scene) {
    uint64_t fingerprint = report_fingerprint(finding);
    size_t at = (size_t)place_hash(fingerprint, finding) & (places.count - 1);
    for (; places.items[at]; at = (at + 1) & (places.count - 1))
        if (same_place(list->items[places.items[at] - 1].finding, finding))
            return;
    size_t line = (size_t)fingerprint & (lines.count - 1);
    while (lines.items[line] && list->items[lines.items[line] - 1].fingerprint != fingerprint)
        line = (line + 1) & (lines.count - 1);
    uint32_t before = lines.items[line] ? list->items[lines.items[line] - 1].occurrence : 0;
    list->items[list->count++] = (struct report_item){finding, scene, fingerprint, before + 1};
    places.items[at] = lines.items[line] = list->count;
}

bool report_list_all(const struct report *report, struct report_list *list) {
    size_t total = 0;
    *list = (struct report_list){0};
    for (uint32_t i = 0; i < report->scene_count; i++)
        total += report->scenes[i].findings.count;
    size_t slot_count = 16;
    while (slot_count < total * 2)
        slot_count *= 2;
    struct slots places = {heap_zeroed(slot_count, sizeof(uint32_t)), slot_count};
    struct slots lines = {heap_zeroed(slot_count, sizeof(uint32_t)), slot_count};
    list->items = heap_zeroed(total + 1, sizeof *list->items);
    bool good = places.items && lines.items && list->items;
    for (uint32_t i = 0; i < report->scene_count && good; i++)
        for (uint32_t k = 0; k < report->scenes[i].findings.count; k++)
            add_item(list, places, lines, &report->scenes[i].findings.items[k], i);
    free(places.items);
    free(lines.items);
    return good;
}
