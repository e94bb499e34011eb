#!/bin/sh
# Each lint passes a clean tree and fails one with a planted violation.
# Usage: selftest.sh FOLDER, which is emptied.
set -eu
lint=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
root=$(CDPATH='' cd -- "$lint/../.." && pwd)
work=$1
failures=0

fresh() { # an empty tree
    rm -rf "$work/tree"
    mkdir -p "$work/tree"
    cd "$work/tree"
}

plant() { # PATH LINE...
    path=$1
    shift
    mkdir -p "$(dirname "$path")"
    printf '%s\n' "$@" >"$path"
}

complain() {
    echo "$1"
    failures=$((failures + 1))
}

passes() { # LINT [ARGUMENT]
    status=0
    output=$("$lint/$1.sh" "$work/tree" ${2+"$2"} 2>&1) || status=$?
    [ $status -eq 0 ] || [ $status -eq 77 ] || complain "$1 fails a clean tree: $output"
}

finds() { # LINT TEXT [ARGUMENT]: the output names the planted violation
    status=0
    output=$("$lint/$1.sh" "$work/tree" ${3+"$3"} 2>&1) || status=$?
    [ $status -eq 77 ] && return 0
    [ $status -eq 1 ] || complain "$1 gives $status where it should find $2"
    case $output in *"$2"*) ;; *) complain "$1 does not find $2: $output" ;; esac
}

