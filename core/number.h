// Numbers as the scene language and mesh files write them, the same in every locale
// (nothing in glint calls setlocale, so strtod and printf use the "C" locale).
//
// Thread safety: pure functions.
#ifndef GLINT_CORE_NUMBER_H
#define GLINT_CORE_NUMBER_H

#include "core/str.h"

enum number_status {
    NUMBER_OK,
    NUMBER_EMPTY,
    NUMBER_NOT_A_NUMBER, // not a number at all: letters, two dots, trailing text
    NUMBER_NAN,          // nan, .nan
    NUMBER_INFINITE,     // inf, .inf, infinity
    NUMBER_HEX,          // 0x1f
    NUMBER_OCTAL,        // 0o17
    NUMBER_UNDERSCORE,   // 1_000
    NUMBER_COMMA,        // 0,5
    NUMBER_LEADING_ZERO, // 007
    NUMBER_UNIT,         // 60deg: a number with letters after it
    NUMBER_OVERFLOW,     // beyond the range of a double
    NUMBER_UNDERFLOW,    // not zero as written, zero as a double
    NUMBER_TOO_LONG,     // more than 1000 characters
    NUMBER_NOT_INTEGER,  // an integer takes digits only
    NUMBER_DASH,         // a typographic dash or minus sign in place of '-'
};

// Reads [+-]?(digits[.digits?]|.digits)([eE][+-]?digits)? without superfluous leading zeros.
// *value is the number if the result is NUMBER_OK, else 0. -0 reads as 0. The double is the nearest one
// (ties to even), as strtod returns it.
enum number_status number_parse(str text, double *value);
// The number that `text` begins with, leading zeros allowed: returns its length, 0 if there is none or if it
// has so many digits or so large an exponent that only number_parse reads it; *value is unspecified
// then. For meshes, which have millions of short numbers.
size_t number_take(str text, double *value);
// Digits with an optional sign, no superfluous leading zeros, within the range of int64_t. A number in
// another form is NUMBER_NOT_INTEGER.
enum number_status number_parse_integer(str text, int64_t *value);
// The same within a range, whose ends belong to it. false: it is something else, and *value stays.
bool number_parse_whole(str text, int64_t least, int64_t most, int32_t *value);
bool number_parse_real(str text, double least, double most, double *value);
// "640x480": two whole numbers from 1 to `most`, with one of `signs` between them. false: the values stay.
bool number_parse_size(str text, const char *signs, int32_t most, int32_t *width, int32_t *height);
// What is wrong, as words that continue "...": "has a decimal comma"; never NULL.
const char *number_problem(enum number_status status);

enum {
    NUMBER_FORMAT_MAX = 40
};
// Writes the fewest digits that read back to the same double (of several such numbers the nearest), large
// and small ones as 1.0e+20, followed by a NUL; returns the length. -0 is written as 0. NaN and infinity,
// which no scene can contain, are written as .nan and .inf, which no reader accepts.
size_t number_format(double value, char out[NUMBER_FORMAT_MAX]);

#endif
