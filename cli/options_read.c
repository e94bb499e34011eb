// Values of options: counts, sizes, limits, folders.
#include "cli/cli.h"

#include "core/nearest.h"
#include "core/number.h"
#include "render/aov/aov.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static bool bad_count(struct cli *cli, int arg, const char *name, const char *text, int64_t least,
                      int64_t most) {
    cli_usage(cli, arg, "--%s takes a whole number from %lld to %lld, not '%s'", name, (long long)least,
              (long long)most, text);
    return false;
}

bool cli_read_count(struct cli *cli, int arg, const char *name, const char *text, int64_t least, int64_t most,
                    int32_t *out) {
    int64_t value = 0;
    if (number_parse_integer(str_from(text), &value) != NUMBER_OK || value < least || value > most)
        return bad_count(cli, arg, name, text, least, most);
    *out = (int32_t)value;
    return true;
}

bool cli_read_depth(struct cli *cli, int arg, const char *text) {
    static const char *const words[] = {"8", "16", "32", NULL};
    static const int32_t bits[] = {8, 16, 32};
    const int word = cli_read_word(cli, arg, "depth", text, words);
    if (word >= 0)
        cli->options.depth = bits[word];
    return word >= 0;
}

bool cli_read_compression(struct cli *cli, int arg, const char *text) {
    static const char *const words[] = {
        [IMAGE_ZIP] = "zip", [IMAGE_PIZ] = "piz", [IMAGE_UNCOMPRESSED] = "none", NULL};
    const int word = cli_read_word(cli, arg, "compression", text, words);
    if (word >= 0)
        cli->options.compression = word;
    return word >= 0;
}

bool cli_read_size(struct cli *cli, int arg, const char *text) {
    const char *x = strpbrk(text, "xX");
    int64_t width = 0;
    int64_t height = 0;
    if (!x || number_parse_integer((str){text, (size_t)(x - text)}, &width) != NUMBER_OK ||
        number_parse_integer(str_from(x + 1), &height) != NUMBER_OK || width < 1 || height < 1 ||
        width > 16384 || height > 16384) {
        cli_usage(cli, arg, "--size takes WIDTHxHEIGHT, each from 1 to 16384, such as 640x480, not '%s'",
                  text);
        return false;
    }
    cli->options.width = (int32_t)width;
    cli->options.height = (int32_t)height;
    return true;
}

static bool bad_aov(struct cli *cli, int arg, str name) {
    struct nearest search = nearest_begin(name);
    for (int i = 0; i < AOVS; i++)
        nearest_offer(&search, str_from(aov_info((enum aov)i)->name));
    if (name.len)
        cli_usage(cli, arg, "--aov does not know '%.*s'", STR_ARG(name));
    else
        cli_usage(cli, arg, "--aov needs a name where there is none");
    if (name.len && nearest_best(&search).len)
        diag_help(&cli->sink, "did you mean '%.*s'?", STR_ARG(nearest_best(&search)));
    else
        diag_help(&cli->sink, "write one or more of %s, separated by commas", AOV_NAMES);
    return false;
}

bool cli_read_aovs(struct cli *cli, int arg, const char *text) {
    cli->options.aov_arg = arg;
    for (const char *at = text;; at++) {
        const str name = {at, strcspn(at, ",")};
        const enum aov aov = aov_named(name);
        if (aov == AOVS)
            return bad_aov(cli, arg, name);
        if (cli->options.aovs >> aov & 1) {
            cli_usage(cli, arg, "--aov has '%.*s' twice", STR_ARG(name));
            diag_help(&cli->sink, "leave one of them out");
            return false;
        }
        cli->options.aovs |= 1u << aov;
        at += name.len;
        if (!*at)
            return true;
    }
}

