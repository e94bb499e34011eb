#include "assets/gltf/json.h"

#include "core/number.h"
#include "core/str_map.h"
#include "core/strbuf.h"

#include <math.h>
#include <string.h>

// An object or a list that is open.
struct frame {
    json_index node;
    json_index last; // the last child; 0: none yet
};

struct reading {
    struct json *json;
    str text;
    size_t at;
    struct frame frames[JSON_DEPTH];
    int depth;
    struct str_map keys; // of one object
};

// ---- faults

static bool fail(struct reading *r, size_t begin, size_t end, const char *what) {
    if (r->json->fault)
        return false;
    r->json->fault = what;
    r->json->fault_begin = begin;
    r->json->fault_end = end > r->text.len ? r->text.len : end;
    return false;
}

static bool fail_here(struct reading *r, const char *what) {
    return fail(r, r->at, r->at + 1, r->at < r->text.len ? what : "the text ends too early");
}

// ---- tokens

static void skip_space(struct reading *r) {
    while (r->at < r->text.len && char_is_space(r->text.ptr[r->at]))
        r->at++;
}

static char peek(const struct reading *r) {
    return r->at < r->text.len ? r->text.ptr[r->at] : '\0';
}

static json_index add(struct reading *r, enum json_kind kind, size_t begin) {
    struct json *json = r->json;
    if (ARENA_IS_FULL(&json->nodes))
        json->nodes.items = arena_regrow(json->arena, json->nodes.items, json->nodes.count,
                                         &json->nodes.capacity, sizeof *json->nodes.items);
    json->nodes.items[json->nodes.count] =
        (struct json_node){.begin = (uint32_t)begin, .end = (uint32_t)r->at, .kind = (uint8_t)kind};
    return json->nodes.count++;
}

static bool skip_escape(struct reading *r) {
    const size_t begin = r->at++;
    const char c = peek(r);
    if (c == 'u') {
        for (int i = 0; i < 4; i++) {
            r->at++;
            if (char_hex(peek(r)) < 0)
                return fail(r, begin, r->at + 1, "'\\u' needs four hexadecimal digits");
        }
    } else if (c == '\0' || !memchr("\"\\/bfnrt", c, 8)) {
        return fail(r, begin, r->at + 1, "this escape does not exist in JSON");
    }
    r->at++;
    return true;
}

// One character that is not printable ASCII, or is special.
static bool skip_special(struct reading *r, bool *is_plain) {
    const unsigned char c = (unsigned char)r->text.ptr[r->at];
    if (c == '\\') {
        *is_plain = false;
        return skip_escape(r);
    }
    if (c < 0x20)
        return fail_here(r, "a text has a control character; write it as an escape");
    const size_t length = utf8_sequence_length(r->text, r->at);
    if (length == 0)
        return fail_here(r, "this byte is not UTF-8");
    r->at += length;
    return true;
}

static bool is_ordinary(unsigned char c) {
    return c >= 0x20 && c < 0x80 && c != '"' && c != '\\';
}

static json_index read_text(struct reading *r) {
    const size_t begin = r->at++;
    bool is_plain = true;
    for (;;) {
        while (r->at < r->text.len && is_ordinary((unsigned char)r->text.ptr[r->at]))
            r->at++;
        if (r->at >= r->text.len) {
            fail(r, begin, begin + 1, "this text has no closing quote");
            return 0;
        }
        if (r->text.ptr[r->at] == '"')
            break;
        if (!skip_special(r, &is_plain))
            return 0;
    }
    r->at++;
    const json_index node = add(r, JSON_TEXT, begin);
    r->json->nodes.items[node].is_plain = is_plain;
    return node;
}

static size_t skip_digits(struct reading *r) {
    const size_t begin = r->at;
    while (peek(r) >= '0' && peek(r) <= '9')
        r->at++;
    return r->at - begin;
}

