#!/bin/sh
# The program that every test runs under. Usage: limited.sh LIMITED FOLDER
set -u
limited=$1
record=$2/limited.txt
failed=0
rm -f "$record"

expect() { # NAME EXIT command...
    name=$1 wanted=$2
    shift 2
    "$limited" 1 "$record" "$name" "$@" 2>/dev/null
    got=$?
    [ $got -eq "$wanted" ] || {
        echo "FAIL $name: exit $got, wanted $wanted"
        failed=1
    }
}

expect a/success 0 true
expect a/status 3 sh -c 'exit 3'
expect a/skip 77 sh -c 'exit 77'
expect a/missing 127 /nonexistent
expect a/signal 143 sh -c 'kill -TERM $$'
expect a/endless 152 sh -c 'while :; do :; done'
expect a/endless-child 152 sh -c 'sh -c "while :; do :; done"; exit $?'
[ "$(awk '{ print $2 }' "$record" | tr '\n' ' ')" = "a/success a/status a/skip a/missing a/signal a/endless a/endless-child " ] &&
    awk '{ ok = $1 >= ($2 ~ /endless/ ? 0.5 : 0) && $1 < 3; bad += !ok } END { exit bad > 0 }' "$record" || {
    echo "FAIL the record:"
    cat "$record"
    failed=1
}
exit $failed
