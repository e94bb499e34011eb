#!/bin/sh
# Builds the libraries that glint.wasm is linked with: tools/web.sh [FOLDER], which is build/web-root if none is named.
# The sources are Debian's source packages, with Debian's patches; apt checks their signatures. Needs emscripten (3.1.6 or
# later), cmake, ninja and dpkg-dev; installs nothing. Then: GLINT_WEB=FOLDER cmake --preset web
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
folder=${1:-$here/build/web-root}
for program in emcc dpkg-source cmake ninja; do
    command -v "$program" >/dev/null || {
        echo "tools/web.sh: needs $program" >&2
        exit 1
    }
done
"$here/tools/emptied" "$folder"
mkdir -p "$folder/sources" "$folder/root"
cd "$folder"
suite=bookworm
kind=deb-src
. "$here/tools/apt_apart.sh"
(cd sources && apt-get source -qq libyaml expat jansson zlib libpng1.6 libjpeg-turbo xxhash freetype >../sources.log 2>&1) || {
    cat sources.log
    exit 1
}
export PKG_CONFIG_LIBDIR="$folder/root/lib/pkgconfig"

# library SOURCE [OPTION...]: by its own CMake files, into root/.
library() {
    source=$1
    shift
    name=$(basename "$source")
    echo "tools/web.sh: $name"
    {
        emcmake cmake -G Ninja -S "$source" -B "build/$name" -DCMAKE_BUILD_TYPE=MinSizeRel -DCMAKE_C_FLAGS_MINSIZEREL="-Oz -DNDEBUG" -DCMAKE_INSTALL_PREFIX="$folder/root" \
            -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_FIND_ROOT_PATH="$folder/root" -DBUILD_SHARED_LIBS=OFF \
            -DCMAKE_C_FLAGS="-ffp-contract=off $lto" "$@" &&
            cmake --build "build/$name" --parallel 2 && cmake --install "build/$name"
    } >"build-$name.log" 2>&1 || {
        tail -n 40 "build-$name.log"
        exit 1
    }
}
# package NAME LIBRARY VERSION [FOLDER of its headers]: what pkg-config says, where the library's own files do not.
package() {
    mkdir -p root/lib/pkgconfig
    printf 'Name: %s\nDescription: %s\nVersion: %s\nCflags: -I%s\nLibs: -L%s -l%s\n' "$1" "$1" "$3" \
        "$folder/root/include/${4:-}" "$folder/root/lib" "$2" >"root/lib/pkgconfig/$1.pc"
}
# By its configure: its CMake files want what Debian leaves out.
zlib() {
    echo "tools/web.sh: zlib and minizip"
    (
        cd sources/zlib-*
        CFLAGS="-Oz $lto -DDYNAMIC_CRC_TABLE" emconfigure ./configure --static --prefix="$folder/root"
        emmake make -j2 libz.a
        emmake make install
        cd contrib/minizip
        for file in zip unzip ioapi; do
            emcc -Oz $lto -DNOCRYPT -DNOUNCRYPT -DUSE_FILE32API -I../.. -c "$file.c" -o "$file.o"
        done
        emar rcs "$folder/root/lib/libminizip.a" zip.o unzip.o ioapi.o
        mkdir -p "$folder/root/include/minizip"
        cp zip.h unzip.h ioapi.h "$folder/root/include/minizip"
    ) >build-zlib.log 2>&1 || {
        tail -n 40 build-zlib.log
        exit 1
    }
    package minizip minizip "$(sed -n 's/^Version: //p' root/lib/pkgconfig/zlib.pc)" minizip
}
export NODE_PATH="${NODE_PATH:-/usr/share/nodejs}" # where Debian keeps what emscripten needs of node
mkdir -p build
lto=-flto # what glint never calls is left out with it
library sources/libyaml-* -DBUILD_TESTING=OFF
package yaml-0.1 yaml "$(basename sources/libyaml-* | sed 's/.*-//')"
cp sources/xxhash-*/xxhash.h root/include
library "$(ls -d sources/expat-*/expat)" -DEXPAT_BUILD_TOOLS=OFF -DEXPAT_BUILD_EXAMPLES=OFF -DEXPAT_BUILD_TESTS=OFF \
    -DEXPAT_SHARED_LIBS=OFF -DEXPAT_BUILD_DOCS=OFF -DEXPAT_DTD=OFF -DEXPAT_NS=OFF -DEXPAT_CONTEXT_BYTES=0 -DEXPAT_MIN_SIZE=ON -DCMAKE_C_FLAGS="-ffp-contract=off $lto -DXML_DTD=1" # patched: == 1
