// A pick as text and as JSON.
#include "render/pick.h"

#include "core/json_write.h"
#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"
#include "grammar/schema.h"
#include "load/where.h"

#include <math.h>

enum {
    LIGHTS_TOLD = 32, // bits of hit_pixel
    FLAT_DEPTH = 3,   // of the JSON: a ray per line
};

static const char *const kind_words[] = {
    [REFERENCE_PRIMARY] = "camera", [REFERENCE_REFLECTED] = "mirrored", [REFERENCE_REFRACTED] = "refracted"};

static const struct pick_log *main_log(const struct pick *pick) {
    return &pick->logs[pick->device.len ? PICK_DEVICE : PICK_REFERENCE];
}

// ---- text

static void put_vector(struct strbuf *out, vec3 v) {
    strbuf_format(out, "%.6g %.6g %.6g", v.x, v.y, v.z);
}

static void put_place(const struct pick *pick, span at, struct strbuf *out) {
    if (span_is_none(at))
        return;
    const struct source_place place = source_locate(&pick->session->sources, at);
    strbuf_format(out, ", %.*s:%u:%u", STR_ARG(place.path), place.line, place.column);
}

static void put_light(const struct pick *pick, uint32_t light, struct strbuf *out) {
    const struct ir_lights *lights = &pick->session->scene->lights;
    if (light >= lights->count)
        strbuf_cstr(out, "the automatic light");
    else if (lights->items[light].name.len)
        strbuf_format(out, "'%.*s'", STR_ARG(lights->items[light].name));
    else
        ir_copies_label(pick->session->origin.copies, ir_walk_pool(&SCHEMA_LIGHT), light, out);
}

static void put_lights(const struct pick *pick, const struct reference_segment *s, struct strbuf *out) {
    const char *joint = "; ";
    for (uint32_t i = 0; i < LIGHTS_TOLD; i++)
        if (s->considered >> i & 1) {
            strbuf_cstr(out, joint);
            put_light(pick, i, out);
            strbuf_cstr(out, s->lit >> i & 1 ? " lit" : " in shadow");
            joint = ", ";
        }
}

// "dragon.obj:12", or in a binary file "face 12 of dragon.ply".
static void put_face(const struct where *where, struct strbuf *out) {
    if (str_equal_cstr(STR("line"), where->mesh_word))
        strbuf_format(out, "%.*s:%u", STR_ARG(where->mesh), where->mesh_line);
    else
        strbuf_format(out, "%s %u of %.*s", where->mesh_word, where->mesh_line, STR_ARG(where->mesh));
}

static void put_target(const struct pick *pick, const struct reference_segment *s, struct strbuf *out) {
    struct where where;
    const bool found = where_find(pick->session, s->body, s->triangle, &where);
    if (s->light != IR_NO_INDEX) {
        strbuf_cstr(out, "light ");
        put_light(pick, s->light, out);
        strbuf_format(out, ", at %.9g", s->distance);
        return;
    }
    where_body_words(found ? &where : NULL, out);
    if (found && where.mesh_line) {
        strbuf_cstr(out, ", ");
        put_face(&where, out);
    }
    if (found)
        strbuf_format(out, ", at %.9g", s->distance);
    else if (s->depth > pick->max_depth)
        strbuf_cstr(out, ", stopped by max_depth");
}

// The body that the ray is inside, if rays know it, and how much of its light attenuation has left.
static void put_medium(const struct pick *pick, const struct reference_segment *s, struct strbuf *out) {
    struct where where;
    if (s->medium != HIT_NONE && where_find(pick->session, s->medium, 0, &where)) {
        strbuf_cstr(out, ", inside ");
        where_body_words(&where, out);
    }
    if (s->tint.x < 1 || s->tint.y < 1 || s->tint.z < 1)
        strbuf_format(out, ", tinted %.4g %.4g %.4g", s->tint.x, s->tint.y, s->tint.z);
}

