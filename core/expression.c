// From text to steps, by recursive descent; types are known at once.
#include "core/expression_internal.h"

#include "core/angle.h"
#include "core/number.h"

// Costs in units of an addition. A remainder costs one for each binary digit by which its operands' sizes
// differ.
enum {
    COST_POWER = 16,
    COST_REMAINDER = 128,
};

// A part of the text that is compiled: its type and place.
struct part {
    enum expression_type type;
    size_t begin, end;
};

// Each step takes at least one character, but for the jumps of `if`, `and`, `or`, whose words are longer. So
// a text has no more steps than characters.
struct scan {
    str text;
    size_t at;
    int depth;
    int turns;                // calls of sin and cos around this place
    uint32_t height, highest; // numbers that wait
    bool moves;
    const struct expression_scope *scope;
    struct expression_step *steps;
    uint32_t count;
    uint64_t cost;
    struct expression_fault *fault;
};

// With what to write in its place.
static bool fail_with(struct scan *s, size_t begin, size_t end, const char *what, const char *help,
                      const char *fix) {
    expression_fail(s->fault, begin, end, "%s", what);
    s->fault->help = help;
    s->fault->fix = fix;
    return false;
}

// ---- tokens

static void skip_blanks(struct scan *s) {
    while (s->at < s->text.len && char_is_space(s->text.ptr[s->at]))
        s->at++;
}

static char next(struct scan *s) {
    skip_blanks(s);
    return s->at < s->text.len ? s->text.ptr[s->at] : '\0';
}

static char after_next(const struct scan *s) {
    return s->at + 1 < s->text.len ? s->text.ptr[s->at + 1] : '\0';
}

static bool take(struct scan *s, char c) {
    if (next(s) != c)
        return false;
    s->at++;
    return true;
}

static str peek_name(struct scan *s) {
    skip_blanks(s);
    return str_slice(s->text, s->at, s->at + expression_name_at(s->text, s->at));
}

static bool take_word(struct scan *s, const char *word) {
    const str name = peek_name(s);
    if (!str_equal_cstr(name, word))
        return false;
    s->at += name.len;
    return true;
}

// ---- steps

static uint32_t width_of(enum expression_type type) {
    return type == EXPRESSION_TRIPLE ? EXPRESSION_WIDTH : 1;
}

static struct expression_step *add(struct scan *s, enum step_kind kind, uint64_t cost, size_t begin) {
    struct expression_step *step = &s->steps[s->count++];
    *step = (struct expression_step){.kind = (uint8_t)kind, .begin = (uint32_t)begin, .end = (uint32_t)s->at};
    s->cost += cost;
    return step;
}

// A value more waits.
static bool push(struct scan *s, enum expression_type type) {
    s->height += width_of(type);
    if (s->height > s->highest)
        s->highest = s->height;
    return s->height <= EXPRESSION_STACK_MOST ||
           expression_fail(s->fault, s->at, s->at + 1, "too many values wait for an operator here");
}

static bool add_number(struct scan *s, double value, size_t begin) {
    add(s, STEP_NUMBER, 1, begin)->number = value;
    return push(s, EXPRESSION_NUMBER);
}

static bool conditional(struct scan *s, struct part *out);

// ---- calls

static bool wrong_arguments(struct scan *s, const struct expression_function *f, size_t begin) {
    return expression_fail(s->fault, begin, s->at, "'%s' takes %s", f->name, f->wrong);
}

static bool count_is_good(const struct expression_function *f, int count) {
    return f->count > 0 ? count == f->count : f->count < 0 ? count <= 4 : count >= 3 && count % 2 == 1;
}

