#include "diag/codes/binding.h"
#include "parser/bind/say.h"
#include "parser/stages/override.h"

#include "core/number.h"

#include <string.h>

// In the file, a track's text may be written with quotes or references: then all of it is shown.
static span at(const struct override *o, size_t begin, size_t end) {
    if (!o->is_track)
        return (span){o->source, (uint32_t)begin, (uint32_t)end};
    str written = source_text(o->loader->input->sources, o->track);
    uint32_t skipped = 0;
    if (written.len == o->text.len + 2 && (written.ptr[0] == '"' || written.ptr[0] == '\'')) {
        written = str_slice(written, 1, written.len - 1);
        skipped = 1;
    }
    if (!str_equal(written, o->text))
        return o->track;
    const uint32_t first = o->track.begin + skipped;
    const size_t last = end < o->text.len ? end : o->text.len;
    return (span){o->track.source, first + (uint32_t)begin, first + (uint32_t)(last > begin ? last : begin)};
}

diag_code override_code(const struct override *o, diag_code code) {
    return o->is_track ? DIAG_TRACK_TARGET : code;
}

static bool syntax(struct override *o, span where, const char *what) {
    struct diag_sink *sink = o->loader->input->sink;
    diag_add(sink, override_code(o, DIAG_SET_SYNTAX), where, "%s", what);
    if (o->is_track)
        diag_help(sink,
                  "the form is that of --set, for example camera.position or models[ball].translation.y");
    else
        diag_help(sink, "the form is PATH=VALUE, for example image.width=640 or lights[0].intensity=2");
    return false;
}

// The first '=' outside brackets; the length of the text if there is none. *open: a bracket is not closed.
static size_t find_equals(str text, bool *open) {
    uint32_t depth = 0;
    for (size_t i = 0; i < text.len; i++) {
        if (text.ptr[i] == '[')
            depth++;
        else if (text.ptr[i] == ']')
            depth -= depth > 0;
        else if (text.ptr[i] == '=' && depth == 0)
            return i;
    }
    *open = depth > 0;
    return text.len;
}

static bool add_step(struct override *o, struct override_step step) {
    if (o->step_count == OVERRIDE_STEPS_MAX)
        return syntax(o, step.at, "the path has more steps than a scene can have");
    o->steps[o->step_count++] = step;
    return true;
}

static bool add_key(struct override *o, size_t begin, size_t end) {
    if (begin == end)
        return syntax(o, at(o, begin, end + 1), "a key is missing here");
    return add_step(o, (struct override_step){.kind = OVERRIDE_KEY,
                                              .text = str_slice(o->text, begin, end),
                                              .begin = begin,
                                              .end = end,
                                              .at = at(o, begin, end)});
}

static bool add_bracket(struct override *o, size_t begin, size_t end) {
    struct override_step step = {.kind = OVERRIDE_NAME,
                                 .text = str_slice(o->text, begin, end),
                                 .begin = begin - 1,
                                 .end = end + 1,
                                 .at = at(o, begin - 1, end + 1)};
    int64_t index;
    if (begin == end)
        return syntax(o, step.at, "a number or name is missing here");
    bool digits = number_parse_integer(step.text, &index) == NUMBER_OK;
    if (digits && index >= 0 && index < UINT32_MAX) {
        step.kind = OVERRIDE_INDEX;
        step.index = (uint32_t)index;
    } else if (digits) {
        return syntax(o, step.at, "entries are counted from 0");
    }
    return add_step(o, step);
}

// The bracket that closes the one at `open`, which may have a copy's name in it: [pawn[3]]; `end`: there is
// none.
static size_t closing(str text, size_t open, size_t end) {
    uint32_t depth = 0;
    for (size_t i = open; i < end; i++) {
        depth += text.ptr[i] == '[';
        depth -= text.ptr[i] == ']';
        if (depth == 0)
            return i;
    }
    return end;
}

static bool parse_steps(struct override *o, size_t end) {
    size_t i = 0;
    bool first = true;
    while (i < end || first) {
        if (i < end && o->text.ptr[i] == '[' && !first) {
            const size_t stop = closing(o->text, i, end);
            if (stop == end)
                return syntax(o, at(o, i, end), "']' is missing");
            if (!add_bracket(o, i + 1, stop))
                return false;
            i = stop + 1;
            continue;
        }
        if (!first && o->text.ptr[i] != '.')
            return syntax(o, at(o, i, end), "a '.' or '[' is missing here");
        size_t begin = first ? i : i + 1;
        size_t stop = begin;
        while (stop < end && o->text.ptr[stop] != '.' && o->text.ptr[stop] != '[')
            stop++;
        if (!add_key(o, begin, stop))
            return false;
        i = stop;
        first = false;
    }
    return true;
}

bool override_parse(struct override *o) {
    bool open = false;
    size_t end = find_equals(o->text, &open);
    o->path = at(o, 0, end);
    if (open)
        return syntax(o, o->path, "']' is missing");
    if (end == o->text.len)
        return syntax(o, at(o, 0, end), "'=' is missing after the path");
    if (end == 0)
        return syntax(o, at(o, 0, 1), "the path is missing before '='");
    o->value_begin = (uint32_t)end + 1;
    while (end > 1 && o->text.ptr[end - 1] == ' ')
        end--; // "radius = 2"
    o->path = at(o, 0, end);
    return parse_steps(o, end);
}

bool override_parse_path(struct override *o) {
    o->path = at(o, 0, o->text.len);
    o->value_begin = (uint32_t)o->text.len;
    return parse_steps(o, o->text.len);
}
