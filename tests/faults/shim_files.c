// The calls by which glint reaches files, which fail as the plan says. Those of libraries and drivers do not.
#define _GNU_SOURCE

#include "faults.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#define EXPORTED __attribute__((visibility("default")))
// The function of the same name that comes after this library's.
#define NEXT(name) ((__typeof__(&name))next(#name))

static void *next(const char *name) {
    return dlsym(RTLD_NEXT, name);
}

// Whether the call fails; with FAULTS_SHORT only those do that can do less than they were asked for.
static bool strikes(const char *call, const void *address, bool may_be_short) {
    if (!faults || faults->kind != FAULTS_FILES || !faults_is_program(address))
        return false;
    if (faults->error == FAULTS_SHORT && !may_be_short)
        return false;
    bool strikes = faults_strike(FAULTS_FILES, call);
    if (strikes)
        errno = faults->error;
    return strikes;
}

#define STRIKES(call) strikes(call, __builtin_return_address(0), false)

static const char *with_descriptor(char *text, size_t size, const char *call, int fd) {
    snprintf(text, size, "%s %d", call, fd < 3 ? fd : 3);
    return text;
}

EXPORTED int open64(const char *path, int flags, ...) {
    va_list args;
    va_start(args, flags);
    mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(args, mode_t) : 0;
    va_end(args);
    return STRIKES(flags & O_CREAT ? "open to write" : "open") ? -1 : NEXT(open64)(path, flags, mode);
}

EXPORTED int openat64(int folder, const char *path, int flags, ...) {
    va_list args;
    va_start(args, flags);
    mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(args, mode_t) : 0;
    va_end(args);
    // That is how a temporary folder is emptied: nobody could do it otherwise.
    if (!(~flags & (O_DIRECTORY | O_NOFOLLOW)) && !(flags & O_PATH))
        return NEXT(openat64)(folder, path, flags, mode);
    const char *name = flags & O_DIRECTORY ? "opendir" : flags & O_CREAT ? "open to write" : "open";
    return STRIKES(name) ? -1 : NEXT(openat64)(folder, path, flags, mode);
}

// openat2, which has no function in the library; the others that programs make this way are not of files.
EXPORTED long syscall(long number, ...) {
    enum {
        CALL_OPENAT2 = 437
    };
    long a[6];
    va_list args;
    va_start(args, number);
    for (int i = 0; i < 6; i++)
        a[i] = va_arg(args, long);
    va_end(args);
    // Its third argument begins with the flags.
    if (number == CALL_OPENAT2 && STRIKES(*(const uint64_t *)a[2] & O_DIRECTORY ? "opendir" : "open"))
        return -1;
    return NEXT(syscall)(number, a[0], a[1], a[2], a[3], a[4], a[5]);
}

EXPORTED ssize_t read(int fd, void *bytes, size_t count) {
    char text[32];
    if (strikes(with_descriptor(text, sizeof text, "read", fd), __builtin_return_address(0), count > 1)) {
        if (faults->error != FAULTS_SHORT)
            return -1;
        count = (count + 1) / 2;
    }
    return NEXT(read)(fd, bytes, count);
}

// As programs with large file offsets name it.
EXPORTED ssize_t pread64(int fd, void *bytes, size_t count, off64_t at) {
    char text[32];
    if (strikes(with_descriptor(text, sizeof text, "read", fd), __builtin_return_address(0), count > 1)) {
        if (faults->error != FAULTS_SHORT)
            return -1;
        count = (count + 1) / 2;
    }
    return NEXT(pread64)(fd, bytes, count, at);
}

EXPORTED ssize_t write(int fd, const void *bytes, size_t count) {
    char text[32];
    if (strikes(with_descriptor(text, sizeof text, "write", fd), __builtin_return_address(0), count > 1)) {
        if (faults->error != FAULTS_SHORT)
            return -1;
        count = (count + 1) / 2;
    }
    return NEXT(write)(fd, bytes, count);
}

EXPORTED int fsync(int fd) {
    return STRIKES("fsync") ? -1 : NEXT(fsync)(fd);
}

// A close that fails closes, too.
EXPORTED int close(int fd) {
    int result = NEXT(close)(fd);
    return STRIKES("close") ? -1 : result;
}

EXPORTED int rename(const char *from, const char *to) {
    return STRIKES("rename") ? -1 : NEXT(rename)(from, to);
}

EXPORTED int renameat(int from_folder, const char *from, int to_folder, const char *to) {
    return STRIKES("rename") ? -1 : NEXT(renameat)(from_folder, from, to_folder, to);
}

EXPORTED off64_t lseek64(int fd, off64_t offset, int whence) {
    return STRIKES("lseek") ? -1 : NEXT(lseek64)(fd, offset, whence);
}

EXPORTED int mkdir(const char *path, mode_t mode) {
    return STRIKES("mkdir") ? -1 : NEXT(mkdir)(path, mode);
}

EXPORTED int mkdirat(int folder, const char *path, mode_t mode) {
    return STRIKES("mkdir") ? -1 : NEXT(mkdirat)(folder, path, mode);
}

EXPORTED char *mkdtemp(char *path) {
    return STRIKES("mkdtemp") ? NULL : NEXT(mkdtemp)(path);
}

EXPORTED int fstat64(int fd, struct stat64 *info) {
    return STRIKES("fstat") ? -1 : NEXT(fstat64)(fd, info);
}

EXPORTED DIR *opendir(const char *path) {
    return STRIKES("opendir") ? NULL : NEXT(opendir)(path);
}

EXPORTED DIR *fdopendir(int fd) {
    return STRIKES("opendir") ? NULL : NEXT(fdopendir)(fd);
}

EXPORTED struct dirent64 *readdir64(DIR *folder) {
    return STRIKES("readdir") ? NULL : NEXT(readdir64)(folder);
}