static bool call(struct scan *s, int function, size_t begin, struct part *out) {
    const struct expression_function *f = &expression_functions[function];
    const bool turns = str_equal_cstr(STR("sin"), f->name) || str_equal_cstr(STR("cos"), f->name);
    const bool mixes = str_equal_cstr(STR("mix"), f->name), makes_color = str_equal_cstr(STR("hsv"), f->name);
    const uint32_t height = s->height;
    enum expression_type first = EXPRESSION_NUMBER;
    int count = 0;
    s->turns += turns;
    do {
        struct part argument;
        if (count == EXPRESSION_ARGUMENTS_MOST)
            return expression_fail(s->fault, begin, s->at, "there are more than 64 arguments");
        if (!conditional(s, &argument))
            return false;
        if (count == 0)
            first = mixes && argument.type == EXPRESSION_TRIPLE ? EXPRESSION_TRIPLE : EXPRESSION_NUMBER;
        if (argument.type != (count < 2 ? first : EXPRESSION_NUMBER))
            return expression_fail(s->fault, argument.begin, argument.end,
                                   "'%s' takes %s here, and this is %s", f->name,
                                   expression_type_name(count < 2 ? first : EXPRESSION_NUMBER),
                                   expression_type_name(argument.type));
        count++;
    } while (take(s, ','));
    s->turns -= turns;
    if (!take(s, ')'))
        return expression_fail(s->fault, s->at, s->at + 1, "')' is missing here");
    if (!count_is_good(f, count))
        return wrong_arguments(s, f, begin);
    struct expression_step *step = add(s,
                                       first == EXPRESSION_TRIPLE ? STEP_MIX_COLORS
                                       : f->call                  ? STEP_CALL
                                       : makes_color              ? STEP_HSV
                                                                  : STEP_RANDOM,
                                       f->cost, begin);
    step->function = (uint8_t)function;
    step->count = (uint16_t)count;
    s->height = height;
    *out = (struct part){makes_color ? EXPRESSION_TRIPLE : first, begin, s->at};
    return push(s, out->type);
}

static bool no_such_function(struct scan *s, str word, size_t begin) {
    *s->fault = (struct expression_fault){
        .problem = EXPRESSION_UNKNOWN_FUNCTION, .begin = begin, .end = begin + word.len};
    s->fault->help = expression_foreign(word);
    return false;
}

// ---- names

static bool constant(struct scan *s, double value, enum expression_type type, size_t begin,
                     struct part *out) {
    *out = (struct part){type, begin, s->at};
    return add_number(s, value, begin);
}

static bool of_frame(struct scan *s, enum step_kind kind, size_t begin, struct part *out) {
    add(s, kind, 1, begin);
    s->moves = true;
    *out = (struct part){EXPRESSION_NUMBER, begin, s->at};
    return push(s, EXPRESSION_NUMBER);
}

static bool own_word(struct scan *s, str word, size_t begin, struct part *out, bool *good) {
    *good = true;
    if (str_equal_cstr(word, "frame") || str_equal_cstr(word, "time"))
        *good = of_frame(s, word.ptr[0] == 'f' ? STEP_FRAME : STEP_TIME, begin, out);
    else if (str_equal_cstr(word, "true") || str_equal_cstr(word, "false"))
        *good = constant(s, word.ptr[0] == 't', EXPRESSION_TRUTH, begin, out);
    else if (str_equal_cstr(word, "pi") && s->turns)
        *good = fail_with(s, begin, s->at, "angles are in degrees, and 'pi' is not: a half turn is 180",
                          "write 180", "180");
    else if (str_equal_cstr(word, "pi"))
        *good = constant(s, PI, EXPRESSION_NUMBER, begin, out);
    else if (str_equal_cstr(word, "tau"))
        *good = fail_with(s, begin, s->at, "angles are in degrees: a whole turn is 360", "write 360", "360");
    else if (expression_is_word(word))
        *good = expression_fail(s->fault, begin, s->at, "'%.*s' does not belong here", STR_ARG(word));
    else
        return false;
    return true;
}

