// The one table of options, its parser and its help.
#include "cli/cli.h"

#include "core/nearest.h"
#include "edit/fixes.h"
#include "render/aov/aov.h"

#include <getopt.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum option_id {
    OPTION_HELP = 1000,
    OPTION_VERSION,
    OPTION_OUTPUT,
    OPTION_SIZE,
    OPTION_SAMPLES,
    OPTION_SAMPLE,
    OPTION_AOV,
    OPTION_CAMERA,
    OPTION_SET,
    OPTION_DEVICE,
    OPTION_ASSET_PATH,
    OPTION_LIMIT,
    OPTION_CONFIG,
    OPTION_REPEAT,
    OPTION_WATCH,
    OPTION_STATS,
    OPTION_QUIET,
    OPTION_VERBOSE,
    OPTION_IR,
    OPTION_AS_FILE,
    OPTION_NO_CACHE,
    OPTION_SKIP_PIXELS,
    OPTION_CHECK,
    OPTION_DIFF,
    OPTION_FIX,
    OPTION_UPGRADE,
    OPTION_LIST,
    OPTION_CHANGED,
    OPTION_BASELINE,
    OPTION_WRITE_BASELINE,
    OPTION_FORMAT,
    OPTION_THRESHOLDS,
    OPTION_AXIS,
    OPTION_ALTERNATIVE,
    OPTION_SCHEMA,
    OPTION_MAX_MESSAGES,
    OPTION_AUDIT,
    OPTION_AS,
    OPTION_BASE,
    OPTION_COLOR,
    OPTION_ALLOW_RESOLUTION,
    OPTION_FORCE,
    OPTION_TRUST_RECORD,
    OPTION_UNTRUSTED,
    OPTION_DEPTH,
    OPTION_QUALITY,
    OPTION_COMPRESSION,
    OPTION_BATCH = 1400,   // and enum cli_batch_option after it
    OPTION_POLICY = 1500,  // and enum cli_policy_option after it
    OPTION_MEASURE = 2000, // and enum cli_measure_option after it
    OPTION_PART = 2500,    // and enum cli_part_option after it
    OPTION_FARM = 3000,    // and enum cli_farm_option after it
    OPTION_TEST = 3500,    // and enum cli_test_option after it
};

struct option_row {
    int id; // enum option_id
    const char *name;
    char letter;          // 0: none
    const char *argument; // NULL: none; "[=X]": optional; "X ...": each further one adds to those before
    const char *commands; // separated by spaces; "*": all, "-": the program itself too
    const char *doc;
};

