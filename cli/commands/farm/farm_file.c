// The plan as a file of its folder: each line is a word and its value, as in the head of a part.
#include "cli/commands/farm/farm.h"
#include "cli/commands/rendering.h"
#include "cli/made.h"
#include "diag/codes/command.h"
#include "diag/codes/file.h"
#include "files/stream.h"
#include "render/frames/frame_name.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define PLAN_NAME "farm.plan"
#define LOG_NAME  "log"

enum {
    PLAN_BYTES = 65536, // a plan is shorter
};

static const char *in_folder(struct cli *cli, const char *folder, const char *name) {
    return path_join(&cli->arena, str_from(folder), str_from(name)).ptr;
}

// ---- writing

static void write_plan(const struct farm_plan *plan, struct strbuf *out) {
    strbuf_format(out, FARM_PLAN_HEAD "engine %s\n", farm_engines[plan->engine]);
    if (plan->has_frames)
        strbuf_format(out, "frames %d %d %d\n", (int)plan->first, (int)plan->last, (int)plan->step);
    strbuf_format(out, "tiles %u\nchunk %u\nroot %s\nfolder %s\noutput %s\n", plan->tiles, plan->chunk,
                  plan->root, plan->folder, plan->output);
    if (plan->part)
        strbuf_format(out, "part %s\n", plan->part);
}

// What is written into the folder, by glint or by its script.
static int judge_made(struct cli *cli, const struct farm_plan *plan) {
    const char *typed = in_folder(cli, plan->folder, "");
    int status = cli_judge_made(cli, typed, in_folder(cli, plan->folder, PLAN_NAME));
    if (status == CLI_OK)
        status = cli_judge_made(cli, typed, in_folder(cli, plan->folder, farm_script_name(plan->engine)));
    if (status == CLI_OK)
        status = cli_judge_made_folder(cli, typed, in_folder(cli, plan->folder, LOG_NAME));
    return status;
}

int farm_judge_logs(struct cli *cli, const struct farm_plan *plan) {
    static const char *const lists[] = {"parallel.txt", "parallel.txt.named", NULL};
    const char *log = plan->folder ? in_folder(cli, plan->folder, LOG_NAME) : NULL;
    struct stat there;
    int status = CLI_OK;
    if (!log || lstat(log, &there) != 0)
        return CLI_OK;
    const char *typed = in_folder(cli, log, "");
    for (const char *const *list = lists; *list && status == CLI_OK; list++)
        status = cli_judge_made(cli, typed, in_folder(cli, log, *list));
    for (uint32_t i = 0; i < plan->tasks && status == CLI_OK; i++)
        status = cli_judge_made(cli, typed, arena_format(&cli->arena, "%s%u.jsonl", typed, i).ptr);
    return status;
}

// Without frames, each task gets the name of its part; names of frames are judged by the tasks.
static int judge_parts(struct cli *cli, const struct farm_plan *plan) {
    int status = CLI_OK;
    for (uint32_t i = 1; i <= plan->tiles && status == CLI_OK && plan->part && !plan->has_frames; i++)
        status = cli_judge_made(cli, render_typed(&cli->options.outputs.items[0]),
                                arena_format(&cli->arena, "%s%u.part", plan->part, i).ptr);
    return status;
}

int farm_begin(struct cli *cli, struct farm_plan *plan) {
    const int parts = judge_parts(cli, plan);
    struct stat there;
    if (parts != CLI_OK || !plan->folder)
        return parts;
    const char *path = in_folder(cli, plan->folder, PLAN_NAME);
    if (!cli->options.force && stat(path, &there) == 0) {
        const int status =
            cli_usage(cli, cli_option_place(cli, "folder"), "'%s' holds the plan of a farm", plan->folder);
        diag_help(&cli->sink, "choose another folder, or overwrite it with --force");
        return status;
    }
    if (mkdir(plan->folder, 0777) == 0) {
        temporary_note(&plan->made, plan->folder);
    } else if (errno != EEXIST) {
        cli_error(cli, DIAG_OUTPUT, plan->folder, NULL, "the folder cannot be made: %s", strerror(errno));
        return CLI_FILE;
    }
    return judge_made(cli, plan);
}

void farm_end(struct farm_plan *plan, int status) {
    if (plan->made.path && status != CLI_OK)
        temporary_remove(plan->folder);
    temporary_forget(&plan->made);
}

// Both files, or neither.
int farm_save(struct cli *cli, const struct farm_plan *plan, str script) {
    const char *paths[] = {in_folder(cli, plan->folder, farm_script_name(plan->engine)),
                           in_folder(cli, plan->folder, PLAN_NAME)};
    struct output outputs[2] = {{.fd = -1}, {.fd = -1}};
    struct strbuf text;
    int status = CLI_OK;
    strbuf_init(&text);
    write_plan(plan, &text);
    const str texts[] = {script, strbuf_view(&text)};
    for (int i = 0; i < 2 && status == CLI_OK; i++) {
        if (cli_open_output(cli, &outputs[i], paths[i]))
            output_write(&outputs[i], texts[i].ptr, texts[i].len);
        if (text.failed || outputs[i].error)
            status = cli_not_written(cli, paths[i], text.failed ? ENOMEM : outputs[i].error);
    }
    for (int i = 0; i < 2; i++)
        if (status != CLI_OK)
            output_abandon(&outputs[i]);
        else if (!output_commit(&outputs[i]))
            status = cli_not_written(cli, paths[i], outputs[i].error);
    strbuf_finish(&text);
    return status;
}

// ---- reading

int farm_load(struct cli *cli, const char *folder, struct farm_plan *plan) {
    const char *path = in_folder(cli, folder, PLAN_NAME);
    struct strbuf file;
    *plan = (struct farm_plan){0};
    strbuf_init(&file);
    const int error = stream_read_file(path, PLAN_BYTES, &file);
    char *text = arena_alloc(&cli->arena, file.len + 1);
    memcpy(text, file.data ? file.data : "", file.len);
    strbuf_finish(&file);
    if (error) {
        cli_error(cli, DIAG_FILE_UNREADABLE, path, "'glint farm' with --folder writes it",
                  "cannot be read: %s", strerror(error));
        return CLI_FILE;
    }
    if (!farm_plan_read(text, plan)) {
        cli_error(cli, DIAG_FILE_UNREADABLE, path, NULL, "this is not a plan that 'glint farm' has written");
        return CLI_FILE;
    }
    return CLI_OK;
}

// ---- names

static const char *name_of(struct cli *cli, const struct farm_plan *plan, const char *pattern, int32_t frame,
                           const char *more) {
    struct strbuf name;
    strbuf_init(&name);
    if (plan->has_frames)
        frame_name(pattern, frame, &name);
    else
        strbuf_cstr(&name, pattern);
    strbuf_cstr(&name, more);
    const str path = path_join(&cli->arena, str_from(plan->root), strbuf_view(&name));
    const char *copy = arena_copy(&cli->arena, path).ptr;
    strbuf_finish(&name);
    return copy;
}

const char *farm_picture(struct cli *cli, const struct farm_plan *plan, int32_t frame) {
    return name_of(cli, plan, plan->output, frame, "");
}

const char *farm_part(struct cli *cli, const struct farm_plan *plan, int32_t frame, uint32_t tile) {
    const char *ending = arena_format(&cli->arena, "%u.part", tile).ptr;
    return name_of(cli, plan, plan->part, frame, ending);
}
