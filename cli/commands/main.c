// glint: the command line. Finds the command, parses its options, runs it.
#include "cli/commands/commands.h"

#include "cli/device.h"
#include "cli/memory.h"
#include "cli/untrusted.h"
#include "core/clock.h"
#include "core/nearest.h"
#include "files/sandbox.h"

#include <ctype.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// What a build leaves out: without devices, the commands that measure them; in a WebAssembly module, which a
// browser downloads, those that a page does not need.
#if GLINT_DEVICE
#define MEASURES(run) (run)
#else
#define MEASURES(run) NULL
#endif
#ifdef __EMSCRIPTEN__
#define INSTALLED(run) NULL
#else
#define INSTALLED(run) (run)
#endif

static const struct cli_command commands[] = {
    {"render", "SCENE...", "render a scene to a picture",
     "SCENE is a scene file (YAML or XML), a mesh (OBJ), or '-' for a scene on standard input. Without -o "
     "the\n"
     "picture is written to the current folder and named after the scene.\n\n"
     "  glint render scenes/showcase.glint.yaml\n"
     "  glint render scene.glint.xml -o picture.png --size 640x480 --samples 4\n"
     "  glint render scene.glint.yaml --set materials.glass.refractive_index=1.33 --stats\n"
     "  glint render scene.glint.yaml --sweep materials.glass.refractive_index=1.3:1.7:9 --montage\n"
     "  glint render scene.glint.yaml --frames 0..99 --set 'models[0].rotation.y={3.6*frame}' -o film.mp4\n",
     0, -1, cmd_render},
    {"view", "SCENE", "fly through a scene in a window, and see it change as its file is saved",
     "W A S D fly, E and Q go up and down, the wheel changes the speed. Drag with the left button to look\n"
     "around, with the right one to turn around what was clicked. A click says what is there and in which\n"
     "line. 1 to 9 are the scene's cameras, R goes back; C prints the camera as text for the scene, P "
     "writes\n"
     "the picture. Tab shows colour, normals, depth, cost or error; H hides the text, Escape ends.\n\n"
     "  glint view scenes/showcase.glint.yaml\n",
     1, 1, cmd_view},
    {"check", "SCENE|FOLDER...|--changed [REV] [FILE|FOLDER...]", "find every mistake in scene files",
     "Reads each scene with every file that it names and reports every mistake with its line and column.\n"
     "In folders it checks the files named *.glint.yaml, *.glint.yml and *.glint.xml. The exit status is 0\n"
     "if there are no errors; '-' is a scene on standard input. Settings come from the nearest .glintrc.yaml "
     "above each scene; --config FILE\n"
     "and options override them. A comment 'glint: allow W401' silences a warning on the next line. --format "
     "is one of\n"
     "text, json, sarif, github, gitlab and junit; notes are shown with --verbose and in reports.\n\n"
     "With --changed it checks the scenes that read a changed file: an include, a mesh, a material file, an\n"
     "image, settings. FILEs changed, and so did all that git says differs from the revision REV, which is\n"
     "HEAD if nothing is named. Scenes are those in FOLDERs, or in the whole repository.\n\n"
     "  glint check scenes\n"
     "  glint check scenes --format sarif -o glint.sarif --fail-on warning\n"
     "  glint check --changed origin/main\n",
     0, -1, cmd_check},
    {"inspect", "SCENE|PICTURE", "show what a scene requires, or how a picture was made",
     "Of a scene: counts, bounds, the features that it switches on and where, and the sizes of the buffers.\n"
     "With --ir, prints the scene as glint understood it, in one file: the same text for two files that say\n"
     "the same. With --ir=evaluated it is that of two files that mean the same: expressions are their "
     "values\n"
     "(what moves, and parameters with it, only in a --frame), and every copy is written out.\n\n"
     "Of a picture that glint rendered: its scene's hash, glint's version, the device, settings, the "
     "command\n"
     "that makes it again, and its accuracy (docs/provenance.md). --format is text or json, of both.\n\n"
     "  glint inspect scenes/showcase.glint.yaml\n"
     "  glint inspect picture.png\n",
     1, 1, cmd_inspect},
    {"convert", "IN OUT", "convert between the YAML and the XML spelling",
     "The extensions of IN and OUT (.yaml .yml .json, .xml) determine the spellings; with OUT '-' the\nother "
     "spelling is written to standard output. Comments before entries and includes are kept (JSON\nhas no "
     "comments). If OUT is in another folder, paths are changed to name the same files.\n\n  glint convert "
     "scene.glint.xml scene.glint.yaml\n",
     2, 2, cmd_convert},
    {"import", "FILE", "make a scene of a glTF file (.glb, .gltf)",
     "Writes a scene with a model for each thing that the file shows, its cameras, its lights and its\n"
     "materials, and beside it the images that the file holds; meshes stay in the file. The scene renders\n"
     "as 'glint render FILE' does, and is there to be changed. Without -o it is written to the current\n"
     "folder and named after the file. Files that exist are kept. docs/gltf.md says what becomes of what.\n\n"
     "  glint import car.glb -o scene.glint.yaml\n",
     1, 1, cmd_import},
    {"deps", "SCENE...", "list every file that scenes read",
     "One path per line, each once: scene files, includes, meshes, their material files, the background.\n"
     "--format is one of text; json, with the role of each file and the places that name it; and make,\n"
     "with a rule for each picture.\n\n"
     "  glint deps --format make scenes/showcase.glint.yaml >showcase.d\n",
     1, -1, cmd_deps},
    {"pack", "SCENE OUT", "put a scene and all its files into one folder or ZIP archive",
     "OUT is a ZIP archive if it ends in .zip, otherwise a new folder. Paths are rewritten in the text of\n"
     "the scene; nothing else is changed, and the package renders the same wherever it is put. A mesh by\n"
     "itself is packed with the scene that glint draws around it.\n\n"
     "  glint pack scenes/showcase.glint.yaml showcase.zip\n",
     2, 2, cmd_pack},
    {"lsp", "", "serve an editor through the Language Server Protocol",
     "Uses standard input and output. While you type: every finding of 'glint check' with its fixes; where\n"
     "names are defined and used, across includes; renaming; completion of names, words and files; the\n"
     "outline; formatting. docs/editors.md shows how to make editors start it.\n",
     0, 0, cmd_lsp},
    {"format", "FILE...", "format scene files in one standard layout",
     "Changes indentation, spaces and line breaks; keeps comments, quoting, numbers, anchors and the order\n"
     "of keys. FILE is a scene, a folder with scenes, or '-' for standard input to standard output.\n"
     "docs/format.md describes the layout.\n\n"
     "  glint format scene.glint.yaml\n"
     "  glint format --check scenes\n",
     1, -1, cmd_format},
    {"diff", "A B", "show how two scenes differ in meaning",
     "Lists values that changed and entries that were added, removed, moved or renamed, each with its\n"
     "place in both files. Differences in spelling, comments and the order of keys do not count. --format\n"
     "is text or json. The exit status is 1 if anything differs.\n\n"
     "  glint diff old.glint.yaml new.glint.xml\n",
     2, 2, cmd_diff},
    {"schema", "json|relaxng|rnc|markdown|install FILE...",
     "print the language's schema or reference page, or connect files to it",
     "json: JSON Schema (draft-07) for YAML editors. relaxng, rnc: RELAX NG, in XML and compact syntax,\n"
     "for XML editors.\n"
     "markdown: the reference page. install: adds a line to scene files that tells editors where the\n"
     "schema is, and writes the schema into the same folder (or uses the one at --schema).\n\n"
     "  glint schema install scene.glint.yaml\n",
     1, -1, cmd_schema},
    {"explain", "[CODE|ELEMENT[.ATTRIBUTE]]", "explain a message's code or a part of the language",
     "With --list, one line for each code, or for each of a family. docs/codes.md is a page of all of "
     "them.\n\n"
     "  glint explain E206\n  glint explain material.albedo\n  glint explain --list W4xx\n",
     0, 1, cmd_explain},
    {"compare", "PICTURE REFERENCE", "measure how far one picture is from another",
     "Reads two pictures of the same size: each " IMAGE_COMPARED_NAMES
     ".\nTwo float pictures are compared as\n"
     "linear values; two 8-bit ones, or one of each kind, as displayed values from 0 to 1 (floats are\n"
     "clamped and encoded, see --tone and --transfer). SSIM and FLIP always use displayed values. --format\n"
     "is text or json. The exit status is 1 if a value is beyond its bound.\n\n"
     "  glint compare picture.png reference.png --max-share 0.001 --heatmap errors.png\n",
     2, 2, cmd_compare},
    {"verify", "PICTURE [SCENE]", "render a picture again, and say whether it is still the same",
     "Reads how the picture was made (docs/provenance.md), renders it again with the settings recorded and\n"
     "compares: the scene, before anything is rendered, glint's version, the device, settings and\n"
     "pixels. SCENE is where the scene is now, if not where it was. Relative paths begin at the current\n"
     "folder. --format is text or json. The exit status is 1 if anything differs that should not.\n\n"
     "  glint verify picture.png\n"
     "  glint verify picture.png scenes/moved.glint.yaml\n",
     1, 2, INSTALLED(cmd_verify)},
    {"test", "FOLDER", "render the scenes of a folder again, and compare with their pictures",
     "A scene's picture is beside it, or in a folder 'pictures', and has its name: hall.png of\n"
     "hall.glint.yaml. glint-test.yaml in FOLDER says how pictures are rendered and how far they may be\n"
     "from their references (docs/test.md). --format is text or json. The exit status is 1 if a picture is\n"
     "missing or not within its bounds.\n\n"
     "  glint test scenes --bless             # writes the pictures that are missing, or wrong\n"
     "  glint test scenes --html report.html --junit report.xml\n",
     1, 1, INSTALLED(cmd_test)},
    {"merge", "OUT PART...", "join parts of a picture",
     "PARTs are files that 'glint render -o NAME.part' wrote with --region, --tile, --samples-from and\n"
     "--samples-to, in any order. They must be of one scene, size and settings, and each pixel and sample\n"
     "must be there once. OUT has the same bytes as the picture that is rendered whole. With --frames, OUT\n"
     "and PARTs are names with %04d, and each frame is joined.\n\n"
     "  glint render scene.glint.yaml --tile 1/2 -o 1.part\n"
     "  glint render scene.glint.yaml --tile 2/2 -o 2.part\n"
     "  glint merge picture.png 1.part 2.part\n",
     2, -1, INSTALLED(cmd_merge)},
    {"farm", "slurm|parallel|k8s SCENE, or status DIR",
     "write a script that renders frames and tiles on many machines",
     "The script starts tasks by Slurm, GNU parallel or Kubernetes, and explains itself. A task takes about "
     "a\n"
     "minute, by small pictures that are measured here (--chunk N says how many frames instead), and leaves "
     "out\n"
     "what is done. It is printed, or written into --folder DIR with the plan; 'status DIR' then says what "
     "is\n"
     "done, failed and missing, and which command does the rest. --format of status is text or json; its "
     "exit\n"
     "status is 1 until all pictures are there.\n\n"
     "  glint farm slurm scene.glint.yaml --frames 0..499 --tiles 4 --folder farm -o 'out.%04d.png' \\\n"
     "      --set 'models[0].rotation.y={3.6*frame}'\n"
     "  sh farm/job.sh\n"
     "  glint farm status farm\n",
     2, 2, INSTALLED(cmd_farm)},
    {"extremes", "SCENE", "push a scene to its extremes, and show what breaks",
     "Moves and scales the scene, moves the camera far away, changes refractive indices and specular\n"
     "exponents, adds slivers, coplanar rectangles and narrow gaps, and puts light and camera onto\n"
     "surfaces. Each variant is traced by the device and by the double-precision reference, which shows\n"
     "wrong hits, self-hits, leaks, holes, escapes out of closed bodies, values that are not a number, and\n"
     "image error. --format is text or json; -o writes a report with the matrix. The exit status is 1 if a\n"
     "bound is broken (docs/accuracy.md; --thresholds uses other bounds).\n\n"
     "  glint extremes scenes/showcase.glint.yaml -o report.html\n",
     1, 1, MEASURES(cmd_extremes)},
    {"pick", "SCENE X,Y", "show what is seen at a pixel, and why",
     "Body, material, the lines of scene and mesh, distance and normal, then the path of the ray: each\n"
     "ray's weight, what it hits, which lights shine there, what it adds; as the device traces it and as\n"
     "the reference does in double precision, with the differences. Pixels count from 0,0 at the top left.\n"
     "--format is text or json; --device reference needs no device.\n\n"
     "  glint pick scenes/showcase.glint.yaml 320,200\n",
     2, 2, cmd_pick},
    {"tradeoff", "SCENE", "measure what each setting costs and what error it causes",
     "Renders the scene with one setting changed at a time (max_depth, min_weight, precision, samples,\n"
     "shadows, resolution), then with pairs of those that mattered, and compares time and error with the\n"
     "double-precision reference. Marks the front of the settings worth choosing, and its knee; with\n"
     "--max-error and --max-time, names the settings to choose, as text to paste. --format is text, json\n"
     "or csv; -o writes a report with a plot and pictures. The exit status is 1 if no settings fit.\n\n"
     "  glint tradeoff scene.glint.yaml -o report.html\n"
     "  glint tradeoff scene.glint.yaml --max-error flip=0.02 --max-time 40\n",
     1, 1, MEASURES(cmd_tradeoff)},
    {"devices", "", "list the devices that can render", "", 0, 0, cli_list_devices},
    {"manual", "page|bash|zsh|fish [COMMAND]", "print a man page, or completions for a shell",
     "page: glint(1), or the page of COMMAND, which 'man -l -' shows. bash, zsh, fish: what the shell "
     "completes\n"
     "after 'glint'. An installed glint has both in their places.\n\n"
     "  glint manual page render | man -l -\n"
     "  eval \"$(glint manual bash)\"\n",
     1, 2, INSTALLED(cmd_manual)},
    {0},
};