static const struct option_row rows[] = {
    {OPTION_OUTPUT, "output", 'o', "FILE ...", "render",
     "write to FILE (" IMAGE_WRITTEN_ENDINGS
     "); '-' writes PNG to standard output; several are rendered once"},
    {OPTION_DEPTH, "depth", 0, "N", "render merge farm",
     "bits per channel: 16 for PNG instead of 8, or for OpenEXR (half) instead of 32 (float)"},
    {OPTION_QUALITY, "quality", 0, "N", "render merge farm",
     "of JPEG and WebP: from 1 to 100, instead of 90; WebP is lossless at 100"},
    {OPTION_COMPRESSION, "compression", 0, "KIND", "render merge farm",
     "of OpenEXR: zip (the default), piz or none"},
    {OPTION_OUTPUT, "output", 'o', "FILE", "tradeoff",
     "write the report with its plot and pictures to FILE (.html)"},
    {OPTION_OUTPUT, "output", 'o', "FILE", "check",
     "write the report to FILE instead of standard error (text) or output (others)"},
    {OPTION_OUTPUT, "output", 'o', "FILE", "extremes", "write the report with its matrix to FILE (.html)"},
    {OPTION_ALTERNATIVE, "study", 0, "NAME", "extremes",
     "trace by another tracer's method, to see it fail: 'offset 1e-3'; docs/accuracy.md lists the others"},
    {OPTION_AXIS, "axis", 0, "NAME,...", "extremes", "only these axes: move, scale, distance ..."},
    {OPTION_THRESHOLDS, "thresholds", 0, "FILE", "extremes",
     "bounds from FILE (YAML) instead of glint's own"},
    {OPTION_OUTPUT, "output", 'o', "FILE", "import",
     "write the scene to FILE (.yaml .yml .json .xml); '-' writes YAML to standard output, and no images"},
    {OPTION_FORCE, "force", 0, NULL, "import farm", "overwrite files that exist"},
    {OPTION_FORCE, "force", 0, NULL, "test", "let --bless replace files that are not pictures"},
    {OPTION_TRUST_RECORD, "trust-record", 0, NULL, "verify",
     "read the scene and the folders that the picture names wherever they are, and not only below its own "
     "folder"},
    {OPTION_SIZE, "size", 0, "WxH", "render view inspect pick tradeoff extremes farm",
     "size of the picture in pixels, instead of the scene's"},
    {OPTION_SAMPLES, "samples", 0, "N", "render view inspect tradeoff farm",
     "rays through each pixel, instead of the scene's"},
    {OPTION_MEASURE + CLI_MEASURE_NOISE, "noise", 0, "E", "render",
     "end each pixel once the standard error of its displayed colour is at most E, such as 0.01; with at "
     "most "
     "1024 samples, or those of --samples"},
    {OPTION_AOV, "aov", 0, AOV_NAMES, "render",
     "write what else is known of each pixel, one or more separated by commas: as layers of OUT.exr, else "
     "beside OUT as OUT.depth.pfm and so on; 'error' needs --noise"},
    {OPTION_SAMPLE, "sample", 0, "N", "pick", "the sample whose path is shown, counted from 0"},
    {OPTION_CAMERA, "camera", 0, "NAME", "view pick tradeoff extremes", "the camera to look through"},
    {OPTION_CAMERA, "camera", 0, "NAME", "render",
     "the camera to look through; 'all' writes OUT.NAME.png for each"},
    {OPTION_SET, "set", 0, "PATH=VALUE ...", "render view pick check inspect deps tradeoff extremes farm",
     "change one value of the scene: materials.glass.refractive_index=1.6; a later one counts"},
    {OPTION_DEVICE, "device", 0, "NAME|N", "render view verify test pick tradeoff extremes farm",
     "the device to render on, see 'glint devices'; 'reference' is the tracer in double precision; also "
     "GLINT_DEVICE"},
    {OPTION_AS_FILE, "as-file", 0, NULL, "render",
     "the reference obeys max_depth, min_weight and depth_limit of the scene"},
    {OPTION_NO_CACHE, "no-cache", 0, NULL, "render test tradeoff",
     "neither read nor write the cache of the reference and of searches"},
    {OPTION_SKIP_PIXELS, "skip-pixels", 0, NULL, "check inspect",
     "read only the headers of images, which is faster; damaged pixels are not found"},
    {OPTION_ASSET_PATH, "asset-path", 0, "DIR ...",
     "render view verify test pick check inspect convert deps pack tradeoff extremes import farm",
     "another folder in which to look for files of the scene"},
    {OPTION_LIMIT, "limit", 0, "NAME=VALUE ...",
     "render view verify test pick check inspect format diff convert deps pack compare tradeoff extremes lsp "
     "import",
     "change a limit on the size of inputs; '--limit help' lists them"},
    {OPTION_CONFIG, "config", 0, "FILE",
     "render view verify test pick check inspect format diff convert deps pack compare tradeoff extremes lsp "
     "import",
     "settings, written as in .glintrc.yaml, that override those beside the scenes, and may raise limits"},
    {OPTION_UNTRUSTED, "untrusted", 0, "[=SECONDS,MB]", "render verify test check inspect format deps",
     "for files from anyone: read only below the folders of the arguments, start no program, and take no "
     "more than 600 "
     "seconds of the processor and 4096 MB; what is refused has exit status 5"},
    {OPTION_REPEAT, "repeat", 0, "N", "render",
     "render N times and show the median time of a frame and its spread"},
#include "cli/options/options_batch.def"
#include "cli/options/options_farm.def"
#include "cli/options/options_part.def"
#include "cli/options/options_test.def"
    {OPTION_WATCH, "watch", 0, NULL, "render",
     "render again each time the scene, or a file that it reads, is saved; ends with Ctrl-C"},
    {OPTION_STATS, "stats", 0, "[=json]", "render",
     "show times, rays, memory and the device: text on standard error, JSON on standard output; "
     "docs/reports.md describes it"},
    {OPTION_OUTPUT, "output", 'o', "FILE", "view",
     "where the key P writes the picture (" IMAGE_WRITTEN_ENDINGS ")"},
    {OPTION_STATS, "stats", 0, "[=json]", "view",
     "show what each load did, as --watch does: text on standard error, JSON on standard output"},
    {OPTION_AUDIT, "audit", 0, NULL, "render",
     "say at most what share of the picture's pixels is off, in the file too; --stats does so as well"},
    {OPTION_MEASURE + CLI_MEASURE_MAX_OFF, "max-off", 0, "X", "render",
     "fail if more than this share of the pixels is off; the audit goes on until it is sure"},
    {OPTION_QUIET, "quiet", 'q', NULL, "render merge view test extremes check tradeoff import farm",
     "show only errors and warnings: no notes, no progress"},
    {OPTION_VERBOSE, "verbose", 'v', NULL, "check", "show notes too"},
    {OPTION_FORMAT, "format", 0, "KIND",
     "check inspect compare verify test tradeoff extremes pick diff deps farm",
     "the format of the report; the text above lists the kinds"},
    {OPTION_POLICY + CLI_POLICY_SEVERITY, "severity", 0, "CODE=LEVEL ...", "check",
     "change the severity of a code: error, warning, note or off"},
    {OPTION_POLICY + CLI_POLICY_IGNORE, "ignore", 0, "CODE|PATH ...", "check",
     "leave out a code of warnings or notes, or the files that match a pattern: 'drafts/**'"},
    {OPTION_POLICY + CLI_POLICY_ONLY, "only", 0, "CODE ...", "check",
     "show only these warnings and notes; errors are always shown"},
    {OPTION_POLICY + CLI_POLICY_FAIL_ON, "fail-on", 0, "LEVEL", "check",
     "what makes the exit status 1: error (the default) or warning"},
    {OPTION_MAX_MESSAGES, "max-messages", 0, "N", "check",
     "findings shown per scene; the rest are only counted"},
    {OPTION_CHANGED, "changed", 0, NULL, "check",
     "check the scenes that read a changed file: one named, or one that git says differs from REV (HEAD)"},
    {OPTION_BASELINE, "baseline", 0, "FILE", "check",
     "report only what is not in FILE, and say which of its findings are gone"},
    {OPTION_WRITE_BASELINE, "write-baseline", 0, "FILE", "check",
     "write the errors and warnings that there are into FILE, for --baseline"},
#include "cli/options/options_compare.def"
    {OPTION_MEASURE + CLI_MEASURE_MAX_ERROR, "max-error", 0, "METRIC=X", "tradeoff render",
     "choose the cheapest settings whose error is no larger, such as flip=0.02"},
    {OPTION_MEASURE + CLI_MEASURE_MAX_TIME, "max-time", 0, "MS", "tradeoff render",
     "choose the best settings whose frame takes no longer, in milliseconds"},
    {OPTION_ALLOW_RESOLUTION, "allow-resolution", 0, NULL, "render",
     "--max-error and --max-time may choose a smaller picture, which is scaled up to the size asked for"},
    {OPTION_MEASURE + CLI_MEASURE_TIME, "time", 0, "S", "render",
     "write the picture at most S seconds after the start, with fewer samples if they do not fit"},
    {OPTION_MEASURE + CLI_MEASURE_BUDGET, "budget", 0, "S", "tradeoff render",
     "seconds that the measurement may take, for tradeoff 60 by default; what does not fit is left out"},
    {OPTION_SCHEMA, "schema", 0, "ADDRESS", "schema",
     "where install finds the schema (a path or URL), instead of writing it into the scene's folder"},
    {OPTION_OUTPUT, "output", 'o', "FILE", "format", "write to FILE instead; '-' is standard output"},
    {OPTION_CHECK, "check", 0, NULL, "format",
     "write nothing; list the files that would change, and fail if there are any"},
    {OPTION_FIX, "fix", 0, "[=all]", "check",
     "write the fixes that are certain into the files; with =all also suggestions"},
    {OPTION_DIFF, "diff", 0, NULL, "format check", "write nothing; show what would change as a patch"},
    {OPTION_UPGRADE, "upgrade", 0, NULL, "format",
     "rewrite what older versions of the language spell differently"},
    {OPTION_LIST, "list", 0, NULL, "explain", "list all codes, or those of a family: --list W4xx"},
    {OPTION_IR, "ir", 0, NULL, "inspect", "print the scene as glint understood it, in canonical form"},
    {OPTION_AS, "as", 0, "yaml|xml", "render pick check inspect convert deps diff tradeoff extremes format",
     "the spelling of standard input (the argument '-'), instead of what its first character says"},
    {OPTION_BASE, "base", 0, "FOLDER", "render pick check inspect convert deps diff tradeoff extremes",
     "the folder that paths in standard input (the argument '-') are relative to, instead of the current "
     "one"},
    {OPTION_COLOR, "color", 0, "WHEN", "*-",
     "colours in messages: always, never, or auto (the default: on a terminal)"},
    {OPTION_HELP, "help", 'h', NULL, "*-", "show this help"},
    {OPTION_VERSION, "version", 'V', NULL, "-", "show the version"},
};
enum {
    ROW_COUNT = sizeof rows / sizeof rows[0]
};

