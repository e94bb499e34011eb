#include "core/nearest.h"

#include <limits.h>

enum {
    WORD_MAX = 128
};

static char fold(char c) {
    return c == '-' || c == ' ' ? '_' : char_lower(c);
}

static unsigned least(unsigned a, unsigned b) {
    return a < b ? a : b;
}

// The distance, or UINT_MAX if it is larger than `most`.
static unsigned distance_up_to(str a, str b, unsigned most) {
    if (a.len > WORD_MAX || b.len > WORD_MAX)
        return UINT_MAX;
    char folded[WORD_MAX]; // b
    unsigned rows[3][WORD_MAX + 1];
    unsigned *before = rows[0], *above = rows[1], *row = rows[2];
    unsigned nearest_above = 0; // the least of the row above
    above[0] = 0;
    for (unsigned j = 1; j <= b.len; j++) {
        above[j] = j;
        folded[j - 1] = fold(b.ptr[j - 1]);
    }
    for (unsigned i = 1; i <= a.len; i++) {
        char now = fold(a.ptr[i - 1]), last = i > 1 ? fold(a.ptr[i - 2]) : '\0';
        unsigned nearest = row[0] = i;
        for (unsigned j = 1; j <= b.len; j++) {
            unsigned same = now == folded[j - 1] ? 0 : 1;
            row[j] = least(least(above[j] + 1, row[j - 1] + 1), above[j - 1] + same);
            if (i > 1 && j > 1 && now == folded[j - 2] && last == folded[j - 1])
                row[j] = least(row[j], before[j - 2] + 1);
            nearest = least(nearest, row[j]);
        }
        // The next rows derive from this row or, by a transposition, from the one above it.
        if (nearest > most && nearest_above >= most)
            return UINT_MAX;
        nearest_above = nearest;
        unsigned *free_row = before;
        before = above;
        above = row;
        row = free_row;
    }
    return above[b.len] <= most ? above[b.len] : UINT_MAX;
}

unsigned nearest_distance(str a, str b) {
    return distance_up_to(a, b, UINT_MAX - 1);
}

// Which letters the word has, a bit each; some share one.
static uint64_t letters_of(str word) {
    uint64_t letters = 0;
    for (size_t i = 0; i < word.len; i++)
        letters |= UINT64_C(1) << (fold(word.ptr[i]) & 63);
    return letters;
}

static unsigned count_bits(uint64_t bits) {
    unsigned count = 0;
    for (; bits; bits &= bits - 1)
        count++;
    return count;
}

struct nearest nearest_begin_within(str word, uint64_t *left) {
    return (struct nearest){
        .word = word, .best_distance = UINT_MAX, .letters = letters_of(word), .left = left};
}

struct nearest nearest_begin(str word) {
    return nearest_begin_within(word, NULL);
}

static bool take_cost(struct nearest *search, uint64_t cost) {
    if (!search->left)
        return true;
    const bool enough = *search->left >= cost;
    *search->left = enough ? *search->left - cost : 0;
    return enough;
}

void nearest_offer(struct nearest *search, str candidate) {
    bool is_longer = search->word.len > candidate.len;
    size_t longer = is_longer ? search->word.len : candidate.len;
    unsigned allowed = longer < 3 ? 0 : (unsigned)((longer + 2) / 3);
    // The distance is at least the difference of the lengths, and the number of letters that one word has and
    // the other lacks.
    size_t difference = longer - (is_longer ? candidate.len : search->word.len);
    if (longer > WORD_MAX || difference > allowed || difference >= search->best_distance ||
        !take_cost(search, candidate.len))
        return;
    const uint64_t letters = letters_of(candidate);
    if (count_bits(search->letters & ~letters) > allowed ||
        count_bits(letters & ~search->letters) > allowed ||
        !take_cost(search, (uint64_t)search->word.len * candidate.len))
        return;
    unsigned distance = distance_up_to(search->word, candidate, allowed);
    if (distance < search->best_distance) {
        search->best = candidate;
        search->best_distance = distance;
    }
}

str nearest_best(const struct nearest *search) {
    return search->best;
}
