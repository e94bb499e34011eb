#include "render/stats/stats.h"

#include "core/json_write.h"
#include "core/strbuf.h"
#include "core/timeline.h"
#include "grammar/ir_features.h"

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

static void put_audit(const struct audit *audit, struct strbuf *out) {
    strbuf_cstr(out, "error\n  ");
    audit_words(audit, out);
    if (audit->off)
        strbuf_format(out, ", the first at %u,%u", audit->x, audit->y);
    strbuf_char(out, '\n');
    seconds(out, "traced again in", audit->seconds);
}

// Threads are numbered as they turn up.
static unsigned thread_number(const struct timeline *timeline, unsigned at) {
    unsigned number = 1;
    for (unsigned i = 0; i < at; i++) {
        bool first = true;
        for (unsigned k = 0; k < i; k++)
            first &= timeline->phases[k].thread != timeline->phases[i].thread;
        if (timeline->phases[i].thread == timeline->phases[at].thread)
            return number;
        number += first;
    }
    return number;
}

static void put_timeline(const struct stats *s, struct strbuf *out) {
    const unsigned count = timeline_sort(s->timeline);
    strbuf_cstr(out, "timeline: start, length, thread\n");
    for (unsigned i = 0; i < count; i++) {
        const struct timeline_phase *p = &s->timeline->phases[i];
        const str file = path_base(p->detail);
        strbuf_format(out, "  %-10s %10.3f %10.3f ms %4u%s%.*s\n", p->name, 1e3 * (p->begin - s->begun),
                      1e3 * p->seconds, thread_number(s->timeline, i), file.len ? "  " : "", STR_ARG(file));
    }
}

static double mean_samples(const struct stats *s) {
    return (double)s->last.all_samples / ((double)s->width * s->height);
}

static void put_rays_text(const struct render_rays *r, struct strbuf *out) {
    strbuf_cstr(out, "rays\n");
    count(out, "primary", r->primary);
    count(out, "reflected", r->reflected);
    count(out, "refracted", r->refracted);
    count(out, "shadow", r->shadow);
    count(out, "total reflection", r->total_reflections);
    count(out, "unseen crossings", r->unseen);
    strbuf_format(out, "  deepest level    %10u\n", r->deepest);
    count(out, "nodes tested", r->nodes);
    count(out, "items tested", r->items);
    strbuf_cstr(out, "rays dropped\n");
    count(out, "by max_depth", r->cut_by_depth);
    count(out, "by min_weight", r->cut_by_weight);
    strbuf_format(out, "  largest lost     %10.3g by depth, %.3g by weight\n", r->lost_by_depth,
                  r->lost_by_weight);
}

void stats_text(const struct stats *s, struct strbuf *out) {
    strbuf_format(out, "device: %s\npicture: %u x %u, %s%u sample%s, in %s precision\n", s->device, s->width,
                  s->height, s->estimate ? "at most " : "", s->samples, s->samples == 1 ? "" : "s",
                  s->is_double ? "double" : "single");
    if (s->estimate)
        strbuf_format(
            out, "  taken %.4g on average: standard error %.3g as displayed, at most %.3g (95 %% sure)\n",
            mean_samples(s), s->estimate->mean, s->estimate->most);
    strbuf_cstr(out, "times\n");
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
        seconds(out, " of it, device", s->median_device_seconds);
    }
    seconds(out, "encode", s->encode_seconds);
    if (s->has_rays) {
        seconds(out, "count rays", s->count_seconds);
        put_rays_text(&s->last.rays, out);
    }
    strbuf_cstr(out, "scene\n");
    count(out, "triangles", s->triangles);
    count(out, "spheres", s->spheres);
    count(out, "dropped, no area", s->dropped);
    count(out, "tree levels", s->triangle_depth);
    // Reports say band for what the renderer calls a portion: their words stay as they are.
    strbuf_format(out, "  dispatches       %10u, %u of them slices, %u bands\n", s->last.dispatches,
                  s->last.slices, s->last.portions);
    strbuf_cstr(out, "memory\n");
    bytes(out, "scene, device", s->scene_bytes);
    bytes(out, "band, device", s->portion_bytes);
    bytes(out, "process, peak", (uint64_t)s->peak_memory_bytes);
    if (s->has_audit)
        put_audit(&s->audit, out);
    put_timeline(s, out);
}

static void put_times(struct json_writer *w, const struct stats *s) {
    json_open_object(w, "times");
    json_write_real(w, "read_s", s->read_seconds);
    json_write_real(w, "assets_s", s->assets_seconds);
    json_write_real(w, "flatten_s", s->flatten_seconds);
    json_write_real(w, "trees_s", s->build_seconds);
    json_write_real(w, "open_device_s", s->device_seconds);
    json_write_real(w, "upload_s", s->upload_seconds);
    json_write_real(w, "first_frame_s", s->first_frame_seconds);
    json_write_real(w, "median_frame_s", s->median_frame_seconds);
    json_write_real(w, "least_frame_s", s->least_frame_seconds);
    json_write_real(w, "most_frame_s", s->most_frame_seconds);
    json_write_real(w, "median_frame_device_s", s->median_device_seconds);
    json_write_real(w, "last_frame_device_s", s->last.device_seconds);
    json_write_real(w, "encode_s", s->encode_seconds);
    json_write_real(w, "count_s", s->count_seconds);
    json_write_integer(w, "frames", (uint64_t)s->frames);
    json_close_object(w);
}

