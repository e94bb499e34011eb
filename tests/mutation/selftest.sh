#!/bin/sh
# The list of mutants: every kind is found where it is, nothing is found in comments and texts, and the order is
# that of the seed alone.
# Usage: selftest.sh FOLDER, which is emptied.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
"$here/../../tools/emptied" "$1"
file=$1/sample.c
cat >"$file" <<'END'
#define CLOSE 0x1p-12 // 3 < 4
#include <math.h>
/* a + b
   c * d */
double sample(double a, int n) {
    const char *text = "x < 1 + 2";
    double t = a + 2;
    float room[4] = {text[1]};
    if (a <= 1e-9 && n != 7)
        t = sqrt(a);
    n++;
    return t;
}
END
failed=0
is() { # NAME WANTED GOT
    if [ "$2" = "$3" ]; then
        echo "ok   $1"
    else
        printf 'FAIL %s: wanted\n%s\nbut got\n%s\n' "$1" "$2" "$3"
        failed=1
    fi
}
places() {
    LC_ALL=C awk -f "$here/mutants.awk" "$file" | awk -F '\t' '{ print $2 ":" $3 "+" $4, $5, $6 }'
}
is "the mutants of a file" '1:15+7 number 0x1p25
7:17+3 operator  - 
7:20+1 number 3
7:16+5 rounding MUTANT_FLOAT(a + 2)
8:27+1 number 2
9:10+4 operator  < 
9:18+4 operator  || 
9:23+4 operator  == 
9:14+4 number (1000 * 1e-9)
9:27+1 number 8
10:9+12 statement ;
10:13+7 rounding MUTANT_FLOAT(sqrt(a))
11:5+4 statement ;
12:12+1 rounding MUTANT_FLOAT(t)' "$(places)"
is "each mutant said to change nothing is one" "" "$(cd "$here/../.." && LC_ALL=C awk -f "$here/mutants.awk" $("$here/run.sh" -f) |
    awk -v stale=1 -f "$here/equivalent.awk" "$here/equivalent.txt" -)"
listed() {
    "$here/run.sh" -l "$@" "$file"
}
is "a seed is an order" "$(listed -s 5 -n 0)" "$(listed -s 5 -n 0)"
is "fewer of them are the first" "$(listed -s 5 -n 0 | sed 4q)" "$(listed -s 5 -n 4)"
is "another seed is another order" different "$([ "$(listed -s 5 -n 0)" = "$(listed -s 6 -n 0)" ] || echo different)"
is "of the same mutants" "$(listed -s 5 -n 0 | sort)" "$(listed -s 6 -n 0 | sort)"
exit $failed
