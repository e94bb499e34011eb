#include "render/reference_shot.h"
#include "diag/codes/device.h"
#include "diag/codes/limit.h"

#include "core/heap.h"
#include "load/where.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum shot_status reference_shot_open(struct reference_shot *shot, struct session *session, uint32_t camera,
                                     struct reference_shot_options options) {
    *shot = (struct reference_shot){.session = session};
    if (!session_view(session, camera, &shot->view))
        return shot_no_memory(session, "the view");
    if (!where_camera_fits(session, camera, &shot->view))
        return SHOT_SCENE;
    struct reference_input input = {.scene = &session->resolved, .view = &shot->view};
    shot->settings =
        reference_settings_of(session->scene, session->image, &session->options.limits, options.as_file);
    shot->store_path = options.no_cache ? NULL : folder_store_path(REFERENCE_CACHE_NAME);
    struct folder_store store = {shot->store_path, REFERENCE_CACHE_BYTES};
    reference_source_init(&shot->source, &input, store);
    return SHOT_OK;
}

void reference_shot_close(struct reference_shot *shot) {
    if (!shot)
        return;
    reference_source_finish(&shot->source);
    free(shot->store_path);
    shot->store_path = NULL;
}

static void report_fault(struct session *session, diag_code code, const struct reference_fault *fault,
                         const char *words) {
    if (fault->pixels)
        where_report_fault(session, &(struct where_fault){.code = code,
                                                          .words = words,
                                                          .pixels = fault->pixels,
                                                          .x = fault->x,
                                                          .y = fault->y,
                                                          .body = fault->body,
                                                          .triangle = fault->triangle});
}

// Floats for the image; a pixel with a value that no float holds is marked as not a number.
static struct reference_fault round_picture(const struct reference_shot *shot, const double *values,
                                            struct image *image) {
    struct reference_fault fault = {.body = HIT_NONE};
    const uint32_t width = shot->settings.width;
    const size_t count = (size_t)width * shot->settings.height;
    for (size_t i = 0; i < count; i++) {
        const double *from = values + 3 * i;
        float *to = image->rgb + 3 * i;
        const double largest = fmax(fabs(from[0]), fmax(fabs(from[1]), fabs(from[2])));
        const bool holds = !isfinite(largest) || largest <= (double)FLT_MAX;
        for (int k = 0; k < 3; k++)
            to[k] = holds ? (float)from[k] : NAN;
        if (!holds && fault.pixels++ == 0) {
            fault.x = (uint32_t)(i % width);
            fault.y = (uint32_t)(i / width);
        }
    }
    return fault;
}

enum shot_status reference_shot_take(struct reference_shot *shot, struct image *image, double *rgb,
                                     const struct reference_progress *progress,
                                     struct reference_statistics *statistics) {
    size_t count = heap_times(heap_times(shot->settings.width, shot->settings.height), 3);
    double *values = rgb ? rgb : heap_array(count, sizeof *values);
    if (!values)
        return shot_no_memory(shot->session, "the reference");
    enum reference_result result =
        reference_source_render(&shot->source, &shot->settings, values, progress, statistics);
    struct reference_fault too_large = {0};
    if (result == REFERENCE_DONE)
        too_large = round_picture(shot, values, image);
    if (!rgb)
        free(values);
    if (result != REFERENCE_DONE)
        return result == REFERENCE_CANCELLED ? SHOT_CANCELLED
                                             : shot_no_memory(shot->session, "the reference");
    const bool is_nested = statistics->not_finite.is_nested;
    report_fault(shot->session, is_nested ? DIAG_LIMIT : DIAG_NOT_FINITE, &statistics->not_finite,
                 is_nested ? WHERE_NESTED : WHERE_NOT_FINITE);
    report_fault(shot->session, DIAG_NOT_FINITE, &too_large, "got a value that is too large for a float");
    report_fault(shot->session, DIAG_PATH_SEGMENTS, &statistics->over_segments, WHERE_OVER_SEGMENTS);
    report_fault(shot->session, DIAG_REFERENCE_CUT, &statistics->cut_short, WHERE_CUT_SHORT);
    return SHOT_OK;
}