static const struct cli_command *find_command(const char *name) {
    for (const struct cli_command *c = commands; c->name; c++)
        if (strcmp(c->name, name) == 0)
            return c;
    return NULL;
}

static void init(struct cli *cli, int argc, char **argv) {
    struct strbuf text;
    *cli = (struct cli){.argc = argc, .argv = argv, .commands = commands, .begun = clock_seconds()};
    arena_init(&cli->arena, SIZE_MAX / 2);
    source_set_init(&cli->sources, &cli->arena);
    diag_sink_init(&cli->sink);
    cli->color = cli_has_color(cli, STDERR_FILENO);
    cli->options.limits = limits_default();
    cli->arg_begin = ARENA_ARRAY(&cli->arena, uint32_t, (size_t)argc + 1);
    strbuf_init(&text);
    for (int i = 0; i < argc; i++) {
        if (i)
            strbuf_char(&text, ' ');
        cli->arg_begin[i] = (uint32_t)text.len;
        strbuf_cstr(&text, i == 0 ? "glint" : argv[i]);
    }
    source_add(&cli->sources, SOURCE_KIND_OPTION, STR("command-line"),
               arena_copy(&cli->arena, strbuf_view(&text)));
    strbuf_finish(&text);
}

static void program_help(struct strbuf *out) {
    strbuf_format(out, "Usage: glint COMMAND [OPTION]...\n\n%s\nCommands:\n", cli_purpose);
    for (const struct cli_command *c = commands; c->name; c++)
        strbuf_format(out, "  %-10s %s\n", c->name, c->summary);
    strbuf_cstr(out, "\nOptions:\n");
    cli_option_help(out, NULL);
    strbuf_cstr(out, "\n'glint COMMAND --help' shows more about a command. An option whose value is followed "
                     "by '...' may be\n"
                     "given several times.\n");
    strbuf_cstr(out, cli_exits);
}

