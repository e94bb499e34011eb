#include "render/pick.h"

#include "core/heap.h"
#include "grammar/ir.h"
#include "render/reference_shot.h"

#include <math.h>
#include <stdlib.h>

// ---- the two paths

static struct reference_segment common_segment(const struct render_segment *s) {
    static const enum reference_kind kinds[] = {[RENDER_RAY_CAMERA] = REFERENCE_PRIMARY,
                                                [RENDER_RAY_REFLECTED] = REFERENCE_REFLECTED,
                                                [RENDER_RAY_REFRACTED] = REFERENCE_REFRACTED};
    return (struct reference_segment){.kind = kinds[s->kind],
                                      .parent = s->parent,
                                      .depth = s->depth,
                                      .weight = s->weight,
                                      .origin = s->origin,
                                      .direction = s->direction,
                                      .body = s->body,
                                      .triangle = s->triangle,
                                      .light = s->light,
                                      .material = s->material,
                                      .enters = s->enters,
                                      .passes = s->passes,
                                      .medium = s->medium,
                                      .tint = s->tint,
                                      .total_reflection = s->total_reflection,
                                      .distance = s->distance,
                                      .point = s->point,
                                      .geometric = s->geometric,
                                      .shading = s->shading,
                                      .considered = s->considered,
                                      .lit = s->lit,
                                      .radiance = s->radiance,
                                      .cut_weight = s->cut_weight};
}

static enum shot_status log_device(struct pick *pick, struct gpu *gpu, uint32_t camera) {
    struct pick_log *out = &pick->logs[PICK_DEVICE];
    struct shot shot;
    enum shot_status status = shot_open(&shot, pick->session, gpu, camera);
    struct render_segment *segments = heap_array(PICK_SEGMENTS_MAX, sizeof *segments);
    out->segments = heap_array(PICK_SEGMENTS_MAX, sizeof *out->segments);
    if (status == SHOT_OK && (!segments || !out->segments))
        status = shot_no_memory(pick->session, "the path");
    struct render_log log = {.segments = segments, .capacity = PICK_SEGMENTS_MAX};
    for (uint32_t i = 0; status == SHOT_OK && i <= pick->sample_count; i++) {
        // The sample that is reported comes last.
        const uint32_t sample = i < pick->sample_count ? i : pick->sample;
        if (renderer_log(shot.renderer, &shot.view.camera, pick->x, pick->y, sample, &log) != RENDER_DONE)
            status = SHOT_DEVICE;
        if (status == SHOT_OK && i < pick->sample_count) {
            pick->samples[PICK_DEVICE][i] =
                (vec3){(double)log.rgb[0], (double)log.rgb[1], (double)log.rgb[2]};
            pick->is_sample_whole[i] = log.whole;
        }
    }
    if (status == SHOT_OK) {
        out->count = log.count;
        out->whole = log.whole;
        out->color = (vec3){(double)log.rgb[0], (double)log.rgb[1], (double)log.rgb[2]};
        for (uint32_t i = 0; i < log.count; i++)
            out->segments[i] = common_segment(&segments[i]);
        pick->is_double = shot.flat.is_double;
        pick->device = str_from(gpu_info(gpu)->name);
    }
    free(segments);
    shot_close(&shot);
    return status;
}

static enum shot_status log_reference(struct pick *pick, uint32_t camera) {
    struct pick_log *out = &pick->logs[PICK_REFERENCE];
    struct reference_shot shot;
    const struct reference_shot_options options = {.as_file = true, .no_cache = true};
    enum shot_status status = reference_shot_open(&shot, pick->session, camera, options);
    if (status == SHOT_OK) {
        const struct reference *reference = reference_source_get(&shot.source);
        out->segments = heap_array(PICK_SEGMENTS_MAX, sizeof *out->segments);
        if (reference && out->segments)
            out->count = reference_log(reference, &shot.settings, pick->x, pick->y, pick->sample,
                                       out->segments, PICK_SEGMENTS_MAX, &out->color);
        for (uint32_t i = 0; reference && i < pick->sample_count; i++)
            reference_log(reference, &shot.settings, pick->x, pick->y, i, NULL, 0,
                          &pick->samples[PICK_REFERENCE][i]);
        out->whole = out->count <= PICK_SEGMENTS_MAX;
        if (out->count == 0)
            status = shot_no_memory(pick->session, "the path");
        if (!out->whole)
            out->count = PICK_SEGMENTS_MAX;
        pick->camera = shot.view.camera.name;
        pick->max_depth = shot.settings.max_depth;
    }
    reference_shot_close(&shot);
    return status;
}

// ---- differences

static void differ(struct pick *pick, enum pick_difference_kind kind, uint32_t device, uint32_t reference) {
    // A ray that a log does not have may come after its end.
    if ((device == UINT32_MAX && !pick->logs[PICK_DEVICE].whole) ||
        (reference == UINT32_MAX && !pick->logs[PICK_REFERENCE].whole))
        return;
    if (pick->difference_count < PICK_DIFFERENCES_MAX)
        pick->differences[pick->difference_count] = (struct pick_difference){kind, device, reference};
    pick->difference_count++;
}

