# Takes the fenced blocks of a page apart: FOLDER/LINE.LANGUAGE holds the text of the block whose first line has
# this number, LINE.marks the comments <!-- test: ... --> before it. Prints "LINE LANGUAGE" of each, in order.
function indentation(text) {
    match(text, /^ */)
    return RLENGTH
}
# A comment of several lines is one mark.
!inside && /^ *<!-- test: / { mark = ""; commenting = 1 }
commenting {
    line = $0
    sub(/^ *(<!-- test: )?/, "", line)
    mark = mark (mark == "" ? "" : " ") line
    if (mark ~ / *-->$/) {
        sub(/ *-->$/, "", mark)
        marks = marks mark "\n"
        commenting = 0
    }
    next
}
!inside && /^ *```/ {
    language = $0
    sub(/^ *```/, "", language)
    if (language == "") language = "plain"
    start = NR + 1
    indent = indentation($0)
    name = folder "/" sprintf("%04d", start)
    printf "%s", "" >(name "." language)
    printf "%s", marks >(name ".marks")
    close(name ".marks")
    marks = ""
    inside = 1
    next
}
inside && /^ *```$/ {
    close(name "." language)
    printf "%04d %s\n", start, language
    inside = 0
    next
}
inside { print substr($0, indentation($0) < indent ? 1 : indent + 1) >(name "." language); next }
/[^ ]/ {
    if (marks != "") { print FILENAME ":" NR ": a test mark without a block" >"/dev/stderr"; bad = 1 }
    marks = ""
}
END { exit bad || inside || commenting }
