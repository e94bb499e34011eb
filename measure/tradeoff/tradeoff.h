// Speed for accuracy, measured: what each setting of a scene costs on a device, and what error it brings.
//
// A study renders the scene at the file's settings, with one knob turned at a time, and then with pairs of
// those that mattered; it times the rows in interleaved rounds on the device's clock, counts their work, and
// compares their pictures with the double-precision reference. Pictures are compared as displayed (the
// scene's tone and transfer, not rounded), smaller ones scaled up to the file's size (bilinear). Ownership:
// tradeoff_finish frees what a study holds; scene, assets, view and gpu must outlive it. Errors: a status;
// device errors in gpu_error, flattening's in the sink. Thread safety: the gpu's thread.
#ifndef GLINT_MEASURE_TRADEOFF_TRADEOFF_H
#define GLINT_MEASURE_TRADEOFF_TRADEOFF_H

#include "measure/tradeoff/study/study.h"

enum tradeoff_status tradeoff_run(struct tradeoff *study, const struct tradeoff_input *input,
                                  const struct tradeoff_options *options,
                                  const struct tradeoff_progress *progress);
void tradeoff_finish(struct tradeoff *study);

// The choice that keeps every bound that was asked for; NULL: none was asked for.
const struct choice *tradeoff_choice(const struct tradeoff *study);

#endif
