#include "diag/source.h"

void source_set_init(struct source_set *set, struct arena *arena) {
    *set = (struct source_set){.arena = arena};
    source_add(set, SOURCE_KIND_DEFAULT, STR("default"), STR(""));
}

void source_set_copy(const struct source_set *from, struct arena *arena, struct source_set *out) {
    *out = (struct source_set){.arena = arena, .count = from->count, .capacity = from->count};
    out->items = ARENA_ARRAY(arena, struct source, from->count);
    memcpy(out->items, from->items, from->count * sizeof *from->items);
}

uint32_t source_add(struct source_set *set, enum source_kind kind, str path, str text) {
    struct source *source = ARENA_PUSH(set->arena, set);
    *source = (struct source){.path = arena_copy(set->arena, path), .text = text, .kind = kind};
    return set->count - 1;
}

// Line ends are \n, \r\n and a \r by itself, as YAML and XML have them.
static bool ends_line(str text, size_t at) {
    return text.ptr[at] == '\n' || (text.ptr[at] == '\r' && !(at + 1 < text.len && text.ptr[at + 1] == '\n'));
}

// Text is made while the arena is not guarded, perhaps because memory has run out: without room for the map,
// lines are counted anew each time. So that the time for a column does not depend on the line's length.
static void map_characters(struct source_set *set, struct source *source) {
    const str text = source->text;
    source->character_count = 0;
    source->characters = arena_try_alloc_array(set->arena, text.len / SOURCE_STEP + 1, sizeof(uint32_t));
    size_t count = 0;
    for (size_t at = 0; source->characters && at < text.len; count++) {
        if (count % SOURCE_STEP == 0)
            source->characters[source->character_count++] = (uint32_t)at;
        const size_t size = utf8_sequence_length(text, at);
        at += size ? size : 1;
    }
}

static void map_lines(struct source_set *set, struct source *source) {
    size_t count = 1;
    for (size_t i = 0; i < source->text.len; i++)
        count += ends_line(source->text, i);
    uint32_t *starts = arena_try_alloc_array(set->arena, count, sizeof *starts);
    if (!starts)
        return;
    source->line_starts = starts;
    source->line_count = 1;
    map_characters(set, source);
    for (size_t i = 0; i < source->text.len; i++)
        if (ends_line(source->text, i))
            starts[source->line_count++] = (uint32_t)i + 1;
}

struct line {
    uint32_t index;
    size_t begin;
    size_t end; // after its line end
};

static struct line count_lines(str text, uint32_t offset) {
    struct line line = {.end = text.len};
    for (size_t i = 0; i < text.len; i++) {
        if (!ends_line(text, i))
            continue;
        if (i >= offset) {
            line.end = i + 1;
            break;
        }
        line.index++;
        line.begin = i + 1;
    }
    return line;
}

static struct line find_line(const struct source *source, uint32_t offset) {
    if (!source->line_starts)
        return count_lines(source->text, offset);
    uint32_t low = 0;
    uint32_t high = source->line_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (source->line_starts[middle] <= offset)
            low = middle;
        else
            high = middle;
    }
    size_t end = low + 1 < source->line_count ? source->line_starts[low + 1] : source->text.len;
    return (struct line){low, source->line_starts[low], end};
}

// A byte order mark takes no column.
static size_t skip_mark(str text, size_t begin) {
    return begin == 0 ? str_skip_mark(text) : begin;
}

// An offset inside a character stands for that character.
static size_t character_begin(str text, size_t offset) {
    for (size_t back = 1; back <= 3 && back <= offset; back++)
        if (utf8_sequence_length(text, offset - back) > back)
            return offset - back;
    return offset;
}

// Characters before an offset.
static size_t characters_before(const struct source *source, size_t offset) {
    uint32_t low = 0, high = source->character_count;
    if (high == 0)
        return utf8_count(str_slice(source->text, 0, offset));
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (source->characters[middle] <= offset)
            low = middle;
        else
            high = middle;
    }
    return (size_t)low * SOURCE_STEP + utf8_count(str_slice(source->text, source->characters[low], offset));
}

