// Meshes that the scene describes: each is made once, by assets/made/, and kept in the store under what it is
// made of, so that a scene that is loaded again makes only those that changed.
#include "assets/loader.h"
#include "assets/made/made.h"
#include "assets/mesh_build.h"
#include "assets/mesh_coordinates.h"
#include "assets/mesh_losses.h"
#include "core/clock.h"
#include "core/hash128.h"
#include "core/timeline.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "diag/codes/rule.h"
#include "grammar/ir.h"
#include "grammar/ir_hash.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"

#include <string.h>

struct making {
    struct loader *loader;
    const struct ir_mesh *ir;
    struct loaded_mesh *loaded;
    struct arena *scratch;
    struct mesh *mesh;
    struct made made;
    bool is_made;
};

// ---- from the scene's lists to plain arrays

static struct ir_pair *pairs(struct arena *arena, const struct ir_outline *outline) {
    struct ir_pair *out = ARENA_ARRAY(arena, struct ir_pair, (size_t)outline->count + 1);
    for (uint32_t i = 0; i < outline->count; i++)
        out[i] = (struct ir_pair){outline->items[i].at.x, outline->items[i].at.y};
    return out;
}

static bool make_lathe(struct making *m, const struct made_to *to) {
    const struct ir_lathe *ir = &m->ir->lathe;
    const struct made_lathe lathe = {pairs(m->scratch, &ir->profile), ir->profile.count,
                                     ir->curve == IR_CURVE_SMOOTH, ir->angle, m->ir->tolerance};
    return made_build_lathe(&lathe, to, &m->made);
}

static bool make_torus(struct making *m, const struct made_to *to) {
    const struct made_torus torus = {m->ir->torus.radius, m->ir->torus.tube, m->ir->tolerance};
    return made_build_torus(&torus, to, &m->made);
}

static bool make_extrude(struct making *m, const struct made_to *to) {
    const struct ir_extrude *ir = &m->ir->extrude;
    struct made_outline *outlines = ARENA_ARRAY(m->scratch, struct made_outline, (size_t)ir->holes.count + 1);
    outlines[0] = (struct made_outline){pairs(m->scratch, &ir->outline), ir->outline.count};
    for (uint32_t i = 0; i < ir->holes.count; i++) {
        const struct ir_outline *hole = &ir->holes.items[i].points;
        outlines[i + 1] = (struct made_outline){pairs(m->scratch, hole), hole->count};
    }
    const struct made_extrude extrude = {
        .outlines = outlines,
        .count = ir->holes.count + 1,
        .smooth = ir->curve == IR_CURVE_SMOOTH,
        .height = ir->height,
        .bevel = ir->bevel,
        .tolerance = m->ir->tolerance,
    };
    return made_build_extrude(&extrude, to, &m->made);
}

static bool make_faces(struct making *m, const struct made_to *to) {
    const struct ir_faces *ir = &m->ir->faces;
    vec3 *vertices = ARENA_ARRAY(m->scratch, vec3, (size_t)ir->vertices.count + 1);
    struct ir_pair *uv = ARENA_ARRAY(m->scratch, struct ir_pair, (size_t)ir->uv.count + 1);
    uint32_t *firsts = ARENA_ARRAY(m->scratch, uint32_t, (size_t)ir->faces.count + 1);
    uint32_t corner_count = 0;
    for (uint32_t i = 0; i < ir->vertices.count; i++)
        vertices[i] = ir->vertices.items[i].at;
    for (uint32_t i = 0; i < ir->uv.count; i++)
        uv[i] = ir->uv.items[i].at;
    for (uint32_t i = 0; i < ir->faces.count; i++) {
        firsts[i] = corner_count;
        corner_count += ir->faces.items[i].corners.count;
    }
    uint32_t *corners = ARENA_ARRAY(m->scratch, uint32_t, (size_t)corner_count + 1);
    for (uint32_t i = 0; i < ir->faces.count; i++)
        for (uint32_t k = 0; k < ir->faces.items[i].corners.count; k++)
            corners[firsts[i] + k] = (uint32_t)ir->faces.items[i].corners.items[k].vertex;
    const struct made_faces faces = {
        .vertices = vertices,
        .vertex_count = ir->vertices.count,
        .corners = corners,
        .corner_count = corner_count,
        .firsts = firsts,
        .face_count = ir->faces.count,
        .coordinates = ir->uv.count ? uv : NULL,
        .coordinate_count = ir->uv.count,
    };
    return made_build_faces(&faces, to, &m->made);
}

