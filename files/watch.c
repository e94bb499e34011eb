#include "files/watch.h"

#include "core/clock.h"
#include "core/heap.h"

#include <errno.h>
#include <limits.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/inotify.h>
#endif

enum {
    EVENT_BYTES = 16384,
    SETTLE_TIMES = 10,
};

struct watched {
    char *path; // absolute
    bool exists;
    uint64_t size_bytes;
    int64_t modified_ns;
};

struct watch {
    struct watched *files;
    uint32_t count, capacity;
    int *folders; // descriptors of what inotify watches
    uint32_t folder_count, folder_capacity;
    int notify;    // inotify; -1: none
    double looked; // clock at the last watch_look; 0: none since watch_begin
};

// ---- inotify

#ifdef __linux__
static int open_notify(void) {
    return inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
}

static int watch_folder(int notify, const char *folder) {
    return inotify_add_watch(notify, folder,
                             IN_CLOSE_WRITE | IN_MODIFY | IN_ATTRIB | IN_CREATE | IN_DELETE | IN_MOVE |
                                 IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR);
}

static void leave_folder(int notify, int folder) {
    inotify_rm_watch(notify, folder);
}
#else
static int open_notify(void) {
    return -1;
}
static int watch_folder(int notify, const char *folder) {
    (void)notify, (void)folder;
    return -1;
}
static void leave_folder(int notify, int folder) {
    (void)notify, (void)folder;
}
#endif

// Cuts the path to the folder that it lies in; false: there is none above.
static bool to_folder(char path[PATH_MAX]) {
    char *slash = strrchr(path, '/');
    if (strcmp(path, "/") == 0 || strcmp(path, ".") == 0)
        return false;
    if (slash)
        slash[slash == path] = '\0';
    else
        memcpy(path, ".", 2);
    return true;
}

// The folder of a file or, if that does not exist, the nearest existing one above it, where it would appear.
static int watch_folder_of(int notify, const char *path) {
    char folder[PATH_MAX];
    if (strlen(path) >= sizeof folder)
        return -1;
    memcpy(folder, path, strlen(path) + 1);
    int found = -1;
    while (found < 0 && to_folder(folder))
        found = watch_folder(notify, folder);
    return found;
}

static bool knows_folder(const struct watch *watch, int folder) {
    for (uint32_t i = 0; i < watch->folder_count; i++)
        if (watch->folders[i] == folder)
            return true;
    return false;
}

// A folder that cannot be watched or noted is checked by watch_wait from time to time.
static void add_folder(struct watch *watch, const char *path) {
    const int folder = watch->notify >= 0 ? watch_folder_of(watch->notify, path) : -1;
    if (folder < 0 || knows_folder(watch, folder))
        return;
    int *folders = heap_grow(watch->folders, watch->folder_count, &watch->folder_capacity, sizeof *folders);
    if (!folders)
        return;
    watch->folders = folders;
    watch->folders[watch->folder_count++] = folder;
}

// ---- the list

struct watch *watch_create(bool polls) {
    struct watch *watch = heap_zeroed(1, sizeof *watch);
    if (watch)
        watch->notify = polls ? -1 : open_notify();
    return watch;
}

static void forget_files(struct watch *watch) {
    for (uint32_t i = 0; i < watch->count; i++)
        free(watch->files[i].path);
    watch->count = 0;
}

void watch_destroy(struct watch *watch) {
    if (!watch)
        return;
    forget_files(watch);
    free(watch->files);
    free(watch->folders);
    if (watch->notify >= 0)
        close(watch->notify);
    free(watch);
}

bool watch_is_told(const struct watch *watch) {
    return watch->notify >= 0;
}

void watch_begin(struct watch *watch) {
    forget_files(watch);
    for (uint32_t i = 0; i < watch->folder_count; i++)
        leave_folder(watch->notify, watch->folders[i]);
    watch->folder_count = 0;
    watch->looked = 0;
}

static bool is_known(const struct watch *watch, str path) {
    for (uint32_t i = 0; i < watch->count; i++)
        if (str_equal_cstr(path, watch->files[i].path))
            return true;
    return false;
}

