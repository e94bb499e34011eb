// The corpus of wrong scenes. A case is a folder CODE_KIND or CODE_KIND_WHAT (e202_yaml, e202_xml_component):
// case.yaml or case.xml, what these need, the text that `glint check` must print in expected.txt, and in
// `options` the command line, one option a line.
//
//     run_invalid case FOLDER      compares
//     run_invalid update FOLDER    writes expected.txt, to be read before it is committed
//     run_invalid complete CORPUS  every code has a case for each kind of input where it can occur
#include "diag/diag_text.h"
#include "files/output.h"
#include "load/check.h"

#include <ctype.h>
#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    OPTIONS_MAX = 16,
    TEXT_MAX = 1 << 20
};

struct case_options {
    char text[4096];
    str sets[OPTIONS_MAX];
    str asset_paths[OPTIONS_MAX];
    struct session_options session;
    str camera;
};

// The whole file as a string; false where there is none.
static bool read_text(const char *path, char *out, size_t size) {
    FILE *file = fopen(path, "rb");
    if (!file)
        return false;
    size_t length = fread(out, 1, size - 1, file);
    out[length] = '\0';
    fclose(file);
    return true;
}

static bool take_option(struct case_options *options, const char *name, const char *value) {
    struct session_options *session = &options->session;
    enum limit which;
    if (strcmp(name, "--set") == 0 && session->set_count < OPTIONS_MAX)
        options->sets[session->set_count++] = str_from(value);
    else if (strcmp(name, "--asset-path") == 0 && session->asset_path_count < OPTIONS_MAX)
        options->asset_paths[session->asset_path_count++] = str_from(value);
    else if (strcmp(name, "--camera") == 0)
        options->camera = str_from(value);
    else
        return strcmp(name, "--limit") == 0 &&
               limits_set(&session->limits, str_from(value), &which) == LIMIT_SET;
    return true;
}

static bool read_options(struct case_options *options) {
    options->session = (struct session_options){
        .limits = limits_default(), .sets = options->sets, .asset_paths = options->asset_paths};
    options->camera = STR("");
    if (!read_text("options", options->text, sizeof options->text))
        return true;
    char *next = options->text;
    while (*next) {
        char *line = next;
        char *end = line + strcspn(line, "\n");
        next = *end ? end + 1 : end;
        *end = '\0';
        char *blank = strchr(line, ' ');
        if (!blank)
            return false;
        *blank = '\0';
        if (!take_option(options, line, blank + 1))
            return false;
    }
    return true;
}