static bool name(struct scan *s, struct part *out) {
    const size_t begin = s->at;
    const str word = peek_name(s);
    struct expression_name found;
    bool good;
    s->at += word.len;
    const size_t end = s->at;
    if (take(s, '(')) {
        const int function = expression_find_function(word);
        return function >= 0 ? call(s, function, begin, out) : no_such_function(s, word, begin);
    }
    s->at = end;
    if (s->scope && s->scope->find(s->scope->context, word, &found)) {
        const bool is_triple = found.type == EXPRESSION_TRIPLE;
        add(s, is_triple ? STEP_TRIPLE : STEP_NAME, 1, begin)->at = found.slot;
        s->moves |= found.moves;
        *out = (struct part){found.type, begin, s->at};
        return push(s, found.type);
    }
    if (own_word(s, word, begin, out, &good))
        return good;
    if ((str_equal_cstr(word, "Math") || str_equal_cstr(word, "math")) && take(s, '.'))
        return fail_with(s, begin, s->at, "functions belong to nothing", "write the function alone: sqrt(2)",
                         "");
    *s->fault = (struct expression_fault){
        .problem = EXPRESSION_UNKNOWN_NUMBER, .begin = begin, .end = end, .help = expression_foreign(word)};
    return false;
}

static bool number(struct scan *s, struct part *out) {
    const size_t begin = s->at;
    double value;
    while (s->at < s->text.len) {
        const char c = s->text.ptr[s->at];
        const bool exponent = (c == 'e' || c == 'E') && s->at > begin;
        if (!char_is_digit(c) && c != '.' && !exponent)
            break;
        s->at++;
        if (exponent && s->at < s->text.len && (s->text.ptr[s->at] == '-' || s->text.ptr[s->at] == '+'))
            s->at++;
    }
    const enum number_status status = number_parse(str_slice(s->text, begin, s->at), &value);
    if (status == NUMBER_NOT_A_NUMBER || status == NUMBER_EMPTY)
        return expression_fail(s->fault, begin, s->at, "this is not a number");
    if (status != NUMBER_OK)
        return expression_fail(s->fault, begin, s->at, "this number %s", number_problem(status));
    return constant(s, value, EXPRESSION_NUMBER, begin, out);
}

static bool atom(struct scan *s, struct part *out) {
    const char c = next(s);
    const size_t begin = s->at;
    if (char_is_digit(c) || c == '.')
        return number(s, out);
    if (expression_name_at(s->text, begin))
        return name(s, out);
    if (c == '+')
        return fail_with(s, begin, begin + 1, "a number has no '+' before it", "leave the '+' out", "");
    if (c == '$')
        return fail_with(s, begin, begin + 1, "a name stands alone, without '$'", "write the name", "");
    if (c == '!')
        return fail_with(s, begin, begin + 1, "'!' is written 'not'", "write not", "not ");
    if (!take(s, '('))
        return expression_fail(s->fault, s->at, s->at + 1, "a number, a name or '(' is missing here");
    if (!conditional(s, out))
        return false;
    if (!take(s, ')'))
        return expression_fail(s->fault, s->at, s->at + 1, "')' is missing here");
    *out = (struct part){out->type, begin, s->at};
    return true;
}

static bool components(struct scan *s, struct part *out) {
    static const char names[] = "xyz";
    if (!atom(s, out))
        return false;
    while (s->at < s->text.len && s->text.ptr[s->at] == '.') {
        const size_t dot = s->at++, length = expression_name_at(s->text, s->at);
        const char *which = length == 1 ? strchr(names, s->text.ptr[s->at]) : NULL;
        s->at += length;
        if (out->type != EXPRESSION_TRIPLE)
            return expression_fail(s->fault, dot, s->at,
                                   "only a vector or a colour has components, and this is %s",
                                   expression_type_name(out->type));
        if (!which)
            return expression_fail(s->fault, dot, s->at, "the components are called .x, .y and .z");
        s->height -= width_of(EXPRESSION_TRIPLE);
        add(s, STEP_COMPONENT, 1, out->begin)->at = (uint32_t)(which - names);
        *out = (struct part){EXPRESSION_NUMBER, out->begin, s->at};
        if (!push(s, EXPRESSION_NUMBER))
            return false;
    }
    return true;
}

// ---- operators

// What the operands of a number's operator must be.
static bool expect_number(struct scan *s, const struct part *part, const char *operator_) {
    return part->type == EXPRESSION_NUMBER ||
           expression_fail(s->fault, part->begin, part->end, "'%s' takes numbers, and this is %s", operator_,
                           expression_type_name(part->type));
}

