#define _XOPEN_SOURCE 700
#include "lsp_kit.h"

#include <fcntl.h>
#include <ftw.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static void give_up(const char *why) {
    fprintf(stderr, "lsp_kit: %s\n", why);
    abort();
}

const char *client_text(const json_t *object, const char *key) {
    const char *text = json_string_value(json_object_get(object, key));
    return text ? text : "";
}

void client_start(struct lsp_client *client, const char *program) {
    int to[2];
    int from[2];
    *client = (struct lsp_client){.diagnostics = json_object(), .versions = json_object()};
    char here[200];
    if (!getcwd(here, sizeof here))
        give_up("no folder");
    snprintf(client->folder, sizeof client->folder, "%s/glint-lsp-XXXXXX", here);
    if (!mkdtemp(client->folder) || pipe(to) != 0 || pipe(from) != 0)
        give_up("no folder or pipe");
    client->pid = fork();
    if (client->pid == 0) {
        dup2(to[0], STDIN_FILENO);
        dup2(from[1], STDOUT_FILENO);
        close(to[1]);
        close(from[0]);
        execl(program, program, "lsp", (char *)NULL);
        _exit(127);
    }
    close(to[0]);
    close(from[1]);
    client->to = to[1];
    client->from = from[0];
    signal(SIGPIPE, SIG_IGN);
}

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *place) {
    (void)info;
    (void)kind;
    (void)place;
    return remove(path);
}

int client_stop(struct lsp_client *client) {
    int status = 0;
    json_decref(client_request(client, "shutdown", NULL, NULL));
    client_notify(client, "exit", NULL);
    close(client->to);
    waitpid(client->pid, &status, 0);
    client_free(client);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void client_free(struct lsp_client *client) {
    close(client->from);
    free(client->bytes);
    json_decref(client->diagnostics);
    json_decref(client->versions);
    nftw(client->folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

void client_send_bytes(struct lsp_client *client, const char *bytes, size_t length) {
    while (length) {
        ssize_t done = write(client->to, bytes, length);
        if (done <= 0)
            return;
        bytes += done;
        length -= (size_t)done;
    }
}

static void send_message(struct lsp_client *client, json_t *message) {
    char header[64];
    json_object_set_new(message, "jsonrpc", json_string("2.0"));
    char *text = json_dumps(message, JSON_COMPACT);
    snprintf(header, sizeof header, "Content-Length: %zu\r\n\r\n", strlen(text));
    client_send_bytes(client, header, strlen(header));
    client_send_bytes(client, text, strlen(text));
    free(text);
    json_decref(message);
}

// The end of the header among what was received, or 0.
static size_t header_end(const struct lsp_client *client) {
    for (size_t i = 0; i + 4 <= client->length; i++)
        if (memcmp(client->bytes + i, "\r\n\r\n", 4) == 0)
            return i + 4;
    return 0;
}

static int receive_more(struct lsp_client *client) {
    if (client->length + 65536 > client->capacity) {
        client->capacity = 2 * client->capacity + 131072;
        client->bytes = realloc(client->bytes, client->capacity);
    }
    ssize_t count = client->bytes ? read(client->from, client->bytes + client->length, 65536) : 0;
    client->length += count > 0 ? (size_t)count : 0;
    return count > 0;
}

json_t *client_receive(struct lsp_client *client) {
    size_t header;
    while ((header = header_end(client)) == 0)
        if (!receive_more(client))
            return NULL;
    size_t length = strtoul(client->bytes + strlen("Content-Length: "), NULL, 10);
    while (client->length < header + length)
        if (!receive_more(client))
            return NULL;
    json_t *message = json_loadb(client->bytes + header, length, 0, NULL);
    memmove(client->bytes, client->bytes + header + length, client->length - header - length);
    client->length -= header + length;
    if (!message)
        give_up("the server's message is no JSON");
    const char *method = json_string_value(json_object_get(message, "method"));
    json_t *params = json_object_get(message, "params");
    if (method && strcmp(method, "textDocument/publishDiagnostics") == 0) {
        const char *uri = json_string_value(json_object_get(params, "uri"));
        json_object_set(client->diagnostics, uri, json_object_get(params, "diagnostics"));
        if (json_object_get(params, "version"))
            json_object_set(client->versions, uri, json_object_get(params, "version"));
    }
    return message;
}

int client_ask(struct lsp_client *client, const char *method, json_t *params) {
    json_t *message = json_object();
    int id = ++client->last_id;
    json_object_set_new(message, "id", json_integer(id));
    json_object_set_new(message, "method", json_string(method));
    if (params)
        json_object_set_new(message, "params", params);
    send_message(client, message);
    return id;
}

json_t *client_answer(struct lsp_client *client, int id) {
    for (;;) {
        json_t *answer = client_receive(client);
        if (!answer)
            give_up("the server has ended");
        if (json_integer_value(json_object_get(answer, "id")) == id)
            return answer;
        json_decref(answer);
    }
}

json_t *client_request(struct lsp_client *client, const char *method, json_t *params, json_t **error) {
    json_t *answer = client_answer(client, client_ask(client, method, params));
    json_t *result = json_incref(json_object_get(answer, "result"));
    if (error)
        *error = json_incref(json_object_get(answer, "error"));
    json_decref(answer);
    return result;
}

void client_notify(struct lsp_client *client, const char *method, json_t *params) {
    json_t *message = json_object();
    json_object_set_new(message, "method", json_string(method));
    if (params)
        json_object_set_new(message, "params", params);
    send_message(client, message);
}

void client_initialize(struct lsp_client *client, json_t *capabilities) {
    json_decref(client_request(client, "initialize",
                               json_pack("{s:n, s:n, s:o}", "processId", "rootUri", "capabilities",
                                         capabilities ? capabilities : json_object()),
                               NULL));
    client_notify(client, "initialized", json_object());
}

json_t *client_diagnostics(struct lsp_client *client, const char *name, int version) {
    char uri[900];
    snprintf(uri, sizeof uri, "%s", client_uri(client, name));
    while (json_integer_value(json_object_get(client->versions, uri)) != version) {
        json_t *message = client_receive(client);
        if (!message)
            give_up("the server has ended");
        json_decref(message);
    }
    return json_object_get(client->diagnostics, uri);
}

const char *client_uri(struct lsp_client *client, const char *name) {
    static char uri[900];
    char path[900];
    int length = snprintf(uri, sizeof uri, "file://");
    snprintf(path, sizeof path, "%s/%s", client->folder, name);
    for (const char *at = path; *at && length < (int)sizeof uri - 4; at++) {
        const bool plain = (*at & 0x80) == 0 && !strchr(" %#?", *at);
        length += snprintf(uri + length, 4, plain ? "%c" : "%%%02X", (unsigned char)*at);
    }
    return uri;
}

void client_file(struct lsp_client *client, const char *name, const char *text) {
    char path[600];
    snprintf(path, sizeof path, "%s/%s", client->folder, name);
    FILE *file = fopen(path, "wb");
    if (!file || fputs(text, file) < 0 || fclose(file) != 0)
        give_up("a file cannot be written");
}

void client_open(struct lsp_client *client, const char *name, const char *text) {
    client_notify(client, "textDocument/didOpen",
                  json_pack("{s:{s:s, s:s, s:i, s:s}}", "textDocument", "uri", client_uri(client, name),
                            "languageId", "yaml", "version", 1, "text", text));
}

json_t *client_at(struct lsp_client *client, const char *name, int line, int character) {
    return json_pack("{s:{s:s}, s:{s:i, s:i}}", "textDocument", "uri", client_uri(client, name), "position",
                     "line", line, "character", character);
}