static void put_rays(struct json_writer *w, const struct render_rays *r) {
    json_open_object(w, "rays");
    json_write_integer(w, "primary", r->primary);
    json_write_integer(w, "reflected", r->reflected);
    json_write_integer(w, "refracted", r->refracted);
    json_write_integer(w, "shadow", r->shadow);
    json_write_integer(w, "total_reflections", r->total_reflections);
    json_write_integer(w, "unseen_crossings", r->unseen);
    json_write_integer(w, "deepest", r->deepest);
    json_write_integer(w, "nodes_tested", r->nodes);
    json_write_integer(w, "items_tested", r->items);
    json_write_integer(w, "cut_by_depth", r->cut_by_depth);
    json_write_integer(w, "cut_by_weight", r->cut_by_weight);
    json_write_real(w, "largest_lost_by_depth", r->lost_by_depth);
    json_write_real(w, "largest_lost_by_weight", r->lost_by_weight);
    json_close_object(w);
}

static void json_audit(struct json_writer *w, const struct audit *audit) {
    json_open_object(w, "audit");
    json_write_integer(w, "pixels", audit->pixels);
    json_write_integer(w, "off", audit->off);
    json_write_boolean(w, "whole", audit->whole);
    json_write_real(w, "share_at_most", audit->bound);
    json_write_real(w, "confidence", audit->whole ? 1 : AUDIT_CONFIDENCE);
    if (audit->off) {
        json_write_integer(w, "first_x", audit->x);
        json_write_integer(w, "first_y", audit->y);
    }
    json_write_real(w, "seconds", audit->seconds);
    json_close_object(w);
}

static void put_estimate(struct json_writer *w, const struct stats *s) {
    if (s->unused_error > 0)
        json_write_real(w, "unused_error", s->unused_error);
    if (!s->estimate)
        return;
    json_open_object(w, "noise");
    json_write_real(w, "mean_samples", mean_samples(s));
    json_write_real(w, "standard_error", s->estimate->mean);
    json_write_real(w, "at_most", s->estimate->most);
    json_write_real(w, "confidence", RENDER_ESTIMATE_CONFIDENCE);
    json_write_integer(w, "not_finite", s->estimate->unknown);
    json_close_object(w);
}

static void put_features(struct json_writer *w, uint64_t mask) {
    json_open_list(w, "features");
    for (uint32_t i = 0; i < FEATURE_COUNT; i++)
        if (mask & (UINT64_C(1) << i))
            json_write_text(w, NULL, str_from(feature_name(UINT64_C(1) << i)));
    json_close_list(w);
}

// As the Trace Event Format of Chrome has it (N. Duca, D. Sinclair): complete events, times in microseconds.
static void put_trace(struct json_writer *w, const struct stats *s) {
    const unsigned count = timeline_sort(s->timeline);
    json_open_list(w, "traceEvents");
    for (unsigned i = 0; i < count; i++) {
        const struct timeline_phase *p = &s->timeline->phases[i];
        json_open_object(w, NULL);
        json_write_text(w, "name", str_from(p->name));
        json_write_text(w, "ph", STR("X"));
        json_write_real(w, "ts", 1e6 * (p->begin - s->begun));
        json_write_real(w, "dur", 1e6 * p->seconds);
        json_write_integer(w, "pid", 1);
        json_write_integer(w, "tid", (uint64_t)p->thread);
        if (p->detail.len) {
            json_open_object(w, "args");
            json_write_text(w, "file", p->detail);
            json_close_object(w);
        }
        json_close_object(w);
    }
    json_close_list(w);
}

void stats_json(const struct stats *s, struct strbuf *out) {
    struct json_writer w;
    json_report_begin(&w, out, JSON_WRITE_DEPTH_MAX, "glint render", 2);
    json_write_text(&w, "device", str_from(s->device));
    json_write_text(&w, "camera", s->camera);
    json_write_integer(&w, "width", s->width);
    json_write_integer(&w, "height", s->height);
    json_write_integer(&w, "samples", s->samples);
    put_estimate(&w, s);
    json_write_text(&w, "precision", s->is_double ? STR("double") : STR("single"));
    put_times(&w, s);
    if (s->has_rays)
        put_rays(&w, &s->last.rays);
    put_features(&w, s->features);
    json_write_integer(&w, "triangles", s->triangles);
    json_write_integer(&w, "dropped_triangles", s->dropped);
    json_write_integer(&w, "spheres", s->spheres);
    json_write_integer(&w, "tree_levels", s->triangle_depth);
    json_write_integer(&w, "dispatches", s->last.dispatches);
    json_write_integer(&w, "slices", s->last.slices);
    json_write_integer(&w, "bands", s->last.portions);
    json_write_integer(&w, "scene_bytes", s->scene_bytes);
    json_write_integer(&w, "band_bytes", s->portion_bytes);
    json_write_integer(&w, "peak_memory_bytes", (uint64_t)s->peak_memory_bytes);
    if (s->has_audit)
        json_audit(&w, &s->audit);
    put_trace(&w, s);
    json_report_end(&w);
}
