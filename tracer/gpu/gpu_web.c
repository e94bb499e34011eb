// The graphics processor of a web page: WebGPU. Slow operations are promises in JavaScript
// (web/gpu/library.js); the engine suspends this stack until they are fulfilled, so each call waits, as with
// Vulkan.
//
// A kernel is WGSL, made from the same GLSL (tools/wgsl.sh): JavaScript has it by its name. WebGPU binds few
// storage buffers: all read-only words and texels are places in one (shaders/web.h). Functions for parallel
// work are never called.
#define _GNU_SOURCE // strcasestr
#include "core/heap.h"
#include "shaders/frame.h"
#include "shaders/gpu_scene.h"
#include "shaders/kernels.h"
#include "shaders/web.h"
#include "tracer/gpu/gpu_screen.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// web/gpu/library.js. Buffers and programs are numbers from 1 on; 0: it failed, and `why` has the message.
// Offsets and sizes in bytes, as doubles, which are exact far enough.
extern int gpuweb_open(char *name, int name_bytes, double *storage_bytes, int *is_cpu);
extern void gpuweb_close(void);
extern int gpuweb_buffer(int use, double bytes, char *why);
extern int gpuweb_grow(int buffer, double bytes, char *why); // keeps the buffer's contents
extern void gpuweb_drop(int buffer);
extern void gpuweb_write(int buffer, double offset, const void *data, double bytes);
extern int gpuweb_read(int buffer, double offset, void *data, double bytes, char *why);
extern int gpuweb_program(const char *kernel, const uint32_t *constants, int count, char *why);
extern void gpuweb_dispatch(int program, const int *buffers, int count, uint32_t x, uint32_t y,
                            const uint32_t *push, int push_count);
extern void gpuweb_copy(int from, double offset, int to, double bytes, void *contents);
extern void gpuweb_clear(int buffer, double offset, double bytes);
extern void gpuweb_submit(void);
extern double
gpuweb_wait(char *why); // seconds of what was submitted; below 0: it failed; -2: the device is lost

enum {
    WORD_BYTES = 16,
    PIECE_BYTES = 1 << 20,
    WORDS_LEAST = 1 << 20,
    PUSH_WORDS = 64
};

struct gpu_buffer {
    enum gpu_use use;
    int id; // 0: a place in gpu->words
    uint64_t bytes, begin, size;
    struct gpu_buffer *next; // by their places
    void *contents;
};

struct gpu {
    struct gpu_device_info info;
    char error[GPU_ERROR_BYTES];
    enum gpu_status status;
    int words; // the buffer of all places; 0: none yet
    uint64_t word_bytes;
    struct gpu_buffer *first;
    uint32_t pipelines;
};

struct gpu_program {
    int id;
    uint32_t push_words;
    struct gpu_buffer *buffers[GPU_BINDINGS];
};

static const struct {
    const struct kernel *kernel;
    const char *name;
} kernels[] = {
    {&kernel_trace_pairs_storage, "trace"},
    {&kernel_resolve_storage, "resolve"},
    {&kernel_hits_pairs_storage, "hits"},
    {&kernel_log_pairs_storage, "log"},
};

__attribute__((format(printf, 3, 4))) static bool fail(struct gpu *gpu, enum gpu_status status,
                                                       const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(gpu->error, sizeof gpu->error, format, arguments);
    va_end(arguments);
    gpu->status = status;
    return false;
}

// ---- the device

