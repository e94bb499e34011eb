// Binding entries of the root's lists while the file is still being read. Private to parser/.
//
// A file without mistakes is bound this way; at the first diagnostic of any kind the caller forgets all of it
// and has the file read whole, so that what is said about a file never depends on how it was read.
// Ownership: as in bind.h. Thread safety: one stream belongs to one thread.
#ifndef GLINT_PARSER_BIND_STREAM_H
#define GLINT_PARSER_BIND_STREAM_H

#include "parser/bind.h"
#include "parser/reader.h"

struct bind_stream {
    struct reader_taker taker;
    struct bind_context *context; // its scene takes the entries
    struct bind_frame root;
    struct arena entry;                // emptied behind each entry
    uint32_t elements_mark, rows_mark; // of the places
};

// `context` is that of the file, complete but for its scene.
void bind_stream_begin(struct bind_stream *stream, struct bind_context *context, size_t memory_bytes);
// Forgets what was bound.
void bind_stream_forget(struct bind_stream *stream);
void bind_stream_finish(struct bind_stream *stream);

#endif