static bool expect_truth(struct scan *s, const struct part *part, const char *operator_) {
    if (part->type == EXPRESSION_TRUTH)
        return true;
    expression_fail(s->fault, part->begin, part->end, "'%s' takes true or false, and this is %s", operator_,
                    expression_type_name(part->type));
    if (part->type == EXPRESSION_NUMBER)
        s->fault->help = "compare it with another number: n > 0";
    return false;
}

static void end_at(struct scan *s, struct part *left, enum expression_type type) {
    left->type = type;
    left->end = s->at;
}

// -x^2 is -(x^2), and 2^-1 is right.
static bool signed_power(struct scan *s, struct part *out) {
    if (++s->depth > EXPRESSION_DEPTH_MOST)
        return expression_fail(s->fault, s->at, s->at + 1, "the expression is nested too deeply");
    bool good;
    if (next(s) == '-') {
        const size_t begin = s->at++;
        good = signed_power(s, out);
        if (good && out->type == EXPRESSION_TRUTH)
            good = expect_number(s, out, "-");
        if (good) {
            out->begin = begin;
            add(s, out->type == EXPRESSION_TRIPLE ? STEP_NEGATE_TRIPLE : STEP_NEGATE, 1, begin);
        }
    } else {
        good = components(s, out);
        if (good && next(s) == '*' && after_next(s) == '*')
            good = fail_with(s, s->at, s->at + 2, "'**' is written '^'", "write ^", "^");
        if (good && take(s, '^')) {
            struct part power;
            good = expect_number(s, out, "^") && signed_power(s, &power) && expect_number(s, &power, "^");
            if (good) {
                s->height--;
                add(s, STEP_POWER, COST_POWER, out->begin);
                end_at(s, out, EXPRESSION_NUMBER);
            }
        }
    }
    s->depth--;
    return good;
}

static bool join_product(struct scan *s, struct part *left, char c) {
    const char operator_[] = {c, '\0'};
    struct part right;
    if (!signed_power(s, &right))
        return false;
    const bool left_triple = left->type == EXPRESSION_TRIPLE, right_triple = right.type == EXPRESSION_TRIPLE;
    if (left_triple && right_triple && c != '%')
        return expression_fail(s->fault, left->begin, right.end,
                               "'%c' takes a vector and a number, not two vectors", c);
    if ((left_triple && c != '%' && right.type == EXPRESSION_NUMBER) ||
        (right_triple && c == '*' && left->type == EXPRESSION_NUMBER)) {
        s->height--;
        add(s, right_triple ? STEP_SCALE_TRIPLE : c == '*' ? STEP_SCALE : STEP_SHRINK, 3, left->begin);
        end_at(s, left, EXPRESSION_TRIPLE);
        return true;
    }
    if (!expect_number(s, left, operator_) || !expect_number(s, &right, operator_))
        return false;
    s->height--;
    add(s,
        c == '*'   ? STEP_MULTIPLY
        : c == '/' ? STEP_DIVIDE
                   : STEP_REMAINDER,
        c == '%' ? COST_REMAINDER : 1, left->begin);
    end_at(s, left, EXPRESSION_NUMBER);
    return true;
}

static bool product(struct scan *s, struct part *out) {
    if (!signed_power(s, out))
        return false;
    for (char c = next(s); c == '*' || c == '/' || c == '%'; c = next(s)) {
        s->at++;
        if (!join_product(s, out, c))
            return false;
    }
    return true;
}

static bool sum(struct scan *s, struct part *out) {
    if (!product(s, out))
        return false;
    for (char c = next(s); c == '+' || c == '-'; c = next(s)) {
        const char operator_[] = {c, '\0'};
        struct part right;
        s->at++;
        if (!product(s, &right))
            return false;
        const bool triples = out->type == EXPRESSION_TRIPLE && right.type == EXPRESSION_TRIPLE;
        if (out->type != right.type && out->type != EXPRESSION_TRUTH && right.type != EXPRESSION_TRUTH)
            return expression_fail(s->fault, out->begin, right.end,
                                   "'%c' takes two numbers or two vectors, not one of each", c);
        if (!triples && (!expect_number(s, out, operator_) || !expect_number(s, &right, operator_)))
            return false;
        s->height -= width_of(right.type);
        add(s,
            triples ? (c == '+' ? STEP_ADD_TRIPLES : STEP_SUBTRACT_TRIPLES)
                    : (c == '+' ? STEP_ADD : STEP_SUBTRACT),
            triples ? 3 : 1, out->begin);
        end_at(s, out, right.type);
    }
    return true;
}

