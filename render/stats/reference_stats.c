#include "render/stats/reference_stats.h"

#include "core/json_write.h"

#define RAY_COUNTS(X)                                                                                        \
    X("primary", "primary", s->primary)                                                                      \
    X("reflected", "reflected", s->reflected)                                                                \
    X("refracted", "refracted", s->refracted)                                                                \
    X("shadow", "shadow", s->shadow)                                                                         \
    X("total reflections", "total_reflections", s->total_reflections)                                        \
    X("unseen crossings", "unseen_crossings", s->unseen)                                                     \
    X("cut by depth", "cut_by_depth", s->cut_by_depth)                                                       \
    X("cut by weight", "cut_by_weight", s->cut_by_weight)                                                    \
    X("cut by segments", "cut_by_segments", s->cut_by_segments)                                              \
    X("deepest level", "deepest", s->deepest)

void reference_stats_text(const struct reference_shot *shot, const struct reference_statistics *s,
                          struct strbuf *out) {
    const struct reference_settings *settings = &shot->settings;
    strbuf_format(
        out, "device: reference, double precision%s\npicture: %u x %u, %u sample%s, computed in %.3f s\n",
        shot->source.found ? ", from its cache" : "", settings->width, settings->height, settings->samples,
        settings->samples == 1 ? "" : "s", s->seconds);
    strbuf_cstr(out, "rays\n");
#define WORDS(words, name, value) strbuf_format(out, "  %-18s %12llu\n", words, (unsigned long long)(value));
    RAY_COUNTS(WORDS)
#undef WORDS
    strbuf_format(
        out,
        "weight of the rays not followed\n  worst pixel        %12.3g\n  mean               %12.3g\n"
        "  brightest in view  %12.3g\n  could add at most  %12.3g\n",
        s->left_weight_most, s->left_weight_mean, s->brightest, s->bound);
}

void reference_stats_json(const struct reference_shot *shot, const struct reference_statistics *s,
                          struct strbuf *out) {
    const struct reference_settings *settings = &shot->settings;
    const double unused_error = shot->session->unused_error;
    struct json_writer w;
    json_report_begin(&w, out, JSON_WRITE_DEPTH_MAX, "glint render --device reference", 1);
    json_write_text(&w, "device", STR("reference"));
    json_write_text(&w, "camera", shot->view.camera.name);
    json_write_boolean(&w, "as_file", settings->as_file);
    json_write_boolean(&w, "cached", shot->source.found > 0);
    json_write_integer(&w, "width", settings->width);
    json_write_integer(&w, "height", settings->height);
    json_write_integer(&w, "samples", settings->samples);
    if (unused_error > 0)
        json_write_real(&w, "unused_error", unused_error);
    json_write_real(&w, "seconds", s->seconds);
    json_open_object(&w, "rays");
#define JSON(words, name, value) json_write_integer(&w, name, value);
    RAY_COUNTS(JSON)
#undef JSON
    json_close_object(&w);
    json_open_object(&w, "left");
    json_write_real(&w, "worst_pixel", s->left_weight_most);
    json_write_real(&w, "mean", s->left_weight_mean);
    json_write_real(&w, "brightest", s->brightest);
    json_write_real(&w, "bound", s->bound);
    json_close_object(&w);
    json_report_end(&w);
}
