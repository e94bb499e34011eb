// Random kills of glint render --resume: whatever moment SIGTERM or SIGKILL comes, each file is absent, the
// one of before or whole, what was finished is not rendered again, and the bytes are those of one run. Usage:
// kills GLINT FOLDER KILLS [SEED]; the folder is made anew.
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum {
    FRAMES = 20,
    BANDS = 30,
    STOPPED = 75,
    WORDS_MOST = 24,
    FILE_MOST = 1 << 20,
};

static uint64_t seed, state;
static unsigned killed, terminated, finished, twice, failed;

static uint32_t draw(uint32_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((state >> 33) % below);
}

static void fail(const char *format, ...) {
    va_list args;
    va_start(args, format);
    printf("FAIL (seed %llu, after %u kills) ", (unsigned long long)seed, killed + terminated);
    vprintf(format, args);
    putchar('\n');
    va_end(args);
    failed++;
}

// ---- files

static size_t read_file(const char *path, char *bytes) {
    FILE *file = fopen(path, "rb");
    const size_t count = file ? fread(bytes, 1, FILE_MOST, file) : 0;
    if (file)
        fclose(file);
    return count;
}

static bool is_same(const char *a, const char *b) {
    static char first[FILE_MOST], second[FILE_MOST];
    const size_t count = read_file(a, first);
    return count == read_file(b, second) && memcmp(first, second, count) == 0;
}

static void write_text(const char *path, const char *text) {
    FILE *file = fopen(path, "wb");
    if (!file || fputs(text, file) < 0 || fclose(file) != 0) {
        perror(path);
        exit(2);
    }
}

// ---- processes

static pid_t start(const char *const *words) {
    const pid_t child = fork();
    if (child == 0) {
        const int said = open("said.txt", O_WRONLY | O_CREAT | O_TRUNC, 0666);
        dup2(said, STDERR_FILENO);
        execv(words[0], (char *const *)words);
        _exit(127);
    }
    return child;
}

static void wait_ms(double ms) {
    struct timespec left = {(time_t)(ms / 1000), (long)(1e6 * (ms - 1000 * (double)(time_t)(ms / 1000)))};
    while (nanosleep(&left, &left) != 0 && errno == EINTR)
        continue;
}

static double now_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static int run(const char *const *words) {
    int status = 0;
    waitpid(start(words), &status, 0);
    return status;
}

enum end {
    END_WHOLE,
    END_STOPPED, // by SIGTERM
    END_KILLED,  // by SIGKILL, or by SIGTERM before glint heard it
};

// Runs it, and kills it within so many milliseconds.
static enum end run_and_kill(const char *const *words, double most_ms) {
    const int number = draw(2) ? SIGKILL : SIGTERM;
    const double wait = most_ms * draw(1000) / 1000;
    int status = 0;
    const pid_t child = start(words);
    wait_ms(wait);
    kill(child, number);
    waitpid(child, &status, 0);
    killed += number == SIGKILL;
    terminated += number == SIGTERM;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return END_WHOLE;
    if (WIFEXITED(status) && WEXITSTATUS(status) == STOPPED && number == SIGTERM)
        return END_STOPPED;
    if (WIFSIGNALED(status) && WTERMSIG(status) == number)
        return END_KILLED;
    static char said[FILE_MOST + 1];
    said[read_file("said.txt", said)] = '\0';
    fail("signal %d after %.0f ms: status %x, and %s", number, wait, (unsigned)status, said);
    return END_KILLED;
}

// The number before `words` in what the last process said; -1: it did not say that.
static int said_before(const char *words) {
    static char said[FILE_MOST + 1];
    said[read_file("said.txt", said)] = '\0';
    const char *at = strstr(said, words);
    while (at && at > said && at[-1] != ' ')
        at--;
    return at ? (int)strtol(at, NULL, 10) : -1;
}

// ---- 20 frames

static const char turn[] = "cameras.front.position=[{6*sin(frame/8)}, 0.5, {6*cos(frame/8)}]";

struct frame {
    struct stat info;
    bool is_there;
};

static void name(char *path, size_t size, const char *stem, int i) {
    snprintf(path, size, "%s.%02d.png", stem, i);
}

// Whether all that is there is whole; `again` counts files that are others than before.
static int look(struct frame *frames, int *again) {
    char path[64], whole[64];
    int there = 0;
    *again = 0;
    for (int i = 0; i < FRAMES; i++) {
        struct stat info;
        name(path, sizeof path, "f", i);
        name(whole, sizeof whole, "whole", i);
        const bool is_there = stat(path, &info) == 0;
        if (is_there && !is_same(path, whole))
            fail("%s is not whole", path);
        if (frames[i].is_there && !is_there)
            fail("%s is lost", path);
        *again += frames[i].is_there && is_there && info.st_ino != frames[i].info.st_ino;
        frames[i] = (struct frame){info, is_there};
        there += is_there;
    }
    return there;
}

