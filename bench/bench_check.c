// Reading at size: glint's parsing, binding and checking against the bare event loop of libyaml or expat over
// the same file, in turn, with the memory that glint takes. See README.md.
#include "bench/clocks.h"
#include "core/clock.h"
#include "core/strbuf.h"
#include "grammar/ir.h"
#include "parser/parser.h"

#include <expat.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <yaml.h>

enum {
    ROUNDS_MAX = 64,
    MODELS = 10000,
    MATERIALS_SHARE = 2000, // bytes of the file for each material
};

// What must hold: glint's speed as a part of the event loop's, and its memory as a multiple of the file.
#define SPEED_LEAST 0.5
#define MEMORY_MOST 8.0

struct options {
    uint64_t bytes;
    unsigned rounds;
    const char *folder;
    bool keep;
};

// ---- files

// Numbers that look like those of a person or an exporter, the same in each run.
struct random {
    uint64_t state;
};

static double next(struct random *random, double least, double most) {
    random->state = random->state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return least + (most - least) * (double)(random->state >> 11) / (double)(UINT64_C(1) << 53);
}

struct writer {
    FILE *file;
    struct random random;
    bool xml;
    uint64_t materials;
};

static void write_material(struct writer *w, uint64_t number) {
    double n[9];
    for (int i = 0; i < 8; i++)
        n[i] = next(&w->random, 0, 1);
    n[8] = next(&w->random, 1, 200);
    if (w->xml)
        fprintf(w->file,
                "  <Material name=\"paint_%llu\" specular_exponent=\"%.1f\">\n"
                "    <Albedo diffuse=\"%.2f\" specular=\"%.2f\" reflection=\"%.2f\"/>\n"
                "    <DiffuseColor r=\"%.3f\" g=\"%.3f\" b=\"%.3f\"/>\n  </Material>\n",
                (unsigned long long)number, n[8], n[0], n[1], n[2], n[4], n[5], n[6]);
    else
        fprintf(w->file,
                "  paint_%llu:\n    albedo: {diffuse: %.2f, specular: %.2f, reflection: %.2f}\n"
                "    diffuse_color: [%.3f, %.3f, %.3f]\n    specular_exponent: %.1f\n",
                (unsigned long long)number, n[0], n[1], n[2], n[4], n[5], n[6], n[8]);
}

static void write_sphere(struct writer *w) {
    double n[4];
    for (int i = 0; i < 3; i++)
        n[i] = next(&w->random, -100, 100);
    n[3] = next(&w->random, 0.05, 2);
    unsigned long long paint = (unsigned long long)next(&w->random, 0, (double)w->materials);
    if (w->xml)
        fprintf(w->file,
                "  <Sphere radius=\"%.3f\" material=\"paint_%llu\">\n"
                "    <Center x=\"%.5f\" y=\"%.5f\" z=\"%.5f\"/>\n  </Sphere>\n",
                n[3], paint, n[0], n[1], n[2]);
    else
        fprintf(w->file, "  - {center: [%.5f, %.5f, %.5f], radius: %.3f, material: paint_%llu}\n", n[0], n[1],
                n[2], n[3], paint);
}

static void write_model(struct writer *w) {
    double n[7];
    n[0] = next(&w->random, 0.1, 3);
    for (int i = 1; i < 4; i++)
        n[i] = next(&w->random, -180, 180);
    for (int i = 4; i < 7; i++)
        n[i] = next(&w->random, -1000, 1000);
    unsigned long long paint = (unsigned long long)next(&w->random, 0, (double)w->materials);
    if (w->xml)
        fprintf(w->file,
                "  <Model mesh=\"meshes/stone.obj\" material=\"paint_%llu\" smooth=\"true\" scale=\"%.4f\">\n"
                "    <Rotation x=\"%.3f\" y=\"%.3f\" z=\"%.3f\"/>\n"
                "    <Translation x=\"%.5f\" y=\"%.5f\" z=\"%.5f\"/>\n  </Model>\n",
                paint, n[0], n[1], n[2], n[3], n[4], n[5], n[6]);
    else
        fprintf(w->file,
                "  - mesh: meshes/stone.obj\n    material: paint_%llu\n    smooth: true\n    scale: %.4f\n"
                "    rotation: [%.3f, %.3f, %.3f]\n    translation: [%.5f, %.5f, %.5f]\n",
                paint, n[0], n[1], n[2], n[3], n[4], n[5], n[6]);
}

