// Who makes a call: by the objects of the process in which the callers' code lies.
#define _GNU_SOURCE

#include "faults.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>
#include <stddef.h>
#include <string.h>

enum {
    OBJECTS_MAX = 64,
    FRAMES_MAX = 48,
};

// The code that the process began with: the program and the libraries that it is linked to.
static struct object {
    uintptr_t begin, end;
    bool is_linker; // of the system, which loads libraries
} objects[OBJECTS_MAX];
static size_t object_count;

static int note(struct dl_phdr_info *info, size_t size, void *data) {
    (void)size;
    (void)data;
    bool is_linker = strstr(info->dlpi_name, "/ld-") != NULL;
    for (int i = 0; i < info->dlpi_phnum && object_count < OBJECTS_MAX; i++) {
        const ElfW(Phdr) *part = &info->dlpi_phdr[i];
        if (part->p_type == PT_LOAD && (part->p_flags & PF_X)) {
            uintptr_t begin = info->dlpi_addr + part->p_vaddr;
            objects[object_count++] = (struct object){begin, begin + part->p_memsz, is_linker};
        }
    }
    return 0;
}

__attribute__((constructor)) static void begin(void) {
    void *frames[2];
    backtrace(frames, 2); // loads what it needs, once
    dl_iterate_phdr(note, NULL);
}

// The program comes first.
bool faults_is_program(const void *address) {
    uintptr_t at = (uintptr_t)address;
    return object_count && at >= objects[0].begin && at < objects[0].end;
}

static const struct object *linked(const void *address) {
    uintptr_t at = (uintptr_t)address;
    for (size_t i = 0; i < object_count; i++)
        if (at >= objects[i].begin && at < objects[i].end)
            return &objects[i];
    return NULL;
}

// The Vulkan loader, which is loaded when it is needed.
static bool is_loader(void *address) {
    struct dl_find_object found;
    const char *name;
    if (_dl_find_object(address, &found) != 0)
        return false;
    name = strrchr(found.dlfo_link_map->l_name, '/');
    return name && strncmp(name, "/libvulkan.so", 13) == 0;
}

// Goes from the call up to the program. A library that glint and a driver share is asked by whoever is
// further up; and what the Vulkan loader lets the system load is a driver's.
bool faults_is_ours(const void *address) {
    void *frames[FRAMES_MAX];
    if (faults_is_program(address))
        return true;
    int count = backtrace(frames, FRAMES_MAX);
    bool loads = false;
    for (int i = 0; i < count; i++) {
        if (faults_is_program(frames[i]))
            return true;
        const struct object *object = linked(frames[i]);
        if (!object && (loads || !is_loader(frames[i])))
            return false;
        loads |= object && object->is_linker;
    }
    return false;
}

static bool is_repeated(void *const *frames, int i) {
    for (int k = 0; k < i; k++)
        if (frames[k] == frames[i])
            return true;
    return false;
}

// FNV-1a over the places, which are counted from where their objects begin.
unsigned long long faults_stack(void) {
    void *frames[FRAMES_MAX];
    unsigned long long hash = 14695981039346656037u;
    const int count = backtrace(frames, FRAMES_MAX);
    for (int i = 0; i < count; i++) {
        const struct object *object = linked(frames[i]);
        if (object && !is_repeated(frames, i))
            hash = (hash ^ ((uintptr_t)frames[i] - object->begin)) * 1099511628211u;
    }
    return hash;
}
