#include "core/srgb.h"

#include <math.h>

double srgb_decode(double displayed) {
    return displayed <= 0.04045 ? displayed / 12.92 : pow((displayed + 0.055) / 1.055, 2.4);
}

double srgb_encode(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

// x^2.4 is (x * x^0.2)^2; the fifth root by Newton's method, from above.
double srgb_decode_byte(uint32_t byte) {
    const double displayed = byte / 255.0;
    if (displayed <= 0.04045)
        return displayed / 12.92;
    const double x = (displayed + 0.055) / 1.055;
    double root = 1;
    for (int i = 0; i < 12; i++) {
        const double square = root * root;
        root -= (root - x / (square * square)) / 5;
    }
    return x * root * (x * root);
}

void srgb_of_hex(uint32_t hex, bool decodes, double out[3]) {
    for (int i = 0; i < 3; i++) {
        const uint32_t byte = hex >> (16 - 8 * i) & 255;
        out[i] = decodes ? srgb_decode_byte(byte) : byte / 255.0;
    }
}
