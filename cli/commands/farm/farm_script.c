// What a task and the merge do, as functions of a shell of POSIX: the same for all engines.
#include "cli/commands/farm/farm.h"

#include "core/number.h"

// What makes a task go on where one before it ended: what is written is left out, and a signal ends the
// render with status 75 and a checkpoint.
#define GO_ON " --skip-done --resume"

void farm_quote(struct strbuf *out, const char *word) {
    strbuf_char(out, '\'');
    for (const char *p = word; *p; p++)
        if (*p == '\'')
            strbuf_cstr(out, "'\\''");
        else
            strbuf_char(out, *p);
    strbuf_char(out, '\'');
}

static void set(struct strbuf *out, const char *name, const char *value) {
    strbuf_format(out, "%s=", name);
    farm_quote(out, value);
    strbuf_char(out, '\n');
}

static void write_settings(const struct farm_plan *plan, struct strbuf *out) {
    strbuf_cstr(
        out, "# The program, and the folder that all names here are relative to: the same on all machines.\n"
             "glint=${GLINT:-glint}\n");
    set(out, "root", plan->root);
    strbuf_cstr(out, "root=${GLINT_FARM_ROOT:-$root}\n");
    set(out, "output", plan->output);
    if (plan->part)
        set(out, "part", plan->part);
    if (plan->folder)
        strbuf_cstr(out, "log="), farm_quote(out, plan->folder), strbuf_cstr(out, "/log\n");
    if (plan->has_frames)
        strbuf_format(out, "first=%d last=%d step=%d chunk=%u", (int)plan->first, (int)plan->last,
                      (int)plan->step, plan->chunk);
    strbuf_format(out, "%stiles=%u tasks=%u\n\n", plan->has_frames ? " " : "", plan->tiles, plan->tasks);
}

static void add_text(struct strbuf *out, const char *option, str text) {
    strbuf_format(out, " --%s ", option);
    struct strbuf copy;
    strbuf_init(&copy);
    strbuf_str(&copy, text);
    strbuf_char(&copy, '\0');
    farm_quote(out, copy.data ? copy.data : "");
    strbuf_finish(&copy);
}

static void add_number(struct strbuf *out, const char *option, double value) {
    char digits[NUMBER_FORMAT_MAX];
    const size_t length = number_format(value, digits);
    strbuf_format(out, " --%s %.*s", option, (int)length, digits);
}

// How a picture is coded: an option of who writes it.
static void add_coding(const struct cli_options *o, struct strbuf *out) {
    static const char *const compressions[] = {
        [IMAGE_ZIP] = "zip", [IMAGE_PIZ] = "piz", [IMAGE_UNCOMPRESSED] = "none"};
    if (o->depth)
        add_number(out, "depth", o->depth);
    if (o->quality)
        add_number(out, "quality", o->quality);
    if (o->compression)
        strbuf_format(out, " --compression %s", compressions[o->compression]);
}

static void add_options(const struct cli_options *o, struct strbuf *out) {
    if (o->width)
        strbuf_format(out, " --size %dx%d", (int)o->width, (int)o->height);
    if (o->samples)
        add_number(out, "samples", o->samples);
    if (o->camera.len)
        add_text(out, "camera", o->camera);
    if (o->device)
        add_text(out, "device", str_from(o->device));
    if (o->batch.fps > 0)
        add_number(out, "fps", o->batch.fps);
    for (uint32_t i = 0; i < o->sets.count; i++)
        add_text(out, "set", o->sets.items[i]);
    for (uint32_t i = 0; i < o->asset_paths.count; i++)
        add_text(out, "asset-path", o->asset_paths.items[i]);
}

// A signal is for the program, whose end is waited for.
static const char run_function[] =
    "# Runs a command, and passes it the signals that this shell gets. Its exit status is in $status.\n"
    "run() {\n"
    "    \"$@\" &\n"
    "    child=$!\n"
    "    trap 'kill -TERM \"$child\" 2>/dev/null' TERM INT\n"
    "    wait \"$child\"\n"
    "    status=$?\n"
    "    while kill -0 \"$child\" 2>/dev/null; do\n"
    "        wait \"$child\"\n"
    "        status=$?\n"
    "    done\n"
    "    trap - TERM INT\n"
    "}\n\n";

