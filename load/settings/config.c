#include "load/settings/config.h"
#include "diag/codes/command.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"

#include "core/unicode.h"
#include "load/settings/keys.h"
#include "load/settings/settings_file.h"

#include <string.h>

enum {
    CONFIG_BYTES_MAX = 1024 * 1024,
    PATTERN_BYTES_MAX = 1024,
    WORD_SHOWN_MAX = 60,
};

struct binder {
    const struct config_input *input;
    const struct tree *tree;
    struct config *config;
    str folder; // of the configuration
};

// ---- reporting what is wrong

// Text from the file, short and without what a terminal might obey.
static str shown(const struct binder *b, tree_index node) {
    str text = tree_text(b->tree, node);
    str clipped = str_slice(text, 0, WORD_SHOWN_MAX);
    while (clipped.len && utf8_first_error(clipped) != clipped.len)
        clipped.len--;
    return clipped;
}

// "<before>'<the node's text>'<after>"
static void bad_value(const struct binder *b, tree_index node, const char *before, const char *after) {
    str word = shown(b, node);
    diag_add(b->input->sink, DIAG_CONFIG_VALUE, tree_span(b->tree, node), "%s'%.*s'%s", before, STR_ARG(word),
             after);
}

static void did_you_mean(const struct binder *b, tree_index node, const struct nearest *search) {
    str best = nearest_best(search);
    if (!best.len)
        return;
    diag_help(b->input->sink, "did you mean '%.*s'?", STR_ARG(best));
    diag_fix(b->input->sink, false, tree_span(b->tree, node), best);
}

// Reports a key that the table does not have, with the one that may be meant, else with all there are.
static void unknown_key(const struct binder *b, const struct key_table *table, diag_code code,
                        tree_index node, const struct nearest *search, str otherwise) {
    if (key_report_unknown(table, b->input->sink, code, tree_span(b->tree, node), shown(b, node), search))
        diag_fix(b->input->sink, false, tree_span(b->tree, node), nearest_best(search));
    else
        diag_help(b->input->sink, "%.*s", STR_ARG(otherwise));
}

static void offer_words(struct nearest *search, const char *const *words) {
    for (; *words; words++)
        nearest_offer(search, str_from(*words));
}

// false: the code is unknown, or no policy changes it; that was reported.
static bool accept_codes(const struct binder *b, tree_index node, enum diag_policy_status status) {
    if (status == DIAG_POLICY_UNKNOWN_CODE) {
        bad_value(b, node, "there is no code ", "");
        diag_help(b->input->sink, "a code is a letter and three digits, such as W401, or a family, such as "
                                  "W4xx; it is at the end of each message");
    } else if (status == DIAG_POLICY_ERROR_CODE) {
        bad_value(b, node, "errors cannot be silenced or lowered, and ", " is one");
        diag_help(b->input->sink, "only warnings (W) and notes (N) can be changed");
    }
    return status == DIAG_POLICY_SET;
}

// ---- what takes a value

static void take_asset_path(struct binder *b, tree_index key, tree_index value) {
    (void)key;
    str path = tree_text(b->tree, value);
    struct arena *arena = b->input->arena;
    str canonical = files_canonical(b->input->files, path_join(arena, b->folder, path));
    str rest;
    struct files probe;
    files_init(&probe, arena);
    if (!path_is_below(canonical, b->folder, &rest)) {
        bad_value(b, value, "the folder ", " is outside the configuration's folder");
        diag_help(b->input->sink, "move .glintrc.yaml to a folder above both, or name it with --asset-path");
    } else if (files_add_root(&probe, canonical) != FILE_OK) {
        bad_value(b, value, "there is no folder ", "");
        diag_help(b->input->sink, "folders are relative to the folder of .glintrc.yaml");
    } else {
        *ARENA_PUSH(arena, &b->config->asset_paths) = canonical;
    }
}

static void take_severity(struct binder *b, tree_index key, tree_index value) {
    str word = tree_text(b->tree, value);
    enum diag_policy_status status = diag_policy_level(&b->config->policy, tree_text(b->tree, key), word);
    if (status != DIAG_POLICY_BAD_WORD) {
        accept_codes(b, key, status);
        return;
    }
    struct nearest search = nearest_begin(word);
    offer_words(&search, diag_level_words);
    bad_value(b, value, "", " is not a severity");
    if (nearest_best(&search).len)
        did_you_mean(b, value, &search);
    else
        diag_help(b->input->sink, "write error, warning, note or off");
}

