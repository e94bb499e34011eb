#define _GNU_SOURCE // syscall, O_PATH

#include "files/sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>
#if defined __linux__ && !defined __EMSCRIPTEN__
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <stddef.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#endif

static atomic_bool entered, refused;

bool sandbox_entered(void) {
    return atomic_load(&entered);
}

void sandbox_refuse(void) {
    if (sandbox_entered())
        atomic_store(&refused, true);
}

bool sandbox_refused(void) {
    return atomic_load(&refused);
}

#if defined __linux__ && !defined __EMSCRIPTEN__

// landlock(7), which the headers of older systems do not have.
enum {
    CALL_CREATE_RULESET = 444,
    CALL_ADD_RULE = 445,
    CALL_RESTRICT_SELF = 446,
    ASK_VERSION = 1,
    RULE_PATH_BENEATH = 1,
};
enum {
    MAY_RUN_FILE = 1 << 0,
    MAY_WRITE_FILE = 1 << 1,
    MAY_READ_FILE = 1 << 2,
    MAY_READ_FOLDER = 1 << 3,
    MAY_REMOVE_FILE = 1 << 5,
    MAY_MAKE_FOLDER = 1 << 7,
    MAY_MAKE_FILE = 1 << 8,
    MAY_TRUNCATE = 1 << 14,
    MAY_CONTROL_DEVICE = 1 << 15,
    OF_FILES = MAY_WRITE_FILE | MAY_READ_FILE | MAY_TRUNCATE | MAY_CONTROL_DEVICE,
};

struct ruleset {
    uint64_t files, network, scope;
};
struct beneath {
    uint64_t allowed;
    int32_t folder;
} __attribute__((packed));

int sandbox_landlock(void) {
    const long version = syscall(CALL_CREATE_RULESET, NULL, 0, ASK_VERSION);
    return version > 0 ? (int)version : 0;
}

// All accesses that a version can refuse, above all running a program.
static struct ruleset all_of(int version) {
    const int files = version >= 5 ? 16 : version >= 3 ? 15 : version >= 2 ? 14 : 13;
    return (struct ruleset){((uint64_t)1 << files) - 1, version >= 4 ? 3 : 0, version >= 6 ? 3 : 0};
}

static int allow(int rules, uint64_t known, const struct sandbox_path *path) {
    struct beneath rule = {MAY_READ_FILE | MAY_READ_FOLDER, open(path->path, O_PATH | O_CLOEXEC)};
    struct stat info;
    if (rule.folder < 0)
        return 0;
    if (path->writes)
        rule.allowed |= MAY_WRITE_FILE | MAY_REMOVE_FILE | MAY_MAKE_FOLDER | MAY_MAKE_FILE | MAY_TRUNCATE |
                        MAY_CONTROL_DEVICE;
    rule.allowed &= known;
    int error = 0;
    if (fstat(rule.folder, &info) != 0)
        error = errno;
    else if (!S_ISDIR(info.st_mode))
        rule.allowed &= OF_FILES;
    if (!error && syscall(CALL_ADD_RULE, rules, RULE_PATH_BENEATH, &rule, 0) != 0)
        error = errno;
    close(rule.folder);
    return error;
}

static int enclose(const struct sandbox *sandbox, int version, struct ruleset all) {
    const size_t size = version >= 6 ? sizeof all : version >= 4 ? 16 : 8;
    const int rules = (int)syscall(CALL_CREATE_RULESET, &all, size, 0);
    int error = rules < 0 ? errno : 0;
    for (uint32_t i = 0; i < sandbox->count && !error; i++)
        error = allow(rules, all.files, &sandbox->paths[i]);
    if (!error && syscall(CALL_RESTRICT_SELF, rules, 0) != 0)
        error = errno;
    if (rules >= 0)
        close(rules);
    return error;
}

