// JSON-RPC 2.0 in the frames of the Language Server Protocol 3.17 ("Base Protocol"): Content-Length headers
// and a JSON body, over two file descriptors; or only the bodies, one per call, if the program is a module of
// another.
//
// Ownership: rpc_read returns a new reference; functions that take a json_t take over its reference, except
// for ids. Errors: a peer that hangs up or does not send frames ends the connection (RPC_END); a body that is
// not JSON is answered here with ParseError, and reading continues.
// Thread safety: one thread.
#ifndef GLINT_LSP_RPC_H
#define GLINT_LSP_RPC_H

#include "core/strbuf.h"

#include <jansson.h>

enum rpc_error_code {
    RPC_PARSE_ERROR = -32700,
    RPC_INVALID_REQUEST = -32600,
    RPC_METHOD_NOT_FOUND = -32601,
    RPC_INVALID_PARAMS = -32602,
    RPC_NOT_INITIALIZED = -32002,
    RPC_REQUEST_CANCELLED = -32800,
    RPC_CONTENT_MODIFIED = -32801,
    RPC_REQUEST_FAILED = -32803,
};

enum rpc_state {
    RPC_MESSAGE,
    RPC_END,
};

enum rpc_pending {
    RPC_NOTHING, // timeout
    RPC_BYTES,   // rpc_read need not wait for the first byte
    RPC_WOKEN,   // `woken` can be read, but there are no bytes
};

// Takes a message that the server sends: JSON in UTF-8, only for the call.
typedef void rpc_sender(void *context, const char *text, size_t length);

struct rpc {
    int in, out;
    int woken;              // another descriptor that rpc_wait looks at; -1: none
    rpc_sender *sender;     // used instead of both; NULL: there is none
    void *context;          // of it
    struct strbuf received; // bytes not yet parsed
    size_t taken;           // of `received`, already parsed
    bool broken;            // a stream failed, or the client is gone
    int error;              // errno of that; 0: the client ended
    bool input_failed;      // else the output
};

void rpc_init(struct rpc *rpc, int in, int out);
void rpc_init_sender(struct rpc *rpc, rpc_sender *sender, void *context);
void rpc_finish(struct rpc *rpc);
// Parses the message in a text; NULL: it is not JSON, which is answered here.
json_t *rpc_parse(struct rpc *rpc, const char *text, size_t length);
// Waits for a message.
enum rpc_state rpc_read(struct rpc *rpc, json_t **message);
// Waits at most that many milliseconds; -1: for ever.
enum rpc_pending rpc_wait(const struct rpc *rpc, int wait_ms);
void rpc_reply(struct rpc *rpc, json_t *id, json_t *result);
void rpc_refuse(struct rpc *rpc, json_t *id, enum rpc_error_code code, const char *message);
void rpc_notify(struct rpc *rpc, const char *method, json_t *params);
// A request; the client's answer is read like any message.
void rpc_ask(struct rpc *rpc, const char *id, const char *method, json_t *params);

#endif
