// The one table of options.
#include "cli/options.h"

#include "core/ranges.h"
#include "edit/fixes.h"
#include "load/session.h"
#include "render/aov/aov.h"

#include <math.h>
#include <stddef.h>

static const struct option_word depths[] = {{"8", 8}, {"16", 16}, {"32", 32}, {0}};
static const struct option_word compressions[] = {
    {"zip", IMAGE_ZIP}, {"piz", IMAGE_PIZ}, {"none", IMAGE_UNCOMPRESSED}, {0}};
static const struct option_word stats[] = {{"", CLI_STATS_TEXT}, {"json", CLI_STATS_JSON}, {0}};
static const struct option_word fixes[] = {{"", FIX_SAFE}, {"all", FIX_ALL}, {0}};
static const struct option_word understood[] = {{"", CLI_IR_WRITTEN}, {"evaluated", CLI_IR_EVALUATED}, {0}};
static const struct option_word goings[] = {{"", false}, {"no", true}, {"yes", false}, {0}};
static const struct option_word spellings[] = {{"yaml", 0}, {"xml", 1}, {0}};
static const struct option_word colors[] = {
    {"auto", CLI_COLOR_AUTO}, {"always", CLI_COLOR_ALWAYS}, {"never", CLI_COLOR_NEVER}, {0}};
static const struct option_word spaces[] = {
    {"auto", CLI_SPACE_AUTO}, {"displayed", CLI_SPACE_DISPLAYED}, {"linear", CLI_SPACE_LINEAR}, {0}};
static const struct option_word tones[] = {{"clip", IR_TONE_CLIP},
                                           {"normalize", IR_TONE_NORMALIZE},
                                           {"neutral", IR_TONE_NEUTRAL},
                                           {"filmic", IR_TONE_FILMIC},
                                           {0}};
static const struct option_word transfers[] = {{"none", IR_TRANSFER_NONE}, {"srgb", IR_TRANSFER_SRGB}, {0}};
static const struct option_word maps[] = {{"difference", false}, {"flip", true}, {0}};

#define FIELD(field)                                                                                         \
    .offset = offsetof(struct cli_options, field), .size = sizeof((struct cli_options *)0)->field
// A field whose type is not the one that its kind writes does not compile.
#define TYPED(field, type)                                                                                   \
    .offset = offsetof(struct cli_options, field),                                                           \
    .size = sizeof *(true ? &((struct cli_options *)0)->field : (type *)0)
#define GIVEN(field)            .given = offsetof(struct cli_options, field)
#define AGAIN                   .kind = OPTION_AGAIN
#define FLAG(field)             .kind = OPTION_FLAG, TYPED(field, bool)
#define TEXT(field)             .kind = OPTION_TEXT, FIELD(field)
#define READ(field)             .kind = OPTION_READ, TYPED(field, const char *)
#define WRITTEN(field)          .kind = OPTION_WRITTEN, TYPED(field, const char *)
#define FOLDER(field)           .kind = OPTION_FOLDER, FIELD(field)
#define LIST(field)             .kind = OPTION_LIST, TYPED(field, struct cli_list)
#define WHOLE(field, from, to)  .kind = OPTION_WHOLE, TYPED(field, int32_t), .least = (from), .most = (to)
#define NUMBER(field, from, to) .kind = OPTION_NUMBER, TYPED(field, double), .least = (from), .most = (to)
#define WORD(field, list)       .kind = OPTION_WORD, FIELD(field), .words = (list)
#define CHOICE(field, list)     .kind = OPTION_CHOICE, TYPED(field, const char *), .words = (list)
#define SYNTAX(reader)          .kind = OPTION_SYNTAX, .read = (reader)