static bool make_text(struct making *m, const struct made_to *to) {
    const struct ir_text *ir = &m->ir->text;
    static const enum made_align aligns[] = {
        [IR_ALIGN_LEFT] = MADE_ALIGN_LEFT,
        [IR_ALIGN_CENTER] = MADE_ALIGN_CENTER,
        [IR_ALIGN_RIGHT] = MADE_ALIGN_RIGHT,
    };
    if (!asset_read(&m->loaded->file, m->scratch))
        return false;
    const struct made_text text = {
        .text = ir->string,
        .font = m->loaded->file.text,
        .height = ir->height,
        .depth = ir->depth,
        .bevel = ir->bevel,
        .tolerance = m->ir->tolerance,
        .align = aligns[ir->align],
    };
    return made_build_text(&text, to, &m->made);
}

static bool make_any(struct making *m, const struct made_to *to) {
    switch ((enum ir_mesh_kind)m->ir->kind) {
    case IR_MESH_LATHE:
        return make_lathe(m, to);
    case IR_MESH_TORUS:
        return make_torus(m, to);
    case IR_MESH_EXTRUDE:
        return make_extrude(m, to);
    case IR_MESH_FACES:
        return make_faces(m, to);
    case IR_MESH_TEXT:
        return make_text(m, to);
    }
    return false;
}

static void make(void *context) {
    struct making *m = context;
    const struct made_to to = {m->scratch, m->loader->input->limits->value[LIMIT_MESH_TRIANGLES]};
    if (!make_any(m, &to))
        return;
    m->made.polygons.is_binary = true;
    mesh_build(&m->made.polygons, m->loaded->name, m->scratch, m->mesh);
    mesh_assign_coordinates(&m->made.textured, m->scratch, m->mesh);
    m->mesh->is_made = true;
    m->is_made = true;
}

// ---- what is wrong

static const struct schema_row *row_of_kind(const struct ir_mesh *ir) {
    for (uint32_t i = 0; i < SCHEMA_MESH.row_count; i++)
        if (SCHEMA_MESH.rows[i].choice && ir_walk_taken(&SCHEMA_MESH, &SCHEMA_MESH.rows[i], ir))
            return &SCHEMA_MESH.rows[i];
    return NULL;
}

static span label(const struct making *m, const void *element) {
    return ir_place_label(m->loader->input->origin, ir_walk_head(element));
}

// Where an entry of the outlines, or a face, is written; the mesh, if the entry is not known.
static span place_of_entry(const struct making *m, uint32_t outline, uint32_t point) {
    const struct ir_mesh *ir = m->ir;
    const struct ir_outline *points = ir->kind == IR_MESH_LATHE ? &ir->lathe.profile : &ir->extrude.outline;
    if (ir->kind == IR_MESH_EXTRUDE && outline > 0 && outline <= ir->extrude.holes.count)
        points = &ir->extrude.holes.items[outline - 1].points;
    if ((ir->kind == IR_MESH_LATHE || ir->kind == IR_MESH_EXTRUDE) && point < points->count)
        return label(m, &points->items[point]);
    if (ir->kind == IR_MESH_FACES && outline < ir->faces.faces.count)
        return label(m, &ir->faces.faces.items[outline]);
    if (ir->kind == IR_MESH_FACES && point < ir->faces.vertices.count)
        return label(m, &ir->faces.vertices.items[point]);
    return label(m, schema_field_const(row_of_kind(ir), ir));
}

static diag_code code_of(enum made_code code) {
    switch (code) {
    case MADE_NO_FONTS:
    case MADE_FONT:
    case MADE_GLYPH_BROKEN:
        return DIAG_FONT_BROKEN;
    case MADE_GLYPH:
    case MADE_TEXT:
    case MADE_TEXT_EMPTY:
        return DIAG_NO_GLYPH;
    default:
        return DIAG_BAD_SHAPE;
    }
}

