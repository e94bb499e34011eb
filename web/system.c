// System calls that a WebAssembly module cannot make: for other programs and for more than one processor.
// They fail, as they may on any system.
#define _GNU_SOURCE
#include "files/git_run.h"

#include "core/heap.h"

#include <emscripten.h>
#include <errno.h>
#include <sched.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>

// Module.runProgram(words), which node has and a page has not, returns {status, out, err}, the last two as
// bytes, or NULL if there is no such program. Returns 0; 1: no program can be run; 2: not this one.
EM_JS(int, run_program, (const char *words, int count), {
    if (!Module["runProgram"])
        return 1;
    var list = [];
    for (var i = 0; i < count; i++, words += lengthBytesUTF8(list[i - 1]) + 1)
        list.push(UTF8ToString(words));
    Module["ran"] = Module["runProgram"](list);
    return Module["ran"] ? 0 : 2;
})
EM_JS(int, ran_bytes, (int which),
      { return which < 0 ? Module["ran"].status : Module["ran"][which ? "err" : "out"].length; })
EM_JS(void, ran_take, (int which, char *to), { HEAPU8.set(Module["ran"][which ? "err" : "out"], to); })

void git_run(struct git_answer *answer, const char *const *words, const struct sandbox *limits) {
    (void)limits; // node's own, or the container's
    struct strbuf list;
    int count = 0;
    strbuf_init(&list);
    for (; words[count]; count++)
        strbuf_add(&list, words[count], strlen(words[count]) + 1);
    const int fault = list.failed ? 1 : run_program(list.data, count);
    answer->error = fault == 0 ? 0 : fault == 1 ? ENOSYS : ENOENT;
    for (int which = GIT_OUT; !answer->error && which <= GIT_ERR; which++) {
        const size_t length = (size_t)ran_bytes(which);
        char *bytes = heap_alloc(length + 1);
        if (!bytes) {
            answer->error = ENOMEM;
            break;
        }
        ran_take(which, bytes);
        strbuf_add(&answer->text[which], bytes, length);
        free(bytes);
    }
    answer->status = answer->error ? 0 : ran_bytes(-1);
    strbuf_finish(&list);
}

int posix_spawnp(pid_t *restrict child, const char *restrict file, const posix_spawn_file_actions_t *actions,
                 const posix_spawnattr_t *restrict attributes, char *const argv[restrict],
                 char *const envp[restrict]) {
    (void)child;
    (void)file;
    (void)actions;
    (void)attributes;
    (void)argv;
    (void)envp;
    return ENOSYS;
}

int sched_getaffinity(pid_t process, size_t size, cpu_set_t *set) {
    (void)process;
    (void)size;
    (void)set;
    errno = ENOSYS;
    return -1;
}

int __sched_cpucount(size_t size, const cpu_set_t *set) {
    (void)size;
    (void)set;
    return 1;
}
