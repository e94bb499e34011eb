#include "measure/share.h"

#include <math.h>
#include <stdbool.h>

// How many ways there are to choose `off` of `pixels`, as a logarithm.
static double log_choices(uint32_t off, uint32_t pixels) {
    double sum = 0;
    for (uint32_t k = 0; k < off; k++)
        sum += log((double)(pixels - k) / (k + 1));
    return sum;
}

// The probability of `off` or fewer among `pixels` where the share is `share`, off / pixels <= share < 1;
// with `more`, of `off` or more, 0 < share <= off / pixels. Terms fall from the first one on.
static double tail(uint32_t off, uint32_t pixels, double choices, double share, bool more) {
    const double odds = share / (1 - share);
    double term = exp(choices + off * log(share) + (pixels - off) * log1p(-share)), sum = 0;
    for (uint32_t k = off; term > sum * 0x1p-60; k = more ? k + 1 : k - 1) {
        sum += term;
        term *= more ? (double)(pixels - k) / (k + 1) * odds : k / ((double)(pixels - k) + 1) / odds;
    }
    return sum;
}

double share_bound(uint32_t off, uint32_t pixels, double risk) {
    double low = (double)off / pixels, high = 1;
    if (off >= pixels)
        return 1;
    const double choices = log_choices(off, pixels);
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (tail(off, pixels, choices, middle, false) > risk)
            low = middle;
        else
            high = middle;
    }
    return high;
}

double share_floor(uint32_t off, uint32_t pixels, double risk) {
    double low = 0, high = (double)off / pixels;
    if (off == 0)
        return 0;
    if (off >= pixels)
        return pow(risk, 1.0 / pixels);
    const double choices = log_choices(off, pixels);
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (tail(off, pixels, choices, middle, true) > risk)
            high = middle;
        else
            low = middle;
    }
    return low;
}