// Takes a comparison's sign: STEP_NOT if there is none. false: a sign of other languages.
static bool take_comparison(struct scan *s, enum step_kind *kind, char sign[3]) {
    const char c = next(s), second = after_next(s);
    *kind = STEP_NOT;
    if (c == '=' && second != '=')
        return fail_with(s, s->at, s->at + 1, "'=' is written '=='", "write ==", "==");
    if (c != '<' && c != '>' && c != '=' && !(c == '!' && second == '='))
        return true;
    const bool equal = second == '=';
    *kind = c == '<'   ? (equal ? STEP_LESS_EQUAL : STEP_LESS)
            : c == '>' ? (equal ? STEP_GREATER_EQUAL : STEP_GREATER)
            : c == '=' ? STEP_EQUAL
                       : STEP_UNEQUAL;
    sign[0] = c;
    sign[1] = equal ? '=' : '\0';
    sign[2] = '\0';
    s->at += equal ? 2 : 1;
    return true;
}

static bool comparison(struct scan *s, struct part *out) {
    enum step_kind kind, another;
    struct part right;
    char sign[3], ignored[3];
    if (!sum(s, out) || !take_comparison(s, &kind, sign))
        return false;
    if (kind == STEP_NOT)
        return true;
    if (!sum(s, &right))
        return false;
    const bool truths = (kind == STEP_EQUAL || kind == STEP_UNEQUAL) && out->type == EXPRESSION_TRUTH &&
                        right.type == EXPRESSION_TRUTH;
    if (!truths && (!expect_number(s, out, sign) || !expect_number(s, &right, sign)))
        return false;
    s->height--;
    add(s, kind, 1, out->begin);
    end_at(s, out, EXPRESSION_TRUTH);
    const size_t at = s->at;
    if (!take_comparison(s, &another, ignored))
        return false;
    return another == STEP_NOT ||
           fail_with(s, at, s->at, "comparisons do not form chains", "write a < b and b < c", NULL);
}

static bool negation(struct scan *s, struct part *out) {
    const size_t begin = (skip_blanks(s), s->at);
    if (!take_word(s, "not"))
        return comparison(s, out);
    if (++s->depth > EXPRESSION_DEPTH_MOST)
        return expression_fail(s->fault, s->at, s->at + 1, "the expression is nested too deeply");
    if (!negation(s, out) || !expect_truth(s, out, "not"))
        return false;
    s->depth--;
    add(s, STEP_NOT, 1, begin);
    *out = (struct part){EXPRESSION_TRUTH, begin, s->at};
    return true;
}

// a and b and c, or the same with "or": the rest is skipped as soon as the value is known.
static bool chain(struct scan *s, struct part *out, bool (*operand)(struct scan *, struct part *),
                  const char *word, const char *sign, const char *fix, enum step_kind kind) {
    if (!operand(s, out))
        return false;
    for (;;) {
        struct part right;
        if (next(s) == sign[0] && after_next(s) == sign[0])
            return fail_with(s, s->at, s->at + 2,
                             sign[0] == '&' ? "'&&' is written 'and'" : "'||' is written 'or'",
                             sign[0] == '&' ? "write and" : "write or", fix);
        if (!take_word(s, word))
            return true;
        if (!expect_truth(s, out, word))
            return false;
        const uint32_t jump = s->count;
        add(s, kind, 1, out->begin);
        s->height--;
        if (!operand(s, &right) || !expect_truth(s, &right, word))
            return false;
        s->steps[jump].at = s->count - jump - 1;
        end_at(s, out, EXPRESSION_TRUTH);
    }
}

static bool conjunction(struct scan *s, struct part *out) {
    return chain(s, out, negation, "and", "&", "and", STEP_AND);
}

static bool disjunction(struct scan *s, struct part *out) {
    return chain(s, out, conjunction, "or", "|", "or", STEP_OR);
}

