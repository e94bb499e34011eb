// The rules about light, over a loaded session.
#include "load/session_precision.h"

#include "core/clock.h"

void session_lint(struct session *session) {
    if (session->options.lint == LINT_NONE || session->sink.errors > 0)
        return;
    double start = clock_seconds();
    struct assets_input files = session_assets_input(session);
    struct lint_input input = {.scene = &session->resolved, .files = &files, .image = session->image};
    lint_run(&input, session->options.lint);
    if (session->options.lint == LINT_ALL)
        precision_check(session);
    session->lint_seconds = clock_seconds() - start;
}
