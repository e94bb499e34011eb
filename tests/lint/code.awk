# Prints C code as path:line:code, without comments and with empty string and character literals.
FNR == 1 { comment = 0 }
{
    rest = $0
    out = ""
    while (rest != "") {
        if (comment) {
            at = index(rest, "*/")
            if (!at)
                break
            rest = substr(rest, at + 2)
            comment = 0
            continue
        }
        if (!match(rest, /["']|\/\/|\/\*/)) {
            out = out rest
            break
        }
        out = out substr(rest, 1, RSTART - 1)
        mark = substr(rest, RSTART, RLENGTH)
        rest = substr(rest, RSTART + RLENGTH)
        if (mark == "//")
            break
        if (mark == "/*") {
            comment = 1
            out = out " "
            continue
        }
        out = out mark mark
        while (rest != "") {
            letter = substr(rest, 1, 1)
            rest = substr(rest, letter == "\\" ? 3 : 2)
            if (letter == mark)
                break
        }
    }
    if (out != "")
        print FILENAME ":" FNR ":" out
}
