// What a task and the merge do, as functions of a shell of POSIX: the same for all engines.
#include "cli/commands/farm/farm.h"

#include "core/number.h"

#include <string.h>

void farm_quote(struct strbuf *out, const char *word) {
    strbuf_char(out, '\'');
    for (const char *p = word; *p; p++)
        if (*p == '\'')
            strbuf_cstr(out, "'\\''");
        else
            strbuf_char(out, *p);
    strbuf_char(out, '\'');
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

// How a picture is coded: options of the command that writes it.
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

// ---- templates: shell that is written as shell, with words in @ and lines with a condition

extern const char farm_tasks_sh[], farm_slurm_sh[], farm_parallel_sh[]; // *.sh.in of this folder

enum word {
    WORD_ROOT,
    WORD_OUTPUT,
    WORD_PART,
    WORD_FOLDER,
    WORD_FIRST,
    WORD_LAST,
    WORD_STEP,
    WORD_CHUNK,
    WORD_TILES,
    WORD_TASKS,
    WORD_OPTIONS,
    WORD_CODING,
    WORD_SCENE,
    WORD_JOBS,
    WORD_HOSTS,
    WORDS,
};
static const char *const word_names[WORDS] = {"@root@",    "@output@", "@part@",  "@folder@", "@first@",
                                              "@last@",    "@step@",   "@chunk@", "@tiles@",  "@tasks@",
                                              "@options@", "@coding@", "@scene@", "@jobs@",   "@hosts@"};

struct filling {
    const struct farm_plan *plan;
    bool gpus;
    struct strbuf words[WORDS];
};

static bool holds(const struct filling *f, str condition) {
    const bool is_not = str_starts_with(condition, STR("no-"));
    const str name = is_not ? str_slice(condition, 3, condition.len) : condition;
    const bool is = str_equal(name, STR("frames"))   ? f->plan->has_frames
                    : str_equal(name, STR("parts"))  ? f->plan->part != NULL
                    : str_equal(name, STR("folder")) ? f->plan->folder != NULL
                                                     : f->gpus;
    return is != is_not;
}

static void fill_words(const struct filling *f, str line, struct strbuf *out) {
    for (size_t at = 0; at < line.len;) {
        int word = 0;
        while (word < WORDS && !str_starts_with(str_slice(line, at, line.len), str_from(word_names[word])))
            word++;
        if (word < WORDS)
            strbuf_str(out, strbuf_view(&f->words[word]));
        else
            strbuf_char(out, line.ptr[at]);
        at += word < WORDS ? strlen(word_names[word]) : 1;
    }
    strbuf_char(out, '\n');
}

// A line that ends with " #@ A no-B" is kept if A holds and B does not.
static void fill_line(const struct filling *f, str line, struct strbuf *out) {
    const str mark = STR(" #@ ");
    size_t end = 0;
    while (end < line.len && !str_starts_with(str_slice(line, end, line.len), mark))
        end++;
    for (size_t at = end + mark.len; at < line.len;) {
        size_t stop = at;
        while (stop < line.len && line.ptr[stop] != ' ')
            stop++;
        if (!holds(f, str_slice(line, at, stop)))
            return;
        at = stop + 1;
    }
    fill_words(f, str_slice(line, 0, end), out);
}

static void fill(const struct filling *f, const char *template, struct strbuf *out) {
    for (const char *line = template; *line;) {
        const size_t length = strcspn(line, "\n");
        fill_line(f, (str){line, length}, out);
        line += length + (line[length] == '\n');
    }
}

static void begin_filling(struct filling *f, const struct cli_options *o, const struct farm_plan *plan) {
    *f = (struct filling){.plan = plan, .gpus = o->farm.gpus};
    for (int i = 0; i < WORDS; i++)
        strbuf_init(&f->words[i]);
    struct strbuf *const w = f->words;
    farm_quote(&w[WORD_ROOT], plan->root);
    farm_quote(&w[WORD_OUTPUT], plan->output);
    farm_quote(&w[WORD_PART], plan->part ? plan->part : "");
    farm_quote(&w[WORD_FOLDER], plan->folder ? plan->folder : "");
    farm_quote(&w[WORD_SCENE], plan->scene);
    strbuf_format(&w[WORD_FIRST], "%d", (int)plan->first);
    strbuf_format(&w[WORD_LAST], "%d", (int)plan->last);
    strbuf_format(&w[WORD_STEP], "%d", (int)plan->step);
    strbuf_format(&w[WORD_CHUNK], "%u", plan->chunk);
    strbuf_format(&w[WORD_TILES], "%u", plan->tiles);
    strbuf_format(&w[WORD_TASKS], "%u", plan->tasks);
    add_options(o, &w[WORD_OPTIONS]);
    add_coding(o, plan->part ? &w[WORD_CODING] : &w[WORD_OPTIONS]);
    if (o->farm.gpus && plan->engine == FARM_PARALLEL)
        strbuf_cstr(&w[WORD_OPTIONS], " --device \"$2\"");
    // A task uses all processors of its host, or a GPU.
    strbuf_format(&w[WORD_JOBS], "%d", o->farm.gpus ? (int)o->farm.gpus : 1);
    if (o->farm.sshlogin)
        strbuf_cstr(&w[WORD_HOSTS], " --sshlogin "), farm_quote(&w[WORD_HOSTS], o->farm.sshlogin);
}

static void end_filling(struct filling *f, struct strbuf *out) {
    for (int i = 0; i < WORDS; i++) {
        out->failed |= f->words[i].failed;
        strbuf_finish(&f->words[i]);
    }
}

void farm_write_tasks(const struct cli_options *options, const struct farm_plan *plan, struct strbuf *out) {
    struct filling f;
    begin_filling(&f, options, plan);
    fill(&f, farm_tasks_sh, out);
    end_filling(&f, out);
}

void farm_write_engine(const struct cli_options *options, const struct farm_plan *plan, struct strbuf *out) {
    struct filling f;
    begin_filling(&f, options, plan);
    fill(&f, plan->engine == FARM_SLURM ? farm_slurm_sh : farm_parallel_sh, out);
    end_filling(&f, out);
}
