// Faults on purpose: what the runner (run_faults.c) and the library that it loads into glint (shim_*.c)
// share.
//
// The runner writes a plan to a file and names it in FAULTS_VARIABLE; the library maps it, counts the calls
// of the plan's kind, makes those fail that it names, and notes what it did. With number 0 it only counts.
// Thread safety: calls of all threads are counted.
#ifndef GLINT_TESTS_FAULTS_FAULTS_H
#define GLINT_TESTS_FAULTS_FAULTS_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

#define FAULTS_VARIABLE "GLINT_TEST_FAULTS"
#define FAULTS_LISTED   "fault: " // begins a line of a list

enum faults_kind {
    FAULTS_MEMORY,
    FAULTS_FILES,
    FAULTS_VULKAN,
};

enum {
    FAULTS_SHORT = -1, // in place of an errno: half of what was asked for, or less
};

struct faults {
    // The plan.
    int32_t kind;
    int32_t error;   // an errno, FAULTS_SHORT, or a VkResult
    uint32_t number; // of the call that fails, from 1
    bool onward;     // and all after it
    bool lists;      // writes each call to the standard error: its name and, but for Vulkan, who makes it
    // What happened.
    atomic_uint seen, failed;
    char call[64]; // the first that failed
};

// ---- shim.c

extern struct faults *faults; // NULL: not under a test
// Counts a call; whether it must fail.
bool faults_strike(enum faults_kind kind, const char *call);

// ---- shim_place.c

// Whether the call that returns to `address` is made by glint, or by a library for glint: drivers are
// another's programs, of which some end the process where memory ends.
bool faults_is_ours(const void *address);
// Whether it is made by the program's own code.
bool faults_is_program(const void *address);
// A number for the calls that led here, each place once however often it calls itself; the same in every run.
unsigned long long faults_stack(void);

#endif
