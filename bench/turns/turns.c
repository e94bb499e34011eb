#include "bench/turns/turns.h"

#include "bench/kit.h"
#include "core/clock.h"
#include "core/number.h"
#include "diag/diag_text.h"
#include "files/output.h"
#include "grammar/ir.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum {
    LINE_BYTES = 4096,
    FRAMES_MOST = BENCH_SAMPLES_MOST,
    SIDE_MOST = 65536,
};

struct turns {
    const struct turns_system *system;
    void *state;
    struct turns_options options;
    struct asset_store *store;
    struct session session;
    struct image image;
    struct bench_series series;
    double load_seconds, open_seconds;
};

enum turns_status turns_say(enum turns_status status, const char *format, ...) {
    va_list args;
    va_start(args, format);
    vfprintf(stderr, format, args);
    va_end(args);
    fputc('\n', stderr);
    return status;
}

// ---- the command line

static bool read_count(const char *text, size_t length, uint32_t *out) {
    int64_t value;
    if (number_parse_integer((str){text, length}, &value) != NUMBER_OK || value < 1 || value > SIDE_MOST)
        return false;
    *out = (uint32_t)value;
    return true;
}

static bool read_size(const char *text, struct turns_options *o) {
    const size_t x = strcspn(text, "x");
    return text[x] && read_count(text, x, &o->width) &&
           read_count(text + x + 1, strlen(text) - x - 1, &o->height);
}

static bool read_option(struct turns_options *o, int letter, const char *text) {
    switch (letter) {
    case 'a':
        o->assets = str_from(text);
        return true;
    case 'd':
        o->device = text;
        return true;
    case 'y':
        o->system = text;
        return true;
    case 'w':
        o->whole = text;
        return true;
    case 's':
        return read_size(text, o);
    case 'n':
        return read_count(text, strlen(text), &o->samples);
    case 't':
        if (o->set_count == TURNS_SETS_MOST)
            return false;
        o->sets[o->set_count++] = str_from(text);
        return true;
    default:
        return false;
    }
}

static bool read_options(int argc, char **argv, struct turns_options *o) {
    static const struct option table[] = {{"assets", 1, NULL, 'a'}, {"device", 1, NULL, 'd'},
                                          {"size", 1, NULL, 's'},   {"samples", 1, NULL, 'n'},
                                          {"set", 1, NULL, 't'},    {"system", 1, NULL, 'y'},
                                          {"whole", 1, NULL, 'w'},  {NULL, 0, NULL, 0}};
    *o = (struct turns_options){.assets = str_from(getenv("GLINT_ASSETS")), .device = getenv("GLINT_DEVICE")};
    for (int letter; (letter = getopt_long(argc, argv, "", table, NULL)) != -1;)
        if (!read_option(o, letter, optarg ? optarg : ""))
            return false;
    o->scene = argv[optind];
    return o->scene && !argv[optind + 1];
}

// ---- the scene

static void report(struct session *session) {
    struct strbuf text;
    strbuf_init(&text);
    diag_text(&text, &session->sink, &session->sources, (struct diag_text_options){.most = 10});
    fwrite(text.data ? text.data : "", 1, text.len, stderr);
    strbuf_finish(&text);
}

static bool load(struct turns *t) {
    const struct turns_options *o = &t->options;
    const struct session_options options = {.path = str_from(o->scene),
                                            .asset_paths = &o->assets,
                                            .asset_path_count = o->assets.len != 0,
                                            .sets = o->sets,
                                            .set_count = o->set_count,
                                            .limits = limits_default(),
                                            .width = (int32_t)o->width,
                                            .height = (int32_t)o->height,
                                            .samples = (int32_t)o->samples};
    const double start = clock_seconds();
    t->store = asset_store_create();
    if (!t->store)
        return false;
    session_load(&t->session, &options, t->store);
    t->load_seconds = clock_seconds() - start;
    if (t->session.state != SESSION_LOADED || t->session.sink.errors) {
        report(&t->session);
        return false;
    }
    return image_init(&t->image, (uint32_t)t->session.image->width, (uint32_t)t->session.image->height);
}

// ---- frames

static bool take_frame(struct turns *t) {
    double device = 0;
    const struct bench_clocks start = bench_clocks_now();
    if (!t->system->frame(t->state, &t->image, &device))
        return false;
    bench_add(&t->series, start, device);
    return true;
}

static void write_series(struct json_writer *w, const char *key, const double *seconds, uint32_t count) {
    json_open_list(w, key);
    for (uint32_t i = 0; i < count; i++)
        json_write_real(w, NULL, seconds[i]);
    json_close_list(w);
}

static uint64_t peak_bytes(void) {
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (uint64_t)usage.ru_maxrss * 1024 : 0;
}

static void write_times(const struct turns *t, struct json_writer *w) {
    write_series(w, "wall", t->series.wall, t->series.count);
    write_series(w, "processor", t->series.processor, t->series.count);
    write_series(w, "device", t->series.device, t->series.count);
    json_write_integer(w, "peak_bytes", peak_bytes());
}

