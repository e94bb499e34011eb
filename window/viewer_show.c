// What the window shows: the picture, or what is known of its pixels, and text over it.
#include "core/heap.h"
#include "core/strbuf.h"
#include "diag/diag_text.h"
#include "grammar/ir_features.h"
#include "render/aov/aov.h"
#include "shaders/features.h"
#include "window/viewer_private.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    TEXT_COLOR = 0xf0f0f0,
    WARNING_COLOR = 0xffb060,
    LINES_MAX = 16,
    FINDINGS_MOST = 3, // shown at most; the terminal has all
    FEATURE_LINES = 4,
    COST_MOST = 8, // rays shown as the brightest
};
#define ERROR_MOST 0.1 // of a channel, shown as the brightest

static const char *const mode_names[VIEWER_MODES] = {
    [VIEWER_COLOR] = "colour", [VIEWER_NORMALS] = "normals", [VIEWER_DEPTH] = "depth",
    [VIEWER_COST] = "cost",    [VIEWER_ERROR] = "error",
};

// ---- pixels

// Black, blue, red, yellow, white.
static void put_heat(double value, uint8_t rgb[3]) {
    const double t = fmin(fmax(value, 0), 1) * 4;
    const double channels[3] = {fmin(fmax(t - 1, 0), 1), fmin(fmax(t - 2, 0), 1),
                                t < 1   ? t
                                : t < 2 ? 2 - t
                                        : fmax(t - 3, 0)};
    for (int c = 0; c < 3; c++)
        rgb[c] = (uint8_t)(255 * channels[c] + 0.5);
}

static void put_gray(double value, uint8_t rgb[3]) {
    rgb[0] = rgb[1] = rgb[2] = (uint8_t)(255 * fmin(fmax(value, 0), 1) + 0.5);
}

static void put_normal(const struct hit_pixel *hit, uint8_t rgb[3]) {
    const double n[3] = {hit->normal.x, hit->normal.y, hit->normal.z};
    for (int c = 0; c < 3; c++)
        rgb[c] = hit->body == HIT_NONE ? 0 : (uint8_t)(127.5 * (n[c] + 1));
}

// Near is bright: the logarithm of the distance, from the nearest to the farthest.
static void depth_range(const struct viewer *v, size_t pixels, double *near, double *far) {
    *near = DBL_MAX;
    *far = 0;
    for (size_t i = 0; i < pixels; i++)
        if (v->hits[i].body != HIT_NONE && v->hits[i].distance > 0) {
            *near = fmin(*near, v->hits[i].distance);
            *far = fmax(*far, v->hits[i].distance);
        }
}

static void put_hits(const struct viewer *v, size_t pixels) {
    double near, far;
    depth_range(v, pixels, &near, &far);
    for (size_t i = 0; i < pixels; i++) {
        const struct hit_pixel *hit = &v->hits[i];
        uint8_t *rgb = v->bytes + 3 * i;
        if (v->mode == VIEWER_NORMALS)
            put_normal(hit, rgb);
        else if (v->mode == VIEWER_COST)
            put_heat((double)aov_cost(hit) / COST_MOST, rgb);
        else
            put_gray(hit->body == HIT_NONE ? 0
                     : far > near          ? 1 - 0.9 * log(hit->distance / near) / log(far / near)
                                           : 1,
                     rgb);
    }
}

static void put_error(const struct viewer *v, size_t pixels) {
    const uint32_t n = v->shown.samples;
    const bool is_known = v->squares && !v->is_coarse && n > 1;
    for (size_t i = 0; i < pixels; i++)
        put_heat(is_known ? sqrt(fmax(v->squares[i], 0) / ((double)n * (n - 1))) / ERROR_MOST : 0,
                 v->bytes + 3 * i);
}

static bool make_bytes(struct viewer *v) {
    const struct image *image = &v->shown.image;
    const size_t pixels = heap_times(image->width, image->height), bytes = heap_times(3, pixels);
    if (v->byte_room < bytes) {
        free(v->bytes);
        v->bytes = heap_alloc(bytes);
        v->byte_room = v->bytes ? bytes : 0;
    }
    if (!v->bytes)
        return false;
    if (v->mode == VIEWER_COLOR)
        image_to_bytes(image, v->live->shot.display, v->bytes);
    else if (v->mode == VIEWER_ERROR)
        put_error(v, pixels);
    else if (viewer_find_hits(v))
        put_hits(v, pixels);
    else
        return false;
    return true;
}

// ---- text

static uint64_t rays_in(const struct render_rays *rays) {
    return rays->primary + rays->reflected + rays->refracted + rays->shadow;
}

// Puts the features' names into lines of at most `room` characters.
static uint32_t put_features(uint64_t mask, size_t room, struct strbuf lines[], uint32_t most) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < FEATURE_COUNT; i++) {
        const str name = str_from(mask & (UINT64_C(1) << i) ? feature_name(UINT64_C(1) << i) : "");
        if (name.len == 0)
            continue;
        const bool begins = count == 0 || lines[count - 1].len + 2 + name.len > room;
        if (begins && count == most)
            break;
        if (begins)
            strbuf_init(&lines[count++]);
        strbuf_format(&lines[count - 1], "%s%.*s", begins ? "" : ", ", STR_ARG(name));
    }
    return count;
}