static json_index read_number(struct reading *r) {
    const size_t begin = r->at;
    r->at += peek(r) == '-';
    const bool zero = peek(r) == '0';
    const size_t digits = skip_digits(r);
    bool good = digits > 0 && !(zero && digits > 1);
    if (good && peek(r) == '.') {
        r->at++;
        good = skip_digits(r) > 0;
    }
    if (good && (peek(r) == 'e' || peek(r) == 'E')) {
        r->at++;
        r->at += peek(r) == '-' || peek(r) == '+';
        good = skip_digits(r) > 0;
    }
    if (!good) {
        fail(r, begin, r->at + (r->at == begin), "this is not a number as JSON writes it");
        return 0;
    }
    return add(r, JSON_NUMBER, begin);
}

static json_index read_word(struct reading *r, const char *word, enum json_kind kind) {
    const size_t length = strlen(word), begin = r->at;
    if (!str_starts_with(str_slice(r->text, r->at, r->text.len), (str){word, length})) {
        fail_here(r, "a value is expected here: an object, a list, a text, a number, true, false or null");
        return 0;
    }
    r->at += length;
    return add(r, kind, begin);
}

// ---- the tree

// Appends to the innermost list or object; counts a value of a list, and a key of an object.
static void append(struct reading *r, json_index node, bool counts) {
    if (r->depth == 0) {
        r->json->root = node;
        return;
    }
    struct frame *frame = &r->frames[r->depth - 1];
    struct json_node *items = r->json->nodes.items;
    if (frame->last)
        items[frame->last].next = node;
    else
        items[frame->node].first = node;
    items[frame->node].count += counts;
    frame->last = node;
}

static bool is_in_object(const struct reading *r) {
    return r->depth > 0 && r->json->nodes.items[r->frames[r->depth - 1].node].kind == JSON_OBJECT;
}

static bool open_frame(struct reading *r, enum json_kind kind, json_index *node) {
    if (r->depth == JSON_DEPTH)
        return fail_here(r, "lists and objects are nested too deeply (more than 64)");
    r->at++;
    *node = add(r, kind, r->at - 1);
    return true;
}

static const char twice[] = "the object has this key twice";

// Checks that no object has a key twice: small ones by comparing all keys, others by a table.
static bool check_keys(struct reading *r, json_index object) {
    struct json *json = r->json;
    enum {
        SMALL = 12
    };
    const bool is_small = json_at(json, object)->count <= SMALL;
    if (!is_small)
        str_map_clear(&r->keys);
    for (json_index key = json_at(json, object)->first; key;
         key = json_at(json, json_at(json, key)->next)->next) {
        const str name = json_raw(json, key);
        bool known = false;
        if (!is_small)
            known = (*str_map_at(&r->keys, name))++ > 0;
        for (json_index other = json_at(json, object)->first; is_small && other != key;
             other = json_at(json, json_at(json, other)->next)->next)
            known |= str_equal(json_raw(json, other), name);
        if (known)
            return fail(r, json_at(json, key)->begin, json_at(json, key)->end, twice);
    }
    return true;
}

static bool close_frame(struct reading *r) {
    const json_index node = r->frames[--r->depth].node;
    r->at++;
    r->json->nodes.items[node].end = (uint32_t)r->at;
    return r->json->nodes.items[node].kind != JSON_OBJECT || check_keys(r, node);
}

// A key with its colon, where an object expects one.
static bool read_key(struct reading *r) {
    if (peek(r) != '"')
        return fail_here(r, "a key in quotes is expected here");
    const json_index key = read_text(r);
    if (!key)
        return false;
    append(r, key, true);
    skip_space(r);
    if (peek(r) != ':')
        return fail_here(r, "a ':' is expected after a key");
    r->at++;
    skip_space(r);
    return true;
}

