#!/bin/sh
# Another build of the program says the same bytes as this one: run_builds.sh GLINT SOURCE WORK KIND, where KIND is
#     check-only   what needs neither Vulkan nor glslang
#     i386         the same for 32 bits, where tools/i386.sh has put its libraries
#     web          the same as WebAssembly, run by node, where tools/web.sh has built its libraries
# The build folder is WORK/../build_KIND, of the module build/web, so that another run only builds what has changed.
built=$(dirname -- "$3")/build_$4
. "$2/tests/cli/lib.sh"
kind=$4

preset=check-only
targets='glint run_invalid run_verdicts'
case $kind in
check-only) toolchain= ;;
web)
    toolchain=
    preset=web
    targets=npm_package
    built=$source/build/web
    GLINT_WEB=${GLINT_WEB:-$source/build/web-root}
    export GLINT_WEB
    [ -d "$GLINT_WEB/root" ] || {
        echo "skipped: no libraries for WebAssembly; tools/web.sh builds them"
        exit 77
    }
    ;;
i386)
    GLINT_I386=${GLINT_I386:-$source/build/i386}
    export GLINT_I386
    [ -d "$GLINT_I386/root" ] || {
        echo "skipped: no libraries of 32 bits; tools/i386.sh fetches them"
        exit 77
    }
    # Not every kernel runs programs of 32 bits.
    printf '.globl _start\n_start:\nmovl $1, %%eax\nxorl %%ebx, %%ebx\nint $0x80\n' | as --32 -o narrow.o &&
        ld -m elf_i386 -o narrow narrow.o && ./narrow 2>/dev/null || {
        echo "skipped: this system runs no programs of 32 bits"
        exit 77
    }
    toolchain="--toolchain $source/cmake/i386.cmake"
    ;;
*) exit 2 ;;
esac

# shellcheck disable=SC2086 # words, or none
if (cd "$source" && cmake --preset $preset -B "$built" $toolchain) >build.log 2>&1 &&
    cmake --build "$built" --parallel 2 --target $targets >>build.log 2>&1; then
    pass "builds"
else
    tail -n 40 build.log
    exit 1
fi
if grep -iE '^[^/#]*(glslang|spirv|vulkan|volk)' "$built/CMakeCache.txt" | grep -v displayName; then
    fail "the build looks for what only devices need"
fi
if (cd "$built" && ninja -t deps) 2>/dev/null | grep -E '/(spirv|vulkan|volk)'; then
    fail "the build includes what only devices need"
fi
other=$built/glint
if [ "$kind" = web ]; then
    mkdir -p bin
    other=$work/bin/glint
    printf '#!/bin/sh\nexec node "%s" "$@"\n' "$built/glint-lint/cli.cjs" >"$other"
    chmod +x "$other"
fi
[ "$kind" != i386 ] || file -L "$other" | grep -q 32-bit || fail "it is no program of 32 bits"

if [ "$kind" = web ]; then
    size=$(gzip -9 -c "$built/glint-lint/glint.wasm" | wc -c)
    [ "$size" -le 760000 ] && pass "$size bytes, compressed" ||
        fail "glint.wasm takes $size bytes, compressed, and 760000 are the most; libraries made anew by tools/web.sh may be smaller"
fi

# ---- what is wrong with scenes

# same NAME ARGUMENT...: both programs answer with the same status and the same bytes.
same() {
    name=$1
    shift
    (cd "$source" && "$glint" "$@") >ours.out 2>ours.err </dev/null
    status=$?
    (cd "$source" && "$other" "$@") >other.out 2>other.err </dev/null
    got=$?
    # The system's own words.
    [ "$kind" != web ] || sed -i 's/Filename too long/File name too long/' other.out other.err
    if [ "$status" = "$got" ] && cmp -s ours.out other.out && cmp -s ours.err other.err; then
        pass "$name"
    else
        fail "$name: status $got, wanted $status"
        diff ours.out other.out | head -10
        diff ours.err other.err | head -10
    fi
}

if [ "$kind" = web ]; then # it runs no tests: one command for all of them
    # shellcheck disable=SC2046 # paths without spaces
    same "every wrong scene" check --verbose $(cd "$source" && ls tests/invalid/*/case.yaml tests/invalid/*/case.xml)
else
    wrong=0
    for case in "$source"/tests/invalid/*/expected.txt; do
        "$built/run_invalid" case "$(dirname "$case")" >case.txt 2>&1 || {
            cat case.txt
            wrong=$((wrong + 1))
        }
    done
    [ "$wrong" = 0 ] && pass "every wrong scene has its text" || fail "$wrong wrong scenes have another text"
    for table in yaml xml; do
        "$built/run_verdicts" check "$source/tests/verdicts/$table.verdicts" >table.txt 2>&1 &&
            pass "verdicts of $table" || {
            cat table.txt
            fail "verdicts of $table"
        }
    done
fi

same "check of all scenes" check scenes --verbose
same "reports of all scenes" check scenes --format json
same "reports of wrong scenes" check tests/invalid --format sarif
scene=scenes/elements/models.glint.yaml
same "inspect" inspect "$scene"
same "the scene as it is understood" inspect --ir=evaluated "$scene"
same "convert" convert "$scene" -
same "format" format --check scenes
same "schema" schema json
same "pick by the reference" pick "$scene" 320,200 --device reference --format json
for scene in spheres models; do
    for program in "$glint" "$other"; do
        "$program" render "$source/scenes/elements/$scene.glint.yaml" --device reference --no-cache --size 160x120 -q \
            -o "$work/$scene.$(basename "$(dirname "$program")").pfm" || fail "render $scene"
    done
    cmp "$work/$scene.$(basename "$(dirname "$glint")").pfm" "$work/$scene.$(basename "$(dirname "$other")").pfm" &&
        pass "the reference's picture of $scene"
done

if [ "$kind" = web ]; then
    expect "the module in a program" 0 '^all good$' - node "$source/tests/builds/web_api.cjs" "$built/glint-lint"
    expect "standard input" 0 '<Sphere' - sh -c 'printf "glint: 1\nspheres: [{center: [0, 0, 0], radius: 1}]\n" | "$0" convert - -' "$other"
fi

# ---- what it cannot do

expect "devices" 4 - 'this glint is built to check scenes: it draws on no device \[E701\]' "$other" devices
also "the package is named" '' "the package 'glint' draws on devices"
for command in render extremes tradeoff; do
    expect "$command" 4 - "draws on no device" "$other" "$command" "$source/scenes/elements/spheres.glint.yaml"
done
[ ! -e spheres.png ] || fail "a picture was left"
exit $failed