static void put_segment(const struct pick *pick, const struct pick_log *log, uint32_t index,
                        struct strbuf *out) {
    const struct reference_segment *s = &log->segments[index];
    strbuf_format(out, "  %4u  ", index);
    if (index)
        strbuf_format(out, "%s from %u", kind_words[s->kind], s->parent);
    else
        strbuf_cstr(out, kind_words[s->kind]);
    strbuf_format(out, ", weight %.6g", s->weight);
    put_medium(pick, s, out);
    strbuf_cstr(out, ": ");
    put_target(pick, s, out);
    put_lights(pick, s, out);
    if (s->total_reflection)
        strbuf_cstr(out, "; total reflection");
    if (s->passes)
        strbuf_cstr(out, "; passes unseen: the medium stays the same");
    strbuf_cstr(out, "; adds ");
    put_vector(out, (vec3){s->radiance.x * s->tint.x * s->weight, s->radiance.y * s->tint.y * s->weight,
                           s->radiance.z * s->tint.z * s->weight});
    if (s->cut_weight > 0)
        strbuf_format(out, "; rays of weight %.3g not followed", s->cut_weight);
    strbuf_char(out, '\n');
}

static void put_path(const struct pick *pick, const struct pick_log *log, struct strbuf *out) {
    for (uint32_t i = 0; i < log->count; i++)
        put_segment(pick, log, i, out);
    if (!log->whole)
        strbuf_format(out, "  and more: the first %u rays were followed\n", log->count);
}

// The texel of what is seen, from the reference: the device knows only colours.
static const struct reference_texel *texel_of(const struct pick *pick) {
    const struct reference_segment *seen = &main_log(pick)->segments[0];
    const struct reference_segment *s = &pick->logs[PICK_REFERENCE].segments[0];
    const bool is_same = s->body == seen->body && s->triangle == seen->triangle;
    return is_same && s->texel.is_there ? &s->texel : NULL;
}

static str texture_path(const struct pick *pick, const struct reference_texel *texel) {
    const struct ir_material *m =
        &pick->session->assets.materials[pick->logs[PICK_REFERENCE].segments[0].material];
    return texel->of_highlight ? m->specular_color.image.file : m->diffuse_color.image.file;
}

static void put_texel(const struct pick *pick, struct strbuf *out) {
    const struct reference_texel *t = texel_of(pick);
    if (!t)
        return;
    strbuf_format(out, "\nimage      '%.*s', pixel %u,%u, at u %.6g v %.6g", STR_ARG(texture_path(pick, t)),
                  t->x, t->y, t->u, t->v);
    if (t->level > 0 || t->taps > 1)
        strbuf_format(out, "; level %.3g, %u place%s averaged", t->level, t->taps, t->taps == 1 ? "" : "s");
    strbuf_cstr(out, "; colour ");
    put_vector(out, t->color);
}

static void put_seen(const struct pick *pick, struct strbuf *out) {
    const struct reference_segment *s = &main_log(pick)->segments[0];
    struct where where;
    const bool found = where_find(pick->session, s->body, s->triangle, &where);
    strbuf_cstr(out, "sees       ");
    if (s->light != IR_NO_INDEX)
        put_target(pick, s, out);
    else
        where_body_words(found ? &where : NULL, out);
    if (found) {
        put_place(pick, where.at, out);
        if (where.instance) {
            strbuf_cstr(out, "\nin         ");
            ir_copies_instance_name(where.copies, where.instance - 1, out);
            put_place(pick, where.instance_at, out);
        }
        strbuf_cstr(out, "\nwith       ");
        where_material_words(&where, out);
        put_place(pick, where.material_at, out);
        if (where.mesh_line) {
            strbuf_format(out, "\nface       triangle %u, ", s->triangle);
            put_face(&where, out);
        }
        strbuf_format(out, "\ndistance   %.9g\npoint      ", s->distance);
        put_vector(out, s->point);
        strbuf_cstr(out, "\nnormal     ");
        put_vector(out, s->shading);
        put_texel(pick, out);
    }
    strbuf_char(out, '\n');
}

