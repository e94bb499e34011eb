#include "lsp/rpc.h"

#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

enum {
    READ_BYTES = 1 << 16,
    HEADER_MOST = 4096,
};
#define BODY_MOST ((size_t)1 << 30)

void rpc_init(struct rpc *rpc, int in, int out) {
    *rpc = (struct rpc){.in = in, .out = out, .woken = -1};
    strbuf_init(&rpc->received);
}

void rpc_init_sender(struct rpc *rpc, rpc_sender *sender, void *context) {
    *rpc = (struct rpc){.in = -1, .out = -1, .woken = -1, .sender = sender, .context = context};
    strbuf_init(&rpc->received);
}

void rpc_finish(struct rpc *rpc) {
    strbuf_finish(&rpc->received);
}

static str unread(const struct rpc *rpc) {
    str all = strbuf_view(&rpc->received);
    return str_slice(all, rpc->taken, all.len);
}

// Removes bytes that were taken, to make room for new ones.
static void compact(struct rpc *rpc) {
    if (rpc->taken == 0)
        return;
    size_t left = rpc->received.len - rpc->taken;
    memmove(rpc->received.data, rpc->received.data + rpc->taken, left);
    rpc->received.len = left;
    rpc->taken = 0;
}

// When the client ends, it closes the stream that we write to.
static void fail(struct rpc *rpc, bool input) {
    rpc->broken = true;
    if (errno == EPIPE || rpc->error)
        return;
    rpc->error = errno ? errno : EIO;
    rpc->input_failed = input;
}

static bool receive(struct rpc *rpc) {
    char bytes[READ_BYTES];
    ssize_t count;
    do
        count = read(rpc->in, bytes, sizeof bytes);
    while (count < 0 && errno == EINTR);
    if (count < 0)
        fail(rpc, true);
    if (count <= 0)
        return false;
    compact(rpc);
    strbuf_add(&rpc->received, bytes, (size_t)count);
    return !rpc->received.failed;
}

// Bytes of the header with its empty line, or 0 if that has not come yet.
static size_t header_length(str text) {
    for (size_t i = 0; i + 4 <= text.len; i++)
        if (memcmp(text.ptr + i, "\r\n\r\n", 4) == 0)
            return i + 4;
    return 0;
}

static bool content_length(str header, size_t *length) {
    static const char name[] = "Content-Length:";
    for (size_t i = 0; i + sizeof name - 1 < header.len; i++) {
        bool line_begins = i == 0 || header.ptr[i - 1] == '\n';
        if (!line_begins || strncasecmp(header.ptr + i, name, sizeof name - 1) != 0)
            continue;
        size_t at = i + sizeof name - 1;
        while (at < header.len && header.ptr[at] == ' ')
            at++;
        size_t value = 0;
        size_t digits = 0;
        for (; at < header.len && header.ptr[at] >= '0' && header.ptr[at] <= '9' && digits < 12;
             at++, digits++)
            value = 10 * value + (size_t)(header.ptr[at] - '0');
        *length = value;
        return digits > 0 && value <= BODY_MOST;
    }
    return false;
}

json_t *rpc_parse(struct rpc *rpc, const char *text, size_t length) {
    json_t *message = json_loadb(text, length, JSON_REJECT_DUPLICATES | JSON_ALLOW_NUL, NULL);
    if (!message)
        rpc_refuse(rpc, NULL, RPC_PARSE_ERROR, "the message is not JSON");
    return message;
}

enum rpc_state rpc_read(struct rpc *rpc, json_t **message) {
    for (;;) {
        size_t header;
        size_t body;
        while ((header = header_length(unread(rpc))) == 0)
            if (unread(rpc).len > HEADER_MOST || !receive(rpc))
                return RPC_END;
        if (!content_length(str_slice(unread(rpc), 0, header), &body))
            return RPC_END;
        while (unread(rpc).len < header + body)
            if (!receive(rpc))
                return RPC_END;
        str text = str_slice(unread(rpc), header, header + body);
        *message = rpc_parse(rpc, text.ptr, text.len);
        rpc->taken += header + body;
        if (*message)
            return RPC_MESSAGE;
    }
}

enum rpc_pending rpc_wait(const struct rpc *rpc, int wait_ms) {
    struct pollfd fds[2] = {{.fd = rpc->in, .events = POLLIN}, {.fd = rpc->woken, .events = POLLIN}};
    if (unread(rpc).len > 0)
        return RPC_BYTES;
    const int count = poll(fds, 2, wait_ms);
    return count <= 0 ? RPC_NOTHING : fds[0].revents ? RPC_BYTES : fds[1].revents ? RPC_WOKEN : RPC_NOTHING;
}

static void write_all(struct rpc *rpc, const char *bytes, size_t count) {
    while (count && !rpc->broken) {
        ssize_t done = write(rpc->out, bytes, count);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            fail(rpc, false);
        bytes += done > 0 ? done : 0;
        count -= done > 0 ? (size_t)done : 0;
    }
}

static void send(struct rpc *rpc, json_t *message) {
    json_object_set_new(message, "jsonrpc", json_string("2.0"));
    char *text = json_dumps(message, JSON_COMPACT);
    json_decref(message);
    if (!text)
        return;
    if (rpc->sender) {
        rpc->sender(rpc->context, text, strlen(text));
    } else {
        char header[64];
        int length = snprintf(header, sizeof header, "Content-Length: %zu\r\n\r\n", strlen(text));
        write_all(rpc, header, (size_t)length);
        write_all(rpc, text, strlen(text));
    }
    free(text);
}

void rpc_reply(struct rpc *rpc, json_t *id, json_t *result) {
    json_t *message = json_object();
    json_object_set(message, "id", id);
    json_object_set_new(message, "result", result ? result : json_null());
    send(rpc, message);
}

void rpc_refuse(struct rpc *rpc, json_t *id, enum rpc_error_code code, const char *text) {
    json_t *message = json_object();
    json_t *error = json_object();
    json_object_set_new(error, "code", json_integer(code));
    json_object_set_new(error, "message", json_string(text));
    if (id)
        json_object_set(message, "id", id);
    else
        json_object_set_new(message, "id", json_null());
    json_object_set_new(message, "error", error);
    send(rpc, message);
}

void rpc_notify(struct rpc *rpc, const char *method, json_t *params) {
    json_t *message = json_object();
    json_object_set_new(message, "method", json_string(method));
    json_object_set_new(message, "params", params);
    send(rpc, message);
}

void rpc_ask(struct rpc *rpc, const char *id, const char *method, json_t *params) {
    json_t *message = json_object();
    json_object_set_new(message, "id", json_string(id));
    json_object_set_new(message, "method", json_string(method));
    json_object_set_new(message, "params", params);
    send(rpc, message);
}
