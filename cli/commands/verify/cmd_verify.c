// glint verify PICTURE [SCENE]: renders a picture again the way its record says, and compares.
#include "cli/commands/commands.h"
#include "cli/commands/verify/verify.h"

#include "cli/commands/rendering.h"
#include "cli/device.h"
#include "core/heap.h"
#include "core/number.h"
#include "diag/codes/file.h"
#include "diag/codes/limit.h"
#include "files/files.h"
#include "grammar/ir.h"
#include "render/record/provenance.h"
#include "scene/content.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    DEVICES_MAX = 32
};

// ---- the picture

static int read_picture(struct verify *v) {
    struct cli *cli = v->cli;
    const struct limits *limits = &cli->options.limits;
    struct files *files = ARENA_NEW(&cli->arena, struct files);
    bool unknown;
    files_init(files, &cli->arena);
    const enum file_status read =
        files_read_given(files, str_from(v->path), limits->value[LIMIT_IMAGE_BYTES], &cli->arena, &v->bytes);
    if (read != FILE_OK) {
        cli_error(cli, session_file_code(read), v->path, NULL, "%s", file_status_text(files, read));
        return CLI_FILE;
    }
    record_find(v->bytes, &v->was);
    const char *fault =
        picture_file_decode(v->bytes, limits->value[LIMIT_IMAGE_MEMORY], &v->pictures[0], &unknown);
    if (fault) {
        cli_error(cli, unknown ? DIAG_IMAGE_KIND : DIAG_IMAGE_BROKEN, v->path, NULL, "%s", fault);
        return CLI_SCENE;
    }
    return CLI_OK;
}

static int no_record(struct verify *v) {
    cli_error(v->cli, DIAG_IMAGE_KIND, v->path,
              "docs/provenance.md says which pictures do; 'glint compare' compares any two",
              v->was.is_there
                  ? "the picture's record of how it was made cannot be understood: its command is "
                    "not one that glint writes"
                  : "the picture does not say how it was made");
    return CLI_SCENE;
}

// The file's record must not make this process read or write anything but its scene.
static int read_record(struct verify *v) {
    struct cli *cli = v->cli;
    if (!v->was.is_there || !record_read_command(v->was.fields[RECORD_COMMAND], &cli->arena, &v->command))
        return no_record(v);
    if (cli->operand_count > 1)
        v->scene = cli->operands[1];
    else if (str_equal(v->command.scene, STR("-")))
        return cli_usage(cli, cli_operand_place(cli, 0),
                         "the picture was made of a scene on standard input: name a file with the scene");
    else
        v->scene = arena_copy(&cli->arena, v->command.scene).ptr;
    if (!cli->options.trust_record) {
        cli->named_in = path_folder(str_from(v->path));
        cli->names_scene = cli->operand_count == 1;
    }
    return CLI_OK;
}

// ---- the same settings

static void add_paths(struct verify *v) {
    struct cli_list *own = &v->cli->options.asset_paths;
    if (v->cli->named_in.len)
        v->cli->named_asset_paths = v->command.asset_path_count;
    for (uint32_t i = 0; i < v->command.asset_path_count; i++)
        *(str *)ARENA_PUSH(&v->cli->arena, own) = v->command.asset_paths[i];
}

// The device of the record, if it is here and no other was asked for.
static const char *device_of(struct verify *v) {
    struct gpu_device_info *items = ARENA_ARRAY(&v->cli->arena, struct gpu_device_info, DEVICES_MAX);
    char error[GPU_ERROR_BYTES] = "";
    uint32_t count = 0;
    const str device = v->was.fields[RECORD_DEVICE];
    if (cli_device_wanted(v->cli))
        return v->cli->options.device;
    if (v->command.is_reference)
        return "reference";
    if (gpu_list(items, DEVICES_MAX, &count, error) != GPU_OK)
        return NULL;
    for (uint32_t i = 0; i < count && i < DEVICES_MAX; i++)
        if (str_starts_with(device, str_from(items[i].name)))
            return items[i].name;
    return NULL;
}

static void take_settings(struct verify *v) {
    struct cli_options *o = &v->cli->options;
    const struct image_coding *coding = &v->command.coding;
    add_paths(v);
    o->depth = (int32_t)coding->bits;
    o->quality = (int32_t)coding->quality;
    o->compression = (int)coding->compression;
    o->device = device_of(v);
    o->quiet = true;
}

