// The report of a study: as text, JSON, CSV, and as one HTML file with a plot.
//
// Ownership: `out` is the caller's. Errors: out->failed where memory lacks. Thread safety: pure.
#ifndef GLINT_MEASURE_TRADEOFF_REPORT_REPORT_H
#define GLINT_MEASURE_TRADEOFF_REPORT_REPORT_H

#include "measure/tradeoff/study/study.h"

// Only the answers, and what was left out: part of the text.
void tradeoff_answers(const struct tradeoff *study, struct strbuf *out);
// For a search: what it took, and what its errors are.
void tradeoff_search_notes(const struct tradeoff *study, struct strbuf *out);
void tradeoff_notes(const struct tradeoff *study, struct strbuf *out);

void tradeoff_text(const struct tradeoff *study, const char *scene, struct strbuf *out);
void tradeoff_json(const struct tradeoff *study, const char *scene, struct strbuf *out);
void tradeoff_csv(const struct tradeoff *study, struct strbuf *out);
void tradeoff_html(const struct tradeoff *study, const char *scene, struct strbuf *out);

#endif
