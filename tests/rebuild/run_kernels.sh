#!/bin/sh
# cmake/shaders.cmake makes a kernel anew where it or a file that it includes has changed, in whatever folder of
# shaders/, and only then. In a small project that has the tools of this one.
# Usage: run_kernels.sh ROOT FOLDER CMAKE CC, the folder being emptied
set -eu
root=$1 work=$2 cmake=$3 cc=$4
failures=0
"$root/tools/emptied" "$work"
mkdir -p "$work/shaders/light"
cd "$work"
ln -s "$root/cmake" "$root/tools" .
cp "$root"/shaders/*.h shaders
cp -r "$root/shaders/packed" shaders

cat >CMakeLists.txt <<'EOF'
cmake_minimum_required(VERSION 3.25)
project(rebuild LANGUAGES C)
set(GLINT_DEVICE ON)
add_subdirectory(tools/spirv_exact)
add_subdirectory(shaders)
EOF
cat >shaders/CMakeLists.txt <<'EOF'
include(${CMAKE_SOURCE_DIR}/cmake/shaders.cmake)
glint_kernel(KERNELS made made.comp)
glint_kernel(KERNELS light light/light.comp)
glint_pack_kernels(KERNELS)
add_custom_target(kernels ALL DEPENDS ${KERNELS_SOURCES})
EOF
kernel() { # INCLUDED
    printf '#version 450\n#extension GL_GOOGLE_include_directive : require\n#include "%s"\n' "$1"
    echo 'layout(binding = 0) buffer Out { float value; };'
    echo 'void main() { value = light(); }'
}
kernel light/part.glsl >shaders/made.comp
kernel light/alone.glsl >shaders/light/light.comp
echo '#include "light/number.h"' >shaders/light/part.glsl
echo 'float light() { return NUMBER; }' >>shaders/light/part.glsl
echo '#define NUMBER 1.0' >shaders/light/number.h
echo 'float light() { return 1.0; }' >shaders/light/alone.glsl

build() { "$cmake" --build build >build.log 2>&1 || { cat build.log && exit 1; }; }
expect() { # WHAT KERNEL...: these were made by the build, and no others
    what=$1
    shift
    build
    made=$(sed -n 's/.*Compiling kernel \([a-z_]*\).*/\1/p' build.log | sort | tr '\n' ' ')
    [ "$made" = "${*:+$* }" ] && return
    echo "after $what: made '$made' instead of '$*'"
    failures=$((failures + 1))
}
change() { sed -i 's/1\.0/2.0/' "$1"; } # FILE: another number

"$cmake" -S . -B build -G Ninja -DCMAKE_C_COMPILER="$cc" >configure.log 2>&1 || { cat configure.log && exit 1; }
expect 'the first build' light made
expect 'no change'
before=$(cksum <build/shaders/kernels.c)
change shaders/light/number.h
expect 'a header in a folder inside' made
[ "$before" != "$(cksum <build/shaders/kernels.c)" ] || { echo 'the kernel is as before' && failures=$((failures + 1)); }
change shaders/light/alone.glsl
expect 'GLSL beside its kernel' light
touch shaders/made.comp
expect 'the kernel itself' made
[ $failures -eq 0 ]
