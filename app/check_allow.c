#include "app/check_allow.h"

#include <string.h>

// A code that a comment allows.
struct allow {
    span code;
    span comment;
    uint32_t first_line, last_line; // of the comment's file, that it applies to
    bool used;
};

struct allows {
    struct session *session;
    bool report; // what is wrong with the comments
    struct {
        struct allow *items;
        uint32_t count, capacity;
    } list;
};

static bool at_comment(str text, size_t at, bool is_xml) {
    return is_xml ? str_starts_with(str_slice(text, at, at + 4), STR("<!--")) : text.ptr[at] == '#';
}

static uint32_t line_of(struct session *session, uint32_t source, size_t at) {
    return source_locate(&session->sources, (span){source, (uint32_t)at, (uint32_t)at}).line;
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

// Where the XML tag that begins at `at` ends. No comment can be inside a tag, so that one before it, or after
// it, applies to all of its lines.
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

// Whether the line has more than the dash of a list's item before `end`.
static bool has_content(str text, size_t end) {
    for (; end > 0 && !char_is_break(text.ptr[end - 1]); end--)
        if (!char_is_space(text.ptr[end - 1]) && text.ptr[end - 1] != '-')
            return true;
    return false;
}

// The lines that a comment applies to: its own if something is before it, else the next one with content.
static void find_lines(struct session *session, span comment, struct allow *allow) {
    const struct source *source = &session->sources.items[comment.source];
    str text = source->text;
    bool is_xml = comment.begin < text.len && text.ptr[comment.begin] == '<';
    size_t before = comment.begin;
    while (before > 0 && char_is_blank(text.ptr[before - 1]))
        before--;
    bool trailing = before > 0 && !char_is_break(text.ptr[before - 1]);
    if (trailing && !is_xml)
        trailing = has_content(text, before);
    size_t first = trailing ? before - 1 : skip_to_content(text, comment.end, is_xml);
    size_t last = first;
    if (is_xml && trailing)
        while (first > 0 && text.ptr[first] != '<')
            first--;
    else if (is_xml)
        last = tag_end(text, first);
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
    for (int i = 0; i < DIAG_CODE_COUNT; i++) {
        bool matches = diag_code_matches((enum diag_code)i, text);
        known = known || matches;
        can_be_allowed = can_be_allowed || (matches && diag_info((enum diag_code)i)->severity != DIAG_ERROR);
    }
    if (!known) {
        bad_comment(allows, word, "there is no code '", text, "'");
    } else if (!can_be_allowed) {
        bad_comment(allows, word, "errors cannot be silenced, and ", text, " is one");
    } else {
        struct allow *allow = ARENA_PUSH(&session->arena, &allows->list);
        *allow = (struct allow){.code = word, .comment = comment};
        find_lines(session, comment, allow);
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

// Whether a place is on the lines that a comment applies to.
static bool speaks_for(struct allows *allows, const struct allow *allow, span at) {
    if (at.source != allow->comment.source)
        return false;
    uint32_t line = source_locate(&allows->session->sources, at).line;
    return line >= allow->first_line && line <= allow->last_line;
}

// A finding is on the lines itself, or, in a mesh or image, the note is that says what names the file.
static bool is_meant(struct allows *allows, const struct allow *allow, const struct diag *item) {
    bool meant = speaks_for(allows, allow, item->at);
    if (item->at.source != allow->comment.source)
        for (const struct diag_related *n = item->notes; n && !meant; n = n->next)
            meant = speaks_for(allows, allow, n->at);
    return meant;
}

static bool keeps(void *context, struct diag *item) {
    struct allows *allows = context;
    bool kept = true;
    if (diag_info(item->code)->severity == DIAG_ERROR)
        return true;
    for (uint32_t i = 0; i < allows->list.count; i++) {
        struct allow *allow = &allows->list.items[i];
        if (!diag_code_matches(item->code, source_text(&allows->session->sources, allow->code)) ||
            !is_meant(allows, allow, item))
            continue;
        allow->used = true;
        kept = false;
    }
    return kept;
}

static bool is_alone(const struct allows *allows, const struct allow *allow) {
    for (uint32_t i = 0; i < allows->list.count; i++) {
        const struct allow *other = &allows->list.items[i];
        if (other != allow && span_equal(other->comment, allow->comment))
            return false;
    }
    return true;
}

// Comments of the scene itself: what an included file allows may only be found in another scene. If there are
// errors, rules may not have run.
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
        if (is_alone(allows, allow))
            diag_fix(&session->sink, false, allow->comment, STR(""));
    }
}

static void apply(void *context) {
    struct allows *allows = context;
    struct session *session = allows->session;
    for (uint32_t i = 0; i < session->origin.directives.count; i++)
        read_comment(allows, session->origin.directives.items[i]);
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