enum gpu_status gpu_create(const struct gpu_options *options, struct gpu **out, char error[GPU_ERROR_BYTES]) {
    double storage_bytes = 0;
    int is_cpu = 0;
    struct gpu *gpu = heap_zeroed(1, sizeof *gpu);
    *out = NULL;
    if (!gpu) {
        snprintf(error, GPU_ERROR_BYTES, "not enough memory");
        return GPU_NO_MEMORY;
    }
    if (!gpuweb_open(gpu->info.name, sizeof gpu->info.name, &storage_bytes, &is_cpu)) {
        snprintf(error, GPU_ERROR_BYTES, "this browser has no WebGPU adapter");
        free(gpu);
        return GPU_NO_DRIVER;
    }
    const char *wanted = options->device ? options->device : "";
    if (*wanted && strcmp(wanted, "0") != 0 && !strcasestr(gpu->info.name, wanted)) {
        snprintf(error, GPU_ERROR_BYTES, "no WebGPU adapter matches '%s'", wanted);
        free(gpu);
        return GPU_NO_DEVICE;
    }
    snprintf(gpu->info.driver, sizeof gpu->info.driver, "WebGPU");
    gpu->info.kind = is_cpu ? GPU_CPU : GPU_INTEGRATED; // the API does not tell which other kind it is
    gpu->info.storage_bytes = gpu->info.memory_bytes = (uint64_t)storage_bytes;
    gpu->info.preferred = true;
    *out = gpu;
    return GPU_OK;
}

enum gpu_status gpu_list(struct gpu_device_info *items, uint32_t capacity, uint32_t *count,
                         char error[GPU_ERROR_BYTES]) {
    struct gpu *gpu;
    *count = 0;
    const enum gpu_status status = gpu_create(&(struct gpu_options){0}, &gpu, error);
    if (status != GPU_OK)
        return status;
    if (capacity)
        items[0] = gpu->info;
    *count = 1;
    gpu_destroy(gpu);
    return GPU_OK;
}

bool gpu_destroy(struct gpu *gpu) {
    if (gpu && gpu->words)
        gpuweb_drop(gpu->words);
    if (gpu)
        gpuweb_close();
    free(gpu);
    return true;
}

const struct gpu_device_info *gpu_info(const struct gpu *gpu) {
    return &gpu->info;
}
const char *gpu_error(const struct gpu *gpu) {
    return gpu->error;
}
enum gpu_status gpu_last_status(const struct gpu *gpu) {
    return gpu->status;
}
bool gpu_fetches_texels(const struct gpu *gpu) {
    (void)gpu;
    return false;
}

// ---- buffers

static bool is_place(enum gpu_use use) {
    return use == GPU_WORDS || use == GPU_TEXELS_U8 || use == GPU_TEXELS_F32;
}

static bool fits(struct gpu *gpu, uint64_t bytes, bool is_words) {
    if (bytes <= gpu->info.storage_bytes)
        return true;
    return fail(gpu, GPU_NO_MEMORY, "a buffer of %llu MiB exceeds the %llu MiB that %s allows%s",
                (unsigned long long)(bytes >> 20), (unsigned long long)(gpu->info.storage_bytes >> 20),
                gpu->info.name,
                is_words ? ": here all of a scene lies in one; use smaller meshes or images" : "");
}

// Into the first gap that is wide enough, or after all others.
static bool take_place(struct gpu *gpu, struct gpu_buffer *buffer) {
    struct gpu_buffer **at = &gpu->first;
    uint64_t end = 0;
    for (; *at && (*at)->begin - end < buffer->size; at = &(*at)->next)
        end = (*at)->begin + (*at)->size;
    const uint64_t needed = end + buffer->size;
    if (!fits(gpu, needed, true))
        return false;
    if (needed > gpu->word_bytes) {
        uint64_t bytes = 2 * needed < WORDS_LEAST ? WORDS_LEAST : 2 * needed;
        bytes = bytes < gpu->info.storage_bytes ? bytes : gpu->info.storage_bytes;
        if (!gpu->words)
            gpu->words = gpuweb_buffer(GPU_WORDS, (double)bytes, gpu->error);
        else if (!gpuweb_grow(gpu->words, (double)bytes, gpu->error))
            return fail(gpu, GPU_NO_MEMORY, "%s", "the scene does not fit into the memory of the device");
        if (!gpu->words)
            return fail(gpu, GPU_NO_MEMORY, "%s", "the scene does not fit into the memory of the device");
        gpu->word_bytes = bytes;
    }
    buffer->begin = end;
    buffer->next = *at;
    *at = buffer;
    return true;
}

static void leave_place(struct gpu *gpu, const struct gpu_buffer *buffer) {
    for (struct gpu_buffer **at = &gpu->first; *at; at = &(*at)->next)
        if (*at == buffer) {
            *at = buffer->next;
            return;
        }
}

