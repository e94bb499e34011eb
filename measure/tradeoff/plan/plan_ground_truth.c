// How many samples and rays the ground truth may take.
#include "measure/tradeoff/plan/plan.h"

#include <math.h>

enum {
    GROUND_TRUTH_SAMPLES = 16, // at least; four times the file's if that is more
    GROUND_TRUTH_SAMPLES_MOST = 64,
    PILOT_STEP = 4, // from one pilot's rays to the next one's
    // If none of n pixels showed it, up to 3 of n others still may (95 %).
    UNSEEN = 3,
    // Twice the file's samples may cost this many times their budget; if they cost more, the file's own
    // samples are taken.
    PATIENCE = 8,
};

static uint32_t least_samples(const struct plan_ground_truth_input *in) {
    return 2 * in->file_samples;
}

static double rays_a_sample(const struct plan_ground_truth_input *in, uint32_t samples) {
    return in->rays_most / ((double)in->pixels * samples);
}

uint64_t plan_next_pilot(const struct plan_ground_truth_input *in) {
    if (!isfinite(in->rays_most))
        return 0;
    if (in->pilot_count == 0)
        return in->segments_most < PLAN_PILOT_SEGMENTS ? in->segments_most : PLAN_PILOT_SEGMENTS;
    const struct plan_pilot *last = &in->pilots[in->pilot_count - 1];
    if (!last->cut || last->segments >= in->segments_most || in->pilot_count == PLAN_PILOTS_MAX ||
        last->rays > rays_a_sample(in, least_samples(in)))
        return 0;
    const uint64_t next = last->segments * PILOT_STEP;
    return next < in->segments_most ? next : in->segments_most;
}

// Samples may want more rays than the pilot's pixels did: they get what is left.
static uint64_t whole_paths(const struct plan_ground_truth_input *in, const struct plan_pilot *pilot,
                            double rays) {
    const double most = (double)in->pilot_pixels * (rays - pilot->rays) / UNSEEN;
    if (pilot->cut || most <= (double)pilot->segments)
        return pilot->segments;
    return most < (double)in->segments_most ? (uint64_t)most : in->segments_most;
}

struct plan_ground_truth plan_ground_truth(const struct plan_ground_truth_input *in) {
    const uint32_t least = least_samples(in);
    uint32_t samples =
        4 * in->file_samples > GROUND_TRUTH_SAMPLES ? 4 * in->file_samples : GROUND_TRUTH_SAMPLES;
    samples = samples < GROUND_TRUTH_SAMPLES_MOST ? samples : GROUND_TRUTH_SAMPLES_MOST;
    samples = samples > least ? samples : least;
    if (in->pilot_count == 0)
        return (struct plan_ground_truth){samples, in->segments_most, true};
    const struct plan_pilot *last = &in->pilots[in->pilot_count - 1];
    while (samples / 2 >= least && last->rays > rays_a_sample(in, samples))
        samples /= 2;
    const double rays = rays_a_sample(in, samples);
    for (uint32_t i = in->pilot_count; i-- > 0;)
        if (in->pilots[i].rays <= rays)
            return (struct plan_ground_truth){samples, whole_paths(in, &in->pilots[i], rays), true};
    if (in->pilots[0].rays > PATIENCE * rays)
        samples = in->file_samples;
    return (struct plan_ground_truth){samples, in->pilots[0].segments, false};
}