static void reverse(struct expression_step *steps, uint32_t count) {
    for (uint32_t i = 0; i < count / 2; i++) {
        const struct expression_step other = steps[i];
        steps[i] = steps[count - 1 - i];
        steps[count - 1 - i] = other;
    }
}

// `a if c else b`: c goes first. Jumps are ways from step to step, so steps can move together.
static bool conditional(struct scan *s, struct part *out) {
    const uint32_t first = s->count;
    struct part condition, other;
    if (++s->depth > EXPRESSION_DEPTH_MOST)
        return expression_fail(s->fault, s->at, s->at + 1, "the expression is nested too deeply");
    if (!disjunction(s, out))
        return false;
    if (next(s) == '?')
        return fail_with(s, s->at, s->at + 1, "'?' and ':' are written 'if' and 'else'",
                         "write a if c else b", NULL);
    if (take_word(s, "if")) {
        const uint32_t middle = s->count;
        if (!disjunction(s, &condition) || !expect_truth(s, &condition, "if"))
            return false;
        if (!take_word(s, "else"))
            return fail_with(s, s->at, s->at + 1, "'else' is missing here", "write a if c else b", NULL);
        const uint32_t after = s->count;
        // Steps of `a`, then of `c`: turned around, and a jump put between them.
        reverse(s->steps + first, middle - first);
        reverse(s->steps + middle, after - middle);
        reverse(s->steps + first, after - first);
        const uint32_t branch = first + after - middle;
        memmove(s->steps + branch + 1, s->steps + branch, (middle - first) * sizeof *s->steps);
        s->steps[branch] = (struct expression_step){
            .kind = STEP_BRANCH, .begin = (uint32_t)condition.begin, .end = (uint32_t)condition.end};
        s->count++;
        s->cost++;
        add(s, STEP_JUMP, 1, out->begin);
        s->steps[branch].at = s->count - branch - 1;
        const uint32_t jump = s->count - 1;
        s->height -= 1 + width_of(out->type);
        if (!conditional(s, &other))
            return false;
        s->steps[jump].at = s->count - jump - 1;
        if (other.type != out->type)
            return expression_fail(s->fault, out->begin, other.end,
                                   "'if' gives %s and 'else' %s: both must be the same",
                                   expression_type_name(out->type), expression_type_name(other.type));
        out->end = s->at;
    }
    s->depth--;
    return true;
}

// Something follows that is not an operator here, though it may be one elsewhere.
static bool no_operator(struct scan *s) {
    const str word = peek_name(s);
    const bool is_product = word.len && s->at > 0 && char_is_digit(s->text.ptr[s->at - 1]);
    if (str_equal_cstr(word, "mod"))
        return fail_with(s, s->at, s->at + 3, "the remainder is written with %", "write a % b", "%");
    if (str_equal_cstr(word, "div"))
        return fail_with(s, s->at, s->at + 3, "no operator is called 'div'", "write floor(a/b)", NULL);
    if (is_product)
        return fail_with(s, s->at, s->at + word.len, "an operator is missing before this",
                         "a product has a '*'", NULL);
    if (s->at < s->text.len && char_is_digit(s->text.ptr[s->at]))
        return fail_with(s, s->at, s->text.len, "an operator is missing before this",
                         "values have commas between them, and a vector has brackets around it: [0, 0, 1]",
                         NULL);
    return expression_fail(s->fault, s->at, s->text.len, "an operator is missing before this");
}

static bool compile(struct scan *s, struct expression *expression) {
    struct part all;
    if (!conditional(s, &all))
        return false;
    if (next(s) != '\0' || s->at < s->text.len)
        return no_operator(s);
    *expression = (struct expression){s->steps, s->count, all.type, s->moves, s->cost};
    return true;
}

bool expression_compile(str text, const struct expression_scope *scope, struct arena *arena,
                        struct expression *expression, struct expression_fault *fault) {
    struct scan s = {.text = text,
                     .scope = scope,
                     .steps = ARENA_ARRAY(arena, struct expression_step, text.len + 1),
                     .fault = fault};
    return compile(&s, expression);
}
