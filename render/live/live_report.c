#include "render/live/live_report.h"

#include "core/json_write.h"
#include "core/strbuf.h"

static bool has_picture(const struct live_report *report) {
    return !report->is_broken && !report->is_view;
}

static const char *plural(uint32_t count) {
    return count == 1 ? "" : "s";
}

void live_text(const struct live_report *report, struct strbuf *out) {
    const struct live_change *c = &report->live->change;
    strbuf_format(out,
                  "load %u: %u mesh%s and %u image%s read, %u tree%s built and %u kept, %u pipeline%s made, ",
                  report->live->loads, c->meshes_read, c->meshes_read == 1 ? "" : "es", c->images_read,
                  plural(c->images_read), c->trees_built, plural(c->trees_built), c->trees_kept,
                  c->pipelines_made, plural(c->pipelines_made));
    if (c->is_whole)
        strbuf_cstr(out, "all written to the device\n");
    else
        strbuf_format(out, "%llu bytes written to the device\n", (unsigned long long)c->written.bytes);
    strbuf_format(out, "  read %.1f, assets %.1f, flatten %.1f, upload %.1f", 1e3 * c->read_seconds,
                  1e3 * c->assets_seconds, 1e3 * c->flatten_seconds, 1e3 * c->upload_seconds);
    if (has_picture(report) && report->coarse_seconds > 0)
        strbuf_format(out, ", a coarse picture after %.1f", 1e3 * report->coarse_seconds);
    if (has_picture(report))
        strbuf_format(out, ", frame %.1f, encode %.1f; all %.1f ms", 1e3 * report->frame->wall_seconds,
                      1e3 * report->encode_seconds, 1e3 * report->total_seconds);
    else
        strbuf_cstr(out, " ms");
    strbuf_char(out, '\n');
}

static void put_times(struct json_writer *w, const struct live_report *report) {
    const struct live_change *c = &report->live->change;
    json_open_object(w, "times");
    json_write_real(w, "read_s", c->read_seconds);
    json_write_real(w, "assets_s", c->assets_seconds);
    json_write_real(w, "flatten_s", c->flatten_seconds);
    json_write_real(w, "upload_s", c->upload_seconds);
    if (has_picture(report)) {
        json_write_real(w, "coarse_s", report->coarse_seconds);
        json_write_real(w, "frame_s", report->frame->wall_seconds);
        json_write_real(w, "encode_s", report->encode_seconds);
        json_write_real(w, "total_s", report->total_seconds);
    }
    json_close_object(w);
}

void live_json(const struct live_report *report, struct strbuf *out) {
    const struct live_change *c = &report->live->change;
    struct json_writer w;
    json_report_begin(&w, out, 0, report->is_view ? "glint view" : "glint render --watch", 1);
    json_write_integer(&w, "load", report->live->loads);
    json_write_boolean(&w, "broken", report->is_broken);
    if (!report->is_view)
        json_write_text(&w, "output", str_from(report->output));
    json_write_boolean(&w, "whole", c->is_whole);
    json_write_integer(&w, "meshes_read", c->meshes_read);
    json_write_integer(&w, "images_read", c->images_read);
    json_write_integer(&w, "trees_built", c->trees_built);
    json_write_integer(&w, "trees_kept", c->trees_kept);
    json_write_integer(&w, "pipelines_made", c->pipelines_made);
    json_write_integer(&w, "bytes_written", c->written.bytes);
    if (has_picture(report)) {
        json_write_integer(&w, "width", report->width);
        json_write_integer(&w, "height", report->height);
        json_write_integer(&w, "samples", report->frame->samples);
    }
    put_times(&w, report);
    json_report_end(&w);
}