static uint32_t column_at(const struct source *source, size_t line_begin, size_t offset) {
    const size_t begin = skip_mark(source->text, line_begin), at = character_begin(source->text, offset);
    return at <= begin ? 1 : (uint32_t)(characters_before(source, at) - characters_before(source, begin)) + 1;
}

// The position of an offset in its line's text.
static uint32_t byte_at(const struct source *source, size_t line_begin, size_t offset) {
    const size_t begin = skip_mark(source->text, line_begin), at = character_begin(source->text, offset);
    return at <= begin ? 0 : (uint32_t)(at - begin);
}

struct source_place source_locate(struct source_set *set, span at) {
    if (set->count == 0) // memory ran out before anything was read
        return (struct source_place){
            .path = STR("default"), .line = 1, .column = 1, .end_line = 1, .end_column = 1};
    struct source *source = &set->items[at.source < set->count ? at.source : SOURCE_DEFAULT];
    struct source_place place = {
        .path = source->path, .line = 1, .column = 1, .end_line = 1, .end_column = 1};
    if (source->text.len == 0 || source->kind == SOURCE_KIND_GENERATED)
        return place; // generated text has no lines to show
    if (!source->line_starts)
        map_lines(set, source);
    str text = source->text;
    uint32_t size = (uint32_t)text.len;
    uint32_t begin = at.begin < size ? at.begin : size;
    uint32_t end = at.end < begin ? begin : at.end < size ? at.end : size;
    struct line line = find_line(source, begin);
    struct line last = find_line(source, end);
    place.line = line.index + 1;
    place.column = column_at(source, line.begin, begin);
    place.begin = byte_at(source, line.begin, begin);
    place.end_line = last.index + 1;
    place.end_column = column_at(source, last.begin, end);
    place.line_text = str_slice(text, skip_mark(text, line.begin), line.end);
    while (place.line_text.len && (place.line_text.ptr[place.line_text.len - 1] == '\n' ||
                                   place.line_text.ptr[place.line_text.len - 1] == '\r'))
        place.line_text.len--;
    const uint32_t length = (uint32_t)place.line_text.len;
    const uint32_t stop = last.index == line.index ? byte_at(source, line.begin, end) : length;
    place.begin = place.begin < length ? place.begin : length;
    place.end = stop < length ? stop : length;
    return place;
}

uint32_t source_line(struct source_set *set, span at) {
    struct source *source =
        set->count ? &set->items[at.source < set->count ? at.source : SOURCE_DEFAULT] : NULL;
    if (!source || source->text.len == 0 || source->kind == SOURCE_KIND_GENERATED)
        return 1;
    if (!source->line_starts)
        map_lines(set, source);
    uint32_t size = (uint32_t)source->text.len;
    return find_line(source, at.begin < size ? at.begin : size).index + 1;
}

// Where a line begins, counted from 0; after the last one: the end of the text.
static size_t line_begin(const struct source *source, uint32_t index) {
    if (source->line_starts)
        return index < source->line_count ? source->line_starts[index] : source->text.len;
    size_t at = 0;
    for (; index > 0 && at < source->text.len; at++)
        index -= ends_line(source->text, at);
    return at;
}

span source_line_span(struct source_set *set, uint32_t index, uint32_t line) {
    struct source *source = &set->items[index];
    str text = source->text;
    if (!source->line_starts && text.len)
        map_lines(set, source);
    size_t begin = line_begin(source, line - 1);
    size_t end = line_begin(source, line);
    while (end > begin && (text.ptr[end - 1] == '\n' || text.ptr[end - 1] == '\r'))
        end--;
    return (span){index, (uint32_t)begin, (uint32_t)end};
}

str source_text(const struct source_set *set, span at) {
    if (at.source >= set->count)
        return STR("");
    return str_slice(set->items[at.source].text, at.begin, at.end);
}

span span_join(span a, span b) {
    if (a.source == SOURCE_DEFAULT)
        return b;
    if (b.source != a.source)
        return a;
    return (span){a.source, a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end};
}

bool span_is_none(span s) {
    return s.source == SOURCE_DEFAULT;
}

bool span_equal(span a, span b) {
    return a.source == b.source && a.begin == b.begin && a.end == b.end;
}
