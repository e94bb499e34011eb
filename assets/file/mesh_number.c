#include "assets/file/mesh_number.h"

#include <string.h>

enum {
    WORD_MOST = 1000 // bytes
};

// Words that number_take does not decide: long mantissas, large exponents, and everything that is not a
// number. The language's own grammar finds what is wrong; only leading zeros are removed first.
static enum number_status slow_number(str word, double *value) {
    char copy[WORD_MOST + 1];
    size_t length = 0;
    size_t at = 0;
    if (word.len > WORD_MOST)
        return NUMBER_TOO_LONG;
    if (at < word.len && (word.ptr[at] == '+' || word.ptr[at] == '-'))
        copy[length++] = word.ptr[at++];
    while (at + 1 < word.len && word.ptr[at] == '0' && char_is_digit(word.ptr[at + 1]))
        at++;
    memcpy(copy + length, word.ptr + at, word.len - at);
    enum number_status status = number_parse((str){copy, length + word.len - at}, value);
    return status == NUMBER_UNDERFLOW ? NUMBER_OK : status;
}

enum number_status mesh_number(str word, double *value) {
    if (word.len && number_take(word, value) == word.len)
        return NUMBER_OK;
    *value = 0;
    return slow_number(word, value);
}