static const char *case_file(void) {
    static const char *const names[] = {"case.yaml", "case.xml"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (access(names[i], R_OK) == 0)
            return names[i];
    return NULL;
}

// Machine paths become $CORPUS.
static void add_portable(struct strbuf *out, str text, const char *corpus) {
    size_t length = strlen(corpus);
    for (size_t i = 0; i < text.len;) {
        bool here = text.len - i >= length && memcmp(text.ptr + i, corpus, length) == 0;
        if (here)
            strbuf_cstr(out, "$CORPUS");
        else
            strbuf_char(out, text.ptr[i]);
        i += here ? length : 1;
    }
}

// What the program has to say about the case in the current folder.
static bool check(struct strbuf *out, const char *corpus) {
    struct case_options *options = calloc(1, sizeof *options);
    const char *file = case_file();
    if (!options || !file || !read_options(options)) {
        fprintf(stderr, "no case.yaml or case.xml, or an option that is not known\n");
        free(options);
        return false;
    }
    options->session.path = str_from(file);
    struct asset_store *store = asset_store_create();
    struct session session;
    enum session_state state = check_scene(&session, &options->session, store);
    if (state == SESSION_LOADED && session.sink.errors == 0 && options->camera.len) {
        session_camera(&session, options->camera);
        diag_sort(&session.sink);
    }
    struct strbuf text;
    strbuf_init(&text);
    diag_text(&text, &session.sink, &session.sources, (struct diag_text_options){.notes = true});
    add_portable(out, strbuf_view(&text), corpus);
    strbuf_finish(&text);
    session_finish(&session);
    asset_store_destroy(store);
    free(options);
    return !out->failed;
}

// "e202_yaml_component": "[E202]".
static void code_of(const char *folder, char code[16]) {
    snprintf(code, 16, "[%c%.3s]", toupper((unsigned char)folder[0]), folder + 1);
}

static bool is_of_code(const char *folder) {
    return strchr("ewn", folder[0]) && isdigit((unsigned char)folder[1]) && folder[4] == '_';
}

static int compare(const char *folder, struct strbuf *got) {
    char *expected = calloc(1, TEXT_MAX);
    char code[16];
    int failures = 0;
    if (!expected || !read_text("expected.txt", expected, TEXT_MAX)) {
        fprintf(stderr, "%s: expected.txt is missing\n", folder);
        failures++;
    } else if (!str_equal_cstr(strbuf_view(got), expected)) {
        fprintf(stderr, "%s: expected\n%s\ngot\n%.*s\n", folder, expected, STR_ARG(strbuf_view(got)));
        failures++;
    } else if (is_of_code(folder)) {
        code_of(folder, code);
        if (!strstr(expected, code)) {
            fprintf(stderr, "%s: %s does not occur\n", folder, code);
            failures++;
        }
    }
    free(expected);
    return failures ? 1 : 0;
}

static int run_case(const char *path, bool update) {
    char folder[PATH_MAX];
    if (chdir(path) != 0 || !getcwd(folder, sizeof folder)) {
        fprintf(stderr, "%s: no such folder\n", path);
        return 1;
    }
    char *slash = strrchr(folder, '/');
    *slash = '\0';
    struct strbuf got;
    strbuf_init(&got);
    int status = 1;
    if (check(&got, folder))
        status = update ? output_whole("expected.txt", got.data ? got.data : "", got.len) != 0
                        : compare(slash + 1, &got);
    strbuf_finish(&got);
    return status;
}

// Completeness.

static bool has_case(const char *corpus, const char *code, const char *kind) {
    char prefix[32];
    snprintf(prefix, sizeof prefix, "%c%s_%s", tolower((unsigned char)code[0]), code + 1, kind);
    size_t length = strlen(prefix);
    DIR *directory = opendir(corpus);
    bool found = false;
    for (struct dirent *entry = directory ? readdir(directory) : NULL; entry; entry = readdir(directory)) {
        bool begins = strncmp(entry->d_name, prefix, length) == 0;
        found = found || (begins && (entry->d_name[length] == '\0' || entry->d_name[length] == '_'));
    }
    if (directory)
        closedir(directory);
    return found;
}

static int complete(const char *corpus) {
    static const struct {
        unsigned where;
        const char *kind;
    } kinds[] = {
        {DIAG_IN_YAML, "yaml"}, {DIAG_IN_XML, "xml"}, {DIAG_IN_MESH, "mesh"}, {DIAG_IN_IMAGE, "image"}};
    int missing = 0;
    for (diag_code i = diag_next(-1); i < DIAG_CODE_COUNT; i = diag_next(i)) {
        const struct diag_info *info = diag_info(i);
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
            if (!(info->where & kinds[k].where) || has_case(corpus, info->code, kinds[k].kind))
                continue;
            fprintf(stderr, "%s (%s) has no case for %s\n", info->code, info->title, kinds[k].kind);
            missing++;
        }
    }
    return missing ? 1 : 0;
}

int main(int argc, char **argv) {
    if (argc == 3 && strcmp(argv[1], "case") == 0)
        return run_case(argv[2], false);
    if (argc == 3 && strcmp(argv[1], "update") == 0)
        return run_case(argv[2], true);
    if (argc == 3 && strcmp(argv[1], "complete") == 0)
        return complete(argv[2]);
    fprintf(stderr, "usage: run_invalid case|update FOLDER, run_invalid complete CORPUS\n");
    return 2;
}