refuses() { # LINT PATH LINE...: a clean tree but for this file, found in its last line
    name=$1
    shift
    plant "$@"
    last=$(($# - 1))
    finds "$name" "$1:$last:"
    rm -f "$1"
}

repeat() { # TEXT COUNT
    awk -v text="$1" -v count="$2" 'BEGIN { while (count-- > 0) print text }'
}

fresh
rooms() { cp "$root/cmake/rooms.txt" "$work/rooms" && plant cmake/rooms.txt '' && cp "$work/rooms" cmake/rooms.txt; }
rooms
plant core/a.c '#include "core/a.h"' '#include <stdio.h>' '// #include "parser/x.h"'
plant grammar/a.c '#include "core/a.h"' '#include "shaders/features.h"'
plant parser/yaml/read_yaml.c '#include <yaml.h>' '#include "parser/tree/tree.h"'
plant tracer/gpu/a.c '#include <volk.h>'
plant tests/a.c '#include "cli/cli.h"' '#include "beside.h"'
passes includes
refuses includes core/b.c '#include "core/a.h"' '#include "grammar/ir.h"'
refuses includes core/b.c '#include <stdio.h>' ' #  include "a.h"'
refuses includes grammar/b.c '#include "shaders/gpu_scene.h"'
refuses includes parser/bind/b.c '#include "tracer/flatten/flatten.h"'
refuses includes parser/bind/b.c '#include "parser/yaml/read_yaml.h"'
refuses includes elsewhere/b.c '#include "core/a.h"'
refuses includes parser/bind/b.c '#include <yaml.h>'
refuses includes parser/yaml/read_yaml.h '#include <expat.h>'
refuses includes assets/b.c '#include "grammar/print/ir_print.h"'
refuses includes tracer/render/b.c '#include "parser/tree/tree.h"'
refuses includes tracer/render/b.c '#include <vulkan/vulkan.h>'
refuses includes reference/b.c '#include "tracer/flatten/flatten.h"'
refuses includes reference/b.c '#include "shaders/gpu_scene.h"'
refuses includes reference/b.c '#include <zlib.h>'
refuses includes load/b.c '#include "cli/cli.h"'
refuses includes cli/b.c '#include "viewer/window.h"'
refuses includes cli/b.c '#include "../core/a.h"'
refuses includes cli/b.c '#include <core/a.h>'
plant shaders/paint/a.h ''
plant shaders/paint/a.glsl '#include "paint/a.h"'
plant shaders/a.comp '#include "paint/a.glsl"'
passes includes
refuses includes shaders/paint/b.glsl '#include "a.h"'
refuses includes shaders/b.comp '' '#include "paint/../paint/a.h"'

fresh
plant core/a.h '// A type.' '#ifndef A' '#define A' '#include <stdint.h>' 'struct a {' '    uint32_t b;' '};' '#endif'
plant core/b.h '// Uses it.' '#ifndef B' '#define B' '#include "core/a.h"' 'struct b {' '    struct a a;' '};' '#endif'
passes headers
refuses headers core/c.h '#include <stdio.h>'
plant core/c.h '// Forgot an include.' 'struct c { struct a a; };'
finds headers 'core/c.h:1: does not compile'
plant core/c.h '// Has no guard.' 'struct c { int a; };'
finds headers 'core/c.h:1: does not compile'
plant core/c.h '// Leaves something unused.' '#ifndef C' '#define C' 'static int c(void) { return 1; }' '#endif'
finds headers 'core/c.h:1: does not compile'

fresh
{ echo 'int a(void)' && echo '{' && repeat '    b();' 300 && echo '}'; } >unformatted.c
{ echo 'int a(int c,' && echo '      int d) {' && repeat '    b();' 57 && echo '}'; } >a.c
{ repeat 'int x;' 600; } >b.c
passes lengths
{ echo && echo 'int a(int c,' && echo '      int d) {' && repeat '    b();' 58 && echo '}'; } >c.c
finds lengths 'c.c:2: a function of 61 lines'
rm c.c
{ repeat 'int x;' 601; } >c.c
finds lengths 'c.c:601:'

fresh
plant cmake/rooms.txt '# core: parser' 'core:' 'core/in:' 'parser: core/in'
plant core/README.md '# core: what all stand on'
plant core/in/in.h '// What it is.'
plant parser/parser.h '// What it is.'
plant core/part/a.c 'int x;'
i=0
while [ $((i += 1)) -le 40 ]; do echo 'int x;' >core/in/$i.c; done
passes rooms
rm core/in/in.h
finds rooms 'core/in:1: neither'
refuses rooms core/in/README.md 1 2 3 4 5 6 7 8 9 10 11

fresh
plant cmake/rooms.txt 'core:' 'grammar: core shaders/features.h' 'shaders: core'
built() { # PATH LINE...: a C file of a room, and its object
    plant "$@"
    mkdir -p "../build/${1%/*}/CMakeFiles/glint.dir"
    "${CC:-cc}" -c -o "../build/${1%/*}/CMakeFiles/glint.dir/${1##*/}.o" "$1"
}
if command -v "${CC:-cc}" >/dev/null; then
    built core/a.c 'int a; int b(void); int f(void) { return b(); }'
    built core/b.c 'static int f(void) { return 1; } int b(void) { return f(); }'
    built grammar/c.c 'int f(void), c(void); int d(void) { return f(); } int main(void) { return c() + d(); }'
    built grammar/d.c 'extern int a; int c(void) { return a; }'
    passes circles ../build
    finds circles 'no object' ../nowhere
    built core/b.c 'extern int a; int b(void) { return a; }'
    finds circles 'core/a.c:1: is in a circle with core/b.c, from which it takes b' ../build
    finds circles 'core/b.c:1: is in a circle with core/a.c, from which it takes a' ../build
    built grammar/c.c 'int c2(void); int d(void) { return c2(); }'
    built grammar/d.c 'int e(void); int c2(void) { return e(); }'
    built grammar/e.c 'int d(void); int e(void) { return d(); }'
    finds circles 'grammar/e.c:1: is in a circle with grammar/c.c, from which it takes d' ../build
    rm core/b.c grammar/e.c
    passes circles ../build
    plant cmake/rooms.txt 'core:' 'grammar: core shaders/features.h' 'shaders: grammar'
    finds circles 'grammar:1: is in a circle with shaders, from which it takes shaders/features.h' ../build
    plant cmake/rooms.txt 'core:' 'grammar:' 'diag: grammar'
    built grammar/c.c 'int say(void); int c(void) { return say(); }'
    built grammar/d.c 'int d(void) { return 1; }'
    built diag/say.c 'int say(void) { return 1; }'
    built diag/more.c 'int d(void); int more(void) { return d(); }'
    finds circles 'grammar:1: is in a circle with diag, from which it takes say' ../build
    rm -rf ../build
fi

fresh
plant cmake/rooms.txt 'core:' 'tests/fuzz:'
if command -v "${CC:-cc}" >/dev/null; then
    plant tests/lint/readers.txt '# none'
    built tests/fuzz/fuzz_a.c 'int reach(void); int a(void) { return reach(); }'
    mkdir -p ../build/tests/fuzz/CMakeFiles/replay_a.dir
    mv ../build/tests/fuzz/CMakeFiles/glint.dir/fuzz_a.c.o ../build/tests/fuzz/CMakeFiles/replay_a.dir
    built core/a.c 'int files_read(void); int reach(void) { return files_read(); }'
    passes readers ../build
    built core/b.c 'int files_read(void), reach(void); int b(void) { return files_read() + reach(); }'
    finds readers 'core/b.c:1: reads bytes (files_read)' ../build
    plant tests/lint/readers.txt 'core/b.c reach'
    passes readers ../build
    plant tests/lint/readers.txt 'core/b.c -'
    finds readers 'readers.txt:1: has neither' ../build
    plant tests/lint/readers.txt 'core/b.c other'
    finds readers 'core/b.c does not use other' ../build
    plant tests/lint/readers.txt 'core/b.c - why' 'core/a.c - why'
    finds readers 'core/a.c needs no line: fuzzing reaches it' ../build
    rm -rf ../build
fi

fresh
rooms
plant core/a.c '// strcpy(a, b); exit(1);' '/* atoi(x)' '   printf("x"); */' 'f("strtok(a)", ascii_atoi(3), s->open(2));' 'snprintf(a, 3, "\"");'
plant core/arena.c 'if (setjmp(guard->jump) == 0)' '        longjmp(guard->jump, 1);' '        abort();'
plant picture/write/encode_png.c 'if (setjmp(png_jmpbuf(png)) == 0)' 'png_longjmp(png, 1);'
plant files/output.c '    f(stdout);' '    int fd = open(a, b);'
plant cli/a.c 'printf("x");' 'exit(1);'
plant grammar/emit/emit_main.c 'fprintf(stderr, "x");'
passes banned
for call in strcpy strcat sprintf vsprintf gets atoi atol atof strtok setlocale; do
    refuses banned cli/b.c '' "    x = $call(a);"
done
refuses banned core/b.c 'a(); /* b */ exit(1);'
refuses banned core/arena.c 'abort();' 'exit(1);'
refuses banned parser/bind/b.c "x = '\"'; abort();"
refuses banned load/b.c 'printf("x");'
refuses banned assets/b.c '/* " */ fprintf(stderr, "x");'
refuses banned core/b.c '' 'if (setjmp(guard.jump) == 0)'
refuses banned parser/yaml/arena.c 'if (sigsetjmp(jump, 0))'
refuses banned cli/b.c 'longjmp(jump, 1);'
refuses banned tests/unit/b.c '#include <setjmp.h>' 'int jumped = _setjmp (jump);'
refuses banned assets/b.c 'FILE *f = fopen(a, "r");'

fresh
plant a.c 'int work; // a/wo''rk/b' 'char *x = "XXXXXX";'
plant b.sh 'f=${TMPDIR:-/t''mp}/x'
plant a.md 'TO''DO is a word that we do not use.'
passes words
refuses words b.c 'x;' '// TO''DO: later'
refuses words b.c '// FIX''ME'
refuses words b.sh 'cd /wo''rk/x'
refuses words b.md 'Look into `x` at /t''mp/y.'
refuses words CMakeLists.txt 'include_directories("/ho''me/me")'

fresh
plant core/a.c '// a blank stands behind the key' 'f("a blank line", "there is no key %s", "the camera is behind the wall");' '#include "is no x.h"' "x = '\"';"
plant tests/a.c 'f("a blank is missing behind the key");'
plant docs/a.md 'A box that stands on a floor is fine. It is' 'nothing that is no longer there.'
plant CONTRIBUTING.md 'Do not write "blank".'
passes english
refuses english core/b.c 'f("a space");' 'f("a blank is missing");'
refuses english core/b.c '/* "fine" */ f("a \\"key\\"", "a colon is missing behind the key");'
plant core/b.c 'f("a colon is "' '  "missing behind"' '  "\nthe key");'
finds english 'core/b.c:1: "missing behind" is odd English; write: after'
rm core/b.c
refuses english diag/b.def 'X(A, E1, "the value stands in quotes")'
refuses english README.md 'A scene.' 'It has not 8 bits.'
plant README.md 'Radiance files that this is' 'no part of.'
finds english 'README.md:2: "is no part"'
rm README.md
refuses english core/b.c '// A colour behind a surface.' '// This is no list.'
plant core/b.c '// The fault that was' '// told at its place.'
finds english 'core/b.c:2: "was told"'
rm core/b.c
refuses english tools/b.sh 'echo "this is no scene"'

fresh
plant parser/bind/bind.c 'f(&SCHEMA_SCENE, "x-", "a sphere", "sphere is");'
plant parser/stages/validate.c 'f("sphere");'
plant ../names '#!/bin/sh' 'echo sphere; echo scene; echo Sphere'
chmod +x ../names
passes bind ../names
plant parser/bind/bind_b.c '' 'if (str_equal_cstr(name, "sphere"))'
finds bind 'parser/bind/bind_b.c:2: names "sphere"' ../names
plant parser/bind/bind_b.c '' 'if (element == &SCHEMA_SPHERE)'
finds bind 'parser/bind/bind_b.c:2: knows the element sphere' ../names

fresh
plant core/heap.c 'x = heap_alloc(count * size);'
plant core/a.h 'void *heap_alloc(struct heap *heap, size_t size);'
plant core/a.c 'struct a *f(size_t n) {' '    char *text = heap_alloc(n + 1);' '    size_t all = heap_times(n, *m);' \
    '    uint64_t small = (uint64_t)w * h;' '    x = heap_array(heap_times(n, 3) + 1, 3 * sizeof(float));' \
    '    x = ARENA_ARRAY(arena, char *, n);' '    return heap_alloc(all) ? heap_array(small, sizeof *x) : NULL;' '}'
passes sizes
refuses sizes core/b.c 'x = heap_alloc(n * sizeof *x);'
refuses sizes core/b.c 'x = heap_zeroed((size_t)n * 4, 1);'
plant core/b.c 'x = arena_try_alloc(arena,' '    2 * (n + 1));'
finds sizes 'core/b.c:1: a product'
refuses sizes core/b.c 'x = ARENA_ARRAY(arena, char *, 3 * n);'
refuses sizes core/b.c 'arena_init(&a, (size_t)in->limits->value[LIMIT_X]);'
plant core/b.c 'void f(void) {' '    const size_t all = (size_t)w *' '        h;' '    x = heap_alloc(all);' '}'
finds sizes 'core/b.c:4: a product'

fresh
cp "$root/.clang-format" .
plant a.c 'int a(void) {' '    return 1;' '}'
passes format
refuses format b.c 'int b;' 'int  c;'

fresh
plant CMakeLists.txt 'glint_library(core SOURCES core/a.c)'
plant core/a.c ''
plant tests/unit/CMakeLists.txt 'foreach(module str strbuf)'
plant tests/unit/test_str.c ''
passes sources
plant core/aa.c ''
finds sources 'core/aa.c:1:'
rm core/aa.c
plant shaders/CMakeLists.txt 'glint_kernel(KERNELS trace trace.comp)'
plant shaders/trace.comp '#include "light/a.glsl"'
plant shaders/light/a.glsl ''
passes sources
plant shaders/light/b.glsl ''
finds sources 'shaders/light/b.glsl:1:'
rm -r shaders
plant tests/unit/test_buf.c ''
finds sources 'tests/unit/test_buf.c:1:'

fresh
if command -v "${CC:-cc}" >/dev/null; then
    plant scene/scene.h 'enum scene_shape {' '    SCENE_MESH,' '};'
    plant scene/shape.h '#include "scene/scene.h"' 'enum shape_items {' '    SHAPE_TRIANGLES,' '};'
    plant scene/shape.c '#include "scene/shape.h"' 'int f(enum scene_shape s);' 'int f(enum scene_shape s) {' '    switch (s) {' \
        '    case SCENE_MESH:' '        return 1;' '    }' '    return 0;' '}'
    plant CONTRIBUTING.md '## How to add a kind of body' '`scene/shape.c`: `f`'
    passes shapes
    plant CONTRIBUTING.md '## How to add a kind of body' '`scene/shape.c`: `g`'
    finds shapes 'does not list scene/shape.c: f'
    finds shapes 'does not need: scene/shape.c: g'
fi

rm -rf "$work/tree" "$work/names" "$work/rooms" "$work/build"
[ $failures -eq 0 ]