// Begins a value; a list or an object is left open.
static bool begin_value(struct reading *r, bool *is_open) {
    const char c = peek(r);
    json_index node = 0;
    *is_open = c == '{' || c == '[';
    if (*is_open) {
        if (!open_frame(r, c == '{' ? JSON_OBJECT : JSON_LIST, &node))
            return false;
    } else if (c == '"') {
        node = read_text(r);
    } else if (c == '-' || (c >= '0' && c <= '9')) {
        node = read_number(r);
    } else {
        node = c == 't'   ? read_word(r, "true", JSON_TRUE)
               : c == 'f' ? read_word(r, "false", JSON_FALSE)
                          : read_word(r, "null", JSON_NULL);
    }
    if (!node)
        return false;
    append(r, node, !is_in_object(r));
    if (*is_open)
        r->frames[r->depth++] = (struct frame){.node = node};
    return true;
}

// After a value: what follows it in its list or object. *more: another value.
static bool after_value(struct reading *r, bool *more) {
    *more = false;
    while (r->depth > 0) {
        const char closing = is_in_object(r) ? '}' : ']';
        skip_space(r);
        if (peek(r) == closing) {
            if (!close_frame(r))
                return false;
            continue;
        }
        if (peek(r) != ',')
            return fail_here(r, is_in_object(r) ? "a ',' or '}' is expected here"
                                                : "a ',' or ']' is expected here");
        r->at++;
        skip_space(r);
        *more = true;
        return !is_in_object(r) || read_key(r);
    }
    return true;
}

static bool read_values(struct reading *r) {
    for (bool more = true; more;) {
        bool is_open;
        if (!begin_value(r, &is_open))
            return false;
        if (is_open) {
            skip_space(r);
            const char closing = is_in_object(r) ? '}' : ']';
            if (peek(r) != closing) {
                if (is_in_object(r) && !read_key(r))
                    return false;
                continue;
            }
        }
        if (!after_value(r, &more))
            return false;
    }
    skip_space(r);
    return r->at == r->text.len ||
           fail(r, r->at, r->text.len, "there is more text after the end of the JSON");
}

bool json_read(struct json *json, str text, struct arena *arena) {
    struct reading *r = ARENA_NEW(arena, struct reading);
    *json = (struct json){.text = text, .arena = arena};
    r->json = json;
    r->text = text;
    str_map_init(&r->keys, arena);
    add(r, JSON_NONE, 0);
    skip_space(r);
    return read_values(r);
}

// ---- values

const char *json_kind_words(enum json_kind kind) {
    static const char *const words[] = {"nothing",  "null",   "false",  "true",
                                        "a number", "a text", "a list", "an object"};
    return words[kind];
}

json_index json_get(const struct json *json, json_index object, const char *key) {
    const str wanted = str_from(key);
    if (json_kind_of(json, object) != JSON_OBJECT)
        return 0;
    for (json_index at = json_at(json, object)->first; at;) {
        const json_index value = json_at(json, at)->next;
        if (str_equal(json_raw(json, at), wanted))
            return value;
        at = json_at(json, value)->next;
    }
    return 0;
}

str json_raw(const struct json *json, json_index text) {
    const struct json_node *node = json_at(json, text);
    return str_slice(json->text, node->begin + 1u, node->end - 1u);
}

static uint32_t hex4(str raw, size_t at) {
    uint32_t value = 0;
    for (size_t i = at; i < at + 4; i++) {
        const char c = raw.ptr[i];
        value = 16 * value + (uint32_t)(c <= '9' ? c - '0' : (c | 0x20) - 'a' + 10);
    }
    return value;
}

