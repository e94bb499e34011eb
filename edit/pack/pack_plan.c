// Which file of a scene goes where in a package, and what its scene files must then contain.
#include "diag/codes/command.h"
#include "diag/codes/limit.h"
#include "edit/pack/pack.h"

#include "core/strbuf.h"
#include "grammar/ir_print_text.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum {
    TRIES = 10000, // folders meshes, meshes-2 ...
};

struct planner {
    struct session *session;
    struct pack_plan *plan;
};

// A replacement in a scene file.
struct edit {
    span at;
    str text;
};
struct edits {
    struct edit *items;
    uint32_t count, capacity;
};

static bool same_name(str a, str b) {
    return a.len == b.len && strncasecmp(a.ptr, b.ptr, a.len) == 0; // some file systems ignore case
}

// The first: a material file may be beside several meshes.
static struct pack_file *find_canonical(const struct pack_plan *plan, str canonical) {
    for (uint32_t i = 0; i < plan->count; i++)
        if (str_equal(plan->items[i].canonical, canonical))
            return &plan->items[i];
    return NULL;
}

static const struct pack_file *find_target(const struct pack_plan *plan, str target) {
    for (uint32_t i = 0; i < plan->count; i++)
        if (same_name(plan->items[i].target, target))
            return &plan->items[i];
    return NULL;
}

static bool is_free(const struct pack_plan *plan, str target, str canonical) {
    const struct pack_file *file = find_target(plan, target);
    return !file || (str_equal(file->target, target) && str_equal(file->canonical, canonical));
}

static void add_file(struct planner *p, str target, const struct inventory_use *use) {
    if (find_target(p->plan, target))
        return;
    *ARENA_PUSH(&p->session->arena, p->plan) =
        (struct pack_file){.target = target, .path = use->path, .canonical = use->canonical};
}

// `path` seen from `folder` ("" or "a/"), both relative to the package, without '.' and '..'; the empty
// string if it leaves the package.
static str normalize(struct arena *arena, str folder, str path) {
    str joined = arena_format(arena, "%.*s%.*s", STR_ARG(folder), STR_ARG(path));
    char *out = arena_alloc(arena, joined.len + 1);
    size_t length = 0;
    for (size_t i = 0; i < joined.len;) {
        size_t end = i;
        while (end < joined.len && joined.ptr[end] != '/')
            end++;
        str part = str_slice(joined, i, end);
        i = end + 1;
        if (part.len == 0 || str_equal(part, STR(".")))
            continue;
        if (str_equal(part, STR(".."))) {
            if (length == 0)
                return STR("");
            while (length > 0 && out[length - 1] != '/')
                length--;
            length -= length > 0;
            continue;
        }
        if (length)
            out[length++] = '/';
        memmove(out + length, part.ptr, part.len);
        length += part.len;
    }
    return (str){out, length};
}

static str folder_name(struct planner *p, const char *base, int number) {
    return number == 1 ? arena_format(&p->session->arena, "%s/", base)
                       : arena_format(&p->session->arena, "%s-%d/", base, number);
}

// ---- targets

// The place where the mesh finds a material file under the name that it uses.
static str library_target(struct planner *p, str mesh_folder, const struct inventory_use *use) {
    struct arena *arena = &p->session->arena;
    str named = arena_copy(arena, use->named);
    for (size_t i = 0; i < named.len; i++)
        if (named.ptr[i] == '\\')
            ((char *)named.ptr)[i] = '/';
    if (named.len && named.ptr[0] == '/')
        return STR("");
    return normalize(arena, mesh_folder, named);
}

static bool belongs_to(const struct inventory_use *library, const struct inventory_use *mesh) {
    return library->role == INVENTORY_MATERIALS && str_equal(library->named_in, mesh->path);
}

static bool is_image_of(const struct inventory_use *image, const struct inventory_use *library) {
    return image->role == INVENTORY_IMAGE && image->named_in.len && str_equal(image->named_in, library->path);
}

// The folder of a file of the package, with its '/'.
static str folder_of(str target) {
    return str_slice(target, 0, target.len - path_base(target).len);
}

// Whether the images of a material file can be placed where it looks for them.
static bool images_fit(struct planner *p, str library, const struct inventory_use *of) {
    for (uint32_t i = 0; i < p->plan->inventory->count; i++) {
        const struct inventory_use *use = &p->plan->inventory->items[i];
        const str target = is_image_of(use, of) ? library_target(p, folder_of(library), use) : STR("");
        if (target.len && !is_free(p->plan, target, use->canonical))
            return false;
    }
    return true;
}