static void put_overlay(struct viewer *v, uint32_t scale) {
    char lines[4][160];
    str texts[LINES_MAX];
    uint32_t count = 0;
    struct strbuf features[FEATURE_LINES];
    const struct viewer_picture *shown = &v->shown;
    const struct render_statistics *s = &shown->statistics;
    const double rays = s->wall_seconds > 0 ? (double)rays_in(&s->rays) / s->wall_seconds : 0;
    snprintf(lines[0], sizeof lines[0], "%s, %u x %u, %u sample%s, %s precision", mode_names[v->mode],
             shown->image.width, shown->image.height, shown->samples, shown->samples == 1 ? "" : "s",
             v->live->shot.flat.is_double ? "double" : "single");
    snprintf(lines[1], sizeof lines[1], "%.1f ms per sample, %.1f million rays/s", 1e3 * shown->seconds,
             1e-6 * rays);
    snprintf(lines[2], sizeof lines[2], "speed %.3g a second; F1 shows the keys", v->steer.speed);
    for (; count < 3; count++)
        texts[count] = str_from(lines[count]);
    const size_t room = v->width / (CANVAS_GLYPH_WIDTH * scale);
    const uint32_t rows = put_features(v->live->shot.flat.features, room, features, FEATURE_LINES);
    for (uint32_t i = 0; i < rows; i++)
        texts[count++] = strbuf_view(&features[i]);
    if (v->said[0])
        texts[count++] = str_from(v->said);
    canvas_put_lines(&v->canvas, texts, count, scale, TEXT_COLOR, false);
    for (uint32_t i = 0; i < rows; i++)
        strbuf_finish(&features[i]);
}

static void put_keys(struct viewer *v, uint32_t scale) {
    static const char *const lines[] = {
        "W A S D  fly; E up, Q down",
        "drag     look around",
        "right    turn around",
        "click    what is there",
        "wheel    fly faster, slower",
        "1 to 0   the scene's cameras",
        "R        back to the camera",
        "C        print the camera",
        "P        write the picture",
        "Tab      normals, depth, cost, error",
        "H        text, or none",
        "F1       keys, or none",
        "Esc      end",
    };
    str texts[sizeof lines / sizeof *lines];
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++)
        texts[i] = str_from(lines[i]);
    canvas_put_lines(&v->canvas, texts, sizeof lines / sizeof *lines, scale, TEXT_COLOR, false);
}

// The next line of at most `room` characters, ending at a word's end if possible.
static str take_line(str *left, size_t room) {
    size_t end = left->len < room ? left->len : room;
    if (left->len > room)
        while (end > room / 2 && left->ptr[end] != ' ')
            end--;
    const str line = str_slice(*left, 0, end);
    *left = str_trim(str_slice(*left, end, left->len));
    return line;
}

// The findings about the files, without the source lines, which an editor shows; lines are as long as fits.
static void put_findings(struct viewer *v, uint32_t scale) {
    struct session *session = live_findings(v->live);
    const size_t room = v->width / (CANVAS_GLYPH_WIDTH * scale);
    str texts[LINES_MAX];
    uint32_t count = 0;
    struct strbuf text;
    strbuf_init(&text);
    diag_sort(&session->sink);
    diag_text(&text, &session->sink, &session->sources, (struct diag_text_options){.most = FINDINGS_MOST});
    for (str left = strbuf_view(&text); left.len && count < LINES_MAX;) {
        size_t end = 0;
        while (end < left.len && left.ptr[end] != '\n')
            end++;
        str line = str_trim(str_slice(left, 0, end));
        // Below a finding, its line of the file and the marks under it are indented; so is help, behind '='.
        if (left.ptr[0] == ' ' && line.len && line.ptr[0] != '=')
            line = STR("");
        while (line.len && room && count < LINES_MAX)
            texts[count++] = take_line(&line, room);
        left = str_slice(left, end + (end < left.len), left.len);
    }
    canvas_put_lines(&v->canvas, texts, count, scale, WARNING_COLOR, true);
    strbuf_finish(&text);
}

bool viewer_show(struct viewer *v) {
    if (v->width == 0 || v->height == 0 || v->shown.samples == 0)
        return true;
    if (!canvas_resize(&v->canvas, v->width, v->height) || !make_bytes(v))
        return false;
    const uint32_t scale = window_text_scale(v->window);
    v->shown_speed = v->steer.speed;
    canvas_put_picture(&v->canvas, v->bytes, v->shown.image.width, v->shown.image.height);
    if (v->shows_keys)
        put_keys(v, scale);
    else if (!v->hides_overlay)
        put_overlay(v, scale);
    if (v->is_broken)
        put_findings(v, scale);
    return gpu_screen_show(v->gpu, v->screen, v->canvas.pixels, v->width, v->height) != GPU_SHOW_FAILED;
}
