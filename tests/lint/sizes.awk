# Reads path:line:code; prints each allocation whose size is a product that is not checked.

# The text without what is a star but no product: sizes of types and things, casts, what a pointer points to.
function without_stars(text) {
    gsub(/sizeof *\([^()]*\)/, "sizeof", text)
    gsub(/sizeof \**/, "sizeof ", text)
    gsub(/(struct [a-z_]+|void|char) \*+/, "", text)
    gsub(/\([a-z_][A-Za-z0-9_ ]* \**\)/, "", text)
    gsub(/[0-9]+ \* sizeof/, "sizeof", text)
    return text
}

function is_product(text) {
    return without_stars(text) ~ /[A-Za-z0-9_)\]] *\* *[A-Za-z0-9_(*]/
}

# What lies between the bracket at `from` and its partner; "" where the text ends first.
function inside(text, from,    at, depth, letter) {
    for (at = from; at <= length(text); at++) {
        letter = substr(text, at, 1)
        if (letter == "(" || letter == "[" || letter == "{")
            depth++
        else if ((letter == ")" || letter == "]" || letter == "}") && --depth == 0)
            return substr(text, from + 1, at - from - 1)
    }
    return ""
}

# The arguments apart from the kinds of things, which may be pointers.
function sizes_of(call, arguments) {
    if (call ~ /^ARENA_ARRAY/)
        sub(/,[^,]*,/, ",", arguments)
    return arguments
}

# Whether an argument is a name to which the function so far gives a product.
function has_product_by_name(arguments,    names, n, k, name) {
    n = split(arguments, names, ",")
    for (k = 1; k <= n; k++) {
        name = names[k]
        gsub(/ /, "", name)
        if (name ~ /^[a-z_]+$/ && comes_from_product(name))
            return 1
    }
    return 0
}

function comes_from_product(name,    at, text) {
    for (at = line; at > begin; at--) {
        text = code[at]
        if (text !~ ("(^|[^A-Za-z0-9_.>])" name " = "))
            continue
        if (text ~ ("uint64_t " name " = ")) # which no two numbers of 32 bits fill
            return 0
        while (text !~ /;/ && at < line)
            text = text " " code[++at]
        sub(".*[^A-Za-z0-9_.>]" name " = ", "", text)
        sub(/;.*/, "", text)
        return is_product(text)
    }
    return 0
}

function look(    joined, at, call, given) {
    joined = code[line]
    for (at = line + 1; at <= line + 5 && at <= count; at++)
        joined = joined " " code[at]
    at = 1
    while (match(substr(joined, at, length(code[line]) - at + 1), allocations)) {
        at += RSTART - 1
        call = substr(joined, at, RLENGTH)
        sub(/^[^A-Za-z_]/, "", call)
        given = sizes_of(call, inside(joined, at + RLENGTH - 1))
        if (is_product(given) || has_product_by_name(given))
            print path ":" place[line] ": a product that may wrap around: use heap_times or heap_array"
        at += RLENGTH
    }
    if (code[line] ~ /\(size_t\)[a-zA-Z_.>-]*limits(->|\.)value\[/)
        print path ":" place[line] ": a limit is cut to a size_t: use limits_size"
}

function look_at_file() {
    begin = 0
    for (line = 1; line <= count; line++) {
        if (code[line] ~ /^[A-Za-z]/)
            begin = line
        look()
    }
    count = 0
}

BEGIN {
    allocations = "(^|[^A-Za-z0-9_])(heap_(alloc|array|zeroed|resize|resize_array)" \
        "|arena_(try_)?alloc(_array)?|ARENA_ARRAY|malloc|realloc)\\("
}
{
    match($0, /^[^:]*:[0-9]*:/)
    split($0, parts, ":")
    if (parts[1] != path)
        look_at_file()
    path = parts[1]
    count++
    place[count] = parts[2]
    code[count] = substr($0, RLENGTH + 1)
}
END { look_at_file() }
