#include "cli/commands/batch/film.h"

#include "cli/made.h"
#include "core/heap.h"
#include "diag/codes/command.h"
#include "files/sandbox.h"
#include "files/spawn.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    SAID_LINES = 4,
    SAID_BYTES = 4096,
};

// ---- pixels

static uint8_t rounded(double value) {
    return (uint8_t)floor(value + 0.5);
}

// One pixel of displayed bytes.
static void to_limited(const uint8_t *rgb, uint8_t *y, uint8_t *cb, uint8_t *cr) {
    const double r = rgb[0] / 255.0, g = rgb[1] / 255.0, b = rgb[2] / 255.0;
    const double luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    *y = rounded(16 + 219 * luma);
    *cb = rounded(128 + 224 * (b - luma) / 1.8556);
    *cr = rounded(128 + 224 * (r - luma) / 1.5748);
}

void film_pixels(enum batch_film kind, const struct image *image, struct image_display display,
                 struct strbuf *out) {
    const size_t pixels = (size_t)image->width * image->height;
    const size_t frame = heap_times(3, pixels);
    uint8_t *bytes = heap_array(frame, 2);
    if (!bytes) {
        out->failed = true;
        return;
    }
    image_to_bytes(image, display, bytes);
    uint8_t *planes = bytes + frame;
    if (kind == BATCH_Y4M) {
        for (size_t i = 0; i < pixels; i++)
            to_limited(bytes + 3 * i, planes + i, planes + pixels + i, planes + 2 * pixels + i);
        strbuf_cstr(out, "FRAME\n");
    }
    strbuf_add(out, kind == BATCH_Y4M ? planes : bytes, frame);
    free(bytes);
}

// ---- Y4M

// Frames a second as a fraction.
static void put_rate(struct strbuf *out, double fps) {
    long under = 1;
    while (under < 1000000 && fabs(fps * (double)under - round(fps * (double)under)) > 1e-9)
        under *= 10;
    if (fabs(fps - 24000.0 / 1001) < 5e-3 && under > 1)
        strbuf_cstr(out, "24000:1001");
    else if (fabs(fps - 30000.0 / 1001) < 5e-3 && under > 1)
        strbuf_cstr(out, "30000:1001");
    else
        strbuf_format(out, "%ld:%ld", lround(fps * (double)under), under);
}

static bool is_stdout(const struct film *film) {
    return strcmp(film->path, "-") == 0;
}

static int cannot_write(struct film *film, int error) {
    return cli_not_written(film->cli, film->path, error);
}

static int put_y4m(struct film *film, str bytes) {
    int error;
    if (is_stdout(film)) {
        error = output_descriptor(STDOUT_FILENO, bytes.ptr, bytes.len);
    } else {
        output_write(&film->output, bytes.ptr, bytes.len);
        error = film->output.error;
    }
    return error ? cannot_write(film, error) : CLI_OK;
}

static int begin_y4m(struct film *film) {
    struct strbuf head;
    strbuf_init(&head);
    strbuf_format(&head, "YUV4MPEG2 W%u H%u F", film->width, film->height);
    put_rate(&head, film->fps);
    strbuf_cstr(&head, " Ip A1:1 C444 XCOLORRANGE=LIMITED\n");
    if (!is_stdout(film) && !cli_open_output(film->cli, &film->output, film->path))
        return cannot_write(film, film->output.error);
    film->is_open = !is_stdout(film);
    const int status = put_y4m(film, strbuf_view(&head));
    strbuf_finish(&head);
    return status;
}

// ---- ffmpeg

static int no_ffmpeg(struct film *film, int error) {
    cli_error(film->cli, DIAG_OUTPUT, film->path,
              error == ENOENT
                  ? "on Debian: apt-get install ffmpeg; or write a .y4m, which needs no other program"
                  : NULL,
              error == ENOENT ? "a film of this kind is written by ffmpeg, which is not installed"
                              : "ffmpeg cannot be started: %s",
              strerror(error));
    return CLI_FILE;
}

// The file that ffmpeg writes to: beside the film, with its ending.
static char *temporary_name(const char *path) {
    const char *dot = strrchr(path, '.');
    const size_t size = strlen(path) + 40;
    char *name = heap_alloc(size);
    if (name)
        snprintf(name, size, "%.*s.glint-%ld%s", (int)(dot - path), path, (long)getpid(), dot);
    return name;
}

