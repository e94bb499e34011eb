// A client of the language server for tests: starts `glint lsp`, speaks JSON-RPC with it, keeps what it says.
#ifndef GLINT_TESTS_LSP_KIT_H
#define GLINT_TESTS_LSP_KIT_H

#include <jansson.h>
#include <sys/types.h>

struct lsp_client {
    pid_t pid;
    int to, from;
    int last_id;
    char *bytes; // received and not yet taken
    size_t length, capacity;
    json_t *diagnostics; // URI: the newest list
    json_t *versions;    // URI: version of that list
    char folder[256];    // temporary
};

// Starts the server and a folder for files. `program` is glint.
void client_start(struct lsp_client *client, const char *program);
// shutdown and exit; the process' exit status. Removes the folder.
int client_stop(struct lsp_client *client);
// For a server that has ended: what client_stop does behind that.
void client_free(struct lsp_client *client);
// The string of a key; empty where there is none. It belongs to the object.
const char *client_text(const json_t *object, const char *key);
void client_initialize(struct lsp_client *client, json_t *capabilities);
// Sends a request and waits for its answer; gives `result` (new reference), or the error object where
// `error` is not NULL and the server refused.
json_t *client_request(struct lsp_client *client, const char *method, json_t *params, json_t **error);
// The same in two halves: the request's id, and the whole answer to it (new reference); answers to others
// that come before it are lost.
int client_ask(struct lsp_client *client, const char *method, json_t *params);
json_t *client_answer(struct lsp_client *client, int id);
void client_notify(struct lsp_client *client, const char *method, json_t *params);
void client_send_bytes(struct lsp_client *client, const char *bytes, size_t length);
// The next message, whatever it is (new reference); NULL where the server has ended.
json_t *client_receive(struct lsp_client *client);
// Reads until diagnostics of this version of the document have come; gives them (borrowed).
json_t *client_diagnostics(struct lsp_client *client, const char *name, int version);

// Files in the folder: written to the disk, and opened in the editor.
void client_file(struct lsp_client *client, const char *name, const char *text);
void client_open(struct lsp_client *client, const char *name, const char *text);
// The URI of a file in the folder; valid until the next call.
const char *client_uri(struct lsp_client *client, const char *name);
// {textDocument, position} with the line and character from 0.
json_t *client_at(struct lsp_client *client, const char *name, int line, int character);

#endif
