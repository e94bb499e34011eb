// Every case of tests/invalid through the program, as a user runs it: a case of an error ends with a status
// other than 0 and an error with file, line and column; each within 64 KB of output and, with `measure`,
// within a second and 256 MB. The good file beside a case ends with 0 and in silence.
//
// Usage: run_corpus GLINT CORPUS check|measure
#include <dirent.h>
#include <fcntl.h>
#include <regex.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    ARGUMENTS_MAX = 40,
    OUTPUT_MAX = 64 * 1024,
    MEMORY_MAX_KB = 256 * 1024,
};
static const double seconds_max = 1;

struct run {
    int status;     // exit status; -1: killed
    double seconds; // of processor time
    long memory_kb;
    size_t output_bytes;
    char output[OUTPUT_MAX + 2];
};

static void read_all(int fd, struct run *run) {
    char more[4096];
    ssize_t n;
    while (run->output_bytes <= OUTPUT_MAX &&
           (n = read(fd, run->output + run->output_bytes, OUTPUT_MAX + 1 - run->output_bytes)) > 0)
        run->output_bytes += (size_t)n;
    run->output[run->output_bytes] = '\0';
    while (read(fd, more, sizeof more) > 0)
        ;
}

static void execute(char **arguments, struct run *run) {
    int ends[2];
    struct rusage usage;
    int status = 0;
    run->status = -1;
    run->output_bytes = 0;
    if (pipe(ends) != 0)
        return;
    pid_t child = fork();
    if (child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        dup2(ends[1], STDERR_FILENO);
        close(ends[0]);
        execv(arguments[0], arguments);
        _exit(127);
    }
    close(ends[1]);
    read_all(ends[0], run);
    close(ends[0]);
    if (child < 0 || wait4(child, &status, 0, &usage) != child)
        return;
    run->seconds = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                   1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    run->memory_kb = usage.ru_maxrss;
    run->status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// The options of a case, a name and a value a line; false: one that `check` does not have.
static bool add_options(char **arguments, int *count, char *text, size_t size) {
    FILE *file = fopen("options", "rb");
    if (!file)
        return true;
    text[fread(text, 1, size - 1, file)] = '\0';
    fclose(file);
    while (*text && *count + 2 < ARGUMENTS_MAX) {
        char *line = text;
        text += strcspn(text, "\n");
        if (*text)
            *text++ = '\0';
        char *blank = strchr(line, ' ');
        if (strncmp(line, "--camera", 8) == 0 || !blank)
            return false;
        *blank = '\0';
        arguments[(*count)++] = line;
        arguments[(*count)++] = blank + 1;
    }
    return true;
}

static bool has_finding(const char *output, bool is_error) {
    static const char *const patterns[] = {
        "(^|\n)[^\n]+:[1-9][0-9]*:[1-9][0-9]*: (error|warning|note): ",
        "(^|\n)[^\n]+:[1-9][0-9]*:[1-9][0-9]*: error: ",
    };
    regex_t regex;
    if (regcomp(&regex, patterns[is_error], REG_EXTENDED | REG_NOSUB) != 0)
        return false;
    bool found = regexec(&regex, output, 0, NULL, 0) == 0;
    regfree(&regex);
    return found;
}

static int judge(const char *name, const struct run *run, bool measured) {
    int bad = 0;
    bool is_error = name[0] == 'e';
    if (run->status < 0 || run->status > 3 || (is_error && run->status == 0))
        bad = fprintf(stderr, "%s: exit status %d\n", name, run->status);
    if (!has_finding(run->output, is_error))
        bad = fprintf(stderr, "%s: no finding with file, line and column\n", name);
    if (run->output_bytes > OUTPUT_MAX)
        bad = fprintf(stderr, "%s: more than 64 KB of output\n", name);
    if (measured && (run->seconds > seconds_max || run->memory_kb > MEMORY_MAX_KB))
        bad = fprintf(stderr, "%s: %.2f s, %ld KB\n", name, run->seconds, run->memory_kb);
    return bad ? 1 : 0;
}

static int run_case(char *glint, const char *name, struct run *run, bool measured) {
    char text[4096];
    char *arguments[ARGUMENTS_MAX] = {glint, (char *)"check", (char *)"--verbose"};
    int count = 3;
    arguments[count++] = (char *)(access("case.xml", R_OK) == 0 ? "case.xml" : "case.yaml");
    if (!add_options(arguments, &count, text, sizeof text))
        return 0;
    execute(arguments, run);
    return judge(name, run, measured);
}

// 0: there is none, or it is silent.
static int run_good(char *glint, const char *name, struct run *run) {
    char *arguments[] = {glint, (char *)"check", (char *)"good.yaml", NULL};
    if (access("good.yaml", R_OK) != 0)
        return 0;
    execute(arguments, run);
    if (run->status == 0 && run->output_bytes == 0)
        return 0;
    fprintf(stderr, "%s/good.yaml: exit status %d\n%.1000s", name, run->status, run->output);
    return 1;
}

int main(int argc, char **argv) {
    struct run *run = calloc(1, sizeof *run);
    char *glint = argc == 4 ? realpath(argv[1], NULL) : NULL;
    DIR *corpus = argc == 4 && chdir(argv[2]) == 0 ? opendir(".") : NULL;
    int cases = 0;
    int bad = 0;
    double slowest = 0;
    long largest = 0;
    if (!run || !glint || !corpus) {
        fprintf(stderr, "usage: run_corpus GLINT CORPUS check|measure\n");
        return 2;
    }
    for (struct dirent *entry; (entry = readdir(corpus));) {
        if (!strchr(entry->d_name, '_') || chdir(entry->d_name) != 0)
            continue;
        bad += run_case(glint, entry->d_name, run, strcmp(argv[3], "measure") == 0);
        slowest = run->seconds > slowest ? run->seconds : slowest;
        largest = run->memory_kb > largest ? run->memory_kb : largest;
        cases++;
        bad += run_good(glint, entry->d_name, run);
        if (chdir("..") != 0)
            return 2;
    }
    closedir(corpus);
    printf("%d cases, %d bad; at most %.2f s and %ld KB\n", cases, bad, slowest, largest);
    free(glint);
    free(run);
    return bad || cases < 100 ? 1 : 0;
}
