// glint format FILE...: scene files in canonical layout.
#include "cli/commands/commands.h"
#include "cli/commands/folder_scenes.h"
#include "core/text_diff.h"
#include "diag/codes/limit.h"
#include "diag/diag_text.h"
#include "edit/layout.h"

#include <stdio.h>
#include <string.h>

struct formatter {
    struct cli *cli;
    struct strbuf out; // patches, or names of files
    int status;
};

static void worsen(struct formatter *f, int status) {
    f->status = status > f->status ? status : f->status;
}

// Errors only: what the file means does not matter for its layout.
static void tell(struct formatter *f, struct layout *layout) {
    struct strbuf text;
    struct diag_text_options options = {.color = f->cli->color,
                                        .most = (uint32_t)f->cli->options.limits.value[LIMIT_MESSAGES],
                                        .alike = cli_text_alike(&f->cli->options.limits)};
    strbuf_init(&text);
    diag_text(&text, &layout->sink, &layout->sources, options);
    cli_write_error(strbuf_view(&text));
    strbuf_finish(&text);
}

static int write_found(struct cli *cli, const char *path, const char *folder, str text) {
    struct files files;
    files_init(&files, &cli->arena);
    files_add_scene_root(&files, str_from(path));
    files_add_root(&files, str_from(folder));
    return cli_write_named(cli, &files, str_from(path), text);
}

static void write_result(struct formatter *f, const char *path, const char *folder,
                         const struct layout *layout) {
    const struct cli_options *o = &f->cli->options;
    str text = layout->status == LAYOUT_CHANGED ? strbuf_view(&layout->result) : layout->text;
    bool is_stream = strcmp(path, "-") == 0;
    if (o->output || is_stream)
        worsen(f, cli_write(f->cli, o->output ? o->output : "-", text));
    else if (layout->status == LAYOUT_CHANGED && folder)
        worsen(f, write_found(f->cli, path, folder, text));
    else if (layout->status == LAYOUT_CHANGED)
        worsen(f, cli_write(f->cli, path, text));
}

// `folder`: the folder that it was found in; NULL: it was named.
static void take(struct formatter *f, const char *path, const char *folder, struct layout *layout) {
    const struct cli_options *o = &f->cli->options;
    if (layout->status > LAYOUT_CHANGED) {
        tell(f, layout);
        worsen(f, layout->status == LAYOUT_UNREADABLE ? CLI_FILE : CLI_SCENE);
        return;
    }
    if (!o->check && !o->diff) {
        write_result(f, path, folder, layout);
        return;
    }
    if (layout->status == LAYOUT_SAME)
        return;
    if (o->diff)
        text_diff(str_from(path), layout->text, str_from(path), strbuf_view(&layout->result), &f->out);
    else
        strbuf_format(&f->out, "%s\n", path);
    if (o->check)
        worsen(f, CLI_SCENE);
}

static void format_stream(struct formatter *f) {
    struct strbuf text;
    struct layout layout;
    strbuf_init(&text);
    int status = cli_read_stream(f->cli, &text);
    if (status == CLI_OK) {
        layout_text(&layout, cli_stream_name(f->cli), strbuf_view(&text), &f->cli->options.limits,
                    f->cli->options.upgrade);
        take(f, "-", NULL, &layout);
        layout_finish(&layout);
    }
    worsen(f, status);
    strbuf_finish(&text);
}

static void format_file(struct formatter *f, const char *path, const char *folder) {
    struct layout layout;
    layout_file(&layout, str_from(path), str_from(folder), &f->cli->options.limits, f->cli->options.upgrade);
    take(f, path, folder, &layout);
    layout_finish(&layout);
}

static void format_folder(struct formatter *f, int operand) {
    const char *path = f->cli->operands[operand];
    struct scene_names found = {0};
    const int status = cli_find_scenes(f->cli, path, &found);
    worsen(f, status);
    for (uint32_t i = 0; i < found.paths.count; i++)
        format_file(f, found.paths.items[i].ptr, path);
    if (status == CLI_OK && !found.paths.count)
        worsen(f, cli_no_scene(f->cli, cli_operand_place(f->cli, operand), path, &found));
    else
        cli_tell_others(f->cli, &found);
}

int cmd_format(struct cli *cli) {
    struct formatter f = {.cli = cli, .status = CLI_OK};
    const struct cli_options *o = &cli->options;
    bool folder = files_is_folder(str_from(cli->operands[0]));
    if (o->output && (cli->operand_count > 1 || folder || o->check || o->diff))
        return cli_usage(cli, cli_option_place(cli, "output"),
                         "-o needs exactly one file, and neither --check nor --diff");
    strbuf_init(&f.out);
    for (int i = 0; i < cli->operand_count; i++) {
        const char *path = cli->operands[i];
        if (strcmp(path, "-") == 0)
            format_stream(&f);
        else if (files_is_folder(str_from(path)))
            format_folder(&f, i);
        else
            format_file(&f, path, NULL);
    }
    if (f.out.failed) {
        cli_error(cli, DIAG_OUT_OF_MEMORY, "format", NULL, "not enough memory for the report");
        worsen(&f, CLI_FILE);
    } else if (f.out.len) {
        worsen(&f, cli_print(cli, strbuf_view(&f.out)));
    }
    strbuf_finish(&f.out);
    return f.status;
}
