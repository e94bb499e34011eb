// glint test FOLDER: every picture of a folder, rendered again and compared with its reference.
#include "cli/commands/commands.h"
#include "cli/commands/test/test.h"
#include "diag/codes/command.h"
#include "diag/codes/limit.h"

#include "core/clock.h"

// ---- new references

static int bless(struct test_run *run, struct test_case *test, const struct test_made *made) {
    struct cli *cli = run->cli;
    if (test->is_foreign && !cli->options.force) {
        const str why = test->is_unread ? test->reason : STR("what is there is not a picture");
        cli_error(cli, DIAG_OUTPUT, test->picture.ptr, "to replace it all the same: --force",
                  "is not written: %.*s", STR_ARG(why));
        return test->is_unread ? CLI_FILE : CLI_REFUSED;
    }
    const int status = cli_write_named(cli, &run->files, test->picture, strbuf_view(&made->file));
    test->is_written = status == CLI_OK;
    return status;
}

// ---- one picture

static int print(struct test_run *run, void (*write)(const struct test_run *, struct strbuf *)) {
    struct strbuf text;
    strbuf_init(&text);
    write(run, &text);
    const int status = cli_write_made(run->cli, "-", &text, "the report");
    strbuf_finish(&text);
    return status;
}

static int tell(struct test_run *run, const struct test_case *test) {
    struct strbuf text;
    strbuf_init(&text);
    test_line(run, test, &text);
    const int status = text.len || text.failed ? cli_write_made(run->cli, "-", &text, "the report") : CLI_OK;
    strbuf_finish(&text);
    return status;
}

static int judge(struct test_run *run, struct test_case *test, const struct test_made *made) {
    if (made && !test_judge(run, test, made)) {
        cli_error(run->cli, DIAG_OUT_OF_MEMORY, test->scene.ptr, NULL,
                  "not enough memory to compare the pictures");
        return CLI_FILE;
    }
    int status = CLI_OK;
    // A reference that cannot be read is replaced as well.
    const bool is_good = test->state == TEST_SAME || test->state == TEST_WITHIN;
    if (made && run->cli->options.test.blesses && !is_good)
        status = bless(run, test, made);
    return status == CLI_OK && run->format == 0 ? tell(run, test) : status;
}

static void drop_libraries(struct test_run *run) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < run->cases.count; i++)
        if (run->cases.items[i].state != TEST_LIBRARY)
            run->cases.items[kept++] = run->cases.items[i];
    run->cases.count = kept;
}

// ---- all of them

static int write_report(struct test_run *run, const char *path,
                        void (*write)(const struct test_run *, struct strbuf *), const char *what) {
    struct strbuf text;
    if (!path)
        return CLI_OK;
    strbuf_init(&text);
    write(run, &text);
    const int status = cli_write_made(run->cli, path, &text, what);
    strbuf_finish(&text);
    return status;
}

static int report(struct test_run *run) {
    const struct cli_test *options = &run->cli->options.test;
    int status = print(run, run->format == 1 ? test_json : test_closing);
    const int html = write_report(run, options->html, test_html, "the page");
    const int junit = write_report(run, options->junit, test_junit, "the report");
    status = status == CLI_OK ? html : status;
    return status == CLI_OK ? junit : status;
}

static void test_finish(struct test_run *run) {
    for (uint32_t i = 0; i < run->cases.count; i++)
        for (int k = 0; k < TEST_SHOWN_COUNT; k++)
            strbuf_finish(&run->cases.items[i].shown[k]);
}

static int judge_outputs(struct cli *cli) {
    const struct cli_test *options = &cli->options.test;
    const int status = cli_try_output(cli, options->html);
    return status == CLI_OK ? cli_try_output(cli, options->junit) : status;
}

int cmd_test(struct cli *cli) {
    static const char *const formats[] = {"text", "json", NULL};
    struct test_run run = {.cli = cli};
    const double start = clock_seconds();
    if (!cli_format(cli, formats, &run.format))
        return CLI_USAGE;
    int status = test_plan(&run);
    if (status == CLI_OK)
        status = judge_outputs(cli);
    if (status == CLI_OK) {
        for (uint32_t i = 0; i < run.cases.count; i++)
            for (int k = 0; k < TEST_SHOWN_COUNT; k++)
                strbuf_init(&run.cases.items[i].shown[k]);
        status = test_render(&run, judge);
        run.seconds = clock_seconds() - start;
        drop_libraries(&run);
        if (status == CLI_OK)
            status = report(&run);
        test_finish(&run);
    }
    return status == CLI_OK && !test_passed(&run) ? CLI_SCENE : status;
}
