// Whether memory was asked to come in huge pages, by what Linux tells of the process's mappings.
#ifndef GLINT_TESTS_UNIT_HUGE_PAGES_H
#define GLINT_TESTS_UNIT_HUGE_PAGES_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static inline bool huge_pages_exist(void) {
    return access("/sys/kernel/mm/transparent_hugepage/enabled", R_OK) == 0 &&
           access("/proc/self/smaps", R_OK) == 0;
}

static inline bool huge_pages_asked(const void *memory) {
    char line[512];
    unsigned long begin, end;
    bool here = false, asked = false;
    FILE *maps = fopen("/proc/self/smaps", "r");
    while (maps && fgets(line, sizeof line, maps)) {
        if (sscanf(line, "%lx-%lx ", &begin, &end) == 2)
            here = (uintptr_t)memory >= begin && (uintptr_t)memory < end;
        else if (here && strncmp(line, "VmFlags:", 8) == 0)
            asked = strstr(line, " hg") != NULL;
    }
    if (maps)
        fclose(maps);
    return asked;
}

#endif
