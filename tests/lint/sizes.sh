#!/bin/sh
# Sizes of memory are multiplied by heap_times of core/heap.h, or by what takes a count and a size: a product that is
# made beside it wraps around where a size_t has 32 bits. Limits become sizes by limits_size of core/limits.h.
. "$(dirname -- "$0")/lib.sh"

ours '^[a-z].*\.[ch]$' | grep -vE '^(tests|bench|tools)/|^core/(heap|arena)\.c$' | code | awk -f "$LINT/sizes.awk" | verdict
