#include "load/check_allow.h"
#include "diag/codes/command.h"

#include <stdlib.h>
#include <string.h>

// A code that a comment allows.
struct allow {
    span code;
    span comment;
    uint32_t first_line, last_line; // of the comment's file, that it applies to
    bool used;
};

// A part of a text that only has spaces and comments, and what follows it.
struct gap {
    uint32_t source;
    size_t begin, end;  // where content begins
    size_t content_end; // end of the entry that begins there; for the root, end of its tag
    size_t root;        // where the root of an XML text begins
};

struct allows {
    struct session *session;
    bool report; // also report what is wrong with the comments
    struct {
        struct allow *items;
        uint32_t count, capacity;
    } list; // in the order of the texts once all have been read
    struct answer {
        uint32_t source, line;
        bool known, allowed;
    } answers[DIAG_CODE_COUNT]; // the last one for each code: a line may have thousands of findings
    uint32_t *outer; // for each: number (from 1) of the nearest earlier comment that reaches its first line;
                     // 0: none
    struct gap last; // consecutive comments share one content
};

static bool at_comment(str text, size_t at, bool is_xml) {
    return is_xml ? str_starts_with(str_slice(text, at, at + 4), STR("<!--")) : text.ptr[at] == '#';
}

static uint32_t line_of(struct session *session, uint32_t source, size_t at) {
    return source_line(&session->sources, (span){source, (uint32_t)at, (uint32_t)at});
}

// After spaces and comments.
static size_t skip_to_content(str text, size_t at, bool is_xml) {
    while (at < text.len) {
        if (char_is_space(text.ptr[at])) {
            at++;
        } else if (is_xml && at_comment(text, at, true)) {
            while (at < text.len && !str_starts_with(str_slice(text, at, at + 3), STR("-->")))
                at++;
            at = at + 3 < text.len ? at + 3 : text.len;
        } else if (!is_xml && at_comment(text, at, false)) {
            while (at < text.len && !char_is_break(text.ptr[at]))
                at++;
        } else {
            break;
        }
    }
    return at;
}

// Where the XML tag that begins at `at` ends. No comment can be inside a tag, so one before or after it
// applies to all of its lines.
static size_t tag_end(str text, size_t at) {
    char quote = '\0';
    for (; at < text.len; at++) {
        char c = text.ptr[at];
        if (quote)
            quote = c == quote ? '\0' : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (c == '>')
            return at;
    }
    return at;
}

static size_t skip_past(str text, size_t at, const char *mark) {
    const str end = str_from(mark);
    while (at < text.len && !str_starts_with(str_slice(text, at, at + end.len), end))
        at++;
    return at;
}

// Where the root of an XML text begins.
static size_t root_of(str text) {
    size_t at = 0;
    for (; at < text.len; at++) {
        if (at_comment(text, at, true))
            at = skip_past(text, at, "-->");
        else if (text.ptr[at] == '<' && at + 1 < text.len && text.ptr[at + 1] != '?' &&
                 text.ptr[at + 1] != '!')
            break;
    }
    return at;
}

// Where the XML element that begins at `at` ends.
static size_t element_end(str text, size_t at) {
    size_t depth = 0;
    while (at < text.len) {
        const str here = str_slice(text, at, text.len);
        const bool closes = str_starts_with(here, STR("</"));
        if (text.ptr[at] != '<') {
            at++;
        } else if (at_comment(text, at, true)) {
            at = skip_past(text, at, "-->");
        } else if (str_starts_with(here, STR("<![CDATA["))) {
            at = skip_past(text, at, "]]>");
        } else {
            at = tag_end(text, at);
            depth += !closes && at < text.len && text.ptr[at - 1] != '/';
            depth -= closes && depth > 0;
            if (depth == 0)
                break;
        }
    }
    return at < text.len ? at : text.len;
}

static bool begins_item(str text, size_t at) {
    return at < text.len && text.ptr[at] == '-' && (at + 1 == text.len || char_is_space(text.ptr[at + 1]));
}

static size_t line_end(str text, size_t at) {
    while (at < text.len && !char_is_break(text.ptr[at]))
        at++;
    return at;
}

// The last content of the YAML entry that begins at `at`: a list item, or a key with what is indented below
// it. For a key of the root with an unindented list: the key itself.
static size_t entry_end(str text, size_t at) {
    size_t column = 0, end = at;
    while (column < at && !char_is_break(text.ptr[at - column - 1]))
        column++;
    for (size_t next = line_end(text, at); next < text.len; next = line_end(text, next)) {
        const size_t content = skip_to_content(text, next, false);
        size_t indent = 0;
        while (indent < content && !char_is_break(text.ptr[content - indent - 1]))
            indent++;
        const bool is_list = begins_item(text, content) && !begins_item(text, at);
        if (content == text.len || indent < column || (indent == column && !is_list) ||
            (column == 0 && is_list && end == at))
            break;
        end = next = content;
    }
    return end;
}