static void take_ignore(struct binder *b, tree_index key, tree_index value) {
    (void)key;
    str text = tree_text(b->tree, value);
    if (diag_is_code_text(text)) {
        accept_codes(b, value, diag_policy_level(&b->config->policy, text, STR("off")));
    } else if (text.len == 0 || text.len > PATTERN_BYTES_MAX) {
        bad_value(b, value, "", " is neither a code nor a path");
        diag_help(b->input->sink, "write a code, such as W401, or a pattern of paths, such as \"drafts/**\"");
    } else {
        diag_policy_ignore_path(&b->config->policy, b->input->arena, b->folder, text);
    }
}

static void take_only(struct binder *b, tree_index key, tree_index value) {
    (void)key;
    accept_codes(b, value, diag_policy_only(&b->config->policy, tree_text(b->tree, value)));
}

static void take_fail_on(struct binder *b, tree_index key, tree_index value) {
    (void)key;
    str word = tree_text(b->tree, value);
    if (diag_policy_fail_on(&b->config->policy, word) == DIAG_POLICY_SET)
        return;
    struct nearest search = nearest_begin(word);
    offer_words(&search, diag_fail_words);
    bad_value(b, value, "'fail_on' must be error or warning, not ", "");
    if (nearest_best(&search).len)
        did_you_mean(b, value, &search);
    else
        diag_help(b->input->sink, "fail_on: warning makes warnings fail too");
}

// Whether the file would raise a limit that it may not raise. A limit set by the runner overrides it anyway.
static bool is_raised(const struct binder *b, enum limit which, uint64_t value) {
    const struct limits *runner = b->input->runner;
    return runner && !(runner->given >> which & 1) && value > limit_info(which)->standard;
}

static void refuse_to_raise(const struct binder *b, tree_index value, const struct limit_info *info) {
    str wanted = shown(b, value);
    diag_add(b->input->sink, DIAG_CONFIG_VALUE, tree_span(b->tree, value),
             "a file beside the scenes can only lower limits, and '%s' is %llu: it was not raised",
             info->name, (unsigned long long)info->standard);
    diag_help(b->input->sink,
              "who runs glint can raise it: --limit %s=%.*s, or a settings file with --config", info->name,
              STR_ARG(wanted));
}

static void set_limit(struct binder *b, tree_index key, tree_index value, enum limit which) {
    const struct limit_info *info = limit_info(which);
    struct limits limits = b->config->limits;
    if (!limits_set_value(&limits, which, tree_text(b->tree, value)))
        diag_add(b->input->sink, DIAG_CONFIG_VALUE, tree_span(b->tree, value),
                 "'%.*s' takes a whole number from %llu to %llu", STR_ARG(shown(b, key)),
                 (unsigned long long)info->least,
                 (unsigned long long)(b->input->runner ? info->standard : info->greatest));
    else if (is_raised(b, which, limits.value[which]))
        refuse_to_raise(b, value, info);
    else
        b->config->limits = limits;
}

static void take_limit(struct binder *b, tree_index key, tree_index value) {
    struct nearest search;
    const struct key_row *row = key_find(&LIMIT_KEYS, tree_text(b->tree, key), &search);
    if (row)
        set_limit(b, key, value, (enum limit)(row - LIMIT_KEYS.rows));
    else
        unknown_key(b, &LIMIT_KEYS, DIAG_CONFIG_VALUE, key, &search,
                    STR("'glint check --limit help' lists the limits"));
}

static void take_max_messages(struct binder *b, tree_index key, tree_index value) {
    set_limit(b, key, value, LIMIT_MESSAGES);
}

// `key`: of a pair of a map, else 0.
static void (*const takers[])(struct binder *b, tree_index key, tree_index value) = {
    [KEY_FOLDER] = take_asset_path,         [KEY_CODE] = take_only,         [KEY_CODE_OR_PATH] = take_ignore,
    [KEY_CODE_SEVERITY] = take_severity,    [KEY_FAIL_WORD] = take_fail_on, [KEY_LIMIT] = take_limit,
    [KEY_MAX_MESSAGES] = take_max_messages,
};

// ---- walking the file

static bool is_reported(const struct binder *b, tree_index node) {
    return (tree_node(b->tree, node)->flags & (TREE_BAD | TREE_CUT)) != 0;
}

static void wrong_shape(struct binder *b, const struct key_row *setting, tree_index node) {
    if (is_reported(b, node))
        return;
    diag_add(b->input->sink, DIAG_CONFIG_VALUE, tree_span(b->tree, node), "'%s' takes %s", setting->name,
             setting->form);
    diag_help(b->input->sink, "write %s", setting->example);
}

static void take_one(struct binder *b, const struct key_row *setting, tree_index key, tree_index value) {
    if (is_reported(b, value))
        return;
    if (tree_node(b->tree, value)->kind == TREE_SCALAR)
        takers[setting->value](b, key, value);
    else
        wrong_shape(b, setting, value);
}

