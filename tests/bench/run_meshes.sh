#!/bin/sh
# The meshes of the bench: a knot is closed, has the triangles that it promises and is the same each time; PLY files
# become the same mesh, and broken ones are refused.
# Usage: run_meshes.sh GLINT SOURCE_FOLDER WORK_FOLDER BENCH_MESH
. "$(dirname -- "$0")/../cli/lib.sh"
mesh=$4

expect "a knot" 0 '^2016 triangles, 1008 vertices' - "$mesh" knot 2000 knot.obj
expect "has as many faces" 0 '^2016$' - grep -c '^f' knot.obj
expect "and again" 0 '' - "$mesh" knot 2000 again.obj
ok "is the same, byte for byte" cmp knot.obj again.obj
expect "it is closed, and not turned" 0 'knot\.obj: 2016 triangles, closed$' '' "$glint" inspect knot.obj
expect "too few triangles" 2 - 'from 18 to' "$mesh" knot 3 few.obj
expect "another word" 2 - '^usage' "$mesh" sphere 30 few.obj

# A tetrahedron: a confidence after each position, a colour before the corners; one face of four corners more.
ply() { # NAME LAST_CORNER
    {
        printf 'ply\nformat binary_little_endian 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\n'
        printf 'property double z\nproperty uchar confidence\nelement face 2\nproperty uchar red\nproperty list uchar int vertex_indices\nend_header\n'
        printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\1'
        printf '\0\0\200\77\0\0\0\0\0\0\0\0\0\0\0\0\2'
        printf '\0\0\0\0\0\0\200\77\0\0\0\0\0\0\0\0\3'
        printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\360\77\4'
        printf '\11\3\0\0\0\0\1\0\0\0\2\0\0\0'
        printf '\11\4\0\0\0\0\1\0\0\0\3\0\0\0'"$2"'\0\0\0'
    } >"$1"
}
ply good.ply '\2'
expect "a PLY file" 0 '^3 triangles, 4 vertices, from 0 0 0 to 1 1 1$' - "$mesh" ply good.ply good.obj
printf 'v 0.0000000 0.0000000 0.0000000\nv 1.0000000 0.0000000 0.0000000\nv 0.0000000 1.0000000 0.0000000\n' >wanted.obj
printf 'v 0.0000000 0.0000000 1.0000000\nf 1 2 3\nf 1 2 4 3\n' >>wanted.obj
ok "is that mesh" cmp good.obj wanted.obj

ply outside.ply '\4'
expect "a corner that does not exist" 1 - 'outside\.ply has a face with a vertex' "$mesh" ply outside.ply out.obj
head -c 300 good.ply >short.ply
expect "a file that ends too early" 1 - 'short\.ply ends within' "$mesh" ply short.ply out.obj
sed 's/binary_little_endian/ascii/' good.ply >ascii.ply
expect "another format" 1 - 'is not a binary little-endian PLY' "$mesh" ply ascii.ply out.obj
expect "no file" 1 - 'none\.ply cannot be opened' "$mesh" ply none.ply out.obj
ok "nothing half-written" test ! -e out.obj
exit $failed
