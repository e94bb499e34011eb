// Pieces of the HTML report. Private to this folder. Thread safety: pure.
#ifndef GLINT_MEASURE_TRADEOFF_REPORT_REPORT_HTML_H
#define GLINT_MEASURE_TRADEOFF_REPORT_REPORT_HTML_H

#include "measure/tradeoff/study/study.h"

// The colour class of a row by its knobs: the knob's name, "pair", "file" or "study".
const char *html_kind(const struct row *row);
// Time against error of all rows, the front joined, as an SVG; both axes logarithmic.
void html_plot(const struct tradeoff *study, struct strbuf *out);

#endif
