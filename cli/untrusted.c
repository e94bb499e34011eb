// --untrusted: what a command may still do with files from unknown sources.
#include "cli/untrusted.h"

#include "cli/device.h"
#include "cli/memory.h"
#include "files/files_walk.h"
#include "files/git.h"
#include "files/sandbox.h"
#include "files/work_tree.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct allowed {
    struct cli *cli;
    struct files files;
    struct {
        struct sandbox_path *items;
        uint32_t count, capacity;
    } paths;
};

static void allow(struct allowed *a, str path, bool writes) {
    if (path.len)
        *ARENA_PUSH(&a->cli->arena, &a->paths) =
            (struct sandbox_path){arena_copy(&a->cli->arena, path).ptr, writes};
}

// Allows a path that an option gave; NULL: it was not given.
static void allow_given(struct allowed *a, const char *path) {
    allow(a, str_from(path ? path : ""), false);
}

static void allow_output(struct allowed *a, const char *path) {
    if (!path || strcmp(path, "-") == 0)
        return;
    allow(a, path_folder(files_canonical(&a->files, str_from(path))), true);
    if (files_exist(str_from(path)))
        allow(a, str_from(path), true); // a device, or what a link leads to
}

void cli_add_root(struct files *files, str folder) {
    const str inside = path_join(files->arena, files_canonical(files, folder), STR("scene"));
    const str tree = files_work_tree(files, inside);
    if (tree.len)
        files_add_root(files, tree);
    else
        files_add_scene_root(files, inside);
}

// ---- what a command needs

// A scene, or a picture with the scene below its folder: allows what it may read, and itself, which may be a
// link.
static void allow_file(struct allowed *a, const char *path) {
    files_add_scene_root(&a->files, str_from(path));
    allow_given(a, path);
}

static void allow_operands(struct allowed *a, const struct cli_command *command) {
    const struct cli *cli = a->cli;
    const bool tests = strcmp(command->name, "test") == 0;
    for (int i = 0; i < cli->operand_count; i++) {
        const str path = str_from(cli->operands[i]);
        const bool is_folder = files_is_folder(path);
        if (is_folder && tests)
            cli_add_root(&a->files, path);
        else if (is_folder)
            files_add_scene_root(&a->files, path_join(&a->cli->arena, path, STR("scene")));
        else
            allow_file(a, cli->operands[i]);
        if (is_folder)
            files_add_root(&a->files, path);
    }
    if (cli->operand_count == 0 && !cli->options.changed)
        files_add_scene_root(&a->files, STR("scene"));
    if (tests && cli->options.test.bounds)
        cli_add_root(&a->files, path_folder(str_from(cli->options.test.bounds)));
}

static void allow_options(struct allowed *a, const struct cli_command *command) {
    const struct cli_options *o = &a->cli->options;
    for (uint32_t i = 0; i < o->asset_paths.count; i++)
        files_add_root(&a->files, o->asset_paths.items[i]);
    for (const struct option_row *row = NULL; (row = cli_next_option(command, row)) != NULL;) {
        const void *field = (const char *)o + row->offset;
        if (row->kind == OPTION_READ)
            allow_given(a, *(const char *const *)field);
        else if (row->kind == OPTION_WRITTEN)
            allow_output(a, *(const char *const *)field);
    }
    allow_output(a, o->output);
    for (uint32_t i = 0; i < o->outputs.count; i++)
        allow_output(a, o->outputs.items[i].path);
    if (strcmp(command->name, "render") == 0 && o->outputs.count == 0)
        allow(a, STR("."), true);
}

static bool writes_roots(const struct cli_options *o, const struct cli_command *command) {
    return o->test.blesses || (o->fix && !o->diff) ||
           (strcmp(command->name, "format") == 0 && !o->check && !o->diff && !o->output);
}

// docs/ci.md lists these paths. Missing ones are left out.
static void allow_driver(struct allowed *a) {
    static const char *const read[] = {"/usr/share/vulkan",
                                       "/usr/local/share/vulkan",
                                       "/etc/vulkan",
                                       "/usr/share/drirc.d",
                                       "/etc/drirc",
                                       "/usr/share/nvidia",
                                       "/usr/lib",
                                       "/usr/lib64",
                                       "/usr/local/lib",
                                       "/lib",
                                       "/lib64",
                                       "/etc/ld.so.cache",
                                       "/sys/devices",
                                       "/sys/class/drm",
                                       "/sys/dev/char",
                                       "/sys/bus/pci",
                                       "/sys/module",
                                       "/proc",
                                       "/dev/urandom",
                                       NULL};
    static const char *const used[] = {"/dev/dri",
                                       "/dev/nvidiactl",
                                       "/dev/nvidia-uvm",
                                       "/dev/nvidia-modeset",
                                       "/dev/nvidia-uvm-tools",
                                       "/dev/null",
                                       "/dev/shm",
                                       NULL};
    for (const char *const *path = read; *path; path++)
        allow(a, str_from(*path), false);
    for (const char *const *path = used; *path; path++)
        allow(a, str_from(*path), true);
    for (int i = 0; i < 16; i++)
        allow(a, arena_format(&a->cli->arena, "/dev/nvidia%d", i), true);
    allow_given(a, getenv("VK_DRIVER_FILES"));
    allow_given(a, getenv("VK_ICD_FILENAMES"));
}

// ---- all of it

void cli_distrust_git(const struct cli *cli) {
    const struct cli_options *o = &cli->options;
    if (o->untrusted_seconds)
        git_distrust(o->untrusted_seconds, (uint64_t)o->untrusted_megabytes << 20);
}

int cli_enter_untrusted(struct cli *cli, const struct cli_command *command, const char *searched) {
    struct allowed a = {.cli = cli};
    const struct cli_options *o = &cli->options;
    if (o->untrusted_seconds == 0)
        return CLI_OK;
    const bool draws = cli_has_option(command, "device") && !cli_device_is_reference(cli);
    files_init(&a.files, &cli->arena);
    allow_operands(&a, command);
    if (searched)
        files_add_scene_root(&a.files, path_join(&cli->arena, str_from(searched), STR("scene")));
    allow_options(&a, command);
    for (uint32_t i = 0; i < a.files.roots.count; i++)
        allow(&a, a.files.roots.items[i], writes_roots(o, command));
    if (draws)
        allow_driver(&a);
#ifdef __SANITIZE_ADDRESS__
    allow(&a, STR("/proc"), false); // the leak check reads the process's threads there
#endif
    const struct sandbox sandbox = {a.paths.items, a.paths.count, o->untrusted_seconds,
                                    (uint64_t)o->untrusted_megabytes << 20};
    memory_catch_untrusted();
    const int error = sandbox_enter(&sandbox);
    if (!error)
        return CLI_OK;
    cli_usage(cli, cli_option_place(cli, "untrusted"),
              "the system did not take the limits of --untrusted: %s", strerror(error));
    return CLI_REFUSED;
}