static void put_side(const struct pick *pick, int side, uint32_t ray, bool in_color, struct strbuf *out) {
    const struct reference_segment *s = &pick->logs[side].segments[ray];
    put_target(pick, s, out);
    put_lights(pick, s, out);
    if (in_color)
        strbuf_format(out, ", colour %.6g %.6g %.6g", s->radiance.x, s->radiance.y, s->radiance.z);
}

static void put_difference(const struct pick *pick, const struct pick_difference *d, struct strbuf *out) {
    if (d->kind == PICK_OTHER_RAYS) {
        const int side = d->device != UINT32_MAX ? PICK_DEVICE : PICK_REFERENCE;
        const uint32_t ray = side == PICK_DEVICE ? d->device : d->reference;
        strbuf_format(out, "  only the %s sends its ray %u (%s), which hits ",
                      side == PICK_DEVICE ? "device" : "reference", ray,
                      kind_words[pick->logs[side].segments[ray].kind]);
        put_side(pick, side, ray, false, out);
        strbuf_char(out, '\n');
        return;
    }
    const bool in_color = d->kind == PICK_OTHER_COLOR;
    strbuf_format(out, "  ray %u: the device has ", d->device);
    put_side(pick, PICK_DEVICE, d->device, in_color, out);
    strbuf_format(out, "\n    the reference, ray %u, has ", d->reference);
    put_side(pick, PICK_REFERENCE, d->reference, in_color, out);
    strbuf_char(out, '\n');
}

// Whose colour it is; not `whole`: only that of the rays that were followed.
static void put_source(const char *words, bool whole, struct strbuf *out) {
    strbuf_format(out, " (%s", words);
    if (!whole)
        strbuf_format(out, ", of the first %u rays", (unsigned)PICK_SEGMENTS_MAX);
    strbuf_char(out, ')');
}

static void put_color(const struct pick_log *log, const char *words, bool whole, struct strbuf *out) {
    strbuf_cstr(out, "colour     ");
    put_vector(out, log->color);
    if (!isfinite(log->color.x + log->color.y + log->color.z))
        strbuf_cstr(out, ": infinite or not a number");
    put_source(words, whole, out);
    strbuf_char(out, '\n');
}

// Which sample decides the colour of a mean.
static void put_samples(const struct pick *pick, struct strbuf *out) {
    for (uint32_t i = 0; pick->sample_count > 1 && i < pick->sample_count; i++) {
        strbuf_format(out, "sample %-4u", i);
        if (pick->device.len) {
            put_vector(out, pick->samples[PICK_DEVICE][i]);
            put_source("device", pick->is_sample_whole[i], out);
            strbuf_cstr(out, ", ");
        }
        put_vector(out, pick->samples[PICK_REFERENCE][i]);
        strbuf_cstr(out, " (reference)\n");
    }
}

void pick_text(const struct pick *pick, struct strbuf *out) {
    const struct session *session = pick->session;
    const char *precision = pick->is_double ? "double precision" : "single precision";
    strbuf_format(out, "pixel      %u,%u of %d x %d, camera '%.*s', sample %u of %d\n", pick->x, pick->y,
                  session->image->width, session->image->height, STR_ARG(pick->camera), pick->sample,
                  session->image->samples);
    put_seen(pick, out);
    if (pick->device.len)
        put_color(&pick->logs[PICK_DEVICE], precision, pick->logs[PICK_DEVICE].whole, out);
    put_color(&pick->logs[PICK_REFERENCE], "reference", true, out);
    put_samples(pick, out);
    if (pick->device.len) {
        strbuf_format(out, "\npath as %.*s sees it, %s\n", STR_ARG(pick->device), precision);
        put_path(pick, &pick->logs[PICK_DEVICE], out);
    }
    strbuf_cstr(out, "\npath as the reference sees it\n");
    put_path(pick, &pick->logs[PICK_REFERENCE], out);
    if (!pick->device.len)
        return;
    strbuf_format(out, "\ndifferences: %u\n", pick->difference_count);
    for (uint32_t i = 0; i < pick->difference_count && i < PICK_DIFFERENCES_MAX; i++)
        put_difference(pick, &pick->differences[i], out);
}

