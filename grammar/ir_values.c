#include "grammar/ir_values.h"

#include "core/number.h"
#include "grammar/ir_print_text.h"

bool ir_values_next(str *rest, str *value) {
    if (!rest->ptr)
        return false;
    size_t end = 0;
    for (int depth = 0; end < rest->len && (depth > 0 || rest->ptr[end] != ','); end++)
        depth += (rest->ptr[end] == '(' || rest->ptr[end] == '[') -
                 (rest->ptr[end] == ')' || rest->ptr[end] == ']');
    *value = str_trim(str_slice(*rest, 0, end));
    *rest = end < rest->len ? str_slice(*rest, end + 1, rest->len) : (str){NULL, 0};
    return true;
}

uint32_t ir_values_count(str text) {
    uint32_t count = 0;
    str value;
    while (ir_values_next(&text, &value))
        count++;
    return count;
}

static bool is_number(str value, double *number) {
    return number_parse(value, number) == NUMBER_OK;
}

void ir_values_normal(struct strbuf *out, str text) {
    char digits[NUMBER_FORMAT_MAX];
    double number;
    str value, inside;
    for (bool first = true; ir_values_next(&text, &value); first = false) {
        strbuf_cstr(out, first ? "" : ", ");
        if (is_number(value, &number)) {
            strbuf_add(out, digits, number_format(number, digits));
        } else if (ir_values_open(value, &inside)) {
            strbuf_char(out, '[');
            ir_values_normal(out, inside);
            strbuf_char(out, ']');
        } else {
            strbuf_str(out, value);
        }
    }
}

bool ir_values_open(str value, str *inside) {
    if (value.len < 2 || value.ptr[0] != '[' || value.ptr[value.len - 1] != ']')
        return false;
    *inside = str_slice(value, 1, value.len - 1);
    return true;
}

static void put_list(struct strbuf *out, str text, bool several, bool json) {
    double number;
    str value, inside;
    if (several)
        strbuf_char(out, '[');
    for (bool first = true; ir_values_next(&text, &value); first = false) {
        strbuf_cstr(out, first ? "" : ", ");
        if (is_number(value, &number) || str_equal(value, STR("true")) || str_equal(value, STR("false")))
            strbuf_str(out, value);
        else if (ir_values_open(value, &inside))
            put_list(out, inside, true, json);
        else if (json)
            print_json_text(out, value);
        else
            print_yaml_expression(out, value);
    }
    if (several)
        strbuf_char(out, ']');
}

void ir_values_yaml(struct strbuf *out, str text, bool is_list) {
    put_list(out, text, is_list || ir_values_count(text) > 1, false);
}

void ir_values_json(struct strbuf *out, str text, bool is_list) {
    put_list(out, text, is_list || ir_values_count(text) > 1, true);
}
