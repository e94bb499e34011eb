// All of a stream, such as standard input, which has no size and can be read only once.
//
// Output: the text, appended to the caller's strbuf; its `failed` says that there was more than `cap_bytes`.
// Errors: an errno, 0 if there was none. Thread safety: one thread reads a stream.
#ifndef GLINT_FILES_STREAM_H
#define GLINT_FILES_STREAM_H

#include "core/strbuf.h"

// The first bytes of a file, at most so many; SIZE_MAX: all. `failed` says that memory ended.
int stream_read_file(const char *path, size_t most_bytes, struct strbuf *bytes);
int stream_read(int fd, size_t cap_bytes, struct strbuf *text);

#endif
