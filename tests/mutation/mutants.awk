# Prints every mutant of a C file, one a line: path, line, column, length of what is replaced, kind, replacement;
# tabs between. Comments, texts and preprocessor lines other than #define of a number have none.

function mutant(column, size, kind, text) {
    printf "%s\t%d\t%d\t%d\t%s\t%s\n", FILENAME, FNR, column, size, kind, text
}

# The line with comments and texts as spaces, column by column.
function code_of(line,    out, i, two, letter, mark) {
    out = ""
    mark = ""
    for (i = 1; i <= length(line); i++) {
        letter = substr(line, i, 1)
        two = substr(line, i, 2)
        if (comment) {
            if (two == "*/") {
                comment = 0
                out = out " "
                i++
            }
            out = out " "
        } else if (mark != "") {
            if (letter == "\\") {
                out = out " "
                i++
            } else if (letter == mark) {
                mark = ""
            }
            out = out " "
        } else if (two == "//") {
            break
        } else if (two == "/*") {
            comment = 1
            out = out "  "
            i++
        } else {
            if (letter == "\"" || letter == "'")
                mark = letter
            out = out (mark == "" ? letter : " ")
        }
    }
    return out
}

# Operators between blanks: a pointer's star and a sign have none.
function operators(code,    i, three, four) {
    for (i = 1; i < length(code); i++) {
        three = substr(code, i, 3)
        four = substr(code, i, 4)
        if (four in OPERATORS)
            mutant(i, 4, "operator", OPERATORS[four])
        else if (three in OPERATORS)
            mutant(i, 3, "operator", OPERATORS[three])
    }
}

# The length of an array that is declared: a longer one changes nothing.
function is_room(code, at, text) {
    return substr(code, at + length(text), 1) == "]" &&
        substr(code, 1, at - 1) ~ /(^|[ (])(double|float|int|char|bool|vec3|[a-z0-9_]+_t|(struct|enum) [a-z0-9_]+) [*]*[a-z0-9_]+(\[[0-9A-Z_]*\])?\[$/
}

# A whole number becomes the next one, another a thousand times as much, a power of two in hexadecimal 2^37 times.
function numbers(code,    at, rest, text, before) {
    at = 1
    rest = code
    while (match(rest, /0x1p-?[0-9]+|[0-9]+\.?[0-9]*(e-?[0-9]+)?/)) {
        text = substr(rest, RSTART, RLENGTH)
        before = RSTART > 1 ? substr(rest, RSTART - 1, 1) : substr(code, at - 1, 1)
        at += RSTART - 1
        if (before !~ /[A-Za-z0-9_.]/ && !is_room(code, at, text) && substr(code, at + length(text), 1) !~ /[A-Za-z0-9_.]/) {
            if (text ~ /^0x1p/)
                mutant(at, length(text), "number", "0x1p" (substr(text, 5) + 37))
            else if (text ~ /[.e]/)
                mutant(at, length(text), "number", "(1000 * " text ")")
            else
                mutant(at, length(text), "number", text + 1)
        }
        at += length(text)
        rest = substr(code, at)
    }
}

function statements(code,    at, first, size) {
    if (code !~ /^ +[^ ].*; *$/ || code ~ /^ *(return|break|continue|goto|case|for|while|else|if)[ ;(]/)
        return
    match(code, /^ +/)
    at = RLENGTH + 1
    first = substr(code, at)
    sub(/ +$/, "", first)
    # What begins with a type declares something that others need.
    if (first ~ /^[a-z_0-9]+(\[[^;=]*\]|->[a-z_]+|\.[a-z_]+)* *[-+*\/|&]?= / || first ~ /^[a-z_0-9]+\(.*\);$/ || first ~ /(\+\+|--);$/)
        mutant(at, length(first), "statement", ";")
}

function is_whole(text) {
    return text ~ /[a-z_]/ && gsub(/\(/, "", text) == gsub(/\)/, "", text)
}

# Values that a float would hold less exactly; the compiler refuses those that are none.
function roundings(code,    at, size) {
    if (match(code, / = [^;{]+; *$/) || match(code, /return [^;{]+; *$/)) {
        at = RSTART + (substr(code, RSTART, 1) == " " ? 3 : 7)
        size = RSTART + RLENGTH - at
        match(substr(code, at, size), /; *$/)
        size = RSTART - 1
        if (is_whole(substr(code, at, size)))
            mutant(at, size, "rounding", "MUTANT_FLOAT(" substr($0, at, size) ")")
    }
    if (match(code, /\.[a-z_]+ = [^,{}]+[,}]/)) {
        at = RSTART + index(substr(code, RSTART), " = ") + 2
        size = RSTART + RLENGTH - 1 - at
        if (is_whole(substr(code, at, size)))
            mutant(at, size, "rounding", "MUTANT_FLOAT(" substr($0, at, size) ")")
    }
}

BEGIN {
    count = split(" < , <= , > , >= , == , != , + , - , * , / , && , || ", names, ",")
    for (i = 1; i < count; i += 2) {
        OPERATORS[names[i]] = names[i + 1]
        OPERATORS[names[i + 1]] = names[i]
    }
}
FNR == 1 { comment = 0 }
{
    code = code_of($0)
    if (code ~ /^#define [A-Z_]+ +[-0-9.x(]/)
        numbers(code)
    if (code ~ /^ *#/)
        next
    operators(code)
    if (code !~ /^static const|^ *\{/)
        numbers(code)
    statements(code)
    roundings(code)
}