static void kill_frames(const char *glint, unsigned kills) {
    const char *const whole[] = {glint,   "render", "scene.yaml", "--frames",       "0..19",
                                 "--set", turn,     "-o",         "whole.%02d.png", NULL};
    const char *const resumed[] = {glint, "render", "scene.yaml", "--frames", "0..19", "--set",
                                   turn,  "-o",     "f.%02d.png", "--resume", NULL};
    struct frame frames[FRAMES] = {0};
    bool may_differ = false; // a kill has left a file that the checkpoint does not know yet
    const double begun = now_ms();
    if (run(whole) != 0)
        fail("cannot render");
    const double most = now_ms() - begun;
    while (killed + terminated < kills && !failed) {
        int again;
        const enum end end = run_and_kill(resumed, most);
        const int there = look(frames, &again);
        if (again > may_differ)
            fail("%d pictures were rendered twice", again);
        twice += (unsigned)again;
        may_differ = end == END_KILLED;
        if (end == END_STOPPED && said_before(" of 20 pictures are written; the same") != there &&
            said_before("interrupted") < 0)
            fail("%d pictures are there, and it says %d", there,
                 said_before(" of 20 pictures are written; the same"));
        const bool is_left = access("f.00.png.checkpoint", F_OK) == 0;
        if (end != END_WHOLE && (is_left || there != FRAMES)) // else it was killed when all was done
            continue;
        if (there != FRAMES || is_left)
            fail("it ended with %d pictures", there);
        finished++;
        may_differ = false;
        memset(frames, 0, sizeof frames);
        for (int i = 0; i < FRAMES; i++) {
            char path[64];
            name(path, sizeof path, "f", i);
            unlink(path);
        }
    }
    // What is left is rendered in peace.
    if (run(resumed) != 0)
        fail("it does not go on");
    int again;
    if (look(frames, &again) != FRAMES)
        fail("pictures are missing");
}

// ---- one picture in bands, over an old one

static void kill_bands(const char *glint, unsigned kills) {
    const char *const whole[] = {glint, "render",    "scene.yaml", "--size",    "160x240", "--samples",
                                 "32",  "--bands=8", "-o",         "whole.png", NULL};
    const char *const resumed[] = {glint, "render",    "scene.yaml", "--size", "160x240",  "--samples",
                                   "32",  "--bands=8", "-o",         "b.png",  "--resume", NULL};
    const double begun = now_ms();
    int had = 0;
    if (run(whole) != 0)
        fail("cannot render in bands");
    const double most = now_ms() - begun;
    write_text("old.txt", "old");
    write_text("b.png", "old");
    while (killed + terminated < kills && !failed) {
        const enum end end = run_and_kill(resumed, most);
        const int found = said_before(" of 30 bands are in b.png.checkpoint already");
        const int left = said_before(" of 30 bands are in b.png.checkpoint; the same");
        if (found >= 0 && found < had)
            fail("%d bands were there, and %d are", had, found);
        had = left > had ? left : found > had ? found : had;
        const bool is_old = is_same("b.png", "old.txt");
        if (!is_old && !is_same("b.png", "whole.png"))
            fail("b.png is neither old nor whole");
        const bool is_left = access("b.png.checkpoint", F_OK) == 0;
        if (end != END_WHOLE && (is_left || is_old))
            continue;
        if (is_old || is_left)
            fail("it ended without its picture");
        finished++;
        had = 0;
        write_text("b.png", "old");
    }
    if (run(resumed) != 0 || !is_same("b.png", "whole.png"))
        fail("it does not go on to the picture");
}

int main(int argc, char **argv) {
    static const char scene[] = "glint: 1\n"
                                "image: {width: 160, height: 120, samples: 4}\n"
                                "cameras: {front: {position: [0, 0, 6]}}\n"
                                "background: {color: [0.3, 0.5, 0.8]}\n"
                                "lights: [{position: [-5, 8, 5]}]\n"
                                "spheres: [{center: [-0.9, 0, 0], radius: 0.9}]\n"
                                "trace: {precision: single}\n";
    if (argc < 4)
        return 2;
    const unsigned kills = (unsigned)strtoul(argv[3], NULL, 10);
    state = seed = argc > 4 ? strtoull(argv[4], NULL, 10) : 20261123;
    if ((mkdir(argv[2], 0777) != 0 && errno != EEXIST) || chdir(argv[2]) != 0)
        return 2;
    write_text("scene.yaml", scene);
    const char *const probe[] = {argv[1], "render", "scene.yaml", "--size", "8x8",
                                 "-q",    "-o",     "probe.png",  NULL};
    if (run(probe) != 0) {
        printf("skip: no Vulkan device\n");
        return 77;
    }
    kill_frames(argv[1], kills);
    printf("frames: %u killed, %u asked to end, %u runs to the end, %u pictures rendered twice\n", killed,
           terminated, finished, twice);
    killed = terminated = finished = 0;
    kill_bands(argv[1], kills / 3);
    printf("bands: %u killed, %u asked to end, %u runs to the end\n", killed, terminated, finished);
    return failed != 0;
}