// ---- JSON

static void json_vector(struct json_writer *w, const char *key, vec3 v) {
    json_open_list(w, key);
    json_write_real(w, NULL, v.x);
    json_write_real(w, NULL, v.y);
    json_write_real(w, NULL, v.z);
    json_close_list(w);
}

static void json_lights(struct json_writer *w, const char *key, uint32_t bits) {
    json_open_list(w, key);
    for (uint32_t i = 0; i < LIGHTS_TOLD; i++)
        if (bits >> i & 1)
            json_write_integer(w, NULL, i);
    json_close_list(w);
}

static void json_place(struct json_writer *w, const char *key, const struct pick *pick, span at) {
    if (span_is_none(at))
        return;
    const struct source_place place = source_locate(&pick->session->sources, at);
    json_open_object(w, key);
    json_write_text(w, "file", place.path);
    json_write_integer(w, "line", place.line);
    json_write_integer(w, "column", place.column);
    json_close_object(w);
}

static void json_target(struct json_writer *w, const struct pick *pick, const struct reference_segment *s) {
    struct where where;
    if (!where_find(pick->session, s->body, s->triangle, &where))
        return;
    json_write_text(w, "kind", str_from(where.kind));
    json_write_integer(w, "index", ir_copies_entry(where.copies, where.row, where.index));
    const uint32_t *places = ir_copies_at(where.copies, where.row, where.index);
    if (places) {
        json_open_list(w, "copy");
        for (uint32_t i = 0; i < places[0]; i++)
            json_write_integer(w, NULL, places[1 + i]);
        json_close_list(w);
    }
    json_write_text(w, "name", where.name);
    json_write_integer(w, "triangle", s->triangle);
    json_place(w, "place", pick, where.at);
    if (where.instance) {
        struct strbuf name;
        strbuf_init(&name);
        ir_copies_instance_name(where.copies, where.instance - 1, &name);
        json_write_text(w, "instance", strbuf_view(&name));
        strbuf_finish(&name);
        json_place(w, "instance_place", pick, where.instance_at);
    }
    json_write_text(w, "material", where.material_name);
    json_write_text(w, "material_kind", str_from(where.material_kind));
    json_place(w, "material_place", pick, where.material_at);
    if (where.mesh_line) {
        json_write_text(w, "mesh", where.mesh);
        json_write_integer(w, str_equal_cstr(STR("line"), where.mesh_word) ? "mesh_line" : "mesh_face",
                           where.mesh_line);
    }
}

static void json_texel(struct json_writer *w, const struct reference_texel *t) {
    if (!t->is_there)
        return;
    json_open_object(w, "image");
    json_write_text(w, "of", t->of_highlight ? STR("specular_color") : STR("diffuse_color"));
    json_write_real(w, "u", t->u);
    json_write_real(w, "v", t->v);
    json_write_integer(w, "x", t->x);
    json_write_integer(w, "y", t->y);
    json_write_real(w, "level", t->level);
    json_write_integer(w, "places", t->taps);
    json_vector(w, "color", t->color);
    json_close_object(w);
}

