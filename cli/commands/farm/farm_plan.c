// The plan that the command line of glint farm asks for.
#include "cli/commands/batch/batch_job.h"
#include "cli/commands/farm/farm.h"
#include "cli/commands/rendering.h"
#include "diag/codes/file.h"
#include "render/frames/frame_name.h"
#include "render/parts/part_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    ROOT_BYTES = 4096,
};

// ---- words that a script can hold

static bool has_control(const char *text) {
    for (const char *p = text; *p; p++)
        if ((unsigned char)*p < 0x20 || *p == 0x7f)
            return true;
    return false;
}

static int judge_word(struct cli *cli, int arg, const char *word) {
    if (word && word[0] == '\0')
        return cli_usage(cli, arg, "a name is empty");
    if (!word || !has_control(word))
        return CLI_OK;
    return cli_usage(cli, arg, "'%s' has a control character, which scripts and manifests cannot hold", word);
}

static int judge_words(struct cli *cli) {
    const struct cli_options *o = &cli->options;
    for (int i = 1; i < cli->argc; i++)
        if (judge_word(cli, i, cli->argv[i]) != CLI_OK)
            return CLI_USAGE;
    if (o->outputs.count && o->outputs.items[0].path[0] == '-')
        return cli_usage(cli, o->outputs.items[0].arg, "a task writes files: '%s' names none",
                         o->outputs.items[0].path);
    return CLI_OK;
}

// ---- what does not go together

static int judge_options(struct cli *cli, enum farm_engine engine) {
    const struct cli_farm *farm = &cli->options.farm;
    static const struct {
        const char *option, *why;
        enum farm_engine engine;
    } rows[] = {{"sshlogin", "only 'parallel' starts tasks over ssh", FARM_PARALLEL},
                {"image", "only 'k8s' runs tasks in containers", FARM_K8S}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if (engine != rows[i].engine && cli_has_no_effect(cli, rows[i].option, rows[i].why))
            return CLI_USAGE;
    if (!farm->folder && cli_has_no_effect(cli, "pack", "the scene is packed into the folder of --folder"))
        return CLI_USAGE;
    if (!farm->folder && cli_has_no_effect(cli, "force", "without --folder no file is written"))
        return CLI_USAGE;
    if (cli_has_no_effect(cli, "format", "it is of 'glint farm status'"))
        return CLI_USAGE;
    if (farm->gpus && engine == FARM_PARALLEL && cli->options.device)
        return cli_usage(cli, cli_option_place(cli, "device"),
                         "with '--gpus' each task takes the device of its number on its host: leave one out");
    if (str_equal(cli->options.camera, STR("all")))
        return cli_usage(cli, cli_option_place(cli, "camera"),
                         "a farm renders through one camera: write a script for each");
    return CLI_OK;
}

// ---- the plan

// "out.%04d.png": parts are called "out.%04d.7.part".
static const char *part_of(struct cli *cli, const char *output) {
    const char *dot = strrchr(output, '.');
    const size_t stem = dot && !strchr(dot, '/') ? (size_t)(dot - output) : strlen(output);
    return arena_format(&cli->arena, "%.*s.", (int)stem, output).ptr;
}

// Names need only the frame's number: scene and values are the same in all frames.
static int judge_output(struct cli *cli, const struct farm_plan *plan) {
    const struct cli_output *output = &cli->options.outputs.items[0];
    struct strbuf name;
    strbuf_init(&name);
    const bool good = !plan->has_frames || frame_name(output->path, 0, &name);
    strbuf_finish(&name);
    if (!good) {
        const int status =
            cli_usage(cli, output->arg, "'%%' in '%s' is followed by no word that is known", output->path);
        diag_help(&cli->sink, "%%d or %%04d is the frame, and %%%% a percent sign");
        return status;
    }
    struct rendering r = {.cli = cli};
    const int status = render_take_outputs(&r);
    if (status != CLI_OK || !r.outputs[0].is_part)
        return status;
    return cli_usage(cli, output->arg, "name the picture: tasks write parts beside it by themselves");
}

static int take_root(struct cli *cli, struct farm_plan *plan) {
    char *root = arena_alloc(&cli->arena, ROOT_BYTES);
    if (!getcwd(root, ROOT_BYTES)) {
        cli_error(cli, DIAG_FILE_UNREADABLE, ".", NULL, "the current folder has no name: %s",
                  strerror(errno));
        return CLI_FILE;
    }
    plan->root = root;
    return judge_word(cli, 1, root);
}

// Whatever is wrong on the command line for many pictures is wrong here, and reported in the same words.
static int judge_frames(struct cli *cli) {
    struct batch batch = {.cli = cli};
    const int status = batch_plan(&batch);
    return status == CLI_OK ? batch_name(&batch) : status;
}

int farm_plan_make(struct cli *cli, struct farm_plan *plan) {
    const struct cli_batch *b = &cli->options.batch;
    const struct cli_farm *farm = &cli->options.farm;
    struct cli_outputs *outputs = &cli->options.outputs;
    plan->has_frames = b->has_frames;
    plan->scene = cli->operands[0];
    const int taken = batch_take_all(cli, plan->scene);
    if (taken != CLI_OK)
        return taken;
    plan->step = 1;
    if (b->has_frames) {
        plan->first = b->first_frame;
        plan->last = b->last_frame;
        plan->step = b->frame_step;
    }
    plan->frames = (uint32_t)((plan->last - plan->first) / plan->step) + 1;
    plan->last = plan->first + (int32_t)(plan->frames - 1) * plan->step;
    plan->tiles = farm->tiles ? (uint32_t)farm->tiles : 1;
    plan->folder = farm->folder;
    int status = judge_words(cli);
    if (status == CLI_OK)
        status = judge_options(cli, plan->engine);
    if (status == CLI_OK && outputs->count == 0)
        *(struct cli_output *)ARENA_PUSH(&cli->arena, outputs) = (struct cli_output){
            .path = plan->has_frames ? arena_format(&cli->arena, "%.*s.%%04d.png",
                                                    (int)(strlen(cli_default_picture(cli, plan->scene)) - 4),
                                                    cli_default_picture(cli, plan->scene))
                                           .ptr
                                     : cli_default_picture(cli, plan->scene)};
    if (status == CLI_OK)
        status = judge_output(cli, plan);
    if (status == CLI_OK)
        status = judge_frames(cli);
    if (status == CLI_OK)
        status = take_root(cli, plan);
    plan->output = outputs->count ? outputs->items[0].path : NULL;
    if (status == CLI_OK && plan->tiles > 1)
        plan->part = part_of(cli, plan->output);
    return status;
}