static void write_note(const struct farm_plan *plan, struct strbuf *out) {
    strbuf_cstr(out, "# note TASK: a line of JSON that says how the task ended; each attempt adds one.\n"
                     "note() {\n"
                     "    host=$(uname -n | tr -cd 'A-Za-z0-9._-')\n"
                     "    line=$(printf '{\"task\": %d, \"tile\": %d, ");
    strbuf_cstr(out, plan->has_frames ? "\"first\": %d, \"last\": %d, " : "");
    strbuf_cstr(out, "\"host\": \"%s\", \"began\": %d, \"seconds\": %d, \"status\": %d}' \\\n"
                     "        \"$1\" \"$tile\" ");
    strbuf_cstr(out, plan->has_frames ? "\"$begin\" \"$end\" " : "");
    strbuf_cstr(out, "\"${SLURMD_NODENAME:-$host}\" \"$began\" \"$(($(date +%s) - began))\" \"$status\")\n");
    strbuf_cstr(out, plan->folder
                         ? "    mkdir -p \"$log\" && printf '%s\\n' \"$line\" >>\"$log/$1.jsonl\"\n}\n\n"
                         : "    printf '%s\\n' \"$line\"\n}\n\n");
}

static void write_task(struct cli *cli, const struct farm_plan *plan, struct strbuf *out) {
    const struct cli_options *o = &cli->options;
    strbuf_cstr(
        out,
        plan->has_frames
            ? "# task N: of tile N % tiles + 1 the chunk N / tiles of frames. What is done is left out.\n"
            : "# task N: tile N + 1. What is done is left out.\n");
    strbuf_cstr(out, "task() {\n    tile=$(($1 % tiles + 1))\n");
    if (plan->has_frames)
        strbuf_cstr(out, "    begin=$((first + chunk * step * ($1 / tiles)))\n"
                         "    end=$((begin + (chunk - 1) * step))\n"
                         "    [ \"$end\" -le \"$last\" ] || end=$last\n");
    strbuf_cstr(out, "    began=$(date +%s)\n    run \"$glint\" render" GO_ON);
    add_options(o, out);
    if (plan->part == NULL)
        add_coding(o, out);
    if (o->farm.gpus && plan->engine == FARM_PARALLEL)
        strbuf_cstr(out, " --device \"$2\"");
    strbuf_cstr(out, " \\\n       ");
    if (plan->has_frames)
        strbuf_cstr(out, " --frames \"$begin..$end:$step\"");
    strbuf_cstr(out, plan->part ? " --tile \"$tile/$tiles\" -o \"$part$tile.part\"" : " -o \"$output\"");
    strbuf_cstr(out, " -- ");
    farm_quote(out, plan->scene);
    strbuf_cstr(out, "\n    note \"$1\"\n}\n\n");
}

static void write_merge(struct cli *cli, const struct farm_plan *plan, struct strbuf *out) {
    if (!plan->part)
        return;
    strbuf_cstr(out, "# merge: joins the tiles of all pictures.\n"
                     "merge() {\n"
                     "    tile=1\n"
                     "    set --\n"
                     "    while [ \"$tile\" -le \"$tiles\" ]; do\n"
                     "        set -- \"$@\" \"$part$tile.part\"\n"
                     "        tile=$((tile + 1))\n"
                     "    done\n"
                     "    run \"$glint\" merge --skip-done");
    add_coding(&cli->options, out);
    if (plan->has_frames)
        strbuf_cstr(out, " --frames \"$first..$last:$step\"");
    strbuf_cstr(out, " -- \"$output\" \"$@\"\n}\n\n");
}

void farm_write_tasks(struct cli *cli, const struct farm_plan *plan, struct strbuf *out) {
    strbuf_cstr(
        out,
        "# shellcheck disable=SC2016 # names are in quotes so that nothing in them is replaced\nset -u\n");
    write_settings(plan, out);
    strbuf_cstr(out, run_function);
    write_note(plan, out);
    write_task(cli, plan, out);
    write_merge(cli, plan, out);
}