static void take_setting(struct binder *b, const struct key_row *setting, tree_index key, tree_index value) {
    enum tree_kind kind = tree_node(b->tree, value)->kind;
    if (kind == TREE_NULL && setting->shape != KEY_ONE)
        return; // an empty list or map
    if (setting->shape == KEY_ONE) {
        take_one(b, setting, key, value);
    } else if (setting->shape == KEY_LIST && kind == TREE_LIST) {
        for (tree_index i = tree_first(b->tree, value); i; i = tree_next(b->tree, i))
            take_one(b, setting, 0, i);
    } else if (setting->shape == KEY_MAP && kind == TREE_MAP) {
        for (tree_index k = tree_first(b->tree, value); k; k = tree_next_key(b->tree, k))
            take_one(b, setting, k, tree_value(b->tree, k));
    } else {
        wrong_shape(b, setting, value);
    }
}

static void unknown_setting(struct binder *b, tree_index key, const struct nearest *search) {
    str all = key_list(&SETTING_KEYS, b->input->arena);
    unknown_key(b, &SETTING_KEYS, DIAG_CONFIG_KEY, key, search,
                arena_format(b->input->arena, "the settings are %.*s", STR_ARG(all)));
}

static void take_key(void *binder, const struct tree *tree, tree_index key) {
    struct binder *b = binder;
    struct nearest search;
    b->tree = tree;
    if (is_reported(b, key))
        return;
    const struct key_row *setting = key_find(&SETTING_KEYS, tree_text(tree, key), &search);
    if (setting)
        take_setting(b, setting, key, tree_value(tree, key));
    else
        unknown_setting(b, key, &search);
}

// The path of the configuration, as a user who wrote this `scene_path` would write it.
static str path_shown(const struct config_input *input, str scene_path, str config_path) {
    str wanted = path_folder(config_path);
    str base = path_base(config_path);
    for (str at = path_folder(scene_path);; at = path_folder(at)) {
        bool ends = str_equal_cstr(at, ".") || str_equal_cstr(at, "/");
        if (str_equal(files_canonical(input->files, at), wanted))
            return path_join(input->arena, at, base);
        if (ends || str_equal_cstr(path_base(at), ".."))
            return config_path;
    }
}

void config_read(const struct config_input *input, uint32_t source, str path, struct config *config) {
    static const struct settings_words words = {
        "a configuration is a map of settings",
        "write a setting, such as fail_on: warning; an empty file marks its folder as the root"};
    const struct limits limits = limits_default();
    *config = (struct config){.path = path, .limits = limits};
    struct binder binder = {
        .input = input, .config = config, .folder = files_canonical(input->files, path_folder(path))};
    const struct reader_context reader = {
        .sources = input->sources, .sink = input->sink, .limits = &limits, .arena = input->arena};
    const enum arena_fault fault = settings_read(&reader, source, &words, take_key, &binder);
    if (fault != ARENA_FAULT_NONE)
        arena_raise(input->arena, fault);
}

// Takes what was read, or reports why it was not read.
static void take_file(const struct config_input *input, enum file_status status, str text, str path,
                      str shown, struct config *config) {
    *config = (struct config){.path = path, .limits = limits_default()};
    uint32_t source = source_add(input->sources, SOURCE_KIND_FILE, shown, text);
    if (status == FILE_OK) {
        config_read(input, source, path, config);
    } else if (status == FILE_OUTSIDE) {
        diag_add(input->sink, DIAG_FILE_OUTSIDE, (span){source, 0, 0},
                 "the configuration is a link that leads out of its folder");
        diag_help(input->sink, "put the settings into the file itself");
    } else {
        diag_add(input->sink, status == FILE_TOO_LARGE ? DIAG_LIMIT : DIAG_FILE_UNREADABLE,
                 (span){source, 0, 0}, "the configuration %s", file_status_text(input->files, status));
    }
}

void config_read_file(const struct config_input *input, str path, str shown, struct config *config) {
    str text = STR("");
    enum file_status status = files_read_given(input->files, path, CONFIG_BYTES_MAX, input->arena, &text);
    take_file(input, status, text, path, shown, config);
}

// Nobody named this file, so a link must not make glint read and report a file elsewhere.
void config_load(const struct config_input *input, str scene_path, struct config *config) {
    str text = STR("");
    *config = (struct config){.path = files_find_config(input->files, scene_path)};
    if (!config->path.len)
        return;
    const str path = config->path, shown = path_shown(input, scene_path, path);
    const enum file_status status =
        files_read_found(input->files, path, path_folder(path), CONFIG_BYTES_MAX, input->arena, &text);
    take_file(input, status, text, path, shown, config);
}
