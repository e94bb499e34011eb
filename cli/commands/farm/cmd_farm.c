// glint farm ENGINE SCENE, and glint farm status DIR.
#include "cli/commands/commands.h"
#include "cli/commands/farm/farm.h"
#include "cli/commands/pack/pack_scene.h"

#include <stdio.h>
#include <string.h>

static int engine_of(struct cli *cli) {
    const char *name = cli->operands[0];
    for (int i = 0; farm_engines[i]; i++)
        if (strcmp(farm_engines[i], name) == 0)
            return i;
    cli_usage(cli, cli_operand_place(cli, 0), "there is no engine '%s' to write a script for", name);
    diag_help(&cli->sink, "write slurm, parallel or k8s; or 'glint farm status DIR'");
    return -1;
}

// 'status' takes no options of a plan: what a farm renders is already decided.
static int status_of(struct cli *cli) {
    for (const struct option_row *row = NULL; (row = cli_next_option(cli->command, row)) != NULL;)
        if (row->commands[0] != '*' && strcmp(row->name, "format") != 0 &&
            cli_has_no_effect(cli, row->name, "status only reads what the farm left"))
            return CLI_USAGE;
    return farm_status(cli, cli->operands[1]);
}

static int choose_tasks(struct cli *cli, struct farm_plan *plan) {
    if (cli->options.farm.chunk && !plan->has_frames &&
        cli_has_no_effect(cli, "chunk", "there are no frames: a task renders a tile"))
        return CLI_USAGE;
    const int status = cli->options.farm.chunk ? farm_check(cli, plan) : farm_measure(cli, plan);
    if (cli->options.farm.chunk)
        plan->chunk = (uint32_t)cli->options.farm.chunk < plan->frames ? (uint32_t)cli->options.farm.chunk
                                                                       : plan->frames;
    plan->tasks = status == CLI_OK ? (plan->frames - 1) / plan->chunk * plan->tiles + plan->tiles : 0;
    return status;
}

static int pack(struct cli *cli, struct farm_plan *plan) {
    const char *folder = path_join(&cli->arena, str_from(plan->folder), STR("scene")).ptr;
    const char *scene = NULL;
    if (!cli->options.farm.packs)
        return CLI_OK;
    const int status = pack_scene(cli, plan->scene, folder, &scene);
    plan->scene = status == CLI_OK ? path_join(&cli->arena, str_from(folder), str_from(scene)).ptr : NULL;
    return status;
}

static void tell(const struct cli *cli, const struct farm_plan *plan) {
    if (cli->options.quiet)
        return;
    fprintf(stderr, "glint: %u task%s", plan->tasks, plan->tasks == 1 ? "" : "s");
    if (plan->has_frames)
        fprintf(stderr, " of %u frame%s", plan->chunk, plan->chunk == 1 ? "" : "s");
    if (plan->folder)
        fprintf(stderr, ", in %s/%s\n", plan->folder, farm_script_name(plan->engine));
    else
        fprintf(stderr, "; with --folder DIR, 'glint farm status DIR' says which are done\n");
}

static int write_script(struct cli *cli, const struct farm_plan *plan) {
    struct strbuf script;
    strbuf_init(&script);
    farm_write_script(cli, plan, &script);
    const int status = script.failed  ? cli_write_made(cli, "-", &script, "the script")
                       : plan->folder ? farm_save(cli, plan, strbuf_view(&script))
                                      : cli_print(cli, strbuf_view(&script));
    strbuf_finish(&script);
    return status;
}

int cmd_farm(struct cli *cli) {
    struct farm_plan plan = {0};
    if (strcmp(cli->operands[0], "status") == 0)
        return status_of(cli);
    const int engine = engine_of(cli);
    if (engine < 0)
        return CLI_USAGE;
    plan.engine = (enum farm_engine)engine;
    cli->operands++;
    cli->operand_count--;
    if (strcmp(cli->operands[0], "-") == 0)
        return cli_usage(cli, cli_operand_place(cli, 0), "tasks read a file: standard input is gone by then");
    int status = farm_plan_make(cli, &plan);
    if (status == CLI_OK)
        status = farm_begin(cli, &plan);
    if (status == CLI_OK)
        status = choose_tasks(cli, &plan);
    if (status == CLI_OK)
        status = farm_judge_logs(cli, &plan);
    if (status == CLI_OK)
        status = pack(cli, &plan);
    if (status == CLI_OK)
        status = write_script(cli, &plan);
    farm_end(&plan, status);
    if (status == CLI_OK)
        tell(cli, &plan);
    return status;
}
