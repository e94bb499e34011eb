// The page of what glint does not do, from the rows of concepts.def.
#include "grammar/concept.h"
#include "grammar/emit/emit.h"

#include <string.h>

static const char opening[] =
    "# What glint does not do, and what to do instead\n"
    "\n"
    "<!-- Made from grammar/concepts.def by the target `emitted`; do not edit. -->\n"
    "\n"
    "glint shows spheres, rectangles, boxes, cylinders, cones and triangle meshes, lit by lights with and "
    "without extent, with "
    "mirrors "
    "and\n"
    "glass. Other tools know more, or the same under another name. This page lists what you may look for, "
    "and what to\n"
    "write. If a scene contains one of these words, `glint check` answers with the same advice, and so does\n"
    "`glint explain WORD`.\n"
    "\n";

static const char closing[] =
    "## How large a scene may be\n"
    "\n"
    "Files, meshes, images and pictures have limits, so that a damaged or hostile file cannot take all "
    "memory.\n"
    "`glint check --limit help` lists them with their defaults, and `--limit NAME=VALUE` changes one. How "
    "accurate a\n"
    "picture is, and how far away and how small things can be, is in [accuracy.md](accuracy.md).\n"
    "\n"
    "The images of a scene may take 251658240 bytes of memory while it is rendered (`image-growth`), or 200 "
    "bytes for each\n"
    "byte of their files if that is more: a photograph of 8192 x 4096 has megabytes and is rendered; a file "
    "of 0.4 MB that\n"
    "has 64 megapixels of 16 bits is an error, in `check`, `inspect` and `render` alike. What counts is what "
    "the decoder\n"
    "needs, the pixels, and the device's texels, since a processor that renders has all in the same memory; "
    "of a surface's\n"
    "image also its smaller levels. An image counts once, however many materials show it. If the file is "
    "right, the message\n"
    "says by which `--limit` it is read.\n"
    "\n"
    "A picture of more than 8 megapixels is rendered in bands, and takes no more memory than a small one, "
    "unless something\n"
    "needs all its pixels at once ([farm.md](farm.md)).\n"
    "\n"
    "A device holds all triangles in one buffer: 48 bytes each, 96 in double precision and where models "
    "share a mesh.\n"
    "How large a buffer may be is the device's own limit: 2 GiB with lavapipe, which is 44 million "
    "triangles, 22\n"
    "million of 96 bytes; 4 GiB on many GPUs, twice as many; and no less than 128 MiB, 2.7 million, wherever "
    "there is\n"
    "Vulkan. A scene that needs more is an error that says both sizes. The triangles of a mesh that several "
    "models\n"
    "show count once where that saves 32 MiB, so that 10 000 models of it need the buffer of one: let models "
    "share a\n"
    "mesh, and `glint inspect` says what they share and how large each buffer is. All of them together may "
    "show\n"
    "2^30 - 3 triangles; more are an error of `check`, too. The reference "
    "(`--audit`,\n"
    "`--device reference`) shares them too; of what is not shared it takes 280 bytes a triangle.\n";

// The anchor that Markdown makes from a heading.
static void put_anchor(struct strbuf *out, const char *heading) {
    for (const char *c = heading; *c; c++)
        if (*c == ' ')
            strbuf_char(out, '-');
        else if (*c != ',')
            strbuf_char(out, char_lower(*c));
}

static bool begins_chapter(const struct concept *concept) {
    return concept == concepts || strcmp(concept[-1].chapter, concept->chapter) != 0;
}

// Rows with the same title form one section: the first row's text, and the words of all.
static bool begins_section(const struct concept *concept) {
    return concept == concepts || !concept->title || strcmp(concept[-1].title, concept->title) != 0;
}

static void put_contents(struct strbuf *out) {
    for (const struct concept *c = concepts; c->title; c++) {
        if (!begins_section(c))
            continue;
        if (begins_chapter(c))
            strbuf_format(out, "%s- **%s**: ", c == concepts ? "" : "\n", c->chapter);
        else
            strbuf_cstr(out, ",\n  ");
        strbuf_format(out, "[%s](#", c->title);
        put_anchor(out, c->title);
        strbuf_char(out, ')');
    }
    strbuf_cstr(out, "\n- [How large a scene may be](#how-large-a-scene-may-be)\n\n");
}

// A clause as a sentence; names in quotes are code. An apostrophe has a letter before it, and none occurs
// inside quotes.
static void put_sentence(struct strbuf *out, const char *clause) {
    bool quoted = false;
    for (const char *c = clause; *c; c++) {
        bool begins = c == clause || c[-1] == ' ' || c[-1] == '(';
        bool is_quote = *c == '\'' && (quoted || begins);
        quoted = quoted != is_quote;
        if (is_quote)
            strbuf_char(out, '`');
        else
            strbuf_char(out, c == clause && *c >= 'a' && *c <= 'z' ? (char)(*c - 'a' + 'A') : *c);
    }
    strbuf_char(out, '.');
}

// "; in a light or camera: "
static void put_place(struct strbuf *out, const struct concept *concept) {
    str rest = str_from(concept->in);
    strbuf_cstr(out, begins_section(concept) ? "*Words* " : "; ");
    for (bool first = true; rest.len; first = false) {
        str element = concept_next_word(&rest);
        strbuf_cstr(out, first ? "in " : rest.len ? ", " : " or ");
        if (first)
            strbuf_cstr(out, strchr("aeiou", *element.ptr) ? "an " : "a ");
        strbuf_str(out, element);
    }
    strbuf_cstr(out, concept->in ? ": " : begins_section(concept) ? "anywhere: " : "");
}

static void put_words(struct strbuf *out, const struct concept *concept) {
    put_place(out, concept);
    str rest = str_from(concept->words);
    for (bool first = true; rest.len; first = false) {
        str word = concept_next_word(&rest);
        strbuf_format(out, "%s`%.*s`", first ? "" : ", ", STR_ARG(word));
    }
}

static void put_section(struct strbuf *out, const struct concept *concept) {
    strbuf_format(out, "### %s\n\n", concept->title);
    put_sentence(out, concept->lacks);
    strbuf_char(out, ' ');
    put_sentence(out, concept->instead);
    strbuf_cstr(out, "\n\n");
    if (concept->example)
        strbuf_format(out, "```yaml\n%s```\n\n", concept->example);
}

void emit_limits(struct strbuf *out) {
    strbuf_cstr(out, opening);
    put_contents(out);
    for (const struct concept *c = concepts; c->title; c++) {
        if (begins_chapter(c))
            strbuf_format(out, "## %s\n\n", c->chapter);
        if (begins_section(c))
            put_section(out, c);
        put_words(out, c);
        if (begins_section(c + 1))
            strbuf_cstr(out, "\n\n");
    }
    strbuf_cstr(out, closing);
}
