// A steady clock for statistics. Thread safety: pure.
#ifndef GLINT_CORE_CLOCK_H
#define GLINT_CORE_CLOCK_H

// Seconds since an arbitrary start, never going back.
double clock_seconds(void);

#endif