// Whether the line has anything but a list item's dash before `end`.
static bool has_content(str text, size_t end) {
    for (; end > 0 && !char_is_break(text.ptr[end - 1]); end--)
        if (!char_is_space(text.ptr[end - 1]) && text.ptr[end - 1] != '-')
            return true;
    return false;
}

// What follows a comment.
static const struct gap *content_after(struct allows *allows, span comment, str text, bool is_xml) {
    struct gap *gap = &allows->last;
    if (gap->source == comment.source && gap->begin <= comment.end && comment.end <= gap->end)
        return gap;
    if (is_xml && (gap->source != comment.source || gap->begin == 0))
        gap->root = root_of(text);
    *gap = (struct gap){.source = comment.source, .begin = comment.end, .root = gap->root};
    gap->end = skip_to_content(text, comment.end, is_xml);
    if (!is_xml)
        gap->content_end = entry_end(text, gap->end);
    else
        gap->content_end = gap->end <= gap->root ? tag_end(text, gap->end) : element_end(text, gap->end);
    return gap;
}

// The lines that a comment applies to: its own if something precedes it, else those of the entry that
// follows. So it still silences a finding that moves to a later line when the entry is spelled differently.
static void find_lines(struct allows *allows, span comment, struct allow *allow) {
    struct session *session = allows->session;
    const struct source *source = &session->sources.items[comment.source];
    str text = source->text;
    bool is_xml = comment.begin < text.len && text.ptr[comment.begin] == '<';
    size_t before = comment.begin;
    while (before > 0 && char_is_blank(text.ptr[before - 1]))
        before--;
    bool trailing = before > 0 && !char_is_break(text.ptr[before - 1]);
    if (trailing && !is_xml)
        trailing = has_content(text, before);
    const struct gap *gap = trailing ? NULL : content_after(allows, comment, text, is_xml);
    size_t first = gap ? gap->end : before - 1;
    size_t last = gap ? gap->content_end : first;
    if (is_xml && trailing)
        while (first > 0 && text.ptr[first] != '<')
            first--;
    allow->first_line = line_of(session, comment.source, first);
    allow->last_line = line_of(session, comment.source, last);
}

// ---- reading a comment

// "<before><word><after>"
static void bad_comment(struct allows *allows, span at, const char *before, str word, const char *after) {
    if (!allows->report)
        return;
    diag_add(&allows->session->sink, DIAG_ALLOW_UNKNOWN, at, "%s%.*s%s", before, STR_ARG(word), after);
    diag_help(&allows->session->sink,
              "write, for example, 'glint: allow W401: the pane is meant to be thin'");
}

// The next word in text[*at, end): up to a space, comma or colon; false: there is none.
static bool next_word(str text, size_t *at, size_t end, span *word, uint32_t source) {
    while (*at < end && (char_is_space(text.ptr[*at]) || text.ptr[*at] == ','))
        ++*at;
    size_t begin = *at;
    while (*at < end && !char_is_space(text.ptr[*at]) && !memchr(",:", text.ptr[*at], 2))
        ++*at;
    *word = (span){source, (uint32_t)begin, (uint32_t)*at};
    return *at > begin;
}

static void read_code(struct allows *allows, span comment, span word) {
    struct session *session = allows->session;
    str text = source_text(&session->sources, word);
    bool known = false;
    bool can_be_allowed = false;
    for (diag_code i = diag_next(-1); i < DIAG_CODE_COUNT; i = diag_next(i)) {
        bool matches = diag_code_matches(i, text);
        known = known || matches;
        can_be_allowed = can_be_allowed || (matches && diag_info(i)->severity != DIAG_ERROR);
    }
    if (!known) {
        bad_comment(allows, word, "there is no code '", text, "'");
    } else if (!can_be_allowed) {
        bad_comment(allows, word, "errors cannot be silenced, and ", text, " is one");
    } else {
        struct allow *allow = ARENA_PUSH(&session->arena, &allows->list);
        *allow = (struct allow){.code = word, .comment = comment};
        find_lines(allows, comment, allow);
    }
}

static void read_comment(struct allows *allows, span comment) {
    const struct source *source = &allows->session->sources.items[comment.source];
    str text = source->text;
    size_t end = comment.end;
    if (end >= 3 && str_equal_cstr(str_slice(text, end - 3, end), "-->"))
        end -= 3;
    size_t at = comment.begin;
    while (at < end && text.ptr[at] != ':')
        at++;
    at++;
    span word;
    bool any = next_word(text, &at, end, &word, comment.source);
    str verb = source_text(&allows->session->sources, word);
    if (!any || !str_equal_cstr(verb, "allow")) {
        bad_comment(allows, any ? word : comment, "a comment for glint must say 'allow'", STR(""), "");
        return;
    }
    uint32_t codes = 0;
    while (at < end && text.ptr[at] != ':' && next_word(text, &at, end, &word, comment.source)) {
        read_code(allows, comment, word);
        codes++;
    }
    if (codes == 0)
        bad_comment(allows, comment, "this comment allows nothing: it names no code", STR(""), "");
}

// ---- using them

