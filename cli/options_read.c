// Values of options that have a syntax of their own.
#include "cli/cli.h"

#include "core/nearest.h"
#include "core/number.h"
#include "core/ranges.h"
#include "render/aov/aov.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    TILES_MOST = 100000,
    SWEPT_MOST = 10000,
    FRAME_MOST = 1000000000,
};

bool cli_bad_count(struct cli *cli, int arg, const char *name, const char *text, uint64_t least,
                   uint64_t most) {
    cli_usage(cli, arg, "--%s takes a whole number from %llu to %llu, not '%s'", name,
              (unsigned long long)least, (unsigned long long)most, text);
    return false;
}

bool cli_read_output(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    (void)row;
    cli->options.output = text;
    *(struct cli_output *)ARENA_PUSH(&cli->arena, &cli->options.outputs) =
        (struct cli_output){.path = text, .arg = arg};
    return true;
}

bool cli_read_size(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    if (number_parse_size(str_from(text), "xX", RANGE_SIDE_MOST, &cli->options.width, &cli->options.height))
        return true;
    cli_usage(cli, arg, "--%s takes WIDTHxHEIGHT, each from 1 to %d, such as 640x480, not '%s'", row->name,
              RANGE_SIDE_MOST, text);
    return false;
}

bool cli_read_heatmap(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    cli->options.measure.heatmap = text;
    if (str_ends_with_nocase(str_from(text), ".png"))
        return true;
    cli_usage(cli, arg, "--%s writes a PNG: '%s' must end in .png", row->name, text);
    return false;
}

// ---- layers

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

