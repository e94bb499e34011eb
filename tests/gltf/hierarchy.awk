# awk -v seed=N -v spread=N -f hierarchy.awk: a glTF file of a random hierarchy in which subtrees occur again, some of them
# turned, mirrored, stretched or sheared by what is above. `spread`: of the roots.
function rnd(n) {
    state = (state * 1103515245 + 12345) % 2147483648
    return int(state / 65536) % n
}
function place(    text) {
    text = sprintf(", \"translation\": [%.9g, %.9g, %.9g]", (rnd(2001) - 1000) / 997, (rnd(2001) - 1000) / 997, (rnd(2001) - 1000) / 991)
    if (rnd(3) == 0) text = text ", \"rotation\": [" turn[rnd(4)] "]"
    if (rnd(4) == 0) text = text ", \"scale\": [" size[rnd(6)] "]"
    return text
}
function add(shows, below, where) {
    shown[nodes] = shows
    children[nodes] = below
    places[nodes] = where
    return nodes++
}
# The same as another node shows, placed as `where` says; what is below is copied too.
function again(node, where,    list, copies, count, i) {
    count = split(children[node], list, " ")
    for (i = 1; i <= count; i++) copies = copies " " again(list[i], places[list[i]])
    return add(shown[node], copies, where)
}
function tree(depth,    count, i, list, shows) {
    count = depth ? 1 + rnd(3) : 0
    for (i = 0; i < count; i++) list = list " " (nodes && rnd(2) && nodes < 60 ? again(rnd(nodes), place()) : tree(depth - 1))
    if (!list || rnd(2)) shows = ", \"mesh\": " rnd(2)
    if (!shows && rnd(4) == 0) shows = shows ", \"extensions\": {\"KHR_lights_punctual\": {\"light\": 0}}"
    if (rnd(25) == 0) shows = shows ", \"camera\": 1"
    return add(shows, list, place())
}
BEGIN {
    state = seed * 7919 + 17
    split("0 0.38268343236509 0 0.92387953251129|0 0 0.70710678118655 0.70710678118655|0.5 0.5 0.5 0.5|0.2 0.4 0 0.89442719099992", turn, "|")
    split("1 1 1|2 2 2|-1 1 1|0.5 1 1|1 2 0.5|0 1 1", size, "|")
    for (i = 0; i < 6; i++) { turn[i] = turn[i + 1]; size[i] = size[i + 1]; gsub(" ", ", ", turn[i]); gsub(" ", ", ", size[i]) }
    if (rnd(4)) size[5] = "3, 3, 3"
    for (i = 0; i < 6; i++) roots = roots " " (i && rnd(2) ? again(rnd(nodes), place()) : tree(3))
    print "{\"asset\": {\"version\": \"2.0\"}, \"extensionsUsed\": [\"KHR_lights_punctual\"],"
    print "\"extensions\": {\"KHR_lights_punctual\": {\"lights\": [{\"type\": \"point\", \"intensity\": 1}, {\"type\": \"directional\", \"intensity\": 4}]}},"
    print "\"buffers\": [{\"byteLength\": 48, \"uri\": \"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAQD8AAAAAAAAAAAAAAAAAAAA/\"}],"
    print "\"bufferViews\": [{\"buffer\": 0, \"byteLength\": 48}],"
    print "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": 3, \"type\": \"VEC3\", \"min\": [0, 0, 0], \"max\": [1, 0.75, 0]},"
    print " {\"bufferView\": 0, \"byteOffset\": 12, \"componentType\": 5126, \"count\": 3, \"type\": \"VEC3\", \"min\": [0, 0, 0], \"max\": [1, 0.75, 0.5]}],"
    print "\"materials\": [{\"name\": \"red\", \"doubleSided\": true, \"pbrMetallicRoughness\": {\"baseColorFactor\": [0.8, 0.2, 0.1, 1], \"metallicFactor\": 0}}],"
    print "\"meshes\": [{\"name\": \"kite\", \"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"material\": 0}]}, {\"primitives\": [{\"attributes\": {\"POSITION\": 1}}]}],"
    print "\"cameras\": [{\"type\": \"orthographic\", \"orthographic\": {\"xmag\": 8, \"ymag\": 6, \"znear\": 0.1, \"zfar\": 100}}, {\"type\": \"perspective\", \"perspective\": {\"yfov\": 1, \"znear\": 1}}],"
    printf "\"nodes\": ["
    for (i = 0; i < nodes; i++) {
        list = children[i]
        gsub("^ ", "", list)
        gsub(" ", ", ", list)
        printf "{\"name\": \"n%d\"%s%s%s},\n ", i % 7, shown[i], places[i], list == "" ? "" : ", \"children\": [" list "]"
    }
    print "{\"name\": \"eye\", \"camera\": 0, \"translation\": [0, 0, 20]}, {\"extensions\": {\"KHR_lights_punctual\": {\"light\": 1}}, \"rotation\": [-0.3, 0.1, 0, 0.94868329805051]}],"
    gsub("^ ", "", roots)
    gsub(" ", ", ", roots)
    print "\"scenes\": [{\"nodes\": [" nodes ", " roots ", " nodes + 1 "]}]}"
}