static size_t put_utf8(char *out, uint32_t c) {
    const bool is_bad = c == 0 || (c >= 0xD800 && c < 0xE000);
    const uint32_t code = is_bad ? 0xFFFD : c;
    if (code < 0x80) {
        out[0] = (char)code;
        return 1;
    }
    if (code < 0x800) {
        out[0] = (char)(0xC0 | code >> 6);
        out[1] = (char)(0x80 | (code & 0x3F));
        return 2;
    }
    if (code < 0x10000) {
        out[0] = (char)(0xE0 | code >> 12);
        out[1] = (char)(0x80 | (code >> 6 & 0x3F));
        out[2] = (char)(0x80 | (code & 0x3F));
        return 3;
    }
    out[0] = (char)(0xF0 | code >> 18);
    out[1] = (char)(0x80 | (code >> 12 & 0x3F));
    out[2] = (char)(0x80 | (code >> 6 & 0x3F));
    out[3] = (char)(0x80 | (code & 0x3F));
    return 4;
}

// The code point of the `\u` at `at`, with its second half if it has one; moves past it.
static uint32_t take_unicode(str raw, size_t *at) {
    uint32_t c = hex4(raw, *at + 2);
    *at += 6;
    const bool is_high = c >= 0xD800 && c < 0xDC00;
    if (is_high && *at + 6 <= raw.len && raw.ptr[*at] == '\\' && raw.ptr[*at + 1] == 'u') {
        const uint32_t low = hex4(raw, *at + 2);
        if (low >= 0xDC00 && low < 0xE000) {
            c = 0x10000 + ((c - 0xD800) << 10) + (low - 0xDC00);
            *at += 6;
        }
    }
    return c;
}

str json_text(const struct json *json, json_index text) {
    const str raw = json_raw(json, text);
    if (json_at(json, text)->is_plain)
        return raw;
    static const char letters[] = "bfnrt", meant[] = "\b\f\n\r\t";
    char *out = arena_alloc(json->arena, raw.len + 1); // no escape is longer when decoded
    size_t length = 0;
    for (size_t at = 0; at < raw.len;) {
        if (raw.ptr[at] != '\\') {
            out[length++] = raw.ptr[at++];
        } else if (raw.ptr[at + 1] == 'u') {
            length += put_utf8(out + length, take_unicode(raw, &at));
        } else {
            const char *letter = strchr(letters, raw.ptr[at + 1]);
            out[length++] = letter ? meant[letter - letters] : raw.ptr[at + 1];
            at += 2;
        }
    }
    return (str){out, length};
}

double json_number(const struct json *json, json_index number) {
    const struct json_node *node = json_at(json, number);
    double value;
    const str text = str_slice(json->text, node->begin, node->end);
    const enum number_status status = number_parse(text, &value);
    if (status == NUMBER_OK)
        return value;
    return status == NUMBER_OVERFLOW || status == NUMBER_TOO_LONG ? HUGE_VAL : 0; // too small for a double
}

// ---- places

// The child of `parent` whose text contains that of `node`; *key and *index identify it.
static json_index child_towards(const struct json *json, json_index parent, json_index node, json_index *key,
                                uint32_t *index) {
    const uint32_t begin = json_at(json, node)->begin;
    const bool is_object = json_kind_of(json, parent) == JSON_OBJECT;
    *index = 0;
    *key = 0;
    for (json_index at = json_at(json, parent)->first; at; at = json_at(json, at)->next, ++*index) {
        *key = is_object ? at : 0;
        if (is_object && at == node)
            return node;
        at = is_object ? json_at(json, at)->next : at;
        if (begin >= json_at(json, at)->begin && begin < json_at(json, at)->end)
            return at;
    }
    return 0;
}

str json_path(const struct json *json, json_index node) {
    str path = STR("");
    for (json_index at = json->root; at && at != node;) {
        json_index key;
        uint32_t index;
        at = child_towards(json, at, node, &key, &index);
        if (!at)
            break;
        const str name = key ? json_text(json, key) : STR("");
        path =
            key ? arena_format(json->arena, "%.*s%s%.*s", STR_ARG(path), path.len ? "." : "", STR_ARG(name))
                : arena_format(json->arena, "%.*s[%u]", STR_ARG(path), index);
    }
    return path.len ? path : STR("the file");
}
