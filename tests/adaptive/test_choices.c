// Random scenes, and whether `auto` chooses their precision well: single where that is right, double where
// single would be wrong.
//
// Usage: test_choices [--count N] [--seed S] [--family NAME,...] [--size WxH] [--keep FOLDER] [--all]
//   [--max-wrong N] [--max-needless SHARE]
// Families take turns (tests/sweep/families.def). FOLDER, which exists, gets the scenes that are not right,
// with
// --all every scene, to be rendered and looked at; the report names the same ones. The exit status is 1 if
// single was chosen for more than --max-wrong scenes where it is wrong, or more than --max-needless of the
// doubles were not needed.
#include "core/number.h"
#include "files/files.h"
#include "tests/pictures/picture_kit.h"
#include "tests/sweep/sweep.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct run {
    struct picture_kit kit;
    struct sweep_input input;
    struct sweep sweep;
    struct sweep_report report;
    const char *keep; // NULL: nothing is kept
};

static bool judge(struct run *run, const struct sweep_scene *made) {
    struct arena arena;
    struct file_overlay overlays[SWEEP_MESHES + 1];
    arena_init(&arena, SIZE_MAX);
    // Scenes are read in a place where no other file is.
    for (uint32_t i = 0; i <= made->mesh_count; i++)
        overlays[i] = (struct file_overlay){
            path_join(&arena, STR("/"), str_from(i ? made->meshes[i - 1].name : made->name)),
            strbuf_view(i ? &made->meshes[i - 1].text : &made->text)};
    const struct session_options options = {.path = overlays[0].path,
                                            .overlays = overlays,
                                            .overlay_count = made->mesh_count + 1,
                                            .limits = limits_default()};
    struct session session;
    const bool good = session_load(&session, &options, run->kit.store) == SESSION_LOADED &&
                      !session.sink.errors &&
                      sweep_judge(&run->sweep, &run->input, made, &session.resolved) == SWEEP_DONE;
    session_finish(&session);
    arena_finish(&arena);
    return good;
}

static bool keep_file(const char *folder, const char *name, const struct strbuf *text) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    const bool good = file && fwrite(text->data, 1, text->len, file) == text->len;
    return file && fclose(file) == 0 && good;
}

static bool keep(const struct run *run, const struct sweep_scene *made) {
    bool good = keep_file(run->keep, made->name, &made->text);
    for (uint32_t i = 0; i < made->mesh_count; i++)
        good = keep_file(run->keep, made->meshes[i].name, &made->meshes[i].text) && good;
    return good;
}

static bool take_scene(struct run *run, uint32_t index) {
    enum sweep_family family;
    uint32_t number;
    struct sweep_scene made;
    sweep_which(&run->input, index, &family, &number);
    sweep_scene_make(&made, run->input.seed, family, number);
    bool good = !made.text.failed && judge(run, &made);
    if (!good)
        printf("FAIL %s is not drawn\n", made.name);
    else if (run->keep && (run->report.all || sweep_is_noted(&run->sweep.items[run->sweep.count - 1])) &&
             !(good = keep(run, &made)))
        printf("FAIL %s is not written to %s\n", made.name, run->keep);
    sweep_scene_finish(&made);
    return good;
}

// ---- the command line

static bool read_families(const char *text, uint64_t *families) {
    *families = 0;
    for (size_t length; *text; text += length + (text[length] == ',')) {
        length = strcspn(text, ",");
        int found = 0;
        while (found < SWEEP_FAMILIES &&
               !str_equal((str){text, length}, str_from(sweep_families[found].name)))
            found++;
        if (found == SWEEP_FAMILIES)
            return false;
        *families |= UINT64_C(1) << found;
    }
    return *families;
}

static bool read_count(const char *text, uint32_t *out) {
    int64_t value;
    if (number_parse_integer(str_from(text), &value) != NUMBER_OK || value < 0 || value > 1000000)
        return false;
    *out = (uint32_t)value;
    return true;
}

static bool read_options(int argc, char **argv, struct run *run) {
    static const struct option longs[] = {
        {"count", required_argument, NULL, 'c'},
        {"seed", required_argument, NULL, 's'},
        {"family", required_argument, NULL, 'f'},
        {"size", required_argument, NULL, 'x'},
        {"keep", required_argument, NULL, 'k'},
        {"all", no_argument, NULL, 'a'},
        {"max-wrong", required_argument, NULL, 'w'},
        {"max-needless", required_argument, NULL, 'n'},
        {NULL, 0, NULL, 0},
    };
    struct sweep_input *input = &run->input;
    for (int option; (option = getopt_long(argc, argv, "", longs, NULL)) != -1;) {
        bool good = option != '?';
        if (option == 'c')
            good = read_count(optarg, &input->count);
        else if (option == 's')
            input->seed = strtoull(optarg, NULL, 10);
        else if (option == 'f')
            good = read_families(optarg, &input->families);
        else if (option == 'x')
            good = sscanf(optarg, "%ux%u", &input->width, &input->height) == 2;
        else if (option == 'k')
            run->keep = optarg;
        else if (option == 'a')
            run->report.all = true;
        else if (option == 'w')
            good = read_count(optarg, &run->report.max_wrong);
        else if (option == 'n')
            run->report.max_needless = strtod(optarg, NULL);
        if (!good)
            return false;
    }
    return optind == argc && input->count && input->width && input->height;
}

static int take_scenes(struct run *run) {
    bool good = sweep_init(&run->sweep, &run->input);
    for (uint32_t i = 0; good && i < run->input.count; i++)
        good = take_scene(run, i);
    if (good) {
        struct strbuf text;
        strbuf_init(&text);
        sweep_text(&run->report, &text);
        fwrite(text.data, 1, text.len, stdout);
        strbuf_finish(&text);
        good = !sweep_is_broken(&run->report);
    }
    sweep_finish(&run->sweep);
    return !good;
}

int main(int argc, char **argv) {
    struct run run = {.input = {.count = 2 * SWEEP_FAMILIES,
                                .width = 64,
                                .height = 48,
                                .families = (UINT64_C(1) << SWEEP_FAMILIES) - 1},
                      .report = {.max_needless = 0.05}};
    if (!read_options(argc, argv, &run)) {
        fprintf(stderr, "test_choices: the first lines of test_choices.c say what it takes\n");
        return 2;
    }
    const struct limits limits = limits_default();
    run.input.limits = &limits;
    run.report.sweep = &run.sweep;
    run.report.input = &run.input;
    if (!picture_kit_open(&run.kit) || run.kit.by_reference || !gpu_info(run.kit.gpu)->has_double)
        return 77;
    run.input.gpu = run.kit.gpu;
    const int status = take_scenes(&run);
    return picture_kit_close(&run.kit) ? 1 : status;
}
