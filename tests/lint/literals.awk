# Prints the string literals of C code as path:line:text; those that the compiler joins are one. Comments and the
# names of included files are left out.
function give() {
    if (text != "") print path ":" line ":" text
    text = ""
}
FNR == 1 { give(); path = FILENAME; comment = 0; joined = 0 }
!comment && /^[ \t]*#[ \t]*include/ { next }
{
    rest = $0
    while (rest != "") {
        if (comment) {
            at = index(rest, "*/")
            rest = at ? substr(rest, at + 2) : ""
            comment = !at
        } else if (match(rest, /^[ \t]+/)) {
            rest = substr(rest, RLENGTH + 1)
        } else if (rest ~ /^\/\//) {
            rest = ""
        } else if (rest ~ /^\/\*/) {
            comment = 1
            rest = substr(rest, 3)
        } else if (match(rest, /^"([^"\\]|\\.)*"/)) {
            if (!joined) { give(); line = FNR }
            text = text substr(rest, 2, RLENGTH - 2)
            rest = substr(rest, RLENGTH + 1)
            joined = 1
        } else {
            if (!match(rest, /^('([^'\\]|\\.)+'|[^"'\/ \t]+)/)) RLENGTH = 1
            rest = substr(rest, RLENGTH + 1)
            joined = 0
        }
    }
}
END { give() }