static void write_frame(struct writer *w, bool begin) {
    static const char yaml[] = "glint: 1\nimage: {width: 640, height: 480}\n"
                               "camera: {position: [0, 0, 500], look_at: [0, 0, 0], fov: 50}\n"
                               "lights:\n  - {position: [200, 300, 400], intensity: 1.5}\n";
    static const char xml[] =
        "<Scene glint=\"1\">\n  <Image width=\"640\" height=\"480\"/>\n"
        "  <Camera fov=\"50\"><Position x=\"0\" y=\"0\" z=\"500\"/>"
        "<LookAt x=\"0\" y=\"0\" z=\"0\"/></Camera>\n"
        "  <Light intensity=\"1.5\"><Position x=\"200\" y=\"300\" z=\"400\"/></Light>\n";
    if (begin)
        fputs(w->xml ? xml : yaml, w->file);
    else if (w->xml)
        fputs("</Scene>\n", w->file);
}

static void heading(struct writer *w, const char *key) {
    if (!w->xml)
        fprintf(w->file, "%s:\n", key);
}

// Materials, then as much of spheres as of models until the size is reached.
static void write_mixed(struct writer *w, uint64_t bytes) {
    w->materials = bytes / MATERIALS_SHARE + 1;
    heading(w, "materials");
    for (uint64_t i = 0; i < w->materials; i++)
        write_material(w, i);
    uint64_t half = ((uint64_t)ftello(w->file) + bytes) / 2;
    heading(w, "spheres");
    while ((uint64_t)ftello(w->file) < half)
        write_sphere(w);
    heading(w, "models");
    while ((uint64_t)ftello(w->file) < bytes)
        write_model(w);
}

static void write_models(struct writer *w) {
    w->materials = 16;
    heading(w, "materials");
    for (uint64_t i = 0; i < w->materials; i++)
        write_material(w, i);
    heading(w, "models");
    for (unsigned i = 0; i < MODELS; i++)
        write_model(w);
}

// `bytes` 0: the models that share a mesh.
static bool write_scene(const char *path, bool xml, uint64_t bytes) {
    struct writer w = {.file = fopen(path, "wb"), .random = {1}, .xml = xml};
    if (!w.file)
        return false;
    write_frame(&w, true);
    if (bytes)
        write_mixed(&w, bytes);
    else
        write_models(&w);
    write_frame(&w, false);
    bool good = !ferror(w.file);
    return fclose(w.file) == 0 && good;
}

// ---- contestants

static char *read_whole(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    fseeko(file, 0, SEEK_END);
    *size = (size_t)ftello(file);
    rewind(file);
    char *text = malloc(*size + 1);
    if (text && fread(text, 1, *size, file) != *size) {
        free(text);
        text = NULL;
    }
    fclose(file);
    return text;
}

// Each event is taken and thrown away.
static bool yaml_events(const char *text, size_t size) {
    yaml_parser_t parser;
    yaml_event_t event;
    if (!yaml_parser_initialize(&parser))
        return false;
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, size);
    bool good = true;
    for (bool end = false; good && !end;) {
        good = yaml_parser_parse(&parser, &event);
        end = good && event.type == YAML_STREAM_END_EVENT;
        if (good)
            yaml_event_delete(&event);
    }
    yaml_parser_delete(&parser);
    return good;
}

