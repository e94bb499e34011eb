#include "core/source.h"

void source_set_init(struct source_set *set, struct arena *arena) {
    *set = (struct source_set){.arena = arena};
    source_add(set, SOURCE_KIND_DEFAULT, STR("default"), STR(""));
}

uint32_t source_add(struct source_set *set, enum source_kind kind, str path, str text) {
    struct source *source = ARENA_PUSH(set->arena, set);
    *source = (struct source){.path = arena_copy(set->arena, path), .text = text, .kind = kind};
    return set->count - 1;
}

// Line ends are \n, \r\n and a lone \r, as YAML and XML have them.
static bool ends_line(str text, size_t at) {
    return text.ptr[at] == '\n' || (text.ptr[at] == '\r' && !(at + 1 < text.len && text.ptr[at + 1] == '\n'));
}

static void map_lines(struct source_set *set, struct source *source) {
    uint32_t count = 1;
    for (size_t i = 0; i < source->text.len; i++)
        count += ends_line(source->text, i);
    source->line_starts = ARENA_ARRAY(set->arena, uint32_t, count);
    source->line_count = 1;
    for (size_t i = 0; i < source->text.len; i++)
        if (ends_line(source->text, i))
            source->line_starts[source->line_count++] = (uint32_t)i + 1;
}

static uint32_t line_index(const struct source *source, uint32_t offset) {
    uint32_t low = 0;
    uint32_t high = source->line_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (source->line_starts[middle] <= offset)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static uint32_t column_at(const struct source *source, uint32_t line, uint32_t offset) {
    size_t begin = source->line_starts[line];
    // A byte order mark takes no column.
    if (begin == 0 && str_starts_with(source->text, STR("\xEF\xBB\xBF")) && offset >= 3)
        begin = 3;
    return (uint32_t)utf8_count(str_slice(source->text, begin, offset)) + 1;
}

struct source_place source_locate(struct source_set *set, span at) {
    struct source *source = &set->items[at.source < set->count ? at.source : SOURCE_DEFAULT];
    struct source_place place = {.path = source->path, .line = 1, .column = 1, .end_line = 1, .end_column = 1};
    if (source->text.len == 0)
        return place;
    if (!source->line_starts)
        map_lines(set, source);
    uint32_t size = (uint32_t)source->text.len;
    uint32_t begin = at.begin < size ? at.begin : size;
    uint32_t end = at.end < begin ? begin : at.end < size ? at.end : size;
    uint32_t line = line_index(source, begin);
    uint32_t end_line = line_index(source, end);
    place.line = line + 1;
    place.column = column_at(source, line, begin);
    place.end_line = end_line + 1;
    place.end_column = column_at(source, end_line, end);
    size_t line_end = line + 1 < source->line_count ? source->line_starts[line + 1] : size;
    str text = str_slice(source->text, source->line_starts[line], line_end);
    while (text.len && (text.ptr[text.len - 1] == '\n' || text.ptr[text.len - 1] == '\r'))
        text.len--;
    if (line == 0 && str_starts_with(text, STR("\xEF\xBB\xBF")))
        text = str_slice(text, 3, text.len);
    place.line_text = text;
    return place;
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

bool span_is_none(span s) { return s.source == SOURCE_DEFAULT; }
