// Schema and checker agree on every YAML file of the invalid corpus: the JSON Schema refuses the cases with
// errors, but for those that tests/invalid/checker_only.txt names, and accepts the others. What is no YAML to
// begin with (E1xx) is left to tests/editors/ajv.sh, whose reader is a strict one.
#include "core/strbuf.h"
#include "grammar/emit/emit.h"
#include "tests/equal/json_schema.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static char *read_all(const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    struct strbuf text;
    strbuf_init(&text);
    char bytes[4096];
    for (size_t count; (count = fread(bytes, 1, sizeof bytes, file)) > 0;)
        strbuf_add(&text, bytes, count);
    fclose(file);
    strbuf_char(&text, '\0');
    return text.data;
}

// Whether the list has a line that is this word.
static bool lists(const char *list, const char *word) {
    size_t length = strlen(word);
    for (const char *at = strstr(list, word); at; at = strstr(at + 1, word))
        if ((at == list || at[-1] == '\n') && (at[length] == '\n' || at[length] == '\0'))
            return true;
    return false;
}

static bool is_error(const char *expected) {
    return strstr(expected, ": error: ") != NULL;
}

static bool is_syntax(const char *expected) {
    return strstr(expected, " [E1") != NULL;
}

static bool is_of_command(const char *name) {
    const char *end = strrchr(name, '_');
    return end && strcmp(end, "_command") == 0;
}

// 1: verdict as wanted; 0: not; -1: no YAML case.
static int judge(const json_t *schema, const char *list, const char *name) {
    char path[512];
    snprintf(path, sizeof path, "tests/invalid/%s/case.yaml", name);
    char *text = read_all(path);
    snprintf(path, sizeof path, "tests/invalid/%s/expected.txt", name);
    char *expected = read_all(path);
    int verdict = -1;
    if (text && expected && !is_of_command(name) && !is_syntax(expected)) {
        json_t *value = json_from_yaml(str_from(text));
        bool accepted = value && json_schema_accepts(schema, schema, value);
        bool wanted = !is_error(expected) || lists(list, name);
        json_decref(value);
        verdict = accepted == wanted;
        if (!verdict)
            print_message("%s: the schema %s it\n", name, accepted ? "accepts" : "refuses");
    }
    free(text);
    free(expected);
    return verdict;
}

static void test_schema_and_checker_agree(void **state) {
    (void)state;
    struct strbuf text;
    strbuf_init(&text);
    emit_json_schema(&text);
    json_t *schema = json_loadb(text.data, text.len, 0, NULL);
    strbuf_finish(&text);
    char *list = read_all("tests/invalid/checker_only.txt");
    DIR *folder = opendir("tests/invalid");
    assert_true(schema && list && folder);
    int count = 0;
    int wrong = 0;
    for (struct dirent *entry; (entry = readdir(folder));) {
        int verdict = judge(schema, list, entry->d_name);
        count += verdict >= 0;
        wrong += verdict == 0;
    }
    closedir(folder);
    free(list);
    json_decref(schema);
    assert_int_equal(wrong, 0);
    assert_true(count > 80);
}

// A line of the list without a case would hide that a case was lost.
static void test_list_names_cases(void **state) {
    (void)state;
    char *list = read_all("tests/invalid/checker_only.txt");
    assert_non_null(list);
    for (char *line = list, *next; line && *line; line = next) {
        char path[512];
        next = strchr(line, '\n');
        if (next)
            *next++ = '\0';
        if (*line == '#')
            continue;
        snprintf(path, sizeof path, "tests/invalid/%s/expected.txt", line);
        char *expected = read_all(path);
        if (!expected || !is_error(expected))
            fail_msg("%s is no case with an error", line);
        free(expected);
    }
    free(list);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_schema_and_checker_agree),
        cmocka_unit_test(test_list_names_cases),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