library sources/jansson-* -DJANSSON_BUILD_DOCS=OFF -DJANSSON_WITHOUT_TESTS=ON -DJANSSON_EXAMPLES=OFF
zlib
# libpng with what glint asks it for, and no more: pixels and text. Its own messages are shown to nobody.
{
    echo 'everything = off'
    for option in SETJMP USER_MEM USER_LIMITS SET_USER_LIMITS SET_UNKNOWN_CHUNKS HANDLE_AS_UNKNOWN EASY_ACCESS POINTER_INDEXING \
        BENIGN_ERRORS BENIGN_READ_ERRORS CHECK_FOR_INVALID_INDEX FIXED_POINT READ SEQUENTIAL_READ READ_16BIT READ_TRANSFORMS \
        READ_EXPAND READ_GRAY_TO_RGB READ_SWAP READ_USER_TRANSFORM USER_TRANSFORM_PTR USER_TRANSFORM_INFO READ_ANCILLARY_CHUNKS \
        READ_OPT_PLTE READ_tRNS WRITE WRITE_16BIT \
        WRITE_CUSTOMIZE_COMPRESSION WRITE_CUSTOMIZE_ZTXT_COMPRESSION WRITE_ANCILLARY_CHUNKS WRITE_TEXT WRITE_tEXt WRITE_iTXt; do
        echo "option $option on"
    done
} >libpng.dfa
library sources/libpng1.6-* -DPNG_SHARED=OFF -DPNG_TESTS=OFF -DPNG_EXECUTABLES=OFF -DPNG_HARDWARE_OPTIMIZATIONS=OFF -DDFA_XTRA="$folder/libpng.dfa"
# What glint never asks libjpeg for: its header of capabilities is meant to be edited.
sed -i -E 's/^#define +((UPSAMPLE_MERGING|QUANT_1PASS|QUANT_2PASS|IDCT_SCALING|DCT_IFAST|DCT_FLOAT)_SUPPORTED)/#undef \1/' \
    sources/libjpeg-turbo-*/jmorecfg.h
library sources/libjpeg-turbo-* -DWITH_SIMD=OFF -DWITH_TURBOJPEG=OFF -DWITH_ARITH_ENC=OFF -DWITH_ARITH_DEC=OFF -DENABLE_SHARED=OFF \
    -DCMAKE_INSTALL_LIBDIR="$folder/root/lib" -DHAVE_SIZE_T=TRUE -DSIZE_T=4 -DHAVE_UNSIGNED_LONG=TRUE -DUNSIGNED_LONG=4 # its own look at a program finds none
# FreeType with what glint asks it for: outlines of TrueType and OpenType files, without hints.
for module in 'FT_Driver_ClassRec, tt_driver_class' 'FT_Driver_ClassRec, cff_driver_class' 'FT_Module_Class, psaux_module_class' \
    'FT_Module_Class, sfnt_module_class'; do
    echo "FT_USE_MODULE( $module )"
done >"$(ls -d sources/freetype-*)/include/freetype/config/ftmodule.h"
sed -i -E 's/^#define +((FT_CONFIG_OPTION_(USE_(LZW|ZLIB)|ENVIRONMENT_PROPERTIES|SUBPIXEL_RENDERING|POSTSCRIPT_NAMES|ADOBE_GLYPH_LIST|MAC_FONTS|GUESSING_EMBEDDED_RFORK|INCREMENTAL|SVG))|TT_CONFIG_OPTION_(POSTSCRIPT_NAMES|EMBEDDED_BITMAPS|COLOR_LAYERS|BYTECODE_INTERPRETER|SUBPIXEL_HINTING|GX_VAR_SUPPORT|BDF))\>.*//' \
    sources/freetype-*/include/freetype/config/ftoption.h
library "$(ls -d sources/freetype-*)" -DFT_DISABLE_ZLIB=ON -DFT_DISABLE_BZIP2=ON -DFT_DISABLE_PNG=ON -DFT_DISABLE_HARFBUZZ=ON -DFT_DISABLE_BROTLI=ON
rm -rf apt build sources sources.log build-*.log libpng.dfa
