#!/bin/sh
# The program's text (code and constants, kernels among them) stays below 3 MB.
# Usage: text.sh GLINT
set -eu
command -v size >/dev/null || exit 77

most=3000000
text=$(size "$1" | awk 'NR == 2 { print $1 }')
echo "text: $text bytes of $most"
[ "$text" -le "$most" ]
