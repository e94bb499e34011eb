// The plan, and the count of calls.
#include "faults.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

struct faults *faults;

// By system calls: the library's own open is what it makes fail.
__attribute__((constructor)) static void begin(void) {
    const char *path = getenv(FAULTS_VARIABLE);
    long file = path ? syscall(SYS_openat, AT_FDCWD, path, O_RDWR | O_CLOEXEC) : -1;
    if (file < 0)
        return;
    void *memory = mmap(NULL, sizeof *faults, PROT_READ | PROT_WRITE, MAP_SHARED, (int)file, 0);
    syscall(SYS_close, file);
    faults = memory == MAP_FAILED ? NULL : memory;
}

static void list(enum faults_kind kind, const char *call) {
    char line[96];
    const unsigned long long from = kind == FAULTS_VULKAN ? 0 : faults_stack();
    const int length =
        snprintf(line, sizeof line, from ? FAULTS_LISTED "%s %llx\n" : FAULTS_LISTED "%s\n", call, from);
    syscall(SYS_write, STDERR_FILENO, line, (size_t)length);
}

bool faults_strike(enum faults_kind kind, const char *call) {
    if (!faults || faults->kind != (int32_t)kind)
        return false;
    uint32_t number = atomic_fetch_add(&faults->seen, 1) + 1;
    if (faults->lists)
        list(kind, call);
    if (faults->number == 0 || number < faults->number || (number > faults->number && !faults->onward))
        return false;
    if (atomic_fetch_add(&faults->failed, 1) == 0)
        strncpy(faults->call, call, sizeof faults->call - 1);
    return true;
}
