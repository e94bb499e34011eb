// How each engine starts the tasks: Slurm, GNU parallel, Kubernetes.
#include "cli/commands/farm/farm.h"

#include <string.h>

const char *farm_script_name(enum farm_engine engine) {
    return engine == FARM_K8S ? "job.yaml" : "job.sh";
}

// ---- what it is, for people

static void explain_plan(const struct farm_plan *plan, struct strbuf *out) {
    const struct farm_pilot *m = &plan->pilot;
    if (plan->has_frames)
        strbuf_format(out, "# %u frames in %u tile%s: %u task%s of %u frame%s", plan->frames, plan->tiles,
                      plan->tiles == 1 ? "" : "s", plan->tasks, plan->tasks == 1 ? "" : "s", plan->chunk,
                      plan->chunk == 1 ? "" : "s");
    else
        strbuf_format(out, "# One picture in %u tile%s, a task each", plan->tiles,
                      plan->tiles == 1 ? "" : "s");
    if (plan->is_measured)
        strbuf_format(out,
                      ", each about %.3g s where it was measured:\n# %.3g s of start, and for each picture "
                      "%.3g s before "
                      "it is traced and %.3g s for all its tiles (%u small pictures up to %u x %u)",
                      m->start_s + plan->chunk * (m->load_s + m->picture_s / plan->tiles), m->start_s,
                      m->load_s, m->picture_s, m->frames, m->width, m->height);
    strbuf_cstr(out, ".\n");
}

static const char slurm_words[] =
    "#     sh job.sh                starts all tasks as a job array, and then the merge\n"
    "#     sh job.sh submit 3,8-9   only these tasks\n"
    "# Options for sbatch come from its environment: SBATCH_PARTITION, SBATCH_ACCOUNT, SBATCH_TIMELIMIT.\n"
    "# A task of a node that fails, or that is preempted, is requeued by Slurm; so is one that ends with "
    "status 75.\n"
    "# It leaves out what is done. Tasks go into as many arrays as MaxArraySize makes necessary (1001 tasks "
    "in "
    "each, unless it is configured).\n";

static const char parallel_words[] =
    "#     sh job.sh                runs all tasks that are not done, and then the merge\n"
    "#     sh job.sh submit 3,8-9   only these tasks\n"
    "# A task that fails is tried three times. Given again, the command does what failed and what was not "
    "begun.\n";

static const char k8s_words[] = "#     kubectl apply -f job.yaml   starts the tasks\n"
                                "# The folder must be in a persistent volume that all nodes can write to: "
                                "its claim is called glint-farm here.\n"
                                "# A task that fails is tried three times; one whose pod is evicted, or that "
                                "ends with status 75 or 143, as often as\n"
                                "# needed. It leaves out what is done.\n";

static const char k8s_merge_words[] =
    "# The merge is suspended until the tasks are complete:\n"
    "#     kubectl wait --for=condition=complete --timeout=-1s job/glint-farm\n"
    "#     kubectl patch job/glint-farm-merge --type=merge -p '{\"spec\": {\"suspend\": false}}'\n";

static void explain(const struct farm_plan *plan, struct strbuf *out) {
    static const char *const words[] = {
        [FARM_SLURM] = slurm_words, [FARM_PARALLEL] = parallel_words, [FARM_K8S] = k8s_words};
    static const char *const names[] = {
        [FARM_SLURM] = "Slurm", [FARM_PARALLEL] = "GNU parallel", [FARM_K8S] = "Kubernetes"};
    strbuf_format(out, "# Written by glint farm %s (glint " GLINT_VERSION "), for %s.\n",
                  farm_engines[plan->engine], names[plan->engine]);
    explain_plan(plan, out);
    strbuf_cstr(out, words[plan->engine]);
    if (plan->engine == FARM_K8S && plan->part)
        strbuf_cstr(out, k8s_merge_words);
    strbuf_cstr(out, "# docs/farm.md says more.\n");
}

// ---- Kubernetes