static bool belongs(const struct option_row *row, const struct cli_command *command) {
    if (!command)
        return strchr(row->commands, '-') != NULL;
    if (row->commands[0] == '*')
        return true;
    size_t n = strlen(command->name);
    for (const char *p = strstr(row->commands, command->name); p; p = strstr(p + n, command->name))
        if ((p == row->commands || p[-1] == ' ') && (p[n] == ' ' || p[n] == '\0'))
            return true;
    return false;
}

void cli_option_help(struct strbuf *out, const struct cli_command *command) {
    for (int i = 0; i < ROW_COUNT; i++) {
        if (!belongs(&rows[i], command))
            continue;
        char left[128];
        const char *argument = rows[i].argument ? rows[i].argument : "";
        const char *joint = rows[i].argument && argument[0] != '[' ? " " : "";
        if (rows[i].letter)
            snprintf(left, sizeof left, "-%c, --%s%s%s", rows[i].letter, rows[i].name, joint, argument);
        else
            snprintf(left, sizeof left, "    --%s%s%s", rows[i].name, joint, argument);
        strbuf_format(out, "  %-28s %s\n", left, rows[i].doc);
    }
}

int cli_next_option(const struct cli_command *command, int at, struct cli_option_text *option) {
    while (at < ROW_COUNT && !belongs(&rows[at], command))
        at++;
    if (at >= ROW_COUNT)
        return 0;
    *option = (struct cli_option_text){rows[at].name, rows[at].argument, rows[at].doc, rows[at].letter};
    return at + 1;
}