static void write_facts(struct turns *t, struct json_writer *w) {
    json_write_text(w, "system", str_from(t->options.system));
    json_write_integer(w, "width", t->image.width);
    json_write_integer(w, "height", t->image.height);
    json_write_integer(w, "samples", (uint64_t)t->session.image->samples);
    json_write_real(w, "load_s", t->load_seconds);
    json_write_real(w, "assets_s", t->session.assets_seconds);
    json_write_real(w, "open_s", t->open_seconds);
    t->system->facts(t->state, w);
}

static bool say_line(struct turns *t, void (*write)(struct turns *, struct json_writer *)) {
    struct strbuf text;
    struct json_writer writer;
    strbuf_init(&text);
    json_writer_init(&writer, &text, 0);
    json_open_object(&writer, NULL);
    write(t, &writer);
    json_close_object(&writer);
    json_end(&writer);
    const bool good = !text.failed && fwrite(text.data, 1, text.len, stdout) == text.len && !fflush(stdout);
    strbuf_finish(&text);
    return good;
}

static void write_ready(struct turns *t, struct json_writer *w) {
    write_facts(t, w);
    json_write_integer(w, "peak_bytes", peak_bytes());
}

static void write_frames(struct turns *t, struct json_writer *w) {
    write_times(t, w);
}

static bool write_picture(struct turns *t, const char *path) {
    enum image_format format;
    struct strbuf bytes;
    if (!image_format_of_path(str_from(path), IMAGE_WRITTEN, &format))
        return turns_say(TURNS_FAILED, "%s: the output must end in %s", path, IMAGE_WRITTEN_ENDINGS) ==
               TURNS_DONE;
    const struct image_display display = image_display_of(t->session.image);
    strbuf_init(&bytes);
    image_encode(&t->image, format, display, &bytes);
    const int error = bytes.failed ? -1 : output_whole(path, bytes.data, bytes.len);
    strbuf_finish(&bytes);
    if (error)
        turns_say(TURNS_FAILED, "%s: %s", path, error < 0 ? "not enough memory" : strerror(error));
    return error == 0;
}

// ---- the conversation

static bool obey(struct turns *t, char *line) {
    line[strcspn(line, "\r\n")] = 0;
    uint32_t count;
    if (strncmp(line, "frames ", 7) == 0 && read_count(line + 7, strlen(line + 7), &count) &&
        count <= FRAMES_MOST) {
        t->series.count = 0;
        bool good = true;
        for (uint32_t i = 0; i < count && good; i++)
            good = take_frame(t);
        return good && say_line(t, write_frames);
    }
    if (strncmp(line, "picture ", 8) == 0)
        return write_picture(t, line + 8) && say_line(t, write_ready);
    return turns_say(TURNS_FAILED, "no such order: %s", line) == TURNS_DONE;
}

static bool converse(struct turns *t) {
    char line[LINE_BYTES];
    if (!say_line(t, write_ready))
        return false;
    while (fgets(line, sizeof line, stdin) && strncmp(line, "end", 3) != 0)
        if (!obey(t, line))
            return false;
    return true;
}

static double encode_seconds; // of the whole picture

static void write_whole(struct turns *t, struct json_writer *w) {
    write_facts(t, w);
    json_write_real(w, "encode_s", encode_seconds);
    write_times(t, w);
}

static bool make_whole(struct turns *t) {
    if (!take_frame(t))
        return false;
    const double start = clock_seconds();
    if (!write_picture(t, t->options.whole))
        return false;
    encode_seconds = clock_seconds() - start;
    return say_line(t, write_whole);
}

static enum turns_status run(struct turns *t) {
    if (!load(t))
        return TURNS_FAILED;
    const double start = clock_seconds();
    const enum turns_status status = t->system->open(t->state, &t->options, &t->session);
    t->open_seconds = clock_seconds() - start;
    if (status != TURNS_DONE) {
        report(&t->session);
        return status;
    }
    return (t->options.whole ? make_whole(t) : converse(t)) ? TURNS_DONE : TURNS_FAILED;
}

int turns_main(int argc, char **argv, const struct turns_system *system, void *state) {
    static const int exits[] = {[TURNS_DONE] = 0, [TURNS_FAILED] = 1, [TURNS_CANNOT] = TURNS_SKIPPED};
    static struct turns t;
    t = (struct turns){.system = system, .state = state};
    if (!read_options(argc, argv, &t.options)) {
        fputs(
            "usage: SCENE [--assets DIR] [--device NAME|N] [--size WxH] [--samples N] [--set PATH=VALUE]...\n"
            "       [--system NAME] [--whole OUT.png]\n",
            stderr);
        return 2;
    }
    t.options.system = t.options.system ? t.options.system : system->name;
    const enum turns_status status = run(&t);
    system->close(state);
    image_finish(&t.image);
    if (t.store) {
        session_finish(&t.session);
        asset_store_destroy(t.store);
    }
    return exits[status];
}
