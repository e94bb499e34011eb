# What tests of commands that go on share: to be sourced after tests/cli/lib.sh. A command runs as $process; its standard
# output, with a line of JSON for each load, goes to loads.json, and its messages to said.txt.

# begin command...
begin() {
    : >loads.json
    : >said.txt
    "$@" >loads.json 2>said.txt </dev/null &
    process=$!
    seen=0
    trap 'kill "$process" 2>/dev/null' EXIT
}

# load: waits for the next line, which is then in load.json; false: none came, or the command has ended.
load() {
    for _ in $(seq 600); do
        if [ "$(grep -c '^{' loads.json)" -gt "$seen" ]; then
            seen=$((seen + 1))
            grep '^{' loads.json | sed -n "${seen}p" >load.json
            return 0
        fi
        kill -0 "$process" 2>/dev/null || break
        sleep 0.1
    done
    : >load.json
    return 1
}

# loaded NAME PATTERN...: the next load is told, and has them all.
loaded() {
    name=$1
    shift
    if ! load; then
        fail "$name: nothing was loaded"
        tail -5 said.txt
        return
    fi
    for pattern in "$@"; do
        grep -qE -e "$pattern" load.json || {
            fail "$name: wanted $pattern"
            cat load.json
            return
        }
    done
    pass "$name"
}

# unloaded NAME: nothing more was loaded than what the test has waited for.
unloaded() {
    sleep 0.5
    if [ "$(grep -c '^{' loads.json)" -eq "$seen" ]; then
        pass "$1"
    else
        fail "$1"
        cat loads.json
    fi
}

# ends NAME SIGNAL EXIT: the command ends by the signal.
ends() {
    kill -"$2" "$process" 2>/dev/null
    wait "$process"
    got=$?
    if [ "$got" -eq "$3" ]; then pass "$1"; else fail "$1: exit $got, wanted $3"; fi
    trap - EXIT
}

# display: begins a display in memory, of 640x480 points, as $server; DISPLAY names it. It keeps what is set for it when nobody
# uses it. false: it did not begin.
display() {
    unset WAYLAND_DISPLAY
    : >number.txt
    Xvfb -noreset -displayfd 3 -screen 0 640x480x24 -nolisten tcp 3>number.txt >xvfb.txt 2>&1 &
    server=$!
    for _ in $(seq 600); do
        [ -s number.txt ] && break
        kill -0 "$server" 2>/dev/null || return 1
        sleep 0.1
    done
    DISPLAY=:$(cat number.txt)
    export DISPLAY
}
