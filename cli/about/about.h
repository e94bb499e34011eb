// What this program is: version, commit, date, and the libraries that it runs with.
//
// Thread safety: pure.
#ifndef GLINT_CLI_ABOUT_ABOUT_H
#define GLINT_CLI_ABOUT_ABOUT_H

#include "core/strbuf.h"

// The commit that it was built from (cmake/about.cmake): a short hash, with '+' if files differed from it,
// and its day, YYYY-MM-DD. Empty if the build did not know.
extern const char about_commit[], about_date[];

// The lines of `glint --version`; the first is "glint VERSION".
void about_program(const char *version, bool has_devices, struct strbuf *out);

#endif
