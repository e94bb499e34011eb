# Adds a column to a list of mutants: why the mutant changes nothing that a test could see, by the list of those that
# is read first; empty for the others. A row there: path, the line as the mutant has it without the spaces around
# it (`without` and the statement that it lacks), the reason; tabs between. With -v stale=1 prints instead the rows of which there is no such mutant (any more).
# Usage: awk -f equivalent.awk equivalent.txt MUTANTS
BEGIN { FS = "\t"; OFS = "\t" }

# A line of a file, which is read once.
function line_of(path, number,    text, count) {
    if (!(path in read)) {
        read[path] = 1
        while ((getline text < path) > 0)
            lines[path, ++count] = text
        close(path)
    }
    return lines[path, number]
}

FNR == NR {
    if ($0 !~ /^#/ && $0 != "") {
        reason[$1, $2] = $3
        rows[++row_count] = $1 OFS $2
    }
    next
}
{
    line = line_of($1, $2)
    mutated = $5 == "statement" ? "without " substr(line, $3, $4) : substr(line, 1, $3 - 1) $6 substr(line, $3 + $4)
    gsub(/^ +| +$/, "", mutated)
    found[$1 OFS mutated] = 1
    if (!stale)
        print $1, $2, $3, $4, $5, $6, reason[$1, mutated]
}
END {
    for (i = 1; stale && i <= row_count; i++)
        if (!(rows[i] in found))
            print rows[i]
}
