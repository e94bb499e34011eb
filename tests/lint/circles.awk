# Circles among things that need each other. Each line of the input is `FROM TO WHY`: FROM needs TO, for WHY.
# Prints each line that lies in a circle, as `FROM:1: what is wrong`; nothing where there is no circle.
function note(thing) {
    if (thing in left) return
    left[thing]
    name[++count] = thing
}
$1 != $2 && !(($1, $2) in why) {
    why[$1, $2] = $3
    needs[$1] = needs[$1] " " $2
    note($1)
    note($2)
}

# What needs nothing that is left lies in no circle.
function prune(    changed, i, k, n, to, any) {
    do {
        changed = 0
        for (i = 1; i <= count; i++) {
            if (!(name[i] in left)) continue
            n = split(needs[name[i]], to, " ")
            any = 0
            for (k = 1; k <= n; k++) if (to[k] in left) any = 1
            if (any) continue
            delete left[name[i]]
            changed = 1
        }
    } while (changed)
}

function reaches(from, to,    queue, head, tail, been, next_ones, n, k) {
    queue[tail = 1] = from
    for (head = 1; head <= tail; head++) {
        if (queue[head] == to) return 1
        n = split(needs[queue[head]], next_ones, " ")
        for (k = 1; k <= n; k++) {
            if (!(next_ones[k] in left) || next_ones[k] in been) continue
            been[next_ones[k]]
            queue[++tail] = next_ones[k]
        }
    }
    return 0
}

END {
    prune()
    for (i = 1; i <= count; i++) {
        if (!(name[i] in left)) continue
        n = split(needs[name[i]], to, " ")
        for (k = 1; k <= n; k++)
            if (to[k] in left && reaches(to[k], name[i]))
                print name[i] ":1: is in a circle with " to[k] ", from which it takes " why[name[i], to[k]]
    }
}