static void json_segment(struct json_writer *w, const struct pick *pick, const struct reference_segment *s,
                         bool first) {
    json_open_object(w, NULL);
    json_write_text(w, "ray", str_from(kind_words[s->kind]));
    if (!first)
        json_write_integer(w, "parent", s->parent);
    json_write_integer(w, "depth", s->depth);
    json_write_real(w, "weight", s->weight);
    json_vector(w, "origin", s->origin);
    json_vector(w, "direction", s->direction);
    json_vector(w, "radiance", s->radiance);
    json_vector(w, "attenuation", s->tint);
    struct where where;
    if (s->medium != HIT_NONE && where_find(pick->session, s->medium, 0, &where)) {
        struct strbuf words;
        strbuf_init(&words);
        where_body_words(&where, &words);
        json_write_text(w, "inside", strbuf_view(&words));
        strbuf_finish(&words);
    }
    json_write_boolean(w, "cut_by_depth", s->depth > pick->max_depth);
    json_write_real(w, "weight_not_followed", s->cut_weight);
    if (s->light != IR_NO_INDEX) {
        json_write_integer(w, "light", s->light);
        json_write_real(w, "distance", s->distance);
    }
    if (s->body != HIT_NONE) {
        json_open_object(w, "hit");
        json_target(w, pick, s);
        json_write_real(w, "distance", s->distance);
        json_vector(w, "point", s->point);
        json_vector(w, "geometric_normal", s->geometric);
        json_vector(w, "normal", s->shading);
        json_write_boolean(w, "enters", s->enters);
        json_write_boolean(w, "total_reflection", s->total_reflection);
        json_texel(w, &s->texel);
        json_write_boolean(w, "passes", s->passes);
        json_lights(w, "lights_considered", s->considered);
        json_lights(w, "lights_lit", s->lit);
        json_close_object(w);
    }
    json_close_object(w);
}

static void json_path(struct json_writer *w, const char *key, const struct pick *pick, int side) {
    const struct pick_log *log = &pick->logs[side];
    json_open_object(w, key);
    if (side == PICK_DEVICE) {
        json_write_text(w, "device", pick->device);
        json_write_text(w, "precision", pick->is_double ? STR("double") : STR("single"));
    }
    json_vector(w, "color", log->color);
    json_write_boolean(w, "whole", log->whole);
    json_open_list(w, "path");
    for (uint32_t i = 0; i < log->count; i++)
        json_segment(w, pick, &log->segments[i], i == 0);
    json_close_list(w);
    json_close_object(w);
}

static void json_differences(struct json_writer *w, const struct pick *pick) {
    static const char *const words[] = {[PICK_OTHER_BODY] = "body",
                                        [PICK_OTHER_LIGHTS] = "lights",
                                        [PICK_OTHER_DISTANCE] = "distance",
                                        [PICK_OTHER_COLOR] = "colour",
                                        [PICK_OTHER_RAYS] = "rays"};
    json_write_integer(w, "difference_count", pick->difference_count);
    json_open_list(w, "differences");
    for (uint32_t i = 0; i < pick->difference_count && i < PICK_DIFFERENCES_MAX; i++) {
        const struct pick_difference *d = &pick->differences[i];
        json_open_object(w, NULL);
        json_write_text(w, "of", str_from(words[d->kind]));
        if (d->device != UINT32_MAX)
            json_write_integer(w, "device_ray", d->device);
        if (d->reference != UINT32_MAX)
            json_write_integer(w, "reference_ray", d->reference);
        json_close_object(w);
    }
    json_close_list(w);
}

void pick_json(const struct pick *pick, struct strbuf *out) {
    struct json_writer w;
    json_report_begin(&w, out, FLAT_DEPTH, "glint pick", 1);
    json_write_integer(&w, "x", pick->x);
    json_write_integer(&w, "y", pick->y);
    json_write_integer(&w, "width", (uint64_t)pick->session->image->width);
    json_write_integer(&w, "height", (uint64_t)pick->session->image->height);
    json_write_text(&w, "camera", pick->camera);
    json_write_integer(&w, "sample", pick->sample);
    if (pick->device.len) {
        json_path(&w, "device", pick, PICK_DEVICE);
        json_differences(&w, pick);
    }
    json_path(&w, "reference", pick, PICK_REFERENCE);
    json_report_end(&w);
}
