// Binding entries of the root's lists while the file is still being read. Private to parser/.
//
// Mistakes within an entry are reported as they would be otherwise. A diagnostic of the reader or of the root
// may change what must be reported about entries: then the caller drops everything and reads the file whole.
// So the reports about a file never depend on how it was read. Ownership: as in bind.h. Thread safety: one
// stream belongs to one thread.
#ifndef GLINT_PARSER_BIND_BIND_STREAM_H
#define GLINT_PARSER_BIND_BIND_STREAM_H

#include "parser/bind/bind.h"
#include "parser/tree/reader.h"

struct bind_stream {
    struct reader_taker taker;
    struct bind_context *context; // its scene takes the entries
    struct bind_frame root;
    struct diag_sink sink;             // what was reported about entries
    struct arena entry;                // emptied after each entry
    uint32_t elements_mark, rows_mark; // places
};

// `context` is that of the file, complete except for its scene.
void bind_stream_begin(struct bind_stream *stream, struct bind_context *context, size_t memory_bytes);
// Forgets everything that was bound and reported.
void bind_stream_forget(struct bind_stream *stream);
void bind_stream_finish(struct bind_stream *stream);

#endif
