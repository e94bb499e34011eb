// How long pictures take to decode: glint's reader, stb_image, and libjpeg-turbo alone at a part of the size.
//
//     bench_image [FILE]...
//
// Processor time of this program, in seconds: each of three rounds, after one that is not counted. How far
// the pixels of 8-bit pictures are from stb_image's is told too: the most of any channel, and the share of
// pixels. Without a FILE it is the 29-megapixel background of tests/scenes/original.glint.yaml, in
// $GLINT_ASSETS/seed or ../shared/assets/seed, which is not ours and not here; where it is absent it is
// skipped.
#include "picture/read/picture_read.h"

#include "core/strbuf.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>

#include <sys/resource.h>

#include <jpeglib.h>

#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

enum {
    ROUNDS = 3,
    PATH_MAX_BYTES = 4096,
};

struct job {
    str bytes;
    struct picture_header header;
    int part; // of the size, in libjpeg's decoding
    struct picture picture;
    unsigned char *stb;
};

static double processor_seconds(void) {
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) * 1e-6;
}

static bool decode_glint(struct job *job) {
    picture_finish(&job->picture);
    return !picture_decode(job->bytes, &job->header, &job->picture);
}

static bool decode_stb(struct job *job) {
    int width, height, channels;
    free(job->stb);
    job->stb = stbi_load_from_memory((const unsigned char *)job->bytes.ptr, (int)job->bytes.len, &width,
                                     &height, &channels, 3);
    return job->stb != NULL;
}

// A bare reading of a good file: libjpeg's own error handling ends the program.
static bool decode_part(struct job *job) {
    struct jpeg_decompress_struct decoder;
    struct jpeg_error_mgr errors;
    decoder.err = jpeg_std_error(&errors);
    jpeg_create_decompress(&decoder);
    jpeg_mem_src(&decoder, (const unsigned char *)job->bytes.ptr, job->bytes.len);
    jpeg_read_header(&decoder, TRUE);
    decoder.out_color_space = JCS_EXT_RGB;
    decoder.scale_denom = (unsigned)job->part;
    jpeg_start_decompress(&decoder);
    size_t row_bytes = (size_t)3 * decoder.output_width;
    unsigned char *pixels = malloc(row_bytes * decoder.output_height);
    while (pixels && decoder.output_scanline < decoder.output_height) {
        JSAMPROW row = pixels + row_bytes * decoder.output_scanline;
        jpeg_read_scanlines(&decoder, &row, 1);
    }
    free(pixels);
    jpeg_destroy_decompress(&decoder);
    return pixels != NULL;
}

static void time_rounds(const char *name, bool (*decode)(struct job *), struct job *job) {
    printf("  %-28s", name);
    for (int round = -1; round < ROUNDS; round++) {
        double before = processor_seconds();
        if (!decode(job)) {
            printf(" cannot decode it\n");
            return;
        }
        if (round >= 0)
            printf(" %7.3f", processor_seconds() - before);
    }
    printf("\n");
}

static void tell_difference(const struct job *job) {
    if (job->picture.depth != PICTURE_8 || !job->stb || !job->picture.pixels)
        return;
    const unsigned char *pixels = job->picture.pixels;
    size_t count = (size_t)job->picture.width * job->picture.height;
    size_t differ = 0;
    int most = 0;
    for (size_t i = 0; i < count; i++) {
        int here = 0;
        for (size_t c = 3 * i; c < 3 * i + 3; c++)
            here = abs(pixels[c] - job->stb[c]) > here ? abs(pixels[c] - job->stb[c]) : here;
        differ += here > 0;
        most = here > most ? here : most;
    }
    printf("  glint and stb_image differ by at most %d of 255, in %.2f %% of the pixels\n", most,
           100.0 * (double)differ / (double)count);
}

static void measure(const char *path, str bytes) {
    struct job job = {.bytes = bytes};
    const char *fault = picture_read_header(bytes, &job.header);
    if (fault || job.header.kind == IMAGE_NONE) {
        printf("%s: %s\n", path, fault ? fault : "it is no picture that is read");
        return;
    }
    printf("%s: %u x %u\n", path, job.header.width, job.header.height);
    time_rounds("glint", decode_glint, &job);
    time_rounds("stb_image", decode_stb, &job);
    tell_difference(&job);
    if (job.header.kind == IMAGE_JPEG)
        for (job.part = 1; job.part <= 8; job.part *= 2) {
            char name[40];
            snprintf(name, sizeof name, "libjpeg-turbo alone, 1/%d", job.part);
            time_rounds(name, decode_part, &job);
        }
    picture_finish(&job.picture);
    free(job.stb);
}

// false: there is no such file.
static bool measure_file(const char *path) {
    FILE *file = fopen(path, "rb");
    struct strbuf bytes;
    char piece[4096];
    size_t count;
    if (!file)
        return false;
    strbuf_init(&bytes);
    while ((count = fread(piece, 1, sizeof piece, file)) > 0)
        strbuf_add(&bytes, piece, count);
    fclose(file);
    measure(path, strbuf_view(&bytes));
    strbuf_finish(&bytes);
    return true;
}

int main(int argc, char **argv) {
    char path[PATH_MAX_BYTES];
    const char *folder = getenv("GLINT_ASSETS");
    printf("processor time, seconds\n");
    for (int i = 1; i < argc; i++)
        if (!measure_file(argv[i])) {
            fprintf(stderr, "bench_image: %s: %s\n", argv[i], strerror(errno));
            return 1;
        }
    snprintf(path, sizeof path, "%s/seed/background.jpg", folder && *folder ? folder : "../shared/assets");
    if (argc == 1 && !measure_file(path))
        printf("skipped: %s is not here\n", path);
    return 0;
}
