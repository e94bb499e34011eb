#include "cli/stats.h"

#include "grammar/ir_features.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

static void seconds(struct strbuf *out, const char *name, double value) {
    strbuf_format(out, "  %-16s %10.3f ms\n", name, 1e3 * value);
}

static void count(struct strbuf *out, const char *name, uint64_t value) {
    strbuf_format(out, "  %-16s %10llu\n", name, (unsigned long long)value);
}

static void bytes(struct strbuf *out, const char *name, uint64_t value) {
    strbuf_format(out, "  %-16s %10.1f MiB\n", name, (double)value / (1 << 20));
}

void stats_text(const struct stats *s, struct strbuf *out) {
    strbuf_format(out, "device: %s\npicture: %u x %u, %u sample%s, in %s precision\ntimes\n", s->device,
                  s->width, s->height, s->samples, s->samples == 1 ? "" : "s",
                  s->is_double ? "double" : "single");
    seconds(out, "read", s->read_seconds);
    seconds(out, "assets", s->assets_seconds);
    seconds(out, "flatten", s->flatten_seconds);
    seconds(out, " of it, trees", s->build_seconds);
    seconds(out, "open device", s->device_seconds);
    seconds(out, "upload, compile", s->upload_seconds);
    seconds(out, "first frame", s->first_frame_seconds);
    if (s->frames > 1) {
        strbuf_format(out, "  median frame     %10.3f ms of %d, from %.3f to %.3f ms\n",
                      1e3 * s->median_frame_seconds, s->frames, 1e3 * s->least_frame_seconds,
                      1e3 * s->most_frame_seconds);
    }
    seconds(out, "encode", s->encode_seconds);
    const struct render_rays *r = &s->rays;
    strbuf_cstr(out, "rays\n");
    count(out, "primary", r->primary);
    count(out, "reflected", r->reflected);
    count(out, "refracted", r->refracted);
    count(out, "shadow", r->shadow);
    count(out, "total reflection", r->total_reflections);
    strbuf_format(out, "  deepest level    %10u\n", r->deepest);
    count(out, "nodes tested", r->nodes);
    count(out, "items tested", r->items);
    strbuf_cstr(out, "dropped\n");
    count(out, "by max_depth", r->cut_by_depth);
    count(out, "by min_weight", r->cut_by_weight);
    strbuf_format(out, "  largest lost     %10.3g by depth, %.3g by weight\n", r->lost_by_depth,
                  r->lost_by_weight);
    count(out, "zero triangles", s->dropped);
    strbuf_cstr(out, "scene\n");
    count(out, "triangles", s->triangles);
    count(out, "spheres", s->spheres);
    count(out, "tree levels", s->triangle_depth);
    strbuf_format(out, "  dispatches       %10u, %u of them slices, %u bands\n", s->last.dispatches,
                  s->last.slices, s->last.bands);
    strbuf_cstr(out, "memory\n");
    bytes(out, "scene, device", s->scene_bytes);
    bytes(out, "band, device", s->band_bytes);
    bytes(out, "process, peak", (uint64_t)s->peak_memory_bytes);
}

static void set_integer(json_t *object, const char *key, uint64_t value) {
    json_object_set_new(object, key, json_integer((json_int_t)value));
}

static void set_real(json_t *object, const char *key, double value) {
    json_object_set_new(object, key, json_real(value));
}

static json_t *times_object(const struct stats *s) {
    json_t *times = json_object();
    set_real(times, "read_s", s->read_seconds);
    set_real(times, "assets_s", s->assets_seconds);
    set_real(times, "flatten_s", s->flatten_seconds);
    set_real(times, "trees_s", s->build_seconds);
    set_real(times, "open_device_s", s->device_seconds);
    set_real(times, "upload_s", s->upload_seconds);
    set_real(times, "first_frame_s", s->first_frame_seconds);
    set_real(times, "median_frame_s", s->median_frame_seconds);
    set_real(times, "least_frame_s", s->least_frame_seconds);
    set_real(times, "most_frame_s", s->most_frame_seconds);
    set_real(times, "last_frame_device_s", s->last.device_seconds);
    set_real(times, "encode_s", s->encode_seconds);
    set_integer(times, "frames", (uint64_t)s->frames);
    return times;
}

static json_t *rays_object(const struct render_rays *r) {
    json_t *rays = json_object();
    set_integer(rays, "primary", r->primary);
    set_integer(rays, "reflected", r->reflected);
    set_integer(rays, "refracted", r->refracted);
    set_integer(rays, "shadow", r->shadow);
    set_integer(rays, "total_reflections", r->total_reflections);
    set_integer(rays, "deepest", r->deepest);
    set_integer(rays, "nodes_tested", r->nodes);
    set_integer(rays, "items_tested", r->items);
    set_integer(rays, "cut_by_depth", r->cut_by_depth);
    set_integer(rays, "cut_by_weight", r->cut_by_weight);
    set_real(rays, "largest_lost_by_depth", r->lost_by_depth);
    set_real(rays, "largest_lost_by_weight", r->lost_by_weight);
    return rays;
}

static json_t *features_array(uint32_t mask) {
    json_t *names = json_array();
    for (uint32_t i = 0; i < FEATURE_COUNT; i++)
        if (mask & (1u << i))
            json_array_append_new(names, json_string(feature_name(1u << i)));
    return names;
}

void stats_json(const struct stats *s, struct strbuf *out) {
    json_t *root = json_object();
    json_object_set_new(root, "device", json_string(s->device));
    set_integer(root, "width", s->width);
    set_integer(root, "height", s->height);
    set_integer(root, "samples", s->samples);
    json_object_set_new(root, "precision", json_string(s->is_double ? "double" : "single"));
    json_object_set_new(root, "times", times_object(s));
    json_object_set_new(root, "rays", rays_object(&s->rays));
    json_object_set_new(root, "features", features_array(s->features));
    set_integer(root, "triangles", s->triangles);
    set_integer(root, "dropped_triangles", s->dropped);
    set_integer(root, "spheres", s->spheres);
    set_integer(root, "tree_levels", s->triangle_depth);
    set_integer(root, "dispatches", s->last.dispatches);
    set_integer(root, "slices", s->last.slices);
    set_integer(root, "bands", s->last.bands);
    set_integer(root, "scene_bytes", s->scene_bytes);
    set_integer(root, "band_bytes", s->band_bytes);
    set_integer(root, "peak_memory_bytes", (uint64_t)s->peak_memory_bytes);
    char *text = json_dumps(root, JSON_INDENT(2) | JSON_REAL_PRECISION(9));
    if (text) {
        strbuf_cstr(out, text);
        strbuf_char(out, '\n');
    } else {
        out->failed = true;
    }
    free(text);
    json_decref(root);
}