static void command_help(struct strbuf *out, const struct cli_command *command) {
    strbuf_format(out, "Usage: glint %s [OPTION]...%s%s\n\n%c%s.\n\n", command->name,
                  command->operands[0] ? " " : "", command->operands,
                  (char)toupper((unsigned char)command->summary[0]), command->summary + 1);
    if (command->details[0])
        strbuf_format(out, "%s\n", command->details);
    strbuf_cstr(out, "Options:\n");
    cli_option_help(out, command);
}

static int show_help(struct cli *cli, const struct cli_command *command) {
    struct strbuf text;
    strbuf_init(&text);
    if (command)
        command_help(&text, command);
    else
        program_help(&text);
    int status = cli_print(cli, strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}

static int show_limits(struct cli *cli) {
    struct strbuf text;
    strbuf_init(&text);
    for (int i = 0; i < LIMIT_COUNT; i++) {
        const struct limit_info *info = limit_info((enum limit)i);
        strbuf_format(&text, "%-16s %12llu  %s\n", info->name, (unsigned long long)info->standard, info->doc);
    }
    int status = cli_print(cli, strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}

static int unknown_command(struct cli *cli, int arg) {
    struct nearest search = nearest_begin(str_from(cli->argv[arg]));
    for (const struct cli_command *c = commands; c->name; c++)
        nearest_offer(&search, str_from(c->name));
    int status = cli_usage(cli, arg, "there is no command '%s'", cli->argv[arg]);
    cli_did_you_mean(cli, &search,
                     arena_format(&cli->arena, "'glint --help' lists the commands%s%s",
                                  arg == 1 ? "; to render a file: glint render " : "",
                                  arg == 1 ? cli->argv[arg] : "")
                         .ptr);
    return status;
}

static int too_many_operands(struct cli *cli, const struct cli_command *command) {
    int arg = cli_operand_place(cli, command->most_operands);
    if (command->most_operands == 0)
        return cli_usage(cli, arg, "'glint %s' takes no argument", command->name);
    return cli_usage(cli, arg, "'glint %s' takes no more than %d argument%s", command->name,
                     command->most_operands, command->most_operands == 1 ? "" : "s");
}

static int run_command(struct cli *cli, const struct cli_command *command) {
    if (!cli_parse_options(cli, command, 2))
        return CLI_USAGE;
    if (cli->options.limit_help)
        return show_limits(cli);
    if (cli->options.help)
        return show_help(cli, command);
    if (cli->options.config && !cli_take_config(cli))
        return CLI_USAGE;
    if (cli->operand_count < command->least_operands)
        return cli_usage(cli, 1, "'glint %s' needs %s", command->name, command->operands);
    if (command->most_operands >= 0 && cli->operand_count > command->most_operands)
        return too_many_operands(cli, command);
    for (int i = 0; i < cli->operand_count; i++)
        if (cli->operands[i][0] == '\0')
            return cli_usage(cli, cli_operand_place(cli, i), "'glint %s' needs %s, but this is empty",
                             command->name, command->operands);
    if (!cli_judge_options(cli) || (!cli->options.batch.has_frames && !cli_fill_sets(cli)))
        return CLI_USAGE;
    int status = cli_take_stream(cli, command);
    cli->command = command;
    if (cli->options.changed) // this asks git first
        cli_distrust_git(cli);
    else if (status == CLI_OK)
        status = cli_enter_untrusted(cli, command, NULL);
    if (status != CLI_OK || command->run)
        return status == CLI_OK ? command->run(cli) : status;
    return cli_left_out(cli, arena_format(&cli->arena, "'glint %s'", command->name).ptr);
}

static int run(struct cli *cli) {
    if (cli->argc < 2) {
        struct strbuf text;
        strbuf_init(&text);
        program_help(&text);
        fwrite(text.data ? text.data : "", 1, text.len, stderr);
        strbuf_finish(&text);
        return cli_usage(cli, 0, "a command is needed");
    }
    if (cli->argv[1][0] == '-') {
        bool good = cli_parse_options(cli, NULL, 1);
        if (good && cli->options.version)
            return cmd_version(cli);
        if (good && cli->options.help)
            return show_help(cli, NULL);
        return good ? cli_usage(cli, 1, "a command is needed before its options") : CLI_USAGE;
    }
    bool help = strcmp(cli->argv[1], "help") == 0;
    if (help && cli->argc == 2)
        return show_help(cli, NULL);
    const struct cli_command *command = find_command(cli->argv[help ? 2 : 1]);
    if (!command)
        return unknown_command(cli, help ? 2 : 1);
    return help ? show_help(cli, command) : run_command(cli, command);
}

// A stream that the caller has closed must not become the first file that is opened.
static void keep_streams(void) {
    int fd;
    do
        fd = open("/dev/null", O_RDONLY);
    while (fd >= 0 && fd <= STDERR_FILENO);
    if (fd >= 0)
        close(fd);
}

int main(int argc, char **argv) {
    struct cli cli;
    keep_streams();
    // A closed pipe and a full disk are errors of the write, with a message, not the end of the process.
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    memory_catch();
    init(&cli, argc, argv);
    int status = run(&cli);
    if (status != CLI_OK && sandbox_refused())
        status = CLI_REFUSED;
    if (cli.sink.count)
        cli_print_sink(&cli, &cli.sink);
    diag_sink_finish(&cli.sink);
    arena_finish(&cli.arena);
    // A driver's exit handlers would free memory that its own threads still use. No output is lost: standard
    // output and error are not buffered.
    if (cli.stuck)
        _exit(status);
    return status;
}
