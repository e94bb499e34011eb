// A value that is computed, of a parameter or of a variable of copies: one expression, three, or a colour.
#include "diag/codes/binding.h"
#include "parser/stages/evaluate.h"

#include "core/srgb.h"
#include "grammar/ir_values.h"
#include "parser/bind/say.h"
#include "parser/tree/mend.h"

#include <string.h>

static bool read_parts(struct evaluation *e, str text, uint32_t count, str what, span at,
                       struct computed *c) {
    bool good = true;
    for (; c->part_count < count && ir_values_next(&text, &c->texts[c->part_count]); c->part_count++) {
        struct expression *part = &c->parts[c->part_count];
        if (!evaluation_compile(e, DIAG_EXPRESSION, c->texts[c->part_count], at, part)) {
            good = false;
            continue;
        }
        c->moves |= part->moves;
        if (count == 3 && part->type != EXPRESSION_NUMBER) {
            diag_add(e->loader->input->sink, DIAG_EXPRESSION, at,
                     "a component of %.*s must be a number; '%.*s' is %s", STR_ARG(what),
                     STR_ARG(c->texts[c->part_count]), expression_type_name(part->type));
            good = false;
        }
    }
    c->type = count == 3 ? EXPRESSION_TRIPLE : c->parts[0].type;
    return good;
}

bool computed_read(struct evaluation *e, str text, str what, span at, struct computed *c) {
    struct diag_sink *sink = e->loader->input->sink;
    *c = (struct computed){.type = EXPRESSION_TRIPLE};
    if (mend_hex_color(text, &c->hex))
        return true;
    if (str_starts_with(text, STR("#"))) {
        diag_add(sink, DIAG_BAD_COLOR, at, "%.*s: '%.*s' is not a colour", STR_ARG(what),
                 STR_ARG(say_text(&e->loader->scratch, text)));
        diag_help(sink, "six hexadecimal digits, as in #ff8800");
        return false;
    }
    const uint32_t count = ir_values_count(text);
    if (count == 1 || count == 3)
        return read_parts(e, text, count, what, at, c);
    diag_add(sink, DIAG_WRONG_COUNT, at, "%.*s has %u values; a number has one, a vector or colour three",
             STR_ARG(what), count);
    return false;
}

bool computed_value(struct evaluation *e, const struct computed *c, span at, double *value) {
    struct expression_fault fault;
    if (c->part_count == 0) {
        srgb_of_hex(c->hex, e->at.decodes, value);
        value[3] = c->hex;
        return true;
    }
    for (uint32_t i = 0; i < c->part_count; i++) {
        double part[EXPRESSION_WIDTH];
        if (!expression_at(&c->parts[i], &e->at, part, &fault)) {
            evaluation_fault(e, DIAG_EXPRESSION, c->texts[i], at, true, &fault);
            return false;
        }
        if (c->part_count == 1)
            memcpy(value, part, sizeof part);
        else
            value[i] = part[0];
    }
    if (c->part_count == 3)
        value[3] = -1;
    return true;
}
