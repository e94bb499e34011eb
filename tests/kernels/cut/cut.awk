# awk -v name=HAS_CONES -v out=FOLDER -f cut.awk FILE...: writes each file to the folder without the statements that run
# only where `name` is true: `if (name)` and `if (name && ...)`. Such a statement ends where a line is indented as it is.
# The last line tells how many lines are gone.
function indent_of(line) {
    match(line, /^ */)
    return RLENGTH
}

$0 ~ "^const bool " name " = " { $0 = "const bool " name " = false;" }

cutting && !/^#/ && (NF == 0 || indent_of($0) > indent) {
    gone++
    next
}

cutting && !/^#/ {
    cutting = 0
    if (indent_of($0) == indent && /^ *}/)
        sub(/} ?/, "")
    if (indent_of($0) == indent && /^ *else/)
        sub(/else ?/, "")
}

!/\\$/ && $0 ~ "^ *if \\(" name "(\\)| && )" {
    cutting = 1
    indent = indent_of($0)
    gone++
    next
}

{ print >(out "/" FILENAME) }

END { print gone + 0 }
