#!/bin/sh
# Odd English that once crept in stays out of the texts that users read: the string literals of the program and
# the documentation. CONTRIBUTING.md, "Words", says what to write.
. "$(dirname -- "$0")/lib.sh"

# A pattern and what to write for it. Small letters; '<' and '>' are the ends of a word. What begins with '+' holds for comments too:
# the others say there what they mean (what is behind a surface, say).
odd="
<blanks?>: space
<remarks?>: comment
<(missing|write|written|space|comment|text|stands?|colon|comma|key|line) behind>: after
<behind (it|them|its|what|this key|that key|the (last|number|path|colon|comma|dash|key|name|line|text|entry))>: after
<behind (the |a |an )?': after
+<(is|are|was) to be>: must be, or should be
<(has|have) not ([0-9]|an? |the |enough>): does not have
+<(is|are|was|were) no [a-z]+>: is not a
+<(this|that|it|which|what) is none>: is not one
<stands? (behind|inside|within|beside|before|after|where|here|there|together|at the|in (the|a|an|one|quotes))>: is, or belongs
+<(is|are) parted|parted by|parts (nothing|inside from)>: separated
<can hold>: is allowed
<a text (that|which|of|in|needs)>: text
+<(is|are|was|were) (told|looked for)>: is reported, or glint looks for
+<(rays?|it|which|last) (meets?|met)>: hits
+<(samples?|rays|bits|bytes|ms|pixels|annotations) an? (pixel|sample|channel|frame|node|dispatch|step|million)>: per
+<in one (plane|column)>: in the same
+<(to and fro|for want of|unless said|if not said|sends on)>: back and forth, for lack of, by default, passes on
"

scan() { # ALL: 1, or 0 for comments; stdin: path:line:text, or path:line:end of the line before, a tab, text
    awk -v odd="$odd" -v all="$1" '
    BEGIN {
        count = split(odd, row, "\n")
        for (i = 1; i <= count; i++) {
            at = match(row[i], /: [^:]*$/)
            pattern[i] = at && (all || row[i] ~ /^\+/) ? substr(row[i], 1, at - 1) : ""
            sub(/^\+/, "", pattern[i])
            better[i] = substr(row[i], at + 2)
            gsub(/</, "(^|[^a-z_-])", pattern[i])
            gsub(/>/, "([^a-z_-]|$)", pattern[i])
        }
    }
    function fair(text) { # without what only looks odd
        gsub(/\\n/, " ", text)
        gsub(/blank lines?|there (is|are|was|were) no |no (more|less|longer|larger|smaller|different)/, "", text)
        return text
    }
    {
        match($0, /^[^:]*:[0-9]*:/)
        place = substr($0, 1, RLENGTH)
        text = tolower(substr($0, RLENGTH + 1))
        tab = index(text, "\t")
        line = fair(substr(text, tab + 1))
        before = fair(substr(text, 1, tab ? tab - 1 : 0))
        joined = fair(substr(text, 1, tab ? tab - 1 : 0) " " substr(text, tab + 1))
        for (i = 1; i <= count; i++) {
            if (pattern[i] == "") continue
            if (match(line, pattern[i])) found = substr(line, RSTART, RLENGTH)
            else if (before !~ pattern[i] && match(joined, pattern[i])) found = substr(joined, RSTART, RLENGTH)
            else continue
            gsub(/^[^a-z]+|[^a-z'\''0-9]+$/, "", found)
            print place " \"" found "\" is odd English; write: " better[i]
        }
    }'
}

list=$(mktemp)
trap 'rm -f "$list"' EXIT
# No user reads the texts of tests, benches and random scenes, nor docs/architecture.md.
code=$(ours '\.(c|h|def)$' | grep -vE '^(tests|bench)/|^grammar/generate' || true)
pages=$(ours '(^|/)(README|CHANGELOG)\.md$|^docs/.*\.(md|json)$|^(run|check|action\.yml|tools/.*\.sh)$' |
    grep -vE '^tests/|^docs/architecture\.md$' || true)
{
    # shellcheck disable=SC2086 -- our paths hold no spaces
    [ -z "$code" ] || awk -f "$LINT/literals.awk" $code
    # A line of a page is read with the last two words of the line before it, where a phrase may begin.
    # shellcheck disable=SC2086
    [ -z "$pages" ] || awk 'FNR == 1 { last = "" }
        {
            print FILENAME ":" FNR ":" last "\t" $0
            last = match($0, /([^ ]+ +)?[^ ]+$/) ? substr($0, RSTART) : ""
        }' $pages
} | scan 1 >"$list"
# Comments of the product, shaders too; a sentence may go on in the next line, which is read with it.
comments=$(ours '\.(c|h|def|glsl|comp)$' | grep -vE '^(tests|bench)/' || true)
# shellcheck disable=SC2086
[ -z "$comments" ] || awk 'FNR == 1 { last = "" }
    {
        text = match($0, /(^|[ \t])\/\/ /) ? substr($0, RSTART + RLENGTH) : ""
        if (text != "") print FILENAME ":" FNR ":" last "\t" text
        last = match(text, /([^ ]+ +)?[^ ]+$/) ? substr(text, RSTART) : ""
    }' $comments | scan 0 >>"$list"
verdict <"$list"
