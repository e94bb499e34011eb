#!/bin/sh
# Who may include whom: the table of docs/architecture.md.
. "$(dirname -- "$0")/lib.sh"

sources=$(ours '\.[ch]$')
[ -z "$sources" ] && exit 0
# shellcheck disable=SC2086
awk '
function own(path, target) {
    if (path ~ /^core\//) return target ~ /^core\//
    if (path ~ /^grammar\//) return target ~ /^(core|grammar)\// || target == "shaders/features.h"
    if (path ~ /^parser\//) return target ~ /^(core|grammar|parser)\//
    if (path ~ /^assets\//)
        return target ~ /^(core|assets)\// || target ~ /^grammar\/(ir|ir_origin|schema)\.h$/
    if (path ~ /^runtime\/reference\//)
        return target ~ /^(core|grammar|assets|runtime\/reference)\// || target == "runtime/hits.h"
    if (path ~ /^runtime\//) return target ~ /^(core|grammar|assets|runtime)\// || target ~ /^shaders\/.*\.h$/
    if (path ~ /^shaders\//) return target ~ /^shaders\//
    if (path ~ /^app\//) return target !~ /^(lsp|cli|viewer|tests|bench|tools)\//
    if (path ~ /^lsp\//) return target !~ /^(cli|viewer|tests|bench|tools)\//
    if (path ~ /^cli\//) return target !~ /^(viewer|tests|bench|tools)\//
    if (path ~ /^viewer\//) return target !~ /^(cli|tests|bench|tools)\//
    return 1
}
function foreign(path, target) {
    if (target ~ /^yaml\.h$/) return path ~ /^(parser\/read_yaml|bench\/bench_check)/
    if (target ~ /^expat/) return path ~ /^(parser\/read_xml|bench\/bench_check)/
    if (target ~ /^(volk|vulkan)/) return path ~ /^runtime\/gpu\//
    if (target ~ /^stb/) return path ~ /^(assets|runtime\/image|tools|tests)\//
    if (target ~ /^png\.h/) return path ~ /^(runtime\/image|tests)\//
    if (target ~ /^jansson/) return path ~ /^(grammar|lsp|tests)\//
    if (target ~ /^minizip/) return path ~ /^app\/pack_zip/
    if (target ~ /^(GLFW|X11|wayland)/) return path ~ /^viewer\//
    if (target ~ /^cmocka/) return path ~ /^tests\//
    if (target ~ /^pthread/) return path ~ /^(core|tests)\//
    return target !~ /^(core|grammar|parser|assets|runtime|shaders|app|lsp|cli|viewer)\//
}
/^[ \t]*#[ \t]*include[ \t]*["<]/ {
    target = $0
    quoted = target ~ /^[^<]*"/
    sub(/^[^"<]*["<]/, "", target)
    sub(/[">].*/, "", target)
    place = FILENAME ":" FNR ": "
    if (!quoted) {
        if (!foreign(FILENAME, target)) print place "<" target "> is not for this folder"
    } else if (target ~ /^\.\.?\// || target ~ /\/\.\.?\//) {
        print place "\"" target "\" is not a path from the root"
    } else if (target !~ /\//) {
        if (FILENAME !~ /^(tests|bench|tools)\//) print place "\"" target "\" lacks its folder"
    } else if (!own(FILENAME, target)) {
        print place "\"" target "\" is not for this folder"
    }
}' $sources | verdict