static void append(struct cli *cli, struct cli_list *list, const char *text) {
    str *item = ARENA_PUSH(&cli->arena, list);
    *item = str_from(text);
}

// The field of an option that takes no value; NULL: it is another kind.
static bool *flag_of(struct cli_options *options, int id) {
    switch (id) {
    case OPTION_HELP:
        return &options->help;
    case OPTION_VERSION:
        return &options->version;
    case OPTION_QUIET:
        return &options->quiet;
    case OPTION_VERBOSE:
        return &options->verbose;
    case OPTION_CHECK:
        return &options->check;
    case OPTION_DIFF:
        return &options->diff;
    case OPTION_UPGRADE:
        return &options->upgrade;
    case OPTION_IR:
        return &options->ir;
    case OPTION_LIST:
        return &options->list;
    case OPTION_FORCE:
        return &options->force;
    case OPTION_TRUST_RECORD:
        return &options->trust_record;
    case OPTION_CHANGED:
        return &options->changed;
    case OPTION_AS_FILE:
        return &options->as_file;
    case OPTION_NO_CACHE:
        return &options->no_cache;
    case OPTION_SKIP_PIXELS:
        return &options->skip_pixels;
    case OPTION_WATCH:
        return &options->watch;
    case OPTION_AUDIT:
        return &options->audit;
    case OPTION_ALLOW_RESOLUTION:
        return &options->measure.allow_resolution;
    default:
        return NULL;
    }
}