static struct session_options scene_options(const struct verify *v) {
    const struct record_command *c = &v->command;
    struct session_options options = cli_session_options(v->cli, v->scene);
    options.sets = c->sets;
    options.set_count = c->set_count;
    options.width = c->width;
    options.height = c->height;
    options.samples = c->samples;
    options.error = cli_device_is_reference(v->cli) ? -1 : c->noise; // the reference takes all samples
    options.lint = LINT_CHEAP;
    options.whole_picture = true;
    return options;
}

static struct job_wish job_wish(const struct verify *v) {
    const struct record_command *c = &v->command;
    const bool by_reference = cli_device_is_reference(v->cli);
    return (struct job_wish){.by_reference = by_reference,
                             .as_file = c->as_file,
                             .no_cache = v->cli->options.no_cache,
                             .audits = (c->audit || c->max_off >= 0) && !by_reference,
                             .max_off = c->max_off};
}

// ---- the scene, before anything is rendered

static int judge_scene(struct verify *v, struct session *session) {
    struct cli *cli = v->cli;
    const bool good = session->state == SESSION_LOADED && session->sink.errors == 0;
    const int status = good ? CLI_OK : cli_report(cli, session, false);
    if (good)
        scene_content_text(&session->resolved, v->scene_hash);
    else if (status == CLI_REFUSED)
        fprintf(stderr,
                "glint: the picture names what is not below its own folder; to read it all the same: "
                "--trust-record%s%s%s\n",
                cli->names_scene ? ", or glint verify " : "", cli->names_scene ? v->path : "",
                cli->names_scene ? " SCENE" : "");
    else if (session->state == SESSION_UNREADABLE && cli->operand_count == 1)
        fprintf(stderr,
                "glint: that is the scene that the picture names; if it is elsewhere now: glint verify %s "
                "SCENE\n",
                v->path);
    if (good && !str_equal_cstr(v->was.fields[RECORD_SCENE], v->scene_hash))
        fprintf(stderr, "glint: %s was changed since the picture was made, or is another scene\n", v->scene);
    return status;
}

// ---- the picture again

static int no_memory_for_picture(struct verify *v) {
    cli_error(v->cli, DIAG_OUT_OF_MEMORY, "-", NULL, "not enough memory for the picture");
    return CLI_SCENE;
}

// Scales to the size that the picture had, if it was scaled up.
static int scale(struct verify *v, struct job *job) {
    int32_t width, height;
    const bool is_scaled = number_parse_size(v->was.fields[RECORD_SCALED], "x", INT32_MAX, &width, &height);
    return !is_scaled || job_scale_up(job, (uint32_t)width, (uint32_t)height) ? CLI_OK
                                                                              : no_memory_for_picture(v);
}

static enum image_format format_of(const struct verify *v) {
    for (int format = 0; format < IMAGE_FORMATS; format++)
        if (strcmp(image_format_info((enum image_format)format)->name, v->pictures[0].kind) == 0)
            return (enum image_format)format;
    return IMAGE_PNG;
}

static void encode(struct verify *v, struct job *job) {
    const enum image_format format = format_of(v);
    job->image.coding = render_coding(&v->cli->options, format);
    const struct provenance made = job_provenance(job, format, job->image.coding);
    job->image.texts = provenance_texts(&made, job->arena);
    image_encode(&job->image, format, v->display, &v->made);
}

// A picture with faulty pixels counts, and its errors are reported.
static int draw(struct verify *v, struct job *job) {
    struct progress progress;
    const struct render_progress callback = progress_callback(&progress);
    progress_begin(&progress, true);
    enum shot_status status = job_draw(job, 1, &callback);
    if (status == SHOT_OK) {
        job_state_estimate(job);
        status = job_audit(job, &callback);
    }
    if (status != SHOT_OK)
        return render_not_drawn(v->cli, job, status, false);
    const int scaled = scale(v, job);
    if (scaled != CLI_OK)
        return scaled;
    encode(v, job);
    render_tell_audit(v->cli, job);
    cli_report(v->cli, job->session, false);
    return CLI_OK;
}

static int make_picture(struct verify *v, struct job *job) {
    struct cli *cli = v->cli;
    const struct ir_image *image = job->session->image;
    const uint32_t camera = session_camera(job->session, v->command.camera);
    int status = CLI_OK;
    if (camera == IR_NO_INDEX)
        return cli_report(cli, job->session, false);
    if (!image_init(&job->image, (uint32_t)image->width, (uint32_t)image->height))
        return no_memory_for_picture(v);
    v->display = job_display(job);
    cli->operands[0] = (char *)v->scene;
    if (!job->wish.by_reference)
        status = cli_open_device(cli, &job->gpu);
    if (status != CLI_OK)
        return status;
    const enum shot_status opened = job_open(job, camera);
    return opened == SHOT_OK ? draw(v, job) : render_not_drawn(v->cli, job, opened, false);
}