static void XMLCALL count_start(void *data, const XML_Char *name, const XML_Char **attributes) {
    (void)name;
    for (; *attributes; attributes += 2)
        ++*(uint64_t *)data;
}
static void XMLCALL count_end(void *data, const XML_Char *name) {
    (void)name;
    ++*(uint64_t *)data;
}
static void XMLCALL count_text(void *data, const XML_Char *text, int length) {
    (void)text;
    *(uint64_t *)data += (uint64_t)length;
}

static bool xml_events(const char *text, size_t size) {
    uint64_t events = 0;
    XML_Parser parser = XML_ParserCreate(NULL);
    if (!parser)
        return false;
    XML_SetUserData(parser, &events);
    XML_SetElementHandler(parser, count_start, count_end);
    XML_SetCharacterDataHandler(parser, count_text);
    bool good = XML_Parse(parser, text, (int)size, 1) == XML_STATUS_OK;
    XML_ParserFree(parser);
    return good && events > 0;
}

static bool run_events(const char *path, bool xml) {
    size_t size;
    char *text = read_whole(path, &size);
    bool good = text && (xml ? xml_events : yaml_events)(text, size);
    free(text);
    return good;
}

static bool load_scene(const char *path, struct arena *arena, struct diag_sink *sink) {
    struct limits limits = limits_default();
    limits.value[LIMIT_SCENE_BYTES] = limit_info(LIMIT_SCENE_BYTES)->greatest;
    limits.value[LIMIT_SCENE_NODES] = limit_info(LIMIT_SCENE_NODES)->greatest;
    limits.value[LIMIT_SCENE_MEMORY] = limit_info(LIMIT_SCENE_MEMORY)->greatest;
    struct source_set sources;
    struct files files;
    struct parser_output output;
    str text;
    source_set_init(&sources, arena);
    files_init(&files, arena);
    if (files_add_scene_root(&files, str_from(path)) != FILE_OK ||
        files_read_given(&files, str_from(path), limits.value[LIMIT_SCENE_BYTES], arena, &text) != FILE_OK)
        return false;
    uint32_t source = source_add(&sources, SOURCE_KIND_FILE, str_from(path), text);
    struct parser_input input = {
        .sources = &sources, .files = &files, .sink = sink, .limits = &limits, .arena = arena};
    return parser_load(&input, source, &output) && ir_body_count(output.scene) > 0;
}

struct job {
    const char *path;
    struct arena arena;
    struct diag_sink sink;
    bool loaded;
};

static void run_job(void *context) {
    struct job *job = context;
    job->loaded = load_scene(job->path, &job->arena, &job->sink);
}

// What `glint check` does before it opens meshes and images.
static bool run_glint(const char *path) {
    struct job job = {.path = path};
    arena_init(&job.arena, SIZE_MAX / 2);
    diag_sink_init(&job.sink);
    arena_guarded(&job.arena, run_job, &job);
    bool good = job.loaded && job.sink.errors == 0; // by chance a number or two look like radians
    diag_sink_finish(&job.sink);
    arena_finish(&job.arena);
    return good;
}

// ---- measuring

struct run {
    double wall, processor; // seconds
    uint64_t peak_bytes;    // of the whole process
    bool good;
};

static double seconds_of(struct timeval t) {
    return (double)t.tv_sec + (double)t.tv_usec * 1e-6;
}

// In a process of its own: memory that one run has touched would be free for the next.
static struct run measure(const char *path, bool xml, bool glint) {
    struct run run = {0};
    double start = clock_seconds();
    fflush(NULL);
    pid_t child = fork();
    if (child == 0)
        _exit((glint ? run_glint(path) : run_events(path, xml)) ? 0 : 1);
    int status = 1;
    struct rusage usage;
    if (child < 0 || wait4(child, &status, 0, &usage) != child)
        return run;
    run.wall = clock_seconds() - start;
    run.processor = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
    run.peak_bytes = (uint64_t)usage.ru_maxrss * 1024;
    run.good = status == 0;
    return run;
}

