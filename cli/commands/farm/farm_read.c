// The plan of a folder, read back. It does not use the command line, so fuzzing can read plans without one.
#include "cli/commands/farm/farm.h"
#include "render/frames/frame_name.h"
#include "render/parts/part_file.h"

#include <string.h>

const char *const farm_engines[] = {
    [FARM_SLURM] = "slurm", [FARM_PARALLEL] = "parallel", [FARM_K8S] = "k8s", NULL};

static int engine_of(const char *name) {
    for (int i = 0; name && farm_engines[i]; i++)
        if (strcmp(farm_engines[i], name) == 0)
            return i;
    return -1;
}

static bool is_name(const char *pattern, const struct farm_plan *plan) {
    struct strbuf name;
    strbuf_init(&name);
    const bool good = pattern && *pattern && (!plan->has_frames || frame_name(pattern, plan->first, &name));
    strbuf_finish(&name);
    return good;
}

bool farm_plan_read(char *text, struct farm_plan *plan) {
    uint32_t frames[3] = {0, 0, 1};
    if (strncmp(text, FARM_PLAN_HEAD, strlen(FARM_PLAN_HEAD)) != 0)
        return false;
    text += strlen(FARM_PLAN_HEAD);
    const int engine = engine_of(part_take_line(&text, "engine"));
    plan->has_frames = part_take_numbers(&text, "frames", frames, 3);
    if (engine < 0 || !part_take_numbers(&text, "tiles", &plan->tiles, 1) ||
        !part_take_numbers(&text, "chunk", &plan->chunk, 1) || frames[1] < frames[0] || frames[2] == 0 ||
        plan->tiles == 0 || plan->chunk == 0)
        return false;
    plan->engine = (enum farm_engine)engine;
    plan->first = (int32_t)frames[0];
    plan->last = (int32_t)frames[1];
    plan->step = (int32_t)frames[2];
    plan->frames = (frames[1] - frames[0]) / frames[2] + 1;
    plan->root = part_take_line(&text, "root");
    plan->folder = plan->root ? part_take_line(&text, "folder") : NULL;
    plan->output = plan->folder ? part_take_line(&text, "output") : NULL;
    plan->part = plan->output ? part_take_line(&text, "part") : NULL;
    const bool good = is_name(plan->output, plan) && (plan->tiles == 1) == (plan->part == NULL) &&
                      (!plan->part || is_name(plan->part, plan)) && *text == '\0';
    const uint64_t chunks = (plan->frames + (uint64_t)plan->chunk - 1) / plan->chunk;
    if (!good || chunks > INT32_MAX / plan->tiles)
        return false;
    plan->tasks = (uint32_t)chunks * plan->tiles;
    return true;
}
