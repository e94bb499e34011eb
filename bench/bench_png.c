// How long a picture takes to be written as PNG, and how large it is: glint's way, and libpng alone at its
// own settings on one thread, in turns.
//
//     bench_png [PICTURE]...
//
// A PICTURE is what a scene may name as an image, of 8 bits per channel; without one it is docs/showcase.png.
// Milliseconds by the clock and of processor time, the least of the rounds; bytes of the file.
#include "kit.h"
#include "picture/read/picture_read.h"
#include "picture/write/encode_internal.h"

#include <errno.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROUNDS = 7,
    WAYS = 2
};

struct job {
    uint32_t width, height;
    const uint8_t *rgb;
    struct strbuf file;
};

static void on_write(png_structp png, png_bytep bytes, size_t count) {
    strbuf_add(png_get_io_ptr(png), bytes, count);
}

// A failure ends the program, as libpng does by itself.
static void by_libpng(struct job *job) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &job->file, on_write, NULL);
    png_set_IHDR(png, info, job->width, job->height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    for (uint32_t y = 0; y < job->height; y++)
        png_write_row(png, job->rgb + (size_t)3 * job->width * y);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
}

static void by_glint(struct job *job) {
    encode_png(job->width, job->height, job->rgb, NULL, &job->file);
}

static void measure(const char *path, struct job *job) {
    static const struct {
        const char *name;
        void (*write)(struct job *);
    } ways[WAYS] = {{"libpng alone", by_libpng}, {"glint", by_glint}};
    struct bench_series series[WAYS] = {{0}};
    size_t bytes[WAYS] = {0};
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < WAYS; i++) {
            strbuf_clear(&job->file);
            const struct bench_clocks start = bench_clocks_now();
            ways[i].write(job);
            bench_add(&series[i], start, 0);
            bytes[i] = job->file.len;
        }
    printf("%s: %u x %u\n  %-14s %10s %10s %12s\n", path, job->width, job->height, "", "clock", "processor",
           "bytes");
    for (int i = 0; i < WAYS; i++)
        printf("  %-14s %7.1f ms %7.1f ms %12zu\n", ways[i].name, 1e3 * bench_least(series[i].wall, ROUNDS),
               1e3 * bench_least(series[i].processor, ROUNDS), bytes[i]);
}

static bool read_file(const char *path, struct strbuf *bytes) {
    FILE *file = fopen(path, "rb");
    char piece[4096];
    size_t count;
    if (!file)
        return false;
    while ((count = fread(piece, 1, sizeof piece, file)) > 0)
        strbuf_add(bytes, piece, count);
    fclose(file);
    return true;
}

static const char *measure_picture(const char *path) {
    struct strbuf bytes;
    struct picture_header header;
    struct picture picture = {0};
    strbuf_init(&bytes);
    const char *fault = read_file(path, &bytes) ? NULL : strerror(errno);
    if (!fault)
        fault = picture_read_header(strbuf_view(&bytes), &header);
    if (!fault)
        fault = picture_depth_of(&header) == PICTURE_8
                    ? picture_decode(strbuf_view(&bytes), &header, &picture)
                    : "it does not have 8 bits per channel";
    if (!fault) {
        struct job job = {.width = picture.width, .height = picture.height, .rgb = picture.pixels};
        strbuf_init(&job.file);
        measure(path, &job);
        strbuf_finish(&job.file);
    }
    picture_finish(&picture);
    strbuf_finish(&bytes);
    return fault;
}

int main(int argc, char **argv) {
    const char *standard[] = {"docs/showcase.png"};
    const char *const *paths = argc > 1 ? (const char *const *)argv + 1 : standard;
    for (int i = 0; i < (argc > 1 ? argc - 1 : 1); i++) {
        const char *fault = measure_picture(paths[i]);
        if (fault) {
            fprintf(stderr, "bench_png: %s: %s\n", paths[i], fault);
            return 1;
        }
    }
    return 0;
}
