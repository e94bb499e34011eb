# To be sourced: one command, its exit code, what it prints; two files. Counts into $failed.
# expect NAME EXIT PATTERN_OUT PATTERN_ERR command...: patterns are extended regular expressions; '-' means empty.
expect() {
    name=$1 wanted=$2 out=$3 err=$4
    shift 4
    "$@" >out.txt 2>err.txt </dev/null
    got=$?
    good=yes
    [ "$got" -eq "$wanted" ] || good=no
    for stream in out err; do
        pattern=$out && [ $stream = err ] && pattern=$err
        if [ "$pattern" = - ]; then
            [ ! -s $stream.txt ] || good=no
        elif [ -n "$pattern" ]; then
            grep -qE -e "$pattern" $stream.txt || good=no
        fi
    done
    if [ $good = yes ]; then
        echo "ok   $name"
    else
        echo "FAIL $name: exit $got, wanted $wanted with out '$out', err '$err'"
        sed 's/^/     out: /' out.txt | head -20
        sed 's/^/     err: /' err.txt | head -20
        failed=1
    fi
}

# same NAME FILE FILE: the files are equal, byte by byte.
same() {
    if cmp -s "$2" "$3"; then
        echo "ok   $1"
    else
        echo "FAIL $1"
        diff "$2" "$3" | head -20
        failed=1
    fi
}