static bool contest(const char *title, const char *path, bool xml, unsigned rounds) {
    double wall[2][ROUNDS_MAX], processor[2][ROUNDS_MAX], ratios[ROUNDS_MAX];
    uint64_t peak = 0;
    struct stat file;
    bool good = stat(path, &file) == 0;
    for (unsigned i = 0; good && i < rounds; i++) {
        for (int glint = 0; glint < 2; glint++) {
            struct run run = measure(path, xml, glint);
            good = good && run.good;
            wall[glint][i] = run.wall;
            processor[glint][i] = run.processor;
            peak = glint && run.peak_bytes > peak ? run.peak_bytes : peak;
        }
        ratios[i] = processor[0][i] / processor[1][i];
    }
    if (!good) {
        fprintf(stderr, "bench_check: %s: not read without mistakes\n", path);
        return false;
    }
    double events = bench_median(wall[0], rounds), glint = bench_median(wall[1], rounds);
    double megabytes = (double)file.st_size / 1e6;
    // Judged by processor time: what else runs makes one process wait longer than the other.
    double share = bench_median(ratios, rounds), memory = (double)peak / (double)file.st_size;
    good = share >= SPEED_LEAST && memory <= MEMORY_MOST;
    printf("%-22s %7.1f MB  %s %6.1f MB/s  glint %6.1f MB/s  speed %.2f (processor %.2f)  memory %.1f x%s\n",
           title, megabytes, xml ? "expat  " : "libyaml", megabytes / events, megabytes / glint,
           events / glint, share, memory, good ? "" : ": FAIL");
    return good;
}

static bool run_case(const struct options *options, const char *title, bool xml, uint64_t bytes) {
    struct strbuf path;
    strbuf_init(&path);
    strbuf_format(&path, "%s/bench_check_%s_%ld.%s", options->folder, bytes ? "mixed" : "models",
                  (long)getpid(), xml ? "xml" : "yaml");
    strbuf_char(&path, '\0');
    const char *name = strbuf_view(&path).ptr;
    bool good = write_scene(name, xml, bytes);
    if (!good)
        fprintf(stderr, "bench_check: %s: cannot be written\n", name);
    good = good && contest(title, name, xml, options->rounds);
    if (options->keep)
        printf("  %s\n", name);
    else
        unlink(name);
    strbuf_finish(&path);
    return good;
}

static bool read_options(int argc, char **argv, struct options *options) {
    for (int i = 1; i < argc; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : NULL;
        if (strcmp(argv[i], "--keep") == 0) {
            options->keep = true;
            continue;
        }
        if (!value)
            return false;
        if (strcmp(argv[i], "--megabytes") == 0)
            options->bytes = strtoull(value, NULL, 10) * 1000000;
        else if (strcmp(argv[i], "--rounds") == 0)
            options->rounds = (unsigned)strtoul(value, NULL, 10);
        else if (strcmp(argv[i], "--folder") == 0)
            options->folder = value;
        else
            return false;
        i++;
    }
    return options->bytes && options->rounds && options->rounds <= ROUNDS_MAX;
}

int main(int argc, char **argv) {
    struct options options = {.bytes = 100000000, .rounds = 5, .folder = "."};
    if (!read_options(argc, argv, &options)) {
        fprintf(stderr, "usage: bench_check [--megabytes N] [--rounds N] [--folder DIR] [--keep]\n");
        return 2;
    }
    bool good = true;
    for (int xml = 0; xml < 2; xml++) {
        good = run_case(&options, xml ? "mixed scene, XML" : "mixed scene, YAML", xml, options.bytes) && good;
        good = run_case(&options, xml ? "10 000 models, XML" : "10 000 models, YAML", xml, 0) && good;
    }
    return good ? 0 : 1;
}