static int make(struct verify *v) {
    struct session session;
    const struct session_options options = scene_options(v);
    struct asset_store *store = asset_store_create();
    struct job job = {.session = &session, .arena = &v->cli->arena, .wish = job_wish(v)};
    session_load(&session, &options, store);
    int status = judge_scene(v, &session);
    interrupt_catch();
    if (status == CLI_OK)
        status = make_picture(v, &job);
    job_close(&job);
    cli_close_device(v->cli, job.gpu);
    session_finish(&session);
    asset_store_destroy(store);
    return status;
}

// ---- pixels

static bool is_other(float a, float b) {
    return a != b && !(isnan(a) && isnan(b));
}

static void count_pixels(struct verify *v) {
    const struct picture_file *p = v->pictures;
    const uint64_t pixels = (uint64_t)p[0].width * p[0].height;
    struct verify_pixels *out = &v->pixels;
    double most = -1;
    out->count = pixels;
    for (uint64_t i = 0; i < pixels; i++) {
        bool differs = false;
        for (uint32_t k = 0; k < 3; k++) {
            const float was = p[0].rgb[3 * i + k], is = p[1].rgb[3 * i + k];
            const double off = isfinite(was) && isfinite(is) ? fabs((double)was - is) : INFINITY;
            if (!is_other(was, is))
                continue;
            differs = true;
            if (off > most)
                out->worst = (struct measure_place){(uint32_t)(i % p[0].width), (uint32_t)(i / p[0].width), k,
                                                    was, is};
            most = fmax(most, off);
        }
        out->differ += differs;
    }
}

static bool measure_displayed(struct verify *v) {
    struct picture_file *p = v->pictures;
    struct measure_options options = measure_options_default();
    struct measure_result result;
    for (int i = 0; i < 2; i++)
        if (p[i].space == MEASURE_LINEAR)
            image_to_displayed(p[i].rgb, (size_t)p[i].width * p[i].height, v->display, p[i].rgb);
    options.threshold = VERIFY_OFF;
    options.metrics = 1u << METRIC_MAE | 1u << METRIC_SHARE;
    if (!measure_pictures(p[0].width, p[0].height, p[0].rgb, p[1].rgb, &options, &result, NULL, NULL))
        return false;
    v->pixels.share = result.value[METRIC_SHARE];
    v->pixels.mean = result.value[METRIC_MAE];
    return true;
}

static int no_memory(struct verify *v) {
    cli_error(v->cli, DIAG_OUT_OF_MEMORY, v->path, NULL, "not enough memory to compare the pictures");
    return CLI_FILE;
}

static int compare(struct verify *v) {
    struct picture_file *p = v->pictures;
    bool unknown;
    const str made = strbuf_view(&v->made);
    const char *fault =
        picture_file_decode(made, v->cli->options.limits.value[LIMIT_IMAGE_MEMORY], &p[1], &unknown);
    if (fault || v->made.failed)
        return no_memory(v);
    record_find(made, &v->is);
    if (p[0].width != p[1].width || p[0].height != p[1].height) {
        v->pixels = (struct verify_pixels){.count = (uint64_t)p[0].width * p[0].height,
                                           .differ = (uint64_t)p[0].width * p[0].height,
                                           .share = 1,
                                           .mean = 1};
        return CLI_OK;
    }
    count_pixels(v);
    return v->pixels.differ == 0 || measure_displayed(v) ? CLI_OK : no_memory(v);
}

// ---- all of it

static int verify(struct verify *v) {
    int status = read_picture(v);
    if (status == CLI_OK)
        status = read_record(v);
    if (status != CLI_OK)
        return status;
    take_settings(v);
    status = make(v);
    if (status == CLI_OK)
        status = compare(v);
    if (status != CLI_OK)
        return status;
    struct strbuf text;
    strbuf_init(&text);
    (v->format == 1 ? verify_json : verify_text)(v, &text);
    status = cli_write_made(v->cli, "-", &text, "the report");
    strbuf_finish(&text);
    return status == CLI_OK && !verify_holds(v) ? CLI_SCENE : status;
}

int cmd_verify(struct cli *cli) {
    static const char *const formats[] = {"text", "json", NULL};
    struct verify v = {.cli = cli, .path = cli->operands[0]};
    if (!cli_format(cli, formats, &v.format))
        return CLI_USAGE;
    strbuf_init(&v.made);
    const int status = verify(&v);
    strbuf_finish(&v.made);
    for (int i = 0; i < 2; i++)
        picture_file_finish(&v.pictures[i]);
    return status;
}