const struct option_row option_rows[] = {
    {"output", 'o', "FILE ...", "render",
     "write to FILE (" IMAGE_WRITTEN_ENDINGS
     "); '-' writes PNG to standard output; several are rendered once",
     SYNTAX(cli_read_output)},
    {"depth", 0, "N", "render merge farm",
     "bits per channel: 16 for PNG instead of 8, or for OpenEXR (half) instead of 32 (float)",
     WORD(depth, depths)},
    {"quality", 0, "N", "render merge farm",
     "of JPEG and WebP: from 1 to 100, instead of 90; WebP is lossless at 100",
     WHOLE(quality, 1, IMAGE_QUALITY_MOST)},
    {"compression", 0, "KIND", "render merge farm", "of OpenEXR: zip (the default), piz or none",
     WORD(compression, compressions)},
    {"output", 'o', "FILE", "tradeoff", "write the report with its plot and pictures to FILE (.html)", AGAIN},
    {"output", 'o', "FILE", "check",
     "write the report to FILE instead of standard error (text) or output (others)", AGAIN},
    {"output", 'o', "FILE", "extremes", "write the report with its matrix to FILE (.html)", AGAIN},
    {"study", 0, "NAME", "extremes",
     "trace by another tracer's method, to see it fail: 'offset 1e-3'; docs/accuracy.md lists the others",
     TEXT(alternative)},
    {"axis", 0, "NAME,...", "extremes", "only these axes: move, scale, distance ...", TEXT(axes)},
    {"thresholds", 0, "FILE", "extremes", "bounds from FILE (YAML) instead of glint's own", READ(thresholds)},
    {"output", 'o', "FILE", "import",
     "write the scene to FILE (.yaml .yml .json .xml); '-' writes YAML to standard output, and no images",
     AGAIN},
    {"force", 0, NULL, "import farm", "overwrite files that exist", FLAG(force)},
    {"force", 0, NULL, "test", "let --bless replace files that are not pictures", AGAIN},
    {"trust-record", 0, NULL, "verify",
     "read the scene and the folders that the picture names wherever they are, and not only below its own "
     "folder",
     FLAG(trust_record)},
    {"size", 0, "WxH", "render view inspect pick tradeoff extremes farm",
     "size of the picture in pixels, instead of the scene's", SYNTAX(cli_read_size), .most = RANGE_SIDE_MOST},
    {"samples", 0, "N", "render view inspect tradeoff farm",
     "rays through each pixel, instead of the scene's", WHOLE(samples, 1, RANGE_SAMPLES_MOST)},
    {"noise", 0, "E", "render",
     "end each pixel once the standard error of its displayed colour is at most E, such as 0.01; with at "
     "most " RANGE_TEXT(SESSION_SAMPLES_MOST) " samples, or those of --samples",
     NUMBER(measure.noise, 1e-6, 1)},
    {"aov", 0, AOV_NAMES, "render",
     "write what else is known of each pixel, one or more separated by commas: as layers of OUT.exr, else "
     "beside OUT as OUT.depth.pfm and so on; 'error' needs --noise",
     SYNTAX(cli_read_aovs)},
    {"sample", 0, "N", "pick", "the sample whose path is shown, counted from 0",
     WHOLE(sample, 0, RANGE_SAMPLES_MOST - 1)},
    {"camera", 0, "NAME", "view pick tradeoff extremes", "the camera to look through", TEXT(camera)},
    {"camera", 0, "NAME", "render", "the camera to look through; 'all' writes OUT.NAME.png for each", AGAIN},
    {"set", 0, "PATH=VALUE ...", "render view pick check inspect deps tradeoff extremes farm",
     "change one value of the scene: materials.glass.refractive_index=1.6; a later one counts", LIST(sets)},
    {"device", 0, "NAME|N", "render view verify test pick tradeoff extremes farm",
     "the device to render on, see 'glint devices'; 'reference' is the tracer in double precision; also "
     "GLINT_DEVICE",
     TEXT(device)},
    {"as-file", 0, NULL, "render", "the reference obeys max_depth, min_weight and depth_limit of the scene",
     FLAG(as_file)},
    {"no-cache", 0, NULL, "render test tradeoff",
     "neither read nor write the cache of the reference and of searches", FLAG(no_cache)},
    {"skip-pixels", 0, NULL, "check inspect",
     "read only the headers of images, which is faster; damaged pixels are not found", FLAG(skip_pixels)},
    {"asset-path", 0, "DIR ...",
     "render view verify test pick check inspect convert deps pack tradeoff extremes import farm",
     "another folder in which to look for files of the scene", FOLDER(asset_paths)},
    {"limit", 0, "NAME=VALUE ...",
     "render view verify test pick check inspect format diff convert deps pack compare tradeoff extremes lsp "
     "import",
     "change a limit on the size of inputs; '--limit help' lists them", SYNTAX(cli_read_limit)},
    {"config", 0, "FILE",
     "render view verify test pick check inspect format diff convert deps pack compare tradeoff extremes lsp "
     "import",
     "settings, written as in .glintrc.yaml, that override those beside the scenes, and may raise limits",
     READ(config)},
    {"untrusted", 0, "[=SECONDS,MB]", "render verify test check inspect format deps",
     "for files from anyone: read only below the folders of the arguments, start no program, and take no "
     "more than " RANGE_TEXT(CLI_UNTRUSTED_SECONDS) " seconds of the processor and " RANGE_TEXT(
         CLI_UNTRUSTED_MEGABYTES) " MB; what is refused has exit status 5",
     SYNTAX(cli_read_untrusted)},
    {"repeat", 0, "N", "render", "render N times and show the median time of a frame and its spread",
     WHOLE(repeat, 1, 100000)},
    {"frames", 0, "A..B[:STEP]|all", "render farm",
     "a picture for each frame of the scene's animation; {expressions} of 'frame' and 'time' in the values "
     "of --set move scenes too",
     SYNTAX(cli_read_frames)},
    {"frame", 0, "N", "render view pick check inspect convert deps tradeoff extremes",
     "the scene as it is in frame N of its animation, counted from 0; without it, its values as they are "
     "written",
     SYNTAX(cli_read_frame)},
    {"frames", 0, "A..B[:STEP]", "merge",
     "a picture for each frame: %d, or %04d, in OUT and PARTs is its number", AGAIN},
    {"fps", 0, "X", "render farm",
     "frames a second, of films and of 'time' in --set, instead of the animation's, or 25",
     NUMBER(batch.fps, RANGE_RATE_LEAST, RANGE_RATE_MOST)},
    {"sweep", 0, "PATH=A:B:N ...", "render",
     "a picture for each of N values from A to B, or of PATH=V,V,...; several are a grid",
     SYNTAX(cli_read_sweep)},
    {"list", 0, "FILE", "render", "render the scenes that FILE names, one a line; '-' is standard input",
     READ(batch.list)},
    {"montage", 0, NULL, "render", "write one sheet with all pictures side by side, in rows",
     FLAG(batch.montage)},
    {"keep-going", 0, "[=no]", "render",
     "render the rest where one of many pictures fails, which is the default; 'no' ends there",
     WORD(batch.stops, goings)},
    {"skip-done", 0, NULL, "render merge",
     "leave out each picture and part that is there whole, and says that it was made of this scene with "
     "these settings",
     FLAG(batch.skip_done)},
    {"output", 'o', "FILE", "farm", "the pictures' name; %04d is the frame, as render has it", AGAIN},
    {"camera", 0, "NAME", "farm", "the camera to look through", AGAIN},
    {"tiles", 0, "N", "farm", "cut each picture into N parts, which are tasks of their own",
     WHOLE(farm.tiles, 1, 2048)},
    {"chunk", 0, "N", "farm",
     "frames of a task, instead of as many as take about a minute by a small picture that is measured",
     WHOLE(farm.chunk, 1, 1000000)},
    {"gpus", 0, "[=N]", "farm", "a GPU for each task; N is how many a host has, for parallel",
     WHOLE(farm.gpus, 1, 64), .otherwise = 1},
    {"folder", 0, "DIR", "farm",
     "write script and plan into this folder, where tasks log; 'glint farm status DIR' follows them",
     TEXT(farm.folder)},
    {"pack", 0, NULL, "farm", "put the scene with all its files into the folder, and render that",
     FLAG(farm.packs)},
    {"sshlogin", 0, "HOST,...", "farm",
     "the hosts that parallel starts tasks on, as its option of that name; ':' is this one",
     TEXT(farm.sshlogin)},
    {"image", 0, "NAME", "farm", "the container image with glint, for k8s", TEXT(farm.image)},
    {"region", 0, "X,Y,W,H", "render",
     "only W x H pixels from X,Y on, which count from 0,0 at the top left: a picture of that size",
     SYNTAX(cli_read_region)},
    {"tile", 0, "I/N", "render",
     "only part I of N, from 1: rows of pixels; 'glint merge' joins parts that -o NAME.part wrote",
     SYNTAX(cli_read_tile)},
    {"samples-from", 0, "A", "render", "only samples from number A on, counted from 0, into -o NAME.part",
     WHOLE(part.samples_from, 0, RANGE_SAMPLES_MOST - 1), GIVEN(part.has_samples)},
    {"samples-to", 0, "B", "render", "only samples before number B, into -o NAME.part",
     WHOLE(part.samples_to, 1, RANGE_SAMPLES_MOST), GIVEN(part.has_samples)},
    {"bands", 0, "[=ROWS]", "render",
     "render bands of ROWS rows one after the other, onto the disk, in little memory, and with --device all "
     "on all devices that are equal; above 64 megapixels always",
     WHOLE(part.band_rows, 1, RANGE_SIDE_MOST)},
    {"resume", 0, NULL, "render",
     "go on from the checkpoint that a stopped run has left, if there is one; SIGTERM leaves one, and exit "
     "status 75",
     FLAG(part.resume)},
    {"partial", 0, NULL, "render", "where the run is stopped, also write what is there to NAME.partial.png",
     FLAG(part.partial)},
    {"bless", 0, NULL, "test",
     "write the pictures that are missing or not within their bounds as new references", FLAG(test.blesses)},
    {"only", 0, "PATTERN", "test", "test only the pictures whose names match, such as 'hall' or 'lamps/*'",
     TEXT(test.only)},
    {"bounds", 0, "FILE", "test",
     "settings and bounds from FILE (YAML) instead of glint-test.yaml in the folder", READ(test.bounds)},
    {"html", 0, "FILE", "test", "write a page with each picture, its reference and their difference to FILE",
     WRITTEN(test.html)},
    {"junit", 0, "FILE", "test", "write the results as JUnit's XML to FILE, for CI", WRITTEN(test.junit)},
    {"watch", 0, NULL, "render",
     "render again each time the scene, or a file that it reads, is saved; ends with Ctrl-C", FLAG(watch)},
    {"stats", 0, "[=json]", "render",
     "show times, sizes, memory and the device: text on standard error, JSON on standard output; "
     "docs/reports.md describes it",
     WORD(stats, stats)},
    {"count-rays", 0, NULL, "render",
     "trace the picture once more, and let the statistics count its rays by kind", FLAG(count_rays),
     .needs = "stats", .why = "only '--stats' shows rays"},
    {"output", 'o', "FILE", "view", "where the key P writes the picture (" IMAGE_WRITTEN_ENDINGS ")", AGAIN},
    {"stats", 0, "[=json]", "view",
     "show what each load did, as --watch does: text on standard error, JSON on standard output", AGAIN},
    {"audit", 0, NULL, "render", "say at most what share of the picture's pixels is off, in the file too",
     FLAG(audit)},
    {"max-off", 0, "X", "render",
     "fail if more than this share of the pixels is off; the audit goes on until it is sure",
     NUMBER(max_off, 0, 1), GIVEN(has_max_off)},
    {"quiet", 'q', NULL, "render merge view test extremes check tradeoff import farm",
     "show only errors and warnings: no notes, no progress", FLAG(quiet)},
    {"verbose", 'v', NULL, "check", "show notes too", FLAG(verbose), .excludes = "quiet",
     .why = "'--quiet' leaves notes out"},
    {"format", 0, "KIND", "check inspect compare verify test tradeoff extremes pick diff deps farm",
     "the format of the report; the text above lists the kinds", TEXT(format)},
    {"severity", 0, "CODE=LEVEL ...", "check", "change the severity of a code: error, warning, note or off",
     SYNTAX(cli_read_severity)},
    {"ignore", 0, "CODE|PATH ...", "check",
     "leave out a code of warnings or notes, or the files that match a pattern: 'drafts/**'",
     SYNTAX(cli_read_ignore)},
    {"only", 0, "CODE ...", "check", "show only these warnings and notes; errors are always shown",
     SYNTAX(cli_read_only)},
    {"fail-on", 0, "LEVEL", "check", "what makes the exit status 1: error (the default) or warning",
     SYNTAX(cli_read_fail_on)},
    {"max-messages", 0, "N", "check", "findings shown per scene; the rest are only counted",
     SYNTAX(cli_read_max_messages)},
    {"changed", 0, NULL, "check",
     "check the scenes that read a changed file: one named, or one that git says differs from REV (HEAD)",
     FLAG(changed)},
    {"baseline", 0, "FILE", "check",
     "report only what is not in FILE, and say which of its findings are gone", READ(baseline)},
    {"write-baseline", 0, "FILE", "check",
     "write the errors and warnings that there are into FILE, for --baseline", WRITTEN(write_baseline)},
#define X(NAME, metric, title, of_displayed, from, to, side, option, argument, fails, holds)                 \
    {option,                                                                                                 \
     0,                                                                                                      \
     argument,                                                                                               \
     "compare",                                                                                              \
     fails,                                                                                                  \
     NUMBER(measure.bounds.bound[METRIC_##NAME], from, to),                                                  \
     GIVEN(measure.bounds.has[METRIC_##NAME])},
#include "picture/metrics/metrics.def"
#undef X
    {"max-not-finite", 0, "N", "compare",
     "how many pixels may be not a number when any bound is given, instead of 0",
     NUMBER(measure.bounds.not_finite, 0, RANGE_BROKEN_MOST)},
    {"threshold", 0, "X", "compare tradeoff", "the threshold for the share of pixels, instead of 1/255",
     NUMBER(measure.threshold, 0, HUGE_VAL), GIVEN(measure.has_threshold)},
    {"ppd", 0, "N", "compare tradeoff",
     "pixels per degree of the viewer's field of view, for FLIP, instead of 67",
     NUMBER(measure.pixels_per_degree, 1, 1000)},
    {"space", 0, "KIND", "compare", "auto, displayed or linear: the values that are compared",
     WORD(measure.space, spaces)},
    {"tone", 0, "KIND", "compare", "clip, normalize, neutral or filmic: how float pictures are displayed",
     WORD(measure.display.tone, tones), GIVEN(measure.has_display)},
    {"exposure", 0, "STOPS", "compare",
     "how much brighter float pictures are displayed, as image.exposure says",
     NUMBER(measure.display.exposure, -100, 100), GIVEN(measure.has_display)},
    {"transfer", 0, "KIND", "compare", "none or srgb: how float pictures are displayed",
     WORD(measure.display.transfer, transfers), GIVEN(measure.has_display)},
    {"heatmap", 0, "FILE", "compare", "write the error of each pixel as colours to FILE (.png)",
     SYNTAX(cli_read_heatmap)},
    {"heatmap-of", 0, "KIND", "compare", "difference (black to 0.001, then three decades) or flip (0 to 1)",
     WORD(measure.heatmap_flip, maps), .needs = "heatmap",
     .why = "no heat map is written without '--heatmap FILE'"},
    {"max-error", 0, "METRIC=X", "tradeoff render",
     "choose the cheapest settings whose error is no larger, such as flip=0.02", TEXT(measure.max_error)},
    {"max-time", 0, "MS", "tradeoff render",
     "choose the best settings whose frame takes no longer, in milliseconds",
     NUMBER(measure.max_time_ms, 1e-6, 1e9)},
    {"allow-resolution", 0, NULL, "render",
     "--max-error and --max-time may choose a smaller picture, which is scaled up to the size asked for",
     FLAG(measure.allow_resolution)},
    {"time", 0, "S", "render",
     "write the picture at most S seconds after the start, with fewer samples if they do not fit",
     NUMBER(measure.time_s, 1e-3, 1e6)},
    {"budget", 0, "S", "tradeoff render",
     "seconds that the measurement may take, for tradeoff 60 by default; what does not fit is left out",
     NUMBER(measure.budget_s, 1, 1e6)},
    {"schema", 0, "ADDRESS", "schema",
     "where install finds the schema (a path or URL), instead of writing it into the scene's folder",
     TEXT(schema)},
    {"output", 'o', "FILE", "format", "write to FILE instead; '-' is standard output", AGAIN},
    {"check", 0, NULL, "format", "write nothing; list the files that would change, and fail if there are any",
     FLAG(check)},
    {"fix", 0, "[=all]", "check",
     "write the fixes that are certain into the files; with =all also suggestions", WORD(fix, fixes)},
    {"diff", 0, NULL, "format check", "write nothing; show what would change as a patch", FLAG(diff)},
    {"upgrade", 0, NULL, "format", "rewrite what older versions of the language spell differently",
     FLAG(upgrade)},
    {"list", 0, NULL, "explain", "list all codes, or those of a family: --list W4xx", FLAG(list)},
    {"expanded", 0, NULL, "convert",
     "write one file without parameters, expressions and includes: the values that they come to",
     FLAG(expanded)},
    {"ir", 0, "[=evaluated]", "inspect",
     "print the scene in canonical form, all files in one; with =evaluated values in the place of what is "
     "computed, and all copies",
     WORD(ir, understood)},
    {"as", 0, "yaml|xml", "render pick check inspect convert deps diff tradeoff extremes format",
     "the spelling of standard input (the argument '-'), instead of what its first character says",
     CHOICE(as, spellings)},
    {"base", 0, "FOLDER", "render pick check inspect convert deps diff tradeoff extremes",
     "the folder that paths in standard input (the argument '-') are relative to, instead of the current one",
     FOLDER(base)},
    {"color", 0, "WHEN", "*-", "colours in messages: always, never, or auto (the default: on a terminal)",
     WORD(color, colors)},
    {"help", 'h', NULL, "*-", "show this help", FLAG(help)},
    {"version", 'V', NULL, "-", "show the version", FLAG(version)},
};
const int option_row_count = sizeof option_rows / sizeof *option_rows;