// Memory that the process already has counts too: a sanitizer's own tables, for example.
static uint64_t memory_now(void) {
    unsigned long pages = 0;
    char text[256] = "";
    const int fd = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    const ssize_t count = fd < 0 ? 0 : read(fd, text, sizeof text - 1);
    if (fd >= 0)
        close(fd);
    if (count > 0)
        sscanf(text, "%*u %*u %*u %*u %*u %lu", &pages);
    return (uint64_t)pages * (uint64_t)sysconf(_SC_PAGESIZE);
}

static void cap(const struct sandbox *sandbox) {
    const uint64_t bytes = memory_now() + sandbox->memory_bytes;
    const struct rlimit time = {sandbox->seconds, sandbox->seconds + 5},
                        memory = {(rlim_t)bytes, (rlim_t)bytes}, files = {0, 0};
    setrlimit(RLIMIT_CPU, &time);
    if ((rlim_t)bytes == bytes)
        setrlimit(RLIMIT_DATA, &memory);
    setrlimit(RLIMIT_CORE, &files); // a core dump would contain what was read
}

int sandbox_enter(const struct sandbox *sandbox) {
    const int version = sandbox_landlock();
    cap(sandbox);
    atomic_store(&entered, true);
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
        return version ? errno : 0;
    return version ? enclose(sandbox, version, all_of(version)) : 0;
}

// ---- another program

// seccomp(2) with these processors' system call numbers; others have no filter.
#if defined __x86_64__ && !defined __ILP32__
#define ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined __i386__
#define ARCHITECTURE AUDIT_ARCH_I386
#elif defined __aarch64__ && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
#define ARCHITECTURE AUDIT_ARCH_AARCH64
#elif defined __riscv && __riscv_xlen == 64
#define ARCHITECTURE AUDIT_ARCH_RISCV64
#endif

#ifdef ARCHITECTURE
enum {
    CALL_CLONE3 = 435,         // the same on all processors; missing in older headers
    OTHER_CALLS = 0x40000000u, // x86-64 has a second set of numbers from here on
};
#define REFUSE(error)  BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | (error))
#define LOAD(field)    BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, field))
#define UNLESS(number) BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (number), 0, 1)

// Threads, but no processes. A filter cannot inspect clone3's arguments: it is reported as unknown, so clone
// is used.
static void forbid_processes(void) {
    struct sock_filter rules[] = {
        LOAD(arch),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, ARCHITECTURE, 1, 0),
        REFUSE(EPERM),
        LOAD(nr),
        BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, OTHER_CALLS, 0, 1),
        REFUSE(EPERM),
#ifdef SYS_fork
        UNLESS(SYS_fork),
        REFUSE(EPERM),
#endif
#ifdef SYS_vfork
        UNLESS(SYS_vfork),
        REFUSE(EPERM),
#endif
        UNLESS(CALL_CLONE3),
        REFUSE(ENOSYS),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_clone, 0, 3),
        LOAD(args[0]),
        BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, CLONE_THREAD, 1, 0),
        REFUSE(EPERM),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const struct sock_fprog program = {sizeof rules / sizeof *rules, rules};
    prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0);
}
#else
static void forbid_processes(void) {}
#endif

void sandbox_only_read(const struct sandbox *limits) {
    const struct sandbox_path nothing = {"/dev/null", true};
    const struct sandbox writable = {&nothing, 1, 0, 0};
    const int version = sandbox_landlock();
    struct ruleset rules = all_of(version);
    rules.files &= ~(uint64_t)(MAY_RUN_FILE | MAY_READ_FILE | MAY_READ_FOLDER | MAY_CONTROL_DEVICE);
    rules.scope = 0;
    cap(limits);
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
        return;
    if (version)
        enclose(&writable, version, rules);
    forbid_processes();
}

#else

int sandbox_landlock(void) {
    return 0;
}

void sandbox_only_read(const struct sandbox *limits) {
    (void)limits;
}

int sandbox_enter(const struct sandbox *sandbox) {
    (void)sandbox;
    atomic_store(&entered, true);
    return 0;
}

#endif