// The field of an option whose text is kept unchanged; NULL: it is another kind.
static const char **text_of(struct cli_options *options, int id) {
    switch (id) {
    case OPTION_OUTPUT:
        return &options->output;
    case OPTION_DEVICE:
        return &options->device;
    case OPTION_SCHEMA:
        return &options->schema;
    case OPTION_CONFIG:
        return &options->config;
    case OPTION_AXIS:
        return &options->axes;
    case OPTION_ALTERNATIVE:
        return &options->alternative;
    case OPTION_THRESHOLDS:
        return &options->thresholds;
    case OPTION_FORMAT:
        return &options->format;
    case OPTION_BASELINE:
        return &options->baseline;
    case OPTION_WRITE_BASELINE:
        return &options->write_baseline;
    default:
        return NULL;
    }
}

// The option's place, for those whose mistakes are found later.
static void keep_place(struct cli_options *options, int id, int arg) {
    int *place = id == OPTION_OUTPUT             ? &options->output_arg
                 : id == OPTION_AS_FILE          ? &options->as_file_arg
                 : id == OPTION_AXIS             ? &options->axes_arg
                 : id == OPTION_ALTERNATIVE      ? &options->alternative_arg
                 : id == OPTION_FORMAT           ? &options->format_arg
                 : id == OPTION_SAMPLE           ? &options->sample_arg
                 : id == OPTION_FIX              ? &options->fix_arg
                 : id == OPTION_CHANGED          ? &options->changed_arg
                 : id == OPTION_WRITE_BASELINE   ? &options->write_baseline_arg
                 : id == OPTION_AUDIT            ? &options->audit_arg
                 : id == OPTION_ALLOW_RESOLUTION ? &options->measure.allow_resolution_arg
                                                 : NULL;
    if (place)
        *place = arg;
}

static bool read_color(struct cli *cli, int arg, const char *value) {
    static const char *const words[] = {
        [CLI_COLOR_AUTO] = "auto", [CLI_COLOR_ALWAYS] = "always", [CLI_COLOR_NEVER] = "never", NULL};
    const int word = cli_read_word(cli, arg, "color", value, words);
    if (word >= 0)
        cli->options.color = (enum cli_color)word;
    cli->color = cli_has_color(cli, STDERR_FILENO);
    return word >= 0;
}