static void add_images(struct planner *p, str library, const struct inventory_use *of) {
    struct diag_sink *sink = &p->session->sink;
    for (uint32_t i = 0; i < p->plan->inventory->count; i++) {
        const struct inventory_use *use = &p->plan->inventory->items[i];
        if (!is_image_of(use, of))
            continue;
        const str target = library_target(p, folder_of(library), use);
        if (target.len) {
            add_file(p, target, use);
            continue;
        }
        diag_add(sink, DIAG_PACK_PATH, use->at,
                 "line %u of the material file '%.*s' names its image '%.*s' by a path that leads out of a "
                 "package",
                 use->named_line, STR_ARG(of->path), STR_ARG(use->named));
        diag_help(
            sink,
            "put the image into the folder of the material file, and write only its name after 'map_Kd'");
    }
}

// Whether the mesh and its material files fit below `folder`.
static bool fits(struct planner *p, str folder, const struct inventory_use *mesh, str target) {
    if (!is_free(p->plan, target, mesh->canonical))
        return false;
    for (uint32_t i = 0; i < p->plan->inventory->count; i++) {
        const struct inventory_use *use = &p->plan->inventory->items[i];
        if (!belongs_to(use, mesh))
            continue;
        str library = library_target(p, folder, use);
        if (library.len && (!is_free(p->plan, library, use->canonical) || !images_fit(p, library, use)))
            return false;
    }
    return true;
}

static void add_libraries(struct planner *p, str folder, const struct inventory_use *mesh) {
    struct diag_sink *sink = &p->session->sink;
    for (uint32_t i = 0; i < p->plan->inventory->count; i++) {
        const struct inventory_use *use = &p->plan->inventory->items[i];
        if (!belongs_to(use, mesh))
            continue;
        str target = library_target(p, folder, use);
        if (target.len) {
            add_file(p, target, use);
            add_images(p, target, use);
            continue;
        }
        diag_add(
            sink, DIAG_PACK_PATH, use->at,
            "line %u of the mesh '%.*s' names its material file '%.*s' by a path that leads out of a package",
            use->named_line, STR_ARG(mesh->path), STR_ARG(use->named));
        diag_help(
            sink,
            "put the material file into the folder of the mesh, and write only its name after 'mtllib'");
    }
}

static void place(struct planner *p, const struct inventory_use *use, const char *folder) {
    if (find_canonical(p->plan, use->canonical))
        return;
    for (int number = 1; number <= TRIES; number++) {
        str in = folder_name(p, folder, number);
        str target = arena_format(&p->session->arena, "%.*s%.*s", STR_ARG(in), STR_ARG(path_base(use->path)));
        // A scene may have the same name as a folder.
        if (find_target(p->plan, str_slice(in, 0, in.len - 1)) || !fits(p, in, use, target))
            continue;
        add_file(p, target, use);
        add_libraries(p, in, use);
        return;
    }
}

// Limits that were raised: without them the package might be refused elsewhere. They are settings for
// --config, since what lies beside a scene cannot raise limits.
static void add_limits(struct planner *p) {
    const struct limits *limits = &p->session->options.limits;
    struct strbuf text;
    strbuf_init(&text);
    for (int i = 0; i < LIMIT_COUNT; i++) {
        const struct limit_info *info = limit_info((enum limit)i);
        if (i != LIMIT_MESSAGES && limits->value[i] > info->standard)
            strbuf_format(&text, "%s  %s: %llu\n", text.len ? "" : "limits:\n", info->name,
                          (unsigned long long)limits->value[i]);
    }
    if (text.len) {
        str target = STR("limits.yaml");
        for (int number = 2; find_target(p->plan, target); number++)
            target = arena_format(&p->session->arena, "limits-%d.yaml", number);
        p->plan->limits = target;
        *ARENA_PUSH(&p->session->arena, p->plan) =
            (struct pack_file){.target = target, .text = arena_copy(&p->session->arena, strbuf_view(&text))};
    }
    strbuf_finish(&text);
}

// The scene around a mesh by itself, which nobody wrote: it has the mesh's name, and its paths start from the
// mesh's folder.
static void add_scene_around(struct planner *p, const struct source *source) {
    const str base = path_base(source->path);
    size_t stem = base.len;
    while (stem > 0 && base.ptr[stem - 1] != '.')
        stem--;
    const str name = str_slice(base, 0, stem > 1 ? stem - 1 : base.len);
    *ARENA_PUSH(&p->session->arena, p->plan) = (struct pack_file){
        .target = arena_format(&p->session->arena, "%.*s.glint.yaml", STR_ARG(name)), .text = source->text};
}

static bool is_generated(const struct session *session) {
    const struct ir_file_origin *file = &session->origin.files.items[0];
    return session->sources.items[file->source].kind == SOURCE_KIND_GENERATED;
}