static bool make(struct gpu *gpu, struct gpu_buffer *buffer) {
    if (is_place(buffer->use))
        return take_place(gpu, buffer);
    if (!fits(gpu, buffer->size, false))
        return false;
    if (buffer->use == GPU_HOST)
        buffer->contents = heap_zeroed(1, (size_t)buffer->size);
    if (buffer->use == GPU_HOST && !buffer->contents)
        return fail(gpu, GPU_NO_MEMORY, "not enough memory");
    buffer->id = gpuweb_buffer((int)buffer->use, (double)buffer->size, gpu->error);
    if (!buffer->id)
        gpu->status = GPU_NO_MEMORY;
    return buffer->id != 0;
}

struct gpu_buffer *gpu_buffer_create(struct gpu *gpu, enum gpu_use use, uint64_t bytes) {
    struct gpu_buffer *buffer = heap_zeroed(1, sizeof *buffer);
    if (!buffer) {
        fail(gpu, GPU_NO_MEMORY, "not enough memory");
        return NULL;
    }
    *buffer = (struct gpu_buffer){
        .use = use, .bytes = bytes, .size = bytes < WORD_BYTES ? WORD_BYTES : (bytes + 15) / 16 * 16};
    if (make(gpu, buffer))
        return buffer;
    gpu_buffer_destroy(gpu, buffer);
    return NULL;
}

void gpu_buffer_destroy(struct gpu *gpu, struct gpu_buffer *buffer) {
    if (!buffer)
        return;
    leave_place(gpu, buffer);
    if (buffer->id)
        gpuweb_drop(buffer->id);
    free(buffer->contents);
    free(buffer);
}

uint64_t gpu_buffer_bytes(const struct gpu_buffer *buffer) {
    return buffer->bytes;
}
const void *gpu_contents(const struct gpu_buffer *buffer) {
    return buffer->contents;
}

static int id_of(const struct gpu *gpu, const struct gpu_buffer *buffer) {
    return buffer->id ? buffer->id : gpu->words;
}

bool gpu_write(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, const void *data,
               uint64_t bytes) {
    if (bytes)
        gpuweb_write(id_of(gpu, buffer), (double)(buffer->begin + offset), data, (double)bytes);
    return true;
}

bool gpu_fill(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, uint64_t bytes, gpu_put *put,
              void *context) {
    void *piece = heap_alloc(PIECE_BYTES);
    if (!piece)
        return fail(gpu, GPU_NO_MEMORY, "not enough memory");
    for (uint64_t done = 0; done < bytes; done += PIECE_BYTES) {
        const uint64_t count = bytes - done < PIECE_BYTES ? bytes - done : PIECE_BYTES;
        put(context, offset + done, piece, count);
        gpu_write(gpu, buffer, offset + done, piece, count);
    }
    free(piece);
    return true;
}

bool gpu_read(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, void *data, uint64_t bytes) {
    if (bytes == 0 ||
        gpuweb_read(id_of(gpu, buffer), (double)(buffer->begin + offset), data, (double)bytes, gpu->error))
        return true;
    gpu->status = GPU_FAILED;
    return false;
}

// ---- programs

struct gpu_program *gpu_program_create(struct gpu *gpu, const struct gpu_program_source *source) {
    const char *name = NULL;
    for (size_t i = 0; i < sizeof kernels / sizeof *kernels; i++)
        if (kernels[i].kernel == source->kernel)
            name = kernels[i].name;
    struct gpu_program *program = heap_zeroed(1, sizeof *program);
    if (!name || !program) {
        fail(gpu, name ? GPU_NO_MEMORY : GPU_FAILED,
             name ? "not enough memory" : "WebGPU has no such kernel");
        free(program);
        return NULL;
    }
    program->push_words = source->push_bytes / sizeof(uint32_t);
    program->id = gpuweb_program(name, source->constants, (int)source->constant_count, gpu->error);
    gpu_program_bind(gpu, program, source->buffers);
    if (program->id) {
        gpu->pipelines++;
        return program;
    }
    gpu->status = GPU_FAILED;
    free(program);
    return NULL;
}