static void report_fault(const struct making *m) {
    const struct made_fault *fault = &m->made.fault;
    const struct assets_input *input = m->loader->input;
    const diag_code code = code_of(fault->code);
    span at = place_of_entry(m, fault->outlines[0], fault->points[0]);
    if (code != DIAG_BAD_SHAPE)
        at = ir_place_value(input->origin, &m->ir->text.head, &SCHEMA_MESH_TEXT,
                            code == DIAG_FONT_BROKEN ? "font" : "string");
    if (fault->code == MADE_TRIANGLES) {
        const struct limit_info *info = limit_info(LIMIT_MESH_TRIANGLES);
        diag_add(input->sink, DIAG_LIMIT, at, "this mesh would have %llu triangles; the limit %s is %llu",
                 (unsigned long long)m->made.triangle_count, info->name,
                 (unsigned long long)input->limits->value[LIMIT_MESH_TRIANGLES]);
        diag_help(input->sink, "write a larger 'tolerance'");
        return;
    }
    diag_add(input->sink, code, at, "%s", fault->text);
    if (fault->points[1] != IR_NO_INDEX && code == DIAG_BAD_SHAPE)
        diag_note(input->sink, place_of_entry(m, fault->outlines[1], fault->points[1]), "with this");
}

// ---- what is notable

// A quadrilateral can be cut along either of its diagonals.
static void help_cut(const struct making *m, const struct ir_face *face) {
    struct diag_sink *sink = m->loader->input->sink;
    const struct ir_corner *c = face->corners.items;
    if (face->corners.count != 4) {
        diag_help(sink, "glint draws triangles: write the face as triangles to choose where it bends");
        return;
    }
    diag_help(
        sink,
        "glint draws triangles: write two faces, of the vertices %d, %d, %d and %d, %d, %d, or of %d, %d, "
        "%d and %d, %d, %d, to choose where it bends",
        c[0].vertex, c[1].vertex, c[2].vertex, c[0].vertex, c[2].vertex, c[3].vertex, c[0].vertex,
        c[1].vertex, c[3].vertex, c[1].vertex, c[2].vertex, c[3].vertex);
}

// The same that is reported of mesh files, at faces of the scene. The other kinds of meshes are flat and
// outward as they are made.
static void report_faces(const struct making *m) {
    const struct mesh *mesh = m->loaded->mesh;
    const struct ir_faces *faces = &m->ir->faces;
    struct diag_sink *sink = m->loader->input->sink;
    if (mesh->turned)
        diag_add(sink, DIAG_MESH_TURNED, label(m, faces),
                 "the faces of this closed mesh point inwards and were turned outwards");
    if (mesh->bent_line == 0)
        return;
    const struct ir_face *face = &faces->faces.items[mesh->bent_line - 1];
    const uint32_t others = mesh->losses[MESH_LOSS_BENT].count - 1;
    diag_add(sink, mesh_losses_bend(mesh), label(m, face),
             "this face is not flat: a corner is off its plane by %.2g %% of the face's size",
             100 * mesh->bent_most);
    if (others)
        diag_note(sink, SPAN_NONE, "%u other face%s of the mesh %s not flat either", others,
                  others == 1 ? "" : "s", others == 1 ? "is" : "are");
    help_cut(m, face);
}

// ---- which

// Whether nothing in the element was reported.
static bool is_sound(const struct schema_element *schema, const void *element) {
    if (ir_walk_head(element)->poisoned)
        return false;
    for (uint32_t i = 0; i < schema->row_count; i++) {
        const struct schema_row *row = &schema->rows[i];
        const struct ir_any_list list = ir_walk_list(row, element);
        if (row->kind == SCHEMA_ELEMENT && ir_walk_taken(schema, row, element) &&
            !is_sound(row->child, schema_field_const(row, element)))
            return false;
        for (uint32_t k = 0; k < list.count; k++)
            if (!is_sound(row->child, ir_walk_item(row, list, k)))
                return false;
    }
    return true;
}

