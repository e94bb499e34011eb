// libFuzzer entry: any bytes as the plan of a farm, with its first line made right. What is read can be
// worked through: frames and tasks that can be counted.
#include "cli/commands/farm/farm.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool holds, const char *what) {
    if (holds)
        return;
    fprintf(stderr, "the plan of a farm broke its promise: %s\n", what);
    abort();
}

static void check(const struct farm_plan *plan) {
    require(plan->engine <= FARM_K8S && farm_engines[plan->engine], "an engine that is known");
    require(plan->first >= 0 && plan->first <= plan->last && plan->step > 0, "frames that go on");
    require(plan->frames == (uint32_t)(plan->last - plan->first) / (uint32_t)plan->step + 1,
            "each is counted");
    const uint64_t chunks = ((uint64_t)plan->frames + plan->chunk - 1) / plan->chunk;
    require(plan->tasks > 0 && plan->tasks == chunks * plan->tiles, "each task has frames of a tile");
    require(*plan->output && plan->root && plan->folder, "names");
    require((plan->tiles > 1) == (plan->part != NULL), "tiles have names of their own");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const size_t head = strlen(FARM_PLAN_HEAD);
    struct farm_plan plan = {0};
    char *text = malloc(head + size + 1);
    if (!text)
        abort();
    memcpy(text, FARM_PLAN_HEAD, head);
    if (size)
        memcpy(text + head, data, size);
    text[head + size] = '\0';
    if (farm_plan_read(text, &plan))
        check(&plan);
    free(text);
    return 0;
}
