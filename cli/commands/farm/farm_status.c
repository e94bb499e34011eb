// glint farm status DIR: which tasks are done, judged by their files and logs, and the command that does the
// rest.
#include "cli/commands/farm/farm.h"
#include "core/heap.h"
#include "core/json_write.h"
#include "files/stream.h"
#include "render/parts/part_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum task_state {
    TASK_DONE,
    TASK_FAILED,  // its last attempt ended with a status other than 0
    TASK_MISSING, // not begun, or at work
};

enum {
    LOG_BYTES = 1 << 20,
    HOST_BYTES = 80,
    FAILED_SHOWN = 5,
};

struct task {
    enum task_state state;
    int status; // of the last attempt
    char host[HOST_BYTES];
};

struct farm_state {
    struct cli *cli;
    const char *folder;
    struct farm_plan plan;
    struct task *tasks;
    bool *pictures; // by number of the frame
    uint32_t counts[TASK_MISSING + 1], pictures_there;
};

// ---- files

static bool is_there(const char *path) {
    struct strbuf file;
    strbuf_init(&file);
    const bool there = stream_read_file(path, 16, &file) == 0 && file.len > 0;
    strbuf_finish(&file);
    return there;
}

// Files have their names once they are whole: the head of a part says what it is.
static bool is_part(const char *path) {
    struct part *part = heap_zeroed(1, sizeof *part);
    struct strbuf error;
    strbuf_init(&error);
    const bool good = part && part_read(path, true, part, &error);
    if (part)
        part_finish(part);
    free(part);
    strbuf_finish(&error);
    return good;
}

static int32_t frame_at(const struct farm_plan *plan, uint32_t number) {
    return plan->first + (int32_t)number * plan->step;
}

static bool has_files(struct farm_state *s, uint32_t task) {
    const struct farm_plan *plan = &s->plan;
    const uint32_t tile = task % plan->tiles + 1, begin = task / plan->tiles * plan->chunk;
    for (uint32_t i = begin; i < begin + plan->chunk && i < plan->frames; i++)
        if (!s->pictures[i] && (!plan->part || !is_part(farm_part(s->cli, plan, frame_at(plan, i), tile))))
            return false;
    return true;
}

// ---- logs

// The text after `key` in the last line of a log.
static const char *value_in(const char *line, const char *key) {
    const char *at = strstr(line, key);
    return at ? at + strlen(key) : NULL;
}

static void read_log(struct farm_state *s, uint32_t number) {
    struct task *task = &s->tasks[number];
    const char *path = arena_format(&s->cli->arena, "%s/log/%u.jsonl", s->folder, number).ptr;
    struct strbuf file;
    strbuf_init(&file);
    const bool good = stream_read_file(path, LOG_BYTES, &file) == 0 && file.len > 0;
    strbuf_char(&file, '\0');
    if (good && !file.failed) {
        const char *line = file.data;
        for (const char *p = line; (p = strchr(p, '\n')) && p[1]; p++)
            line = p + 1;
        const char *host = value_in(line, "\"host\": \""), *status = value_in(line, "\"status\": ");
        task->status = status ? (int)strtol(status, NULL, 10) : 0;
        if (host)
            snprintf(task->host, sizeof task->host, "%.*s", (int)strcspn(host, "\"\n"), host);
        task->state = task->status ? TASK_FAILED : TASK_MISSING;
    }
    strbuf_finish(&file);
}

// ---- all tasks

static void look(struct farm_state *s) {
    const struct farm_plan *plan = &s->plan;
    for (uint32_t i = 0; i < plan->frames; i++) {
        s->pictures[i] = is_there(farm_picture(s->cli, plan, frame_at(plan, i)));
        s->pictures_there += s->pictures[i];
    }
    for (uint32_t i = 0; i < plan->tasks; i++) {
        s->tasks[i].state = TASK_MISSING;
        if (has_files(s, i))
            s->tasks[i].state = TASK_DONE;
        else
            read_log(s, i);
        s->counts[s->tasks[i].state]++;
    }
}

// "3,7-12": the tasks that are not done.
static void write_list(const struct farm_state *s, struct strbuf *out) {
    const char *comma = "";
    for (uint32_t i = 0; i < s->plan.tasks; i++) {
        uint32_t end = i;
        if (s->tasks[i].state == TASK_DONE)
            continue;
        while (end + 1 < s->plan.tasks && s->tasks[end + 1].state != TASK_DONE)
            end++;
        strbuf_format(out, end > i ? "%s%u-%u" : "%s%u", comma, i, end);
        comma = ",";
        i = end;
    }
}

static bool is_complete(const struct farm_state *s) {
    return s->pictures_there == s->plan.frames;
}

