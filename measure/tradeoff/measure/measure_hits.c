// A row's first hits, against the reference.
#include "core/heap.h"
#include "measure/tradeoff/measure/measure.h"

enum {
    RAYS_A_HIT = 4, // about: the first, to lights, mirrored and refracted
};

// The reference's hits at the file's size, once.
static enum tradeoff_status make_reference_hits(struct measuring *s) {
    const size_t pixels = heap_times(s->base.width, s->base.height);
    if (s->hits[1])
        return TRADEOFF_DONE;
    for (int i = 0; i < 2; i++)
        s->hits[i] = heap_array(pixels, sizeof *s->hits[i]);
    if (!s->hits[0] || !s->hits[1])
        return TRADEOFF_MEMORY;
    const struct reference_progress progress = measuring_reference_progress(s);
    return measuring_reference_status(reference_source_hits(&s->source[0], &s->full, s->hits[1], &progress));
}

enum tradeoff_status hits_measure(struct measuring *s, struct row *row) {
    if (!s->hits[1] && !s->no_hits)
        s->no_hits = s->out->hits_out =
            !ground_truth_affords(s, RAYS_A_HIT * (double)s->base.width * s->base.height);
    if (s->no_hits)
        return TRADEOFF_DONE;
    enum tradeoff_status status = make_reference_hits(s);
    if (status == TRADEOFF_DONE)
        status = device_hits(s, &row->setting, s->hits[0]);
    if (status != TRADEOFF_DONE)
        return status;
    hits_compare(s->base.width, s->base.height, s->hits[0], s->hits[1], s->input->scene, &row->hits);
    return TRADEOFF_DONE;
}