// The rest: options whose text means something.
static bool apply_value(struct cli *cli, int arg, int id, const char *value) {
    struct cli_options *options = &cli->options;
    static const char *const as_words[] = {"yaml", "xml", NULL};
    switch (id) {
    case OPTION_SIZE:
        return cli_read_size(cli, arg, value);
    case OPTION_SAMPLES:
        return cli_read_count(cli, arg, "samples", value, 1, 4096, &options->samples);
    case OPTION_AOV:
        return cli_read_aovs(cli, arg, value);
    case OPTION_DEPTH:
        return cli_read_depth(cli, arg, value);
    case OPTION_QUALITY:
        return cli_read_count(cli, arg, "quality", value, 1, IMAGE_QUALITY_MOST, &options->quality);
    case OPTION_COMPRESSION:
        return cli_read_compression(cli, arg, value);
    case OPTION_SAMPLE:
        return cli_read_count(cli, arg, "sample", value, 0, 4095, &options->sample);
    case OPTION_CAMERA:
        options->camera = str_from(value);
        return true;
    case OPTION_SET:
        append(cli, &options->sets, value);
        return true;
    case OPTION_ASSET_PATH:
        if (!cli_read_folder(cli, arg, "asset-path", value))
            return false;
        append(cli, &options->asset_paths, value);
        return true;
    case OPTION_LIMIT:
        return cli_read_limit(cli, arg, value);
    case OPTION_MAX_MESSAGES:
        return cli_read_max_messages(cli, arg, value);
    case OPTION_AS:
        return cli_read_word(cli, arg, "as", value, as_words) >= 0 && (options->as = value);
    case OPTION_BASE:
        options->base = value;
        return cli_read_folder(cli, arg, "base", value);
    case OPTION_COLOR:
        return read_color(cli, arg, value);
    case OPTION_REPEAT:
        return cli_read_count(cli, arg, "repeat", value, 1, 100000, &options->repeat);
    case OPTION_STATS:
        options->stats = value ? CLI_STATS_JSON : CLI_STATS_TEXT;
        if (value && strcmp(value, "json") != 0)
            cli_usage(cli, arg, "--stats takes 'json' or nothing, not '%s'", value);
        return !value || strcmp(value, "json") == 0;
    case OPTION_UNTRUSTED:
        return cli_read_untrusted(cli, arg, value);
    case OPTION_FIX:
        options->fix = value ? FIX_ALL : FIX_SAFE;
        if (value && strcmp(value, "all") != 0)
            cli_usage(cli, arg, "--fix takes 'all' or nothing, not '%s'", value);
        return !value || strcmp(value, "all") == 0;
    default:
        return false;
    }
}

static bool apply(struct cli *cli, int arg, const struct option_row *row, const char *value) {
    if (row->id >= OPTION_POLICY && row->id < OPTION_MEASURE)
        return cli_policy_apply(cli, arg, (enum cli_policy_option)(row->id - OPTION_POLICY), value);
    if (row->id >= OPTION_TEST)
        return cli_test_apply(cli, arg, (enum cli_test_option)(row->id - OPTION_TEST), value);
    if (row->id >= OPTION_FARM)
        return cli_farm_apply(cli, arg, (enum cli_farm_option)(row->id - OPTION_FARM), value);
    if (row->id >= OPTION_PART)
        return cli_part_apply(cli, arg, (enum cli_part_option)(row->id - OPTION_PART), value);
    if (row->id >= OPTION_MEASURE)
        return cli_measure_apply(cli, arg, (enum cli_measure_option)(row->id - OPTION_MEASURE), row->name,
                                 value);
    if (row->id >= OPTION_BATCH && row->id < OPTION_POLICY)
        return cli_batch_apply(cli, arg, (enum cli_batch_option)(row->id - OPTION_BATCH), value);
    bool *flag = flag_of(&cli->options, row->id);
    const char **text = text_of(&cli->options, row->id);
    keep_place(&cli->options, row->id, arg);
    if (flag)
        *flag = true;
    if (text)
        *text = value;
    if (row->id == OPTION_OUTPUT)
        *(struct cli_output *)ARENA_PUSH(&cli->arena, &cli->options.outputs) =
            (struct cli_output){.path = value, .arg = arg};
    return flag || text || apply_value(cli, arg, row->id, value);
}

// A flag says the same again.
static bool takes_many(const struct option_row *row) {
    return !row->argument || str_ends_with_nocase(str_from(row->argument), " ...");
}

// An option that takes one value would lose the first one.
static bool is_repeated(struct cli *cli, int arg, const struct option_row *row) {
    int *first = &cli->option_places[row - rows];
    if (*first == 0 || takes_many(row)) {
        *first = arg;
        return false;
    }
    cli_usage(cli, arg, "option '--%s' is given twice, and takes one value", row->name);
    diag_note(&cli->sink, cli_place(cli, *first), "the first one is here");
    diag_help(&cli->sink, "leave one of them out");
    return true;
}

bool cli_has_option(const struct cli_command *command, const char *name) {
    for (int i = 0; i < ROW_COUNT; i++)
        if (strcmp(rows[i].name, name) == 0 && belongs(&rows[i], command))
            return true;
    return false;
}