static bool add(struct watch *watch, str path, struct watched file) {
    if (is_known(watch, path))
        return true;
    struct watched *files = heap_grow(watch->files, watch->count, &watch->capacity, sizeof *files);
    watch->files = files ? files : watch->files;
    file.path = files ? heap_text_of(path.ptr, path.len) : NULL;
    if (!file.path)
        return false;
    watch->files[watch->count++] = file;
    add_folder(watch, file.path);
    return true;
}

static struct watched look(const char *path) {
    struct stat info;
    if (stat(path, &info) != 0)
        return (struct watched){0};
    return (struct watched){.exists = true,
                            .size_bytes = (uint64_t)info.st_size,
                            .modified_ns = (int64_t)info.st_mtim.tv_sec * 1000000000 + info.st_mtim.tv_nsec};
}

bool watch_add(struct watch *watch, const struct file_read *read) {
    return add(
        watch, read->path,
        (struct watched){.exists = true, .size_bytes = read->size_bytes, .modified_ns = read->modified_ns});
}

bool watch_add_missing(struct watch *watch, str path) {
    return add(watch, path, (struct watched){0});
}

bool watch_add_now(struct watch *watch, str path) {
    char *text = heap_text_of(path.ptr, path.len);
    const bool added = text && add(watch, path, look(text));
    free(text);
    return added;
}

// ---- waiting

static bool is_same(const struct watched *a, const struct watched *b) {
    return a->exists == b->exists && a->size_bytes == b->size_bytes && a->modified_ns == b->modified_ns;
}

bool watch_differs(const struct watch *watch) {
    for (uint32_t i = 0; i < watch->count; i++) {
        const struct watched now = look(watch->files[i].path);
        if (!is_same(&now, &watch->files[i]))
            return true;
    }
    return false;
}

// The contents of the events do not matter: the files are checked.
static void drain(const struct watch *watch) {
    char events[EVENT_BYTES];
    while (read(watch->notify, events, sizeof events) > 0)
        continue;
}

// Waits until something may have changed or the time is up. false: a signal came.
static bool wait_for_events(const struct watch *watch, double seconds) {
    struct pollfd poll_one = {.fd = watch->notify, .events = POLLIN};
    const int milliseconds = (int)(1e3 * seconds + 0.999);
    const int count = poll(&poll_one, watch->notify >= 0, milliseconds > 0 ? milliseconds : 0);
    if (count < 0)
        return errno != EINTR;
    if (count > 0)
        drain(watch);
    return true;
}

bool watch_look(struct watch *watch) {
    const double now = clock_seconds();
    struct pollfd told = {.fd = watch->notify, .events = POLLIN};
    const bool is_told = watch_is_told(watch);
    if (is_told && poll(&told, 1, 0) > 0)
        drain(watch);
    else if (now - watch->looked < (is_told ? WATCH_SLOW_SECONDS : WATCH_POLL_SECONDS))
        return false;
    watch->looked = now;
    return watch_differs(watch);
}

static double least(double a, double b) {
    return a < b ? a : b;
}

bool watch_wait(struct watch *watch, double seconds) {
    const double step = watch_is_told(watch) ? WATCH_SLOW_SECONDS : WATCH_POLL_SECONDS;
    const double end = clock_seconds() + seconds;
    bool differs = watch_differs(watch);
    for (double left = seconds; !differs && left > 0; left = end - clock_seconds()) {
        if (!wait_for_events(watch, least(left, step)))
            break;
        differs = watch_differs(watch);
    }
    return differs;
}

static void note(const struct watch *watch, struct watched *seen) {
    for (uint32_t i = 0; i < watch->count; i++)
        seen[i] = look(watch->files[i].path);
}

static bool is_quiet(const struct watch *watch, const struct watched *seen) {
    for (uint32_t i = 0; i < watch->count; i++) {
        const struct watched now = look(watch->files[i].path);
        if (!is_same(&now, &seen[i]))
            return false;
    }
    return true;
}

bool watch_settle(struct watch *watch, double seconds) {
    struct watched *seen = heap_array(watch->count + (size_t)1, sizeof *seen);
    bool quiet = false, goes_on = true;
    for (int i = 0; seen && i < SETTLE_TIMES && goes_on && !quiet; i++) {
        note(watch, seen);
        goes_on = poll(NULL, 0, (int)(1e3 * seconds + 0.999)) == 0;
        quiet = is_quiet(watch, seen);
    }
    free(seen);
    return goes_on;
}
