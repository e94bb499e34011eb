#include "cli/memory.h"

#include "cli/cli.h"
#include "core/heap.h"
#include "files/output.h"
#include "files/temporary.h"

#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <unistd.h>

static bool is_untrusted; // set before there is a second thread

static void say(const char *text, size_t count) {
    // The exit status tells it even if this cannot be written.
    (void)output_descriptor(STDERR_FILENO, text, count);
}

static void say_number(size_t number) {
    char digits[24];
    size_t at = sizeof digits;
    do
        digits[--at] = (char)('0' + number % 10);
    while (number /= 10);
    say(digits + at, sizeof digits - at);
}

static void end(size_t size_bytes) {
    static const char clear_line[] = "\r\033[K", message[] = "glint: out of memory",
                      limit[] = ", refused: more than --untrusted allows, or than there is",
                      before[] = ": the system refused ", after[] = " bytes";
    static atomic_flag ending = ATOMIC_FLAG_INIT;
    while (atomic_flag_test_and_set(&ending)) // another thread was first, and ends this one too
        pause();
    temporary_remove_all();
    if (isatty(STDERR_FILENO))
        say(clear_line, sizeof clear_line - 1); // a progress bar
    say(message, sizeof message - 1);
    if (is_untrusted)
        say(limit, sizeof limit - 1);
    if (size_bytes) {
        say(before, sizeof before - 1);
        say_number(size_bytes);
        say(after, sizeof after - 1);
    }
    say("\n", 1);
    _exit(is_untrusted ? CLI_REFUSED : CLI_FILE);
}

static void end_time(int number) {
    static const char message[] = "glint: refused: more time than --untrusted allows\n";
    (void)number;
    say(message, sizeof message - 1);
    _exit(CLI_REFUSED);
}

void memory_catch_untrusted(void) {
    is_untrusted = true;
    signal(SIGXCPU, end_time);
}

void memory_catch(void) {
    heap_on_exhausted(end);
}
