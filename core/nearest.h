// "Did you mean": the candidate nearest to a misspelt word.
//
// Distance is the optimal string alignment distance (Damerau 1964; restricted transpositions), over bytes;
// ASCII case is ignored, and '-' and spaces equal '_'. A candidate counts when it is at most a third of the
// longer word's length away, rounded up; words of fewer than three bytes must be equal in that sense.
// Thread safety: one search belongs to one thread.
#ifndef GLINT_CORE_NEAREST_H
#define GLINT_CORE_NEAREST_H

#include "core/str.h"

struct nearest {
    str word;
    str best; // empty: none is near enough
    unsigned best_distance;
    uint64_t letters; // of the word, a bit each
    uint64_t *left;   // what comparisons may still cost, shared by many searches; NULL: any amount
};

struct nearest nearest_begin(str word);
// As nearest_begin, for when a file decides how many words and candidates there are: candidates offered when
// nothing is left are ignored. A comparison costs the product of the lengths.
struct nearest nearest_begin_within(str word, uint64_t *left);
void nearest_offer(struct nearest *search, str candidate);
// The best candidate, or the empty string.
str nearest_best(const struct nearest *search);
// The distance itself; words longer than 128 bytes count as far apart (UINT_MAX).
unsigned nearest_distance(str a, str b);

#endif