// The script as a block of YAML. Kubernetes reads "$$" as one '$', and $(NAME) as a variable: each is
// doubled.
static void write_block(str script, struct strbuf *out) {
    strbuf_cstr(out, "            - |\n");
    bool begins = true;
    for (size_t i = 0; i < script.len; i++) {
        const char c = script.ptr[i];
        if (begins && c != '\n')
            strbuf_cstr(out, "              ");
        strbuf_cstr(out, c == '$' ? "$" : "");
        strbuf_char(out, c);
        begins = c == '\n';
    }
}

// As a string in double quotes.
static void quote_yaml(struct strbuf *out, const char *text) {
    strbuf_char(out, '"');
    for (const char *p = text; *p; p++) {
        if (*p == '"' || *p == '\\')
            strbuf_char(out, '\\');
        strbuf_char(out, *p);
    }
    strbuf_char(out, '"');
}

static void write_container(const struct cli_options *o, const struct farm_plan *plan, str script,
                            const char *what, struct strbuf *out) {
    strbuf_cstr(
        out, "  template:\n    spec:\n      restartPolicy: Never\n      containers:\n        - name: glint\n"
             "          image: ");
    quote_yaml(out, o->farm.image ? o->farm.image : "glint:" GLINT_VERSION);
    strbuf_cstr(out, "\n          command: [/bin/sh, -c]\n          args:\n");
    write_block(script, out);
    strbuf_format(out, "            - job\n            - %s\n", what);
    if (o->farm.gpus && strcmp(what, "task") == 0)
        strbuf_cstr(out, "          resources:\n            limits:\n              nvidia.com/gpu: 1\n");
    strbuf_cstr(out, "          volumeMounts:\n            - name: farm\n              mountPath: ");
    quote_yaml(out, plan->root);
    strbuf_cstr(out, "\n      volumes:\n        - name: farm\n          persistentVolumeClaim:\n"
                     "            claimName: glint-farm\n");
}

static void write_k8s(struct cli *cli, const struct farm_plan *plan, struct strbuf *out) {
    struct strbuf script;
    strbuf_init(&script);
    farm_write_tasks(&cli->options, plan, &script);
    strbuf_format(&script,
                  "cd -- \"$root\" || exit 3\n"
                  "case $1 in\n"
                  "task) task \"$JOB_COMPLETION_INDEX\" ;;\n"
                  "%s"
                  "esac\n"
                  "exit \"$status\"\n",
                  plan->part ? "merge) merge ;;\n" : "");
    strbuf_format(
        out,
        "apiVersion: batch/v1\nkind: Job\nmetadata:\n  name: glint-farm\nspec:\n"
        "  completionMode: Indexed\n  completions: %u\n  parallelism: %u\n  backoffLimitPerIndex: 3\n"
        "  podFailurePolicy:\n    rules:\n"
        "      - action: Ignore\n        onPodConditions:\n          - type: DisruptionTarget\n"
        "            status: \"True\"\n"
        "      - action: Ignore\n        onExitCodes:\n          containerName: glint\n"
        "          operator: In\n          values: [75, 143]\n",
        plan->tasks, plan->tasks);
    write_container(&cli->options, plan, strbuf_view(&script), "task", out);
    if (plan->part) {
        strbuf_cstr(out, "---\napiVersion: batch/v1\nkind: Job\nmetadata:\n  name: glint-farm-merge\nspec:\n"
                         "  suspend: true\n  backoffLimit: 3\n");
        write_container(&cli->options, plan, strbuf_view(&script), "merge", out);
    }
    strbuf_finish(&script);
}

void farm_write_script(struct cli *cli, const struct farm_plan *plan, struct strbuf *out) {
    if (plan->engine != FARM_K8S)
        strbuf_cstr(out, "#!/bin/sh\n");
    explain(plan, out);
    if (plan->engine == FARM_K8S) {
        write_k8s(cli, plan, out);
        return;
    }
    farm_write_tasks(&cli->options, plan, out);
    farm_write_engine(&cli->options, plan, out);
}
