// Runs a test with a limit on processor time, and notes how much it took.
//
// Usage: limited SECONDS RECORD NAME COMMAND [ARGUMENT]...
// Each process of the command may take SECONDS; one that takes more is ended by SIGXCPU. A line "SECONDS
// NAME" of all processes together is added to the file RECORD. Gives the exit status of the command, or ends
// by its signal.
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
    GRACE_SECONDS = 5, // from SIGXCPU to SIGKILL
};

static double seconds_of(struct timeval t) {
    return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

static void run(rlim_t seconds, char **command) {
    const struct rlimit limit = {seconds, seconds + GRACE_SECONDS};
    prctl(PR_SET_PDEATHSIG, SIGKILL); // where ctest ends this process
    setrlimit(RLIMIT_CPU, &limit);
    execvp(command[0], command);
    perror(command[0]);
    _exit(127);
}

// One write of a short line: tests that run at the same time do not mix theirs.
static void note(const char *record, const char *name, double seconds) {
    char line[512];
    const int length = snprintf(line, sizeof line, "%.2f %s\n", seconds, name);
    const int file = open(record, O_WRONLY | O_APPEND | O_CREAT, 0666);
    if (file < 0 || length < 0 || (size_t)length >= sizeof line ||
        write(file, line, (size_t)length) != length)
        fprintf(stderr, "%s: cannot note the time of %s\n", record, name);
    if (file >= 0)
        close(file);
}

// As the command ended by a signal, so does this process.
static int end_by(int number, const char *name, rlim_t limit) {
    if (number == SIGXCPU)
        fprintf(stderr, "%s: ended, a process took more than %llu s of processor time\n", name,
                (unsigned long long)limit);
    const struct rlimit no_core = {0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    signal(number, SIG_DFL);
    raise(number);
    return 128 + number;
}

int main(int argc, char **argv) {
    struct rusage usage;
    int status;
    if (argc < 5) {
        fprintf(stderr, "usage: limited SECONDS RECORD NAME COMMAND [ARGUMENT]...\n");
        return 2;
    }
    const rlim_t limit = strtoul(argv[1], NULL, 10);
    const pid_t child = fork();
    if (child == 0)
        run(limit, argv + 4);
    if (child < 0 || waitpid(child, &status, 0) != child || getrusage(RUSAGE_CHILDREN, &usage) != 0) {
        perror("limited");
        return 2;
    }
    note(argv[2], argv[3], seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime));
    return WIFSIGNALED(status) ? end_by(WTERMSIG(status), argv[3], limit) : WEXITSTATUS(status);
}