static void write_rest(const struct farm_state *s, struct strbuf *out) {
    const bool tasks_done = s->counts[TASK_DONE] == s->plan.tasks;
    const char *script =
        arena_format(&s->cli->arena, "%s/%s", s->folder, farm_script_name(s->plan.engine)).ptr;
    if (s->plan.engine == FARM_K8S) {
        strbuf_cstr(
            out, tasks_done
                     ? "kubectl patch job/glint-farm-merge --type=merge -p '{\"spec\": {\"suspend\": false}}'"
                     : "kubectl delete --ignore-not-found -f ");
        if (tasks_done)
            return;
        farm_quote(out, script);
        strbuf_cstr(out, " && kubectl apply -f ");
        farm_quote(out, script);
        return;
    }
    strbuf_cstr(out, "sh ");
    farm_quote(out, script);
    if (tasks_done) {
        strbuf_cstr(out, " merge");
        return;
    }
    strbuf_cstr(out, " submit ");
    write_list(s, out);
}

static void put_text(const struct farm_state *s, struct strbuf *out) {
    const struct farm_plan *plan = &s->plan;
    uint32_t shown = 0;
    strbuf_format(out, "%u of %u pictures\n", s->pictures_there, plan->frames);
    strbuf_format(out, "%u of %u tasks done, %u failed, %u not begun or at work\n", s->counts[TASK_DONE],
                  plan->tasks, s->counts[TASK_FAILED], s->counts[TASK_MISSING]);
    for (uint32_t i = 0; i < plan->tasks; i++)
        if (s->tasks[i].state == TASK_FAILED && shown++ < FAILED_SHOWN)
            strbuf_format(out, "  task %u ended with status %d on %s\n", i, s->tasks[i].status,
                          s->tasks[i].host);
    if (shown > FAILED_SHOWN)
        strbuf_format(out, "  and %u more\n", shown - FAILED_SHOWN);
    if (is_complete(s))
        return;
    strbuf_cstr(out, "what does the rest, once no task is at work:\n  ");
    write_rest(s, out);
    strbuf_char(out, '\n');
}

static void put_tasks(const struct farm_state *s, enum task_state state, const char *key,
                      struct json_writer *w) {
    json_open_list(w, key);
    for (uint32_t i = 0; i < s->plan.tasks; i++) {
        if (s->tasks[i].state != state)
            continue;
        if (state == TASK_MISSING) {
            json_write_integer(w, NULL, i);
            continue;
        }
        json_open_object(w, NULL);
        json_write_integer(w, "task", i);
        json_write_integer(w, "status", (uint64_t)s->tasks[i].status);
        json_write_text(w, "host", str_from(s->tasks[i].host));
        json_close_object(w);
    }
    json_close_list(w);
}

static void put_json(const struct farm_state *s, struct strbuf *out) {
    struct json_writer w;
    struct strbuf rest;
    strbuf_init(&rest);
    json_report_begin(&w, out, 2, "glint farm status", 1);
    json_write_text(&w, "engine", str_from(farm_engines[s->plan.engine]));
    json_write_integer(&w, "pictures", s->plan.frames);
    json_write_integer(&w, "written", s->pictures_there);
    json_write_integer(&w, "tasks", s->plan.tasks);
    json_write_integer(&w, "done", s->counts[TASK_DONE]);
    put_tasks(s, TASK_FAILED, "failed", &w);
    put_tasks(s, TASK_MISSING, "missing", &w);
    if (is_complete(s)) {
        json_write_null(&w, "rest");
    } else {
        write_rest(s, &rest);
        json_write_text(&w, "rest", strbuf_view(&rest));
    }
    json_report_end(&w);
    strbuf_finish(&rest);
}

int farm_status(struct cli *cli, const char *folder) {
    static const char *const kinds[] = {"text", "json", NULL};
    struct farm_state s = {.cli = cli, .folder = folder};
    struct strbuf text;
    int kind = 0;
    if (!cli_format(cli, kinds, &kind))
        return CLI_USAGE;
    int status = farm_load(cli, folder, &s.plan);
    if (status != CLI_OK)
        return status;
    s.tasks = ARENA_ARRAY(&cli->arena, struct task, s.plan.tasks);
    s.pictures = ARENA_ARRAY(&cli->arena, bool, s.plan.frames);
    look(&s);
    strbuf_init(&text);
    (kind == 1 ? put_json : put_text)(&s, &text);
    status = cli_write_made(cli, "-", &text, "the report");
    strbuf_finish(&text);
    return status == CLI_OK && !is_complete(&s) ? CLI_SCENE : status;
}
