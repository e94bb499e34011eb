// Counts what a program does: each basic block that runs (-fsanitize-coverage=trace-pc calls into here), and
// of the C library's functions that walk memory each 16 bytes. The same program and input give the same
// count, on any machine, however busy it is.
//
// Output: at the end of the process the count is appended as a line to the file that GLINT_STEPS names.
// Linked with
// --wrap for each function below. This file itself is not counted. Thread safety: none; the driver allows one
// processor, on which glint starts no threads.
#include <inttypes.h>
#include <malloc.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static uint64_t steps;

void __sanitizer_cov_trace_pc(void);
void __sanitizer_cov_trace_pc(void) {
    steps++;
}

static void walk(size_t bytes) {
    steps += 1 + bytes / 16;
}

// Functions that go through `count` bytes.
size_t __real_strlen(const char *s);
#define WALKS(type, name, parameters, arguments, count)                                                      \
    type __real_##name parameters;                                                                           \
    type __wrap_##name parameters;                                                                           \
    type __wrap_##name parameters {                                                                          \
        walk(count);                                                                                         \
        return __real_##name arguments;                                                                      \
    }

WALKS(void *, memcpy, (void *to, const void *from, size_t size), (to, from, size), size)
WALKS(void *, memmove, (void *to, const void *from, size_t size), (to, from, size), size)
WALKS(void *, memset, (void *to, int byte, size_t size), (to, byte, size), size)
WALKS(void *, calloc, (size_t count, size_t size), (count, size), count *size)
WALKS(void *, realloc, (void *old, size_t size), (old, size), old ? malloc_usable_size(old) : 0)
WALKS(int, strcmp, (const char *a, const char *b), (a, b), __real_strlen(b))
WALKS(char *, strchr, (const char *s, int c), (s, c), __real_strlen(s))
WALKS(size_t, fread, (void *to, size_t size, size_t count, FILE *file), (to, size, count, file), size *count)
WALKS(size_t, fwrite, (const void *from, size_t size, size_t count, FILE *file), (from, size, count, file),
      size *count)
WALKS(ssize_t, read, (int fd, void *to, size_t size), (fd, to, size), size)

// Functions that stop where they find something: as far as they went.
size_t __wrap_strlen(const char *s);
size_t __wrap_strlen(const char *s) {
    size_t length = __real_strlen(s);
    walk(length);
    return length;
}

void *__real_memchr(const void *s, int c, size_t size);
void *__wrap_memchr(const void *s, int c, size_t size);
void *__wrap_memchr(const void *s, int c, size_t size) {
    const char *found = __real_memchr(s, c, size);
    walk(found ? (size_t)(found - (const char *)s) : size);
    return (void *)(uintptr_t)found;
}

char *__real_strstr(const char *s, const char *part);
char *__wrap_strstr(const char *s, const char *part);
char *__wrap_strstr(const char *s, const char *part) {
    char *found = __real_strstr(s, part);
    walk(found ? (size_t)(found - s) : __real_strlen(s));
    return found;
}

int __real_memcmp(const void *a, const void *b, size_t size);
int __wrap_memcmp(const void *a, const void *b, size_t size);
int __wrap_memcmp(const void *a, const void *b, size_t size) {
    size_t same = 0;
    while (same < size && ((const char *)a)[same] == ((const char *)b)[same])
        same++;
    walk(same);
    return __real_memcmp(a, b, size);
}

__attribute__((destructor)) static void tell(void) {
    const char *path = getenv("GLINT_STEPS");
    FILE *file = path ? fopen(path, "a") : NULL;
    if (!file)
        return;
    fprintf(file, "%" PRIu64 "\n", steps);
    fclose(file);
}