// The ray of this kind that leaves what ray `parent` hit; UINT32_MAX: none.
static uint32_t child_of(const struct pick_log *log, uint32_t parent, enum reference_kind kind,
                         uint32_t max_depth) {
    for (uint32_t i = parent + 1; i < log->count; i++)
        if (log->segments[i].parent == parent && log->segments[i].kind == kind &&
            log->segments[i].depth <= max_depth)
            return i;
    return UINT32_MAX;
}

static vec3 share_of(const struct reference_segment *s) {
    return (vec3){s->radiance.x * s->tint.x * s->weight, s->radiance.y * s->tint.y * s->weight,
                  s->radiance.z * s->tint.z * s->weight};
}

// Whether the pixel gets other colours from them: another cell of a checker, or another place of the
// background.
static bool has_other_color(const struct reference_segment *a, const struct reference_segment *b) {
    const double apart = vec3_max_abs(vec3_sub(share_of(a), share_of(b)));
    return !(apart <= PICK_COLOR_ERROR * fmax(1, vec3_max_abs(b->radiance) * b->weight));
}

// Whether the two rays hit the same; if so, the rays that leave it can be compared too.
static bool compare_segments(struct pick *pick, uint32_t device, uint32_t reference) {
    const struct reference_segment *a = &pick->logs[PICK_DEVICE].segments[device];
    const struct reference_segment *b = &pick->logs[PICK_REFERENCE].segments[reference];
    if (a->body != b->body || a->triangle != b->triangle || a->light != b->light) {
        differ(pick, PICK_OTHER_BODY, device, reference);
        return a->body == b->body && fabs(a->distance - b->distance) <= PICK_DISTANCE_ERROR * b->distance;
    }
    if (!(fabs(a->distance - b->distance) <= PICK_DISTANCE_ERROR * b->distance))
        differ(pick, PICK_OTHER_DISTANCE, device, reference);
    if (a->considered != b->considered || a->lit != b->lit)
        differ(pick, PICK_OTHER_LIGHTS, device, reference);
    else if (has_other_color(a, b))
        differ(pick, PICK_OTHER_COLOR, device, reference);
    return true;
}

static enum shot_status compare_paths(struct pick *pick) {
    const struct pick_log *logs = pick->logs;
    uint32_t *twin = heap_array((size_t)logs[PICK_DEVICE].count + 1, sizeof *twin); // in the reference's log
    if (!twin)
        return shot_no_memory(pick->session, "the path");
    for (uint32_t i = 0; i < logs[PICK_DEVICE].count; i++) {
        const struct reference_segment *s = &logs[PICK_DEVICE].segments[i];
        if (i > 0 && (s->depth > pick->max_depth || twin[s->parent] == UINT32_MAX)) {
            twin[i] = UINT32_MAX;
            continue;
        }
        twin[i] = i ? child_of(&logs[PICK_REFERENCE], twin[s->parent], s->kind, pick->max_depth) : 0;
        if (twin[i] == UINT32_MAX) {
            differ(pick, PICK_OTHER_RAYS, i, UINT32_MAX);
            continue;
        }
        if (!compare_segments(pick, i, twin[i])) {
            twin[i] = UINT32_MAX;
            continue;
        }
        for (enum reference_kind kind = REFERENCE_REFLECTED; kind <= REFERENCE_REFRACTED; kind++) {
            const uint32_t theirs = child_of(&logs[PICK_REFERENCE], twin[i], kind, pick->max_depth);
            if (theirs != UINT32_MAX && child_of(&logs[PICK_DEVICE], i, kind, pick->max_depth) == UINT32_MAX)
                differ(pick, PICK_OTHER_RAYS, UINT32_MAX, theirs);
        }
    }
    free(twin);
    return SHOT_OK;
}

// ---- the whole

enum shot_status pick_take(struct pick *pick, struct session *session, struct gpu *gpu, uint32_t camera,
                           uint32_t x, uint32_t y, uint32_t sample) {
    const uint32_t samples = (uint32_t)session->image->samples;
    *pick = (struct pick){.session = session, .x = x, .y = y, .sample = sample};
    pick->sample_count = samples < PICK_SAMPLES_MAX ? samples : PICK_SAMPLES_MAX;
    enum shot_status status = log_reference(pick, camera);
    if (status == SHOT_OK && gpu)
        status = log_device(pick, gpu, camera);
    if (status == SHOT_OK && gpu)
        status = compare_paths(pick);
    return status;
}

void pick_finish(struct pick *pick) {
    if (!pick)
        return;
    for (int i = 0; i < 2; i++)
        free(pick->logs[i].segments);
    *pick = (struct pick){0};
}