void gpu_program_destroy(struct gpu *gpu, struct gpu_program *program) {
    (void)gpu;
    free(program); // JavaScript keeps what was compiled
}

void gpu_program_bind(struct gpu *gpu, struct gpu_program *program,
                      struct gpu_buffer *const buffers[GPU_BINDINGS]) {
    (void)gpu;
    memcpy(program->buffers, buffers, sizeof program->buffers);
}

uint32_t gpu_pipelines_made(const struct gpu *gpu) {
    return gpu->pipelines;
}

bool gpu_program_tell(struct gpu *gpu, const struct gpu_program *program, gpu_tell *tell, void *context) {
    (void)gpu, (void)program, (void)tell, (void)context;
    return false;
}

// ---- dispatches

// Where the words of a binding begin, as shaders/web.h lists them.
static uint32_t begin_of(const struct gpu_program *program, int binding) {
    const struct gpu_buffer *buffer = program->buffers[binding];
    return buffer ? (uint32_t)(buffer->begin / WORD_BYTES) : 0;
}

bool gpu_dispatch(struct gpu *gpu, struct gpu_program *program, uint32_t groups_x, uint32_t groups_y,
                  const void *push) {
    uint32_t words[PUSH_WORDS];
    uint32_t count = program->push_words;
    int ids[GPU_BINDINGS];
    memcpy(words, push, count * sizeof *words);
    for (int binding = BINDING_TRIANGLE_NODES; binding <= BINDING_BACKGROUND; binding++)
        words[count++] = begin_of(program, binding);
    words[count++] = begin_of(program, BINDING_PAINTS);
    const struct gpu_buffer *background = program->buffers[BINDING_BACKGROUND];
    words[count++] = background && background->use == GPU_TEXELS_F32;
    for (int i = 0; i < GPU_BINDINGS; i++)
        ids[i] = program->buffers[i] ? program->buffers[i]->id : 0;
    ids[BINDING_WORDS] = gpu->words;
    gpuweb_dispatch(program->id, ids, GPU_BINDINGS, groups_x, groups_y, words, (int)count);
    return true;
}

bool gpu_dispatch_beside(struct gpu *gpu, struct gpu_program *program, uint32_t groups_x, uint32_t groups_y,
                         const void *push) {
    return gpu_dispatch(gpu, program, groups_x, groups_y, push);
}

bool gpu_copy(struct gpu *gpu, struct gpu_buffer *from, struct gpu_buffer *to, uint64_t bytes) {
    gpuweb_copy(id_of(gpu, from), (double)from->begin, to->id, (double)bytes, to->contents);
    return true;
}

bool gpu_clear(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, uint64_t bytes) {
    gpuweb_clear(id_of(gpu, buffer), (double)(buffer->begin + offset), (double)bytes);
    return true;
}

bool gpu_submit(struct gpu *gpu) {
    (void)gpu;
    gpuweb_submit();
    return true;
}

bool gpu_wait(struct gpu *gpu, double *seconds) {
    const double took = gpuweb_wait(gpu->error);
    if (seconds)
        *seconds = took > 0 ? took : 0;
    if (took < 0)
        gpu->status = took < -1 ? GPU_LOST : GPU_FAILED;
    return took >= 0;
}

bool gpu_compile(struct gpu *gpu, struct gpu_program *program, const void *push) {
    (void)gpu, (void)program, (void)push; // it is compiled when it is created
    return true;
}

// ---- a page has no window

struct gpu_screen *gpu_screen_create(struct gpu *gpu, gpu_make_surface *make_surface, void *context) {
    (void)make_surface, (void)context;
    fail(gpu, GPU_FAILED, "a page has no window");
    return NULL;
}
void gpu_screen_destroy(struct gpu *gpu, struct gpu_screen *screen) {
    (void)gpu, (void)screen;
}
enum gpu_shown gpu_screen_show(struct gpu *gpu, struct gpu_screen *screen, const uint8_t *pixels,
                               uint32_t width, uint32_t height) {
    (void)gpu, (void)screen, (void)pixels, (void)width, (void)height;
    return GPU_SHOW_FAILED;
}