static void place_all(struct planner *p) {
    if (is_generated(p->session))
        add_scene_around(p, &p->session->sources.items[p->session->origin.files.items[0].source]);
    for (uint32_t i = 0; i < p->plan->inventory->count; i++) {
        const struct inventory_use *use = &p->plan->inventory->items[i];
        if (use->role == INVENTORY_SCENE)
            add_file(p, arena_copy(&p->session->arena, path_base(use->path)), use);
        else if (use->role == INVENTORY_INCLUDE)
            place(p, use, "includes");
        else if (use->role == INVENTORY_MESH)
            place(p, use, "meshes");
        else if (use->role == INVENTORY_IMAGE && !use->named_in.len)
            place(p, use, "images");
        else if (use->role == INVENTORY_FONT)
            place(p, use, "fonts");
    }
}

// ---- scene files

// The relative path from one file of the package to another. Folders are one level deep.
static str way(struct arena *arena, str from, str to) {
    const char *slash = memchr(from.ptr, '/', from.len);
    if (!slash)
        return to;
    str folder = str_slice(from, 0, (size_t)(slash - from.ptr) + 1);
    if (str_starts_with(to, folder))
        return str_slice(to, folder.len, to.len);
    return arena_format(arena, "../%.*s", STR_ARG(to));
}

// A path as the file writes it; `old` is the text that it replaces.
static str spell(struct arena *arena, bool is_xml, str old, str path) {
    struct strbuf text;
    strbuf_init(&text);
    bool quoted = old.len >= 2 && (old.ptr[0] == '"' || old.ptr[0] == '\'');
    if (!is_xml) {
        print_yaml_text(&text, path, true);
    } else {
        strbuf_cstr(&text, quoted ? "\"" : "");
        print_xml_text(&text, path);
        strbuf_cstr(&text, quoted ? "\"" : "");
    }
    str copy = arena_copy(arena, strbuf_view(&text));
    strbuf_finish(&text);
    return copy;
}

static int compare_edits(const void *a, const void *b) {
    const struct edit *x = a;
    const struct edit *y = b;
    return x->at.begin < y->at.begin ? -1 : x->at.begin > y->at.begin;
}

static void collect_edits(struct planner *p, const struct ir_file_origin *file, str from,
                          struct edits *edits) {
    struct arena *arena = &p->session->arena;
    for (uint32_t i = 0; i < p->plan->inventory->count; i++) {
        const struct inventory_use *use = &p->plan->inventory->items[i];
        if (!use->named.len || use->named_in.len || use->at.source != file->source)
            continue;
        const struct pack_file *to = find_canonical(p->plan, use->canonical);
        str path = to ? way(arena, from, to->target) : use->named;
        if (str_equal(path, use->named))
            continue;
        str old = source_text(&p->session->sources, use->at);
        *ARENA_PUSH(arena, edits) = (struct edit){use->at, spell(arena, file->is_xml, old, path)};
    }
    if (edits->count)
        qsort(edits->items, edits->count, sizeof *edits->items, compare_edits);
}

static void rewrite(struct planner *p, const struct ir_file_origin *file, struct pack_file *out) {
    struct edits edits = {0};
    struct strbuf text;
    str old = p->session->sources.items[file->source].text;
    uint32_t at = 0;
    collect_edits(p, file, out->target, &edits);
    strbuf_init(&text);
    for (uint32_t i = 0; i < edits.count; i++) {
        const struct edit *edit = &edits.items[i];
        if (edit->at.begin < at)
            continue; // an anchored path is written once and used more than once
        strbuf_str(&text, str_slice(old, at, edit->at.begin));
        strbuf_str(&text, edit->text);
        at = edit->at.end;
    }
    strbuf_str(&text, str_slice(old, at, old.len));
    if (text.failed)
        diag_add(&p->session->sink, DIAG_OUT_OF_MEMORY, SPAN_NONE, "not enough memory to pack this scene");
    out->text = arena_copy(&p->session->arena, strbuf_view(&text));
    out->path = STR("");
    strbuf_finish(&text);
}

static void rewrite_all(struct planner *p) {
    for (uint32_t f = 0; f < p->session->origin.files.count; f++) {
        const struct ir_file_origin *file = &p->session->origin.files.items[f];
        str canonical = files_canonical(&p->session->files, p->session->sources.items[file->source].path);
        struct pack_file *out =
            f == 0 && is_generated(p->session) ? &p->plan->items[0] : find_canonical(p->plan, canonical);
        if (out)
            rewrite(p, file, out);
    }
}

static void plan_all(void *context) {
    struct planner *planner = context;
    place_all(planner);
    rewrite_all(planner);
    add_limits(planner);
}

enum pack_status pack_make_plan(struct session *session, const struct inventory *inventory,
                                struct pack_plan *plan) {
    struct planner planner = {session, plan};
    *plan = (struct pack_plan){.inventory = inventory};
    if (arena_guarded(&session->arena, plan_all, &planner) != ARENA_FAULT_NONE)
        diag_add(&session->sink, DIAG_OUT_OF_MEMORY, SPAN_NONE, "not enough memory to pack this scene");
    return session->sink.errors ? PACK_SCENE : PACK_OK;
}