bool cli_read_aovs(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    (void)row;
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

// ---- limits

bool cli_read_limit(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    (void)row;
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
    cli_did_you_mean(cli, &search, "'--limit help' lists the limits");
    return false;
}

bool cli_read_max_messages(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    const struct limit_info *info = limit_info(LIMIT_MESSAGES);
    if (cli->options.limits.given >> LIMIT_MESSAGES & 1) {
        cli_usage(cli, arg, "the limit %s is given twice: --max-messages is another word for it", info->name);
        diag_help(&cli->sink, "leave one of them out");
        return false;
    }
    return limits_set_value(&cli->options.limits, LIMIT_MESSAGES, str_from(text)) ||
           cli_bad_count(cli, arg, row->name, text, info->least, info->greatest);
}

bool cli_read_untrusted(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    (void)row;
    struct cli_options *o = &cli->options;
    char end;
    o->untrusted_seconds = CLI_UNTRUSTED_SECONDS;
    o->untrusted_megabytes = CLI_UNTRUSTED_MEGABYTES;
    const int read = text ? sscanf(text, "%u,%u%c", &o->untrusted_seconds, &o->untrusted_megabytes, &end) : 2;
    const bool whole = read == 2 || (read == 1 && text[strspn(text, "0123456789")] == '\0');
    if (whole && o->untrusted_seconds > 0 && o->untrusted_seconds <= 1000000 && o->untrusted_megabytes > 0)
        return true;
    cli_usage(cli, arg, "--untrusted takes seconds and, after a comma, megabytes, not '%s'", text);
    diag_help(&cli->sink, "write --untrusted, or --untrusted=60,2048");
    return false;
}

// ---- a part of a picture

// Whole numbers with `mark` between them, and nothing else.
static bool read_numbers(const char *text, char mark, uint32_t most, uint32_t *out, int count) {
    for (int i = 0; i < count; i++) {
        char *end;
        if (*text < '0' || *text > '9')
            return false;
        const unsigned long value = strtoul(text, &end, 10);
        if (value > most || *end != (i + 1 < count ? mark : '\0'))
            return false;
        out[i] = (uint32_t)value;
        text = end + 1;
    }
    return true;
}

bool cli_read_region(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    (void)row;
    struct cli_part *part = &cli->options.part;
    if (read_numbers(text, ',', RANGE_SIDE_MOST, part->region, 4) && part->region[2] && part->region[3])
        return true;
    cli_usage(cli, arg, "--region takes X,Y,W,H in pixels, such as 320,200,64,48, not '%s'", text);
    return false;
}

bool cli_read_tile(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    (void)row;
    struct cli_part *part = &cli->options.part;
    uint32_t numbers[2];
    if (read_numbers(text, '/', TILES_MOST, numbers, 2) && numbers[0] >= 1 && numbers[0] <= numbers[1]) {
        part->tile = numbers[0];
        part->tiles = numbers[1];
        return true;
    }
    cli_usage(cli, arg, "--tile takes I/N, part I of N from 1 to N, such as 3/16, not '%s'", text);
    return false;
}

// ---- many pictures

static bool take_integer(str text, int32_t *out) {
    return number_parse_whole(text, 0, FRAME_MOST, out);
}

// Splits a text before and after `word`; without `word`, `before` is all of it and `after` empty.
static bool split(str text, const char *word, str *before, str *after) {
    const size_t n = strlen(word);
    for (size_t i = 0; i + n <= text.len; i++)
        if (memcmp(text.ptr + i, word, n) == 0) {
            *before = str_slice(text, 0, i);
            *after = str_slice(text, i + n, text.len);
            return true;
        }
    *before = text;
    *after = STR("");
    return false;
}

bool cli_read_frames(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    (void)row;
    struct cli_batch *b = &cli->options.batch;
    str first, rest, last, step;
    b->all_frames = strcmp(text, "all") == 0;
    const bool is_range = split(str_from(text), "..", &first, &rest);
    const bool has_step = split(rest, ":", &last, &step);
    b->frame_step = 1;
    bool good = b->all_frames || take_integer(first, &b->first_frame);
    b->first_frame = b->all_frames ? 0 : b->first_frame;
    b->last_frame = b->first_frame;
    good = good && (!is_range || take_integer(last, &b->last_frame));
    good = good && (!has_step || (take_integer(step, &b->frame_step) && b->frame_step > 0));
    b->has_frames = true;
    if (!good)
        cli_usage(cli, arg,
                  "--frames takes 'all', A..B, A..B:STEP or one frame, whole numbers from 0, not '%s'", text);
    else if (b->last_frame < b->first_frame)
        cli_usage(cli, arg, "--frames ends before it begins: '%s'", text);
    else
        return true;
    return false;
}

// Stored as --set would give it.
bool cli_read_frame(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    (void)row;
    int32_t frame;
    if (!take_integer(str_from(text), &frame)) {
        cli_usage(cli, arg, "--frame takes a whole number from 0, not '%s'", text);
        return false;
    }
    cli->options.frame = frame;
    *(str *)ARENA_PUSH(&cli->arena, &cli->options.sets) =
        arena_format(&cli->arena, "animation.frame=%d", (int)frame);
    return true;
}

static void add_value(struct cli *cli, struct cli_batch_sweep *sweep, str text) {
    sweep->values.items[sweep->values.count++] = arena_copy(&cli->arena, text);
}

// A:B:N, all numbers.
static bool take_steps(struct cli *cli, struct cli_batch_sweep *sweep, str text) {
    char digits[NUMBER_FORMAT_MAX];
    str a, b, n;
    double first, last;
    int32_t count;
    if (!split(text, ":", &a, &b) || !split(b, ":", &b, &n) || number_parse(a, &first) != NUMBER_OK ||
        number_parse(b, &last) != NUMBER_OK || !take_integer(n, &count) || count < 1 || count > SWEPT_MOST)
        return false;
    sweep->values.items = ARENA_ARRAY(&cli->arena, str, (size_t)count);
    for (int32_t i = 0; i < count; i++) {
        const double share = count > 1 ? (double)i / (count - 1) : 0;
        const double value = first * (1 - share) + last * share;
        // 1.3, 1.35, 1.4: not 1.3500000000000001
        const double rounded = strtod(arena_format(&cli->arena, "%.12g", value).ptr, NULL);
        add_value(cli, sweep, (str){digits, number_format(rounded, digits)});
    }
    return true;
}

// V,V,...: commas in brackets belong to a value.
static void take_list(struct cli *cli, struct cli_batch_sweep *sweep, str text) {
    size_t begin = 0;
    int depth = 0;
    sweep->values.items = ARENA_ARRAY(&cli->arena, str, text.len + 1);
    for (size_t i = 0; i <= text.len; i++) {
        const char c = i < text.len ? text.ptr[i] : ',';
        depth += (c == '[' || c == '{') - (c == ']' || c == '}');
        if (c == ',' && (depth == 0 || i == text.len)) {
            add_value(cli, sweep, str_trim(str_slice(text, begin, i)));
            begin = i + 1;
        }
    }
}

bool cli_read_sweep(struct cli *cli, int arg, const struct option_row *row, const char *text) {
    (void)row;
    struct cli_batch_sweep sweep = {.arg = arg};
    str values;
    bool good = split(str_from(text), "=", &sweep.path, &values) && sweep.path.len;
    if (good && !take_steps(cli, &sweep, values))
        take_list(cli, &sweep, values);
    for (uint32_t i = 0; good && i < sweep.values.count; i++)
        good = sweep.values.items[i].len > 0;
    if (!good) {
        cli_usage(cli, arg, "--sweep takes PATH=A:B:N or PATH=VALUE,VALUE,..., not '%s'", text);
        diag_help(&cli->sink, "for example materials.glass.refractive_index=1.3:1.7:9");
        return false;
    }
    *(struct cli_batch_sweep *)ARENA_PUSH(&cli->arena, &cli->options.batch.sweeps) = sweep;
    return true;
}