bool cli_read_limit(struct cli *cli, int arg, const char *text) {
    enum limit which = LIMIT_COUNT;
    if (strcmp(text, "help") == 0) {
        cli->options.limit_help = true;
        return true;
    }
    const uint64_t given = cli->options.limits.given;
    enum limit_status status = limits_set(&cli->options.limits, str_from(text), &which);
    if (status == LIMIT_SET && !(given >> which & 1))
        return true;
    if (status == LIMIT_SET) {
        cli_usage(cli, arg, "the limit %s is given twice", limit_info(which)->name);
        diag_help(&cli->sink, "leave one of them out");
        return false;
    }
    if (status == LIMIT_BAD_VALUE) {
        const struct limit_info *info = limit_info(which);
        cli_usage(cli, arg, "--limit %s takes a whole number from %llu to %llu", info->name,
                  (unsigned long long)info->least, (unsigned long long)info->greatest);
        return false;
    }
    size_t length = strcspn(text, "=");
    struct nearest search = nearest_begin((str){text, length});
    for (int i = 0; i < LIMIT_COUNT; i++)
        nearest_offer(&search, str_from(limit_info((enum limit)i)->name));
    cli_usage(cli, arg, "there is no limit '%.*s'", (int)length, text);
    if (nearest_best(&search).len)
        diag_help(&cli->sink, "did you mean '%.*s'?", STR_ARG(nearest_best(&search)));
    else
        diag_help(&cli->sink, "'--limit help' lists the limits");
    return false;
}

bool cli_read_folder(struct cli *cli, int arg, const char *name, const char *text) {
    struct stat info;
    int error = stat(text, &info) != 0 ? errno : S_ISDIR(info.st_mode) ? 0 : ENOTDIR;
    if (error)
        cli_usage(cli, arg, "--%s: '%s' is not a folder that can be read: %s", name, text, strerror(error));
    return error == 0;
}

bool cli_read_max_messages(struct cli *cli, int arg, const char *text) {
    const struct limit_info *info = limit_info(LIMIT_MESSAGES);
    if (cli->options.limits.given >> LIMIT_MESSAGES & 1) {
        cli_usage(cli, arg, "the limit %s is given twice: --max-messages is another word for it", info->name);
        diag_help(&cli->sink, "leave one of them out");
        return false;
    }
    return limits_set_value(&cli->options.limits, LIMIT_MESSAGES, str_from(text)) ||
           bad_count(cli, arg, "max-messages", text, (int64_t)info->least, (int64_t)info->greatest);
}

bool cli_format(struct cli *cli, const char *const *kinds, int *kind) {
    const char *text = cli->options.format;
    *kind = 0;
    if (!text)
        return true;
    struct nearest search = nearest_begin(str_from(text));
    for (int i = 0; kinds[i]; i++) {
        nearest_offer(&search, str_from(kinds[i]));
        *kind = i;
        if (strcmp(text, kinds[i]) == 0)
            return true;
    }
    cli_usage(cli, cli->options.format_arg, "--format does not know '%s'", text);
    struct strbuf list;
    strbuf_init(&list);
    for (int i = 0; kinds[i]; i++)
        strbuf_format(&list, "%s%s", i ? ", " : "", kinds[i]);
    str best = nearest_best(&search);
    if (best.len)
        diag_help(&cli->sink, "did you mean '%.*s'?", STR_ARG(best));
    else
        diag_help(&cli->sink, "it takes one of: %.*s", (int)list.len, list.data ? list.data : "");
    strbuf_finish(&list);
    return false;
}

bool cli_read_untrusted(struct cli *cli, int arg, const char *text) {
    struct cli_options *o = &cli->options;
    enum {
        SECONDS = 600,
        MEGABYTES = 4096,
    };
    char end;
    o->untrusted_seconds = SECONDS;
    o->untrusted_megabytes = MEGABYTES;
    const int read = text ? sscanf(text, "%u,%u%c", &o->untrusted_seconds, &o->untrusted_megabytes, &end) : 2;
    const bool whole = read == 2 || (read == 1 && text[strspn(text, "0123456789")] == '\0');
    if (whole && o->untrusted_seconds > 0 && o->untrusted_seconds <= 1000000 && o->untrusted_megabytes > 0)
        return true;
    cli_usage(cli, arg, "--untrusted takes seconds and, after a comma, megabytes, not '%s'", text);
    diag_help(&cli->sink, "write --untrusted, or --untrusted=60,2048");
    return false;
}
