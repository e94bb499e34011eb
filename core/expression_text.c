// Expressions in texts of one use: a number for a frame, and braces.
#include "core/expression_internal.h"

#include "core/number.h"

bool expression_value(str text, const struct expression_at *at, double *value,
                      struct expression_fault *fault) {
    double all[EXPRESSION_WIDTH] = {0};
    struct expression expression;
    struct arena arena;
    arena_init(&arena, SIZE_MAX);
    bool good = expression_compile(text, NULL, &arena, &expression, fault);
    if (good && expression.type != EXPRESSION_NUMBER)
        good = expression_fail(fault, 0, text.len, "this is %s, and a number is needed",
                               expression_type_name(expression.type));
    good = good && expression_at(&expression, at, all, fault);
    *value = good ? all[0] : 0;
    arena_finish(&arena);
    return good;
}

// ---- texts with expressions

static bool is_map(str inside) {
    return str_trim(inside).len == 0 || memchr(inside.ptr, ':', inside.len);
}

bool expression_fill(str text, const struct expression_at *at, struct strbuf *out, bool *filled,
                     struct expression_fault *fault) {
    char digits[NUMBER_FORMAT_MAX];
    double value;
    *filled = false;
    for (size_t i = 0; i < text.len; i++) {
        const char *close = text.ptr[i] == '{' ? memchr(text.ptr + i, '}', text.len - i) : NULL;
        const size_t end = close ? (size_t)(close - text.ptr) : i;
        const str inside = close ? str_slice(text, i + 1, end) : STR("");
        if (!close || is_map(inside)) {
            strbuf_char(out, text.ptr[i]);
            continue;
        }
        if (!expression_value(inside, at, &value, fault)) {
            fault->begin += i + 1;
            fault->end += i + 1;
            return false;
        }
        strbuf_add(out, digits, number_format(value, digits));
        *filled = true;
        i = end;
    }
    return true;
}