static bool find_font(struct making *m, struct file_read *identity) {
    struct asset_file *file = &m->loaded->file;
    const str font = m->ir->text.font;
    file->what = "font";
    file->limit = LIMIT_FONT_BYTES;
    file->named_at = ir_place_value(file->input->origin, &m->ir->text.head, &SCHEMA_MESH_TEXT, "font");
    if (!schema_file_fits(SCHEMA_FILE_FONT, font)) {
        asset_report_named(file, DIAG_FILE_KIND, "'%.*s' is not a font", STR_ARG(font));
        diag_help(file->input->sink, "fonts end in %.*s",
                  STR_ARG(schema_file_words(SCHEMA_FILE_FONT, file->input->arena)));
        return false;
    }
    return asset_find(file, asset_base(file->input, file->named_at), font, identity, NULL);
}

// What the mesh depends on, as the path of a file that nobody can name.
static str key_of(const struct making *m, const struct file_read *font) {
    struct hash128 h;
    uint64_t key[2];
    const struct schema_row *row = row_of_kind(m->ir);
    hash128_begin(&h);
    hash128_text(&h, str_from(row->name));
    hash128_number(&h, m->ir->tolerance);
    ir_hash(&h, row->child, schema_field_const(row, m->ir));
    hash128_text(&h, font->path);
    hash128_end(&h, key);
    return arena_format(m->loader->input->arena, "made\n%016llx%016llx", (unsigned long long)key[0],
                        (unsigned long long)key[1]);
}

static void make_guarded(struct making *m) {
    const size_t cap = limits_size(m->loader->input->limits, LIMIT_MESH_MEMORY);
    struct arena *arenas[] = {m->scratch, &m->mesh->arena, NULL};
    const double start = clock_seconds();
    arena_init(m->scratch, cap);
    arena_init(&m->mesh->arena, cap);
    const enum arena_fault fault = arena_guarded_all(arenas, make, m);
    timeline_add(m->loader->input->timeline, "mesh", m->loaded->name, start);
    if (fault)
        asset_report_memory(&m->loaded->file, fault);
    else if (!m->is_made && m->loaded->file.errors == 0)
        report_fault(m);
    m->loaded->file.text = STR("");
    arena_finish(m->scratch);
}

static void load(struct making *m) {
    struct file_read key = {0};
    if (m->ir->kind == IR_MESH_TEXT && !find_font(m, &key))
        return;
    key.path = key_of(m, &key);
    struct store_entry *entry = store_find(m->loader->hold, STORE_MESH, &key);
    if (!entry) {
        entry = store_add(m->loader->hold, STORE_MESH, &key);
        if (!entry) {
            asset_report_memory(&m->loaded->file, ARENA_FAULT_SYSTEM);
            return;
        }
        m->mesh = &entry->mesh;
        make_guarded(m);
        if (m->is_made)
            store_complete(m->loader->hold, entry);
        else
            arena_finish(&entry->mesh.arena);
    }
    m->loaded->mesh = m->loaded->own = entry->is_whole ? &entry->mesh : NULL;
    if (m->loaded->mesh && m->ir->kind == IR_MESH_FACES)
        report_faces(m);
}

bool loader_names_file(const struct ir_model *model) {
    return ir_walk_path(&SCHEMA_MODEL.rows[schema_find_row(&SCHEMA_MODEL, STR("mesh"))], model) != NULL;
}

struct loaded_mesh *loader_made_mesh(struct loader *loader, uint32_t index) {
    const struct assets_input *input = loader->input;
    const struct ir_mesh *ir = &input->scene->meshes.items[index];
    if (!loader->made)
        loader->made = ARENA_ARRAY(input->arena, struct loaded_mesh *, input->scene->meshes.count);
    if (loader->made[index])
        return loader->made[index];
    struct loaded_mesh *loaded = ARENA_NEW(input->arena, struct loaded_mesh);
    loader->made[index] = loaded;
    if (!is_sound(&SCHEMA_MESH, ir))
        return loaded;
    struct making making = {.loader = loader, .ir = ir, .loaded = loaded, .scratch = &loader->hold->scratch};
    loaded->made = ir;
    loaded->name = loaded->file.path = ir->name.len ? ir->name : str_from(row_of_kind(ir)->name);
    loaded->file.input = input;
    loaded->file.what = "mesh";
    loaded->file.limit = LIMIT_MESH_MEMORY;
    loaded->file.named_at = ir_place_label(input->origin, &ir->head);
    load(&making);
    return loaded;
}