int cli_option_place(const struct cli *cli, const char *name) {
    int place = 0;
    for (int i = 0; i < ROW_COUNT; i++)
        if (cli->option_places && strcmp(rows[i].name, name) == 0 && cli->option_places[i])
            place = cli->option_places[i];
    return place;
}

bool cli_has_no_effect(struct cli *cli, const char *name, const char *why) {
    int place = cli_option_place(cli, name);
    if (place == 0)
        return false;
    cli_usage(cli, place, "option '--%s' would have no effect: %s", name, why);
    diag_help(&cli->sink, "leave it out");
    return true;
}

static void suggest(struct cli *cli, const struct cli_command *command, const char *word) {
    size_t length = strcspn(word, "=");
    struct nearest search = nearest_begin((str){word, length});
    char spelled[ROW_COUNT][40];
    for (int i = 0; i < ROW_COUNT; i++) {
        snprintf(spelled[i], sizeof spelled[i], "--%s", rows[i].name);
        if (belongs(&rows[i], command))
            nearest_offer(&search, str_from(spelled[i]));
    }
    if (nearest_best(&search).len)
        diag_help(&cli->sink, "did you mean '%.*s'?", STR_ARG(nearest_best(&search)));
    else
        diag_help(&cli->sink, "'glint %s%s--help' lists the options", command ? command->name : "",
                  command ? " " : "");
}

// The word that getopt read last.
static const char *word_of_option(int argc, char **argv, bool unknown) {
    const char *word = argv[optind - 1] == optarg && optind >= 2 ? argv[optind - 2] : argv[optind - 1];
    // inside a word of several letters, optind stays on it
    return unknown && word[0] != '-' && optind < argc ? argv[optind] : word;
}

bool cli_parse_options(struct cli *cli, const struct cli_command *command, int first) {
    struct option longs[ROW_COUNT + 1] = {0};
    char letters[3 * ROW_COUNT + 3] = ":";
    size_t letter_count = 1;
    int count = 0;
    for (int i = 0; i < ROW_COUNT; i++) {
        if (!belongs(&rows[i], command))
            continue;
        int has = !rows[i].argument            ? no_argument
                  : rows[i].argument[0] == '[' ? optional_argument
                                               : required_argument;
        longs[count++] = (struct option){rows[i].name, has, NULL, rows[i].id};
        if (rows[i].letter) {
            letters[letter_count++] = rows[i].letter;
            if (has == required_argument)
                letters[letter_count++] = ':';
        }
    }
    letters[letter_count] = '\0';
    // getopt sorts operands after options: it works on a copy, so that places stay those of the user.
    int argc = cli->argc - first + 1;
    char **argv = ARENA_ARRAY(&cli->arena, char *, (size_t)argc + 1);
    for (int i = 0; i < argc; i++)
        argv[i] = cli->argv[first - 1 + i];
    cli->option_places = ARENA_ARRAY(&cli->arena, int, ROW_COUNT);
    opterr = 0;
    optind = 0;
    bool good = true;
    const char *faulty = NULL;
    for (;;) {
        int at = optind ? optind : 1;
        int id = getopt_long(argc, argv, letters, longs, NULL);
        if (id == -1)
            break;
        const char *word = word_of_option(argc, argv, id == '?');
        int arg = at;
        for (int i = first; i < cli->argc; i++)
            if (cli->argv[i] == word)
                arg = i;
        if (id == '?' || id == ':') {
            if (word == faulty)
                continue; // another of its letters
            faulty = word;
            cli_usage(cli, arg, id == ':' ? "option '%s' needs a value" : "unknown or ambiguous option '%s'",
                      word);
            if (id == '?')
                suggest(cli, command, word);
            good = false;
            continue;
        }
        for (int i = 0; i < ROW_COUNT; i++)
            if ((rows[i].id == id || rows[i].letter == id) && belongs(&rows[i], command)) {
                good = !is_repeated(cli, arg, &rows[i]) && apply(cli, arg, &rows[i], optarg) && good;
                break;
            }
    }
    cli->operands = argv + optind;
    cli->operand_count = argc - optind;
    return good;
}
