// --frames, --frame, --fps, --sweep, --list, --montage and --keep-going.
#include "cli/cli.h"
#include "core/number.h"

#include <stdlib.h>
#include <string.h>

enum {
    VALUES_MAX = 10000,
    FRAME_MAX = 1000000000,
};

static bool take_integer(str text, int32_t *out) {
    int64_t value;
    if (number_parse_integer(text, &value) != NUMBER_OK || value < 0 || value > FRAME_MAX)
        return false;
    *out = (int32_t)value;
    return true;
}

// What is before `word`, and what is after it; all of it and nothing where it is not there.
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

static bool read_frames(struct cli *cli, int arg, const char *value) {
    struct cli_batch *b = &cli->options.batch;
    str first, rest, last, step;
    b->all_frames = strcmp(value, "all") == 0;
    const bool is_range = split(str_from(value), "..", &first, &rest);
    const bool has_step = split(rest, ":", &last, &step);
    b->frame_step = 1;
    bool good = b->all_frames || take_integer(first, &b->first_frame);
    b->first_frame = b->all_frames ? 0 : b->first_frame;
    b->last_frame = b->first_frame;
    good = good && (!is_range || take_integer(last, &b->last_frame));
    good = good && (!has_step || (take_integer(step, &b->frame_step) && b->frame_step > 0));
    b->has_frames = true;
    b->frames_arg = arg;
    if (!good)
        cli_usage(cli, arg,
                  "--frames takes 'all', A..B, A..B:STEP or one frame, whole numbers from 0, not '%s'",
                  value);
    else if (b->last_frame < b->first_frame)
        cli_usage(cli, arg, "--frames ends before it begins: '%s'", value);
    else
        return true;
    return false;
}

// As --set would give it.
static bool read_frame(struct cli *cli, int arg, const char *value) {
    int32_t frame;
    if (!take_integer(str_from(value), &frame)) {
        cli_usage(cli, arg, "--frame takes a whole number from 0, not '%s'", value);
        return false;
    }
    *(str *)ARENA_PUSH(&cli->arena, &cli->options.sets) =
        arena_format(&cli->arena, "animation.frame=%d", (int)frame);
    return true;
}

static bool read_fps(struct cli *cli, int arg, const char *value) {
    double *fps = &cli->options.batch.fps;
    if (number_parse(str_from(value), fps) == NUMBER_OK && *fps >= 0.001 && *fps <= 1000)
        return true;
    cli_usage(cli, arg, "--fps takes a number from 0.001 to 1000, not '%s'", value);
    return false;
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
        number_parse(b, &last) != NUMBER_OK || !take_integer(n, &count) || count < 1 || count > VALUES_MAX)
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

// V,V,...: commas in brackets are of a value.
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

static bool read_sweep(struct cli *cli, int arg, const char *value) {
    struct cli_batch_sweep sweep = {.arg = arg};
    str values;
    bool good = split(str_from(value), "=", &sweep.path, &values) && sweep.path.len;
    if (good && !take_steps(cli, &sweep, values))
        take_list(cli, &sweep, values);
    for (uint32_t i = 0; good && i < sweep.values.count; i++)
        good = sweep.values.items[i].len > 0;
    if (!good) {
        cli_usage(cli, arg, "--sweep takes PATH=A:B:N or PATH=VALUE,VALUE,..., not '%s'", value);
        diag_help(&cli->sink, "for example materials.glass.refractive_index=1.3:1.7:9");
        return false;
    }
    *(struct cli_batch_sweep *)ARENA_PUSH(&cli->arena, &cli->options.batch.sweeps) = sweep;
    return true;
}

bool cli_batch_apply(struct cli *cli, int arg, enum cli_batch_option option, const char *value) {
    struct cli_batch *b = &cli->options.batch;
    switch (option) {
    case CLI_BATCH_FRAMES:
        return read_frames(cli, arg, value);
    case CLI_BATCH_FRAME:
        return read_frame(cli, arg, value);
    case CLI_BATCH_FPS:
        return read_fps(cli, arg, value);
    case CLI_BATCH_SWEEP:
        return read_sweep(cli, arg, value);
    case CLI_BATCH_LIST:
        b->list = value;
        b->list_arg = arg;
        return true;
    case CLI_BATCH_MONTAGE:
        b->montage = true;
        b->montage_arg = arg;
        return true;
    case CLI_BATCH_SKIP_DONE:
        return b->skip_done = true;
    case CLI_BATCH_KEEP_GOING:
        b->stops = value && strcmp(value, "no") == 0;
        if (!value || b->stops || strcmp(value, "yes") == 0)
            return true;
        cli_usage(cli, arg, "--keep-going takes 'no', 'yes' or nothing, not '%s'", value);
    }
    return false;
}
