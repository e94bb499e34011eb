#include "diag/diag_outside.h"

#include "files/work_tree.h"

void diag_outside(struct diag_sink *sink, struct files *files, str path, str target) {
    struct files_marker marker;
    str advice = files_outside_advice(files, path, target, &marker);
    diag_help(sink, "%.*s", STR_ARG(advice));
    if (marker.path.len)
        diag_fix_file(sink, marker.is_certain, marker.path, STR(FILES_MARKER_TEXT));
}