static const char *const mp4_words[] = {"-c:v", "libx264", "-crf", "16", "-movflags", "+faststart", NULL};
static const char *const webm_words[] = {"-c:v", "libvpx-vp9", "-crf", "20", "-b:v", "0", NULL};
static const char *const gif_words[] = {NULL};
// For all kinds but GIF, which has neither BT.709 nor a limited range.
static const char *const bt709_words[] = {
    "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv", NULL};
enum {
    WORDS_MOST = 48, // in the command, with the NULL at its end
};

static const char *const *coding_words(const char *path) {
    const str p = str_from(path);
    return str_ends_with_nocase(p, ".mp4")    ? mp4_words
           : str_ends_with_nocase(p, ".webm") ? webm_words
                                              : gif_words;
}

// A GIF has the 256 colours that suit all of its frames; films with halved chroma have even sizes.
static const char *filter_of(const struct film *film) {
    if (str_ends_with_nocase(str_from(film->path), ".gif"))
        return "split[a][b];[a]palettegen[p];[b][p]paletteuse";
    return film->width % 2 || film->height % 2
               ? "scale=flags=accurate_rnd+full_chroma_int:out_color_matrix=bt709:out_range=tv,format=yuv444p"
               : "scale=flags=accurate_rnd+full_chroma_int:out_color_matrix=bt709:out_range=tv,format="
                 "yuv420p";
}

// Appends after the last of `words`; NULL ends both lists.
static void append_words(const char *words[WORDS_MOST], const char *const *more) {
    size_t count = 0;
    while (words[count])
        count++;
    while (*more && count + 1 < WORDS_MOST)
        words[count++] = *more++;
}

static int start_ffmpeg(struct film *film) {
    char size[32], rate[48];
    int ends[2];
    FILE *said = tmpfile();
    film->said = said ? dup(fileno(said)) : -1;
    if (said)
        fclose(said);
    if (film->said < 0 || pipe(ends) != 0)
        return no_ffmpeg(film, errno);
    struct strbuf fraction;
    strbuf_init(&fraction);
    put_rate(&fraction, film->fps);
    for (char *p = fraction.data; p && *p; p++)
        *p = *p == ':' ? '/' : *p;
    snprintf(size, sizeof size, "%ux%u", film->width, film->height);
    snprintf(rate, sizeof rate, "%s", fraction.data ? fraction.data : "25");
    strbuf_finish(&fraction);
    const char *words[WORDS_MOST] = {
        "ffmpeg",        "-hide_banner",    "-loglevel",    "error", "-y",         "-f", "rawvideo",
        "-pixel_format", "rgb24",           "-video_size",  size,    "-framerate", rate, "-i",
        "pipe:0",        "-filter_complex", filter_of(film)};
    const char *const *const coding = coding_words(film->path);
    if (coding != gif_words)
        append_words(words, bt709_words);
    append_words(words, coding);
    append_words(words, (const char *const[]){film->temporary, NULL});
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    fcntl(film->said, F_SETFD, FD_CLOEXEC);
    // Ctrl-C goes to glint, which then ends ffmpeg.
    const int error =
        spawn(&film->child, words, &(struct spawn_streams){ends[0], film->said, film->said}, true);
    close(ends[0]);
    film->pipe = ends[1];
    return error ? no_ffmpeg(film, error) : CLI_OK;
}

static int begin_ffmpeg(struct film *film) {
    film->temporary = temporary_name(film->path);
    if (!film->temporary)
        return cannot_write(film, ENOMEM);
    const int fd = temporary_create(&film->entry, AT_FDCWD, film->temporary, film->temporary);
    if (fd < 0) {
        const int error = errno;
        free(film->temporary);
        film->temporary = NULL;
        return cannot_write(film, error);
    }
    close(fd);
    return start_ffmpeg(film);
}

// The last lines of what ffmpeg said.
static str last_lines(struct film *film) {
    char *text = arena_alloc(&film->cli->arena, SAID_BYTES + 1);
    const off_t size = lseek(film->said, 0, SEEK_END);
    const off_t begin = size > SAID_BYTES ? size - SAID_BYTES : 0;
    const ssize_t n = pread(film->said, text, SAID_BYTES, begin);
    const str said = str_trim((str){text, n > 0 ? (size_t)n : 0});
    size_t at = said.len;
    for (int lines = 0; at > 0; at--)
        if (said.ptr[at - 1] == '\n' && ++lines == SAID_LINES)
            break;
    return str_slice(said, at, said.len);
}