static int compare_allows(const void *left, const void *right) {
    const struct allow *a = left, *b = right;
    if (a->comment.source != b->comment.source)
        return a->comment.source < b->comment.source ? -1 : 1;
    if (a->first_line != b->first_line)
        return a->first_line < b->first_line ? -1 : 1;
    return a->code.begin < b->code.begin ? -1 : a->code.begin > b->code.begin;
}

static void sort(struct allows *allows) {
    struct allow *items = allows->list.items;
    uint32_t count = allows->list.count;
    qsort(items, count, sizeof *items, compare_allows);
    allows->outer = ARENA_ARRAY(&allows->session->arena, uint32_t, count);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t at = i;
        while (at > 0 && (items[at - 1].comment.source != items[i].comment.source ||
                          items[at - 1].last_line < items[i].first_line))
            at = allows->outer[at - 1];
        allows->outer[i] = at;
    }
}

// The number of comments that begin to apply at this line or before it.
static uint32_t count_up_to(const struct allows *allows, uint32_t source, uint32_t line) {
    uint32_t low = 0, high = allows->list.count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        const struct allow *allow = &allows->list.items[middle];
        bool before =
            allow->comment.source < source || (allow->comment.source == source && allow->first_line <= line);
        low = before ? middle + 1 : low;
        high = before ? high : middle;
    }
    return low;
}

// Marks the comments that allow the code on a line; false: no comment does.
static bool allows_on(struct allows *allows, diag_code code, uint32_t source, uint32_t line) {
    bool found = false;
    for (uint32_t i = count_up_to(allows, source, line); i > 0; i = allows->outer[i - 1]) {
        struct allow *allow = &allows->list.items[i - 1];
        if (allow->comment.source != source)
            break;
        if (allow->last_line < line ||
            !diag_code_matches(code, source_text(&allows->session->sources, allow->code)))
            continue;
        allow->used = true;
        found = true;
    }
    return found;
}

static bool allows_at(struct allows *allows, diag_code code, span at) {
    uint32_t line = source_line(&allows->session->sources, at);
    struct answer *answer = &allows->answers[code];
    if (!answer->known || answer->source != at.source || answer->line != line)
        *answer = (struct answer){at.source, line, true, allows_on(allows, code, at.source, line)};
    return answer->allowed;
}

// A comment covers the finding's own line or, for a finding in a mesh or image, the line of the note that
// says what names the file.
static bool keeps(void *context, struct diag *item) {
    struct allows *allows = context;
    if (diag_info(item->code)->severity == DIAG_ERROR)
        return true;
    bool allowed = allows_at(allows, item->code, item->at);
    for (const struct diag_related *n = item->notes; n; n = n->next)
        if (n->at.source != item->at.source)
            allowed = allows_at(allows, item->code, n->at) || allowed;
    return !allowed;
}

// Whether a comment allows only one code. The codes of one comment are adjacent.
static bool is_alone(const struct allows *allows, uint32_t i) {
    const struct allow *items = allows->list.items;
    bool before = i > 0 && span_equal(items[i - 1].comment, items[i].comment);
    return !before && !(i + 1 < allows->list.count && span_equal(items[i + 1].comment, items[i].comment));
}

// Only comments in the scene file itself: one in an included file may be for findings in another scene. If
// there are errors, rules may not have run.
static void report_unused(struct allows *allows) {
    struct session *session = allows->session;
    uint32_t main_source =
        session->origin.files.count ? session->origin.files.items[0].source : SOURCE_DEFAULT;
    for (uint32_t i = 0; i < allows->list.count && session->sink.errors == 0; i++) {
        const struct allow *allow = &allows->list.items[i];
        if (allow->used || allow->comment.source != main_source)
            continue;
        str code = source_text(&session->sources, allow->code);
        diag_add(&session->sink, DIAG_ALLOW_UNUSED, allow->code,
                 "%.*s does not occur on %s %u: the comment silences nothing", STR_ARG(code),
                 allow->first_line == allow->last_line ? "line" : "the lines from", allow->first_line);
        diag_help(&session->sink, "remove it, or move it to the line before the finding");
        if (is_alone(allows, i))
            diag_fix(&session->sink, false, allow->comment, STR(""));
    }
}

static void apply(void *context) {
    struct allows *allows = context;
    struct session *session = allows->session;
    for (uint32_t i = 0; i < session->origin.directives.count; i++)
        read_comment(allows, session->origin.directives.items[i]);
    if (allows->list.count)
        sort(allows);
    if (allows->list.count)
        diag_filter(&session->sink, keeps, allows);
    if (allows->report)
        report_unused(allows);
}

void check_allow(struct session *session, bool report) {
    struct allows allows = {.session = session, .report = report};
    if (session->origin.directives.count)
        arena_guarded(&session->arena, apply, &allows);
}

static bool is_told(void *context, struct diag *item) {
    const struct session *session = context;
    return diag_info(item->code)->severity == DIAG_ERROR ||
           session->policy.level[item->code] != DIAG_LEVEL_OFF;
}

void check_silence(struct session *session) {
    if (session->sink.warnings + session->sink.notes == 0)
        return;
    check_allow(session, false);
    diag_filter(&session->sink, is_told, session);
}
