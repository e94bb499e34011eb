// glint view SCENE: a window (view/); its messages go to standard output, findings to standard error.
#include "cli/commands/commands.h"
#include "cli/device.h"
#include "cli/made.h"
#include "cli/progress.h"
#include "diag/codes/device.h"
#include "diag/codes/limit.h"
#include "grammar/ir.h"
#include "render/live/live_report.h"
#include "window/viewer.h"

#include <stdio.h>
#include <string.h>

enum {
    // Used until the scene is read and its picture's size is known.
    FIRST_WIDTH = 640,
    FIRST_HEIGHT = 480,
};

struct viewing {
    struct cli *cli;
    const char *output;
    enum image_format format;
    int status; // of writing
};

static void say(void *context, str line) {
    struct viewing *v = context;
    struct strbuf text;
    strbuf_init(&text);
    strbuf_str(&text, line);
    strbuf_char(&text, '\n');
    v->status = cli_print(v->cli, strbuf_view(&text));
    strbuf_finish(&text);
}

static void loaded(void *context, struct live *live, bool is_broken) {
    const struct viewing *v = context;
    const struct live_report report = {.live = live, .is_broken = is_broken, .is_view = true};
    struct strbuf text;
    struct session *session = live_findings(live);
    if (session)
        cli_report(v->cli, session, !v->cli->options.quiet);
    if (!v->cli->options.stats)
        return;
    strbuf_init(&text);
    if (v->cli->options.stats == CLI_STATS_JSON) {
        live_json(&report, &text);
        cli_print(v->cli, strbuf_view(&text));
    } else {
        live_text(&report, &text);
        cli_write_error(strbuf_view(&text));
    }
    strbuf_finish(&text);
}

static bool write_picture(void *context, const struct image *image, struct image_display display,
                          uint32_t samples) {
    struct viewing *v = context;
    struct strbuf file;
    strbuf_init(&file);
    image_encode(image, v->format, display, &file);
    const bool done = cli_write_made(v->cli, v->output, &file, "the picture") == CLI_OK;
    if (done && !v->cli->options.quiet)
        fprintf(stderr, "glint: wrote %s, %u x %u, %u sample%s\n", v->output, image->width, image->height,
                samples, samples == 1 ? "" : "s");
    strbuf_finish(&file);
    return done;
}

static bool is_over(void *context) {
    const struct viewing *v = context;
    return interrupt_signal() != 0 || v->status == CLI_PIPE;
}

static int no_window(struct cli *cli, const char *why) {
    cli_error(cli, DIAG_NO_DISPLAY, cli->operands[0],
              "'glint render SCENE --watch -o FILE' follows the scene without a window", "no window: %s",
              why);
    return CLI_DEVICE;
}

static int end(struct viewing *v, enum viewer_status status, struct live *live, struct gpu *gpu) {
    switch (status) {
    case VIEWER_DONE:
        return CLI_OK;
    case VIEWER_BROKEN:
        return cli_report(v->cli, live_findings(live), !v->cli->options.quiet);
    case VIEWER_NO_MEMORY:
        cli_error(v->cli, DIAG_OUT_OF_MEMORY, v->cli->operands[0], NULL, "not enough memory for a window");
        return CLI_FILE;
    default:
        return cli_device_failed(v->cli, gpu);
    }
}

static int run(struct viewing *v, struct window *window, struct gpu *gpu) {
    struct cli *cli = v->cli;
    const str scene = str_from(cli->operands[0]);
    struct viewer_wish wish = {
        .live = {.session = cli_session_options(cli, cli->operands[0]), .camera = cli->options.camera},
        .name = cli->operands[0],
        .is_xml = str_ends_with_nocase(scene, ".xml")};
    const struct viewer_host host = {v, say, loaded, write_picture, is_over};
    struct live live;
    wish.live.session.lint = LINT_CHEAP;
    enum viewer_status status = VIEWER_NO_MEMORY;
    if (live_begin(&live, &wish.live, gpu))
        status = viewer_run(&wish, &host, gpu, window, &live);
    const int code = end(v, status, &live, gpu);
    live_finish(&live);
    return code;
}

static int refuse(struct cli *cli) {
    if (strcmp(cli->operands[0], "-") == 0)
        return cli_usage(cli, cli_operand_place(cli, 0),
                         "a window follows a file, and standard input is none");
    if (cli_device_is_reference(cli))
        return cli_usage(cli, cli_option_place(cli, "device"), "a window needs a device, not the reference");
    return CLI_OK;
}

int cmd_view(struct cli *cli) {
    struct viewing v = {.cli = cli};
    char error[WINDOW_ERROR_BYTES];
    struct gpu *gpu = NULL;
    uint32_t count;
    v.output = cli->options.output ? cli->options.output : cli_default_picture(cli, cli->operands[0]);
    int status = refuse(cli);
    if (status == CLI_OK && !cli->options.output)
        status = cli_judge_made(cli, "", v.output);
    if (status != CLI_OK)
        return status;
    if (!image_format_of_path(str_from(v.output), IMAGE_WRITTEN, &v.format))
        return cli_usage(cli, cli_option_place(cli, "output"),
                         "the output '%s' must end in " IMAGE_WRITTEN_ENDINGS, v.output);
    status = cli_try_scene(cli, cli->operands[0]);
    if (status != CLI_OK)
        return status;
    interrupt_catch();
    const uint32_t width = cli->options.width ? (uint32_t)cli->options.width : FIRST_WIDTH;
    const uint32_t height = cli->options.height ? (uint32_t)cli->options.height : FIRST_HEIGHT;
    struct window *window = window_open(cli->operands[0], width, height, error);
    if (!window)
        return no_window(cli, error);
    const char *const *extensions = window_extensions(window, &count);
    status = cli_open_screen_device(cli, extensions, count, &gpu);
    if (status == CLI_OK)
        status = run(&v, window, gpu);
    cli_close_device(cli, gpu);
    window_close(window);
    return status;
}