// Whether ffmpeg is in the PATH; this does not count as time of the frames.
static int find_ffmpeg(struct film *film) {
    str path = str_from(getenv("PATH"));
    if (sandbox_entered()) {
        sandbox_refuse();
        return no_ffmpeg(film, EPERM);
    }
    for (size_t begin = 0, i = 0; i <= path.len; i++) {
        if (i < path.len && path.ptr[i] != ':')
            continue;
        const str folder = str_slice(path, begin, i);
        if (access(arena_format(&film->cli->arena, "%.*s/ffmpeg", STR_ARG(folder)).ptr, X_OK) == 0)
            return CLI_OK;
        begin = i + 1;
    }
    return no_ffmpeg(film, ENOENT);
}

static int put_ffmpeg(struct film *film, str bytes) {
    const int error = output_descriptor(film->pipe, bytes.ptr, bytes.len);
    film->is_deaf = error == EPIPE; // film_end says why, in ffmpeg's words
    return error == EPIPE ? CLI_FILE : error ? cannot_write(film, error) : CLI_OK;
}

// Waits for its end; false: the reason why there is no film was reported.
static bool is_made(struct film *film) {
    int status = 0;
    while (waitpid(film->child, &status, 0) < 0 && errno == EINTR)
        continue;
    film->child = 0;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    const str said = last_lines(film);
    cli_error(film->cli, DIAG_OUTPUT, film->path, NULL, "ffmpeg made no film: %.*s",
              STR_ARG(said.len ? said : STR("it said nothing")));
    return false;
}

static int end_ffmpeg(struct film *film, bool whole) {
    int status = CLI_OK;
    if (film->pipe >= 0)
        close(film->pipe);
    if (film->child && !whole && !film->is_deaf)
        kill(film->child, SIGTERM);
    if (film->child && (whole || film->is_deaf) && !is_made(film))
        status = CLI_FILE;
    if (film->child)
        waitpid(film->child, NULL, 0);
    if (film->temporary && whole && status == CLI_OK && rename(film->temporary, film->path) != 0)
        status = cannot_write(film, errno);
    if (film->temporary && (!whole || status != CLI_OK))
        unlink(film->temporary);
    if (film->temporary)
        temporary_forget(&film->entry);
    if (film->said >= 0)
        close(film->said);
    free(film->temporary);
    return status;
}

// ---- the whole

int film_begin(struct film *film, struct cli *cli, const char *path, enum batch_film kind, double fps) {
    *film = (struct film){.cli = cli, .kind = kind, .path = path, .fps = fps, .pipe = -1, .said = -1};
    return kind == BATCH_FFMPEG ? find_ffmpeg(film) : cli_try_output(cli, path);
}

static int refuse_size(struct film *film, uint32_t width, uint32_t height) {
    cli_error(film->cli, DIAG_OUTPUT, film->path, "give all frames one size with --size WxH",
              "a frame is %u x %u, and those before it %u x %u", width, height, film->width, film->height);
    return CLI_SCENE;
}

int film_frame(struct film *film, uint32_t width, uint32_t height, str bytes) {
    int status = CLI_OK;
    if (film->width && (film->width != width || film->height != height))
        return refuse_size(film, width, height);
    if (!film->width) {
        film->width = width;
        film->height = height;
        status = film->kind == BATCH_Y4M ? begin_y4m(film) : begin_ffmpeg(film);
    }
    return status != CLI_OK          ? status
           : film->kind == BATCH_Y4M ? put_y4m(film, bytes)
                                     : put_ffmpeg(film, bytes);
}

int film_end(struct film *film, bool whole) {
    if (film->kind == BATCH_FFMPEG)
        return end_ffmpeg(film, whole && film->width);
    if (!film->is_open)
        return CLI_OK;
    film->is_open = false;
    if (!whole)
        output_abandon(&film->output);
    else if (!output_commit(&film->output))
        return cannot_write(film, film->output.error);
    return CLI_OK;
}
