// The graphics processor: device, buffers, program, dispatch, times. The only folder that sees Vulkan.
//
// Compute only, and headless except for gpu_screen.h. The Vulkan loader is opened at run time: a program that
// never calls gpu_create or gpu_list runs where no Vulkan is installed. CPU drivers (lavapipe) are devices
// like others. Errors: functions return false, or a status; gpu_error then has one line of text. After
// GPU_LOST only destroying works. Ownership: *_create returns a heap object, *_destroy takes NULL; buffers
// and programs must be destroyed before their gpu. Sizes in bytes, times in seconds. Thread safety: one
// thread at a time for a gpu and all that belongs to it, and one in the whole process for gpu_list,
// gpu_create and gpu_destroy.
#ifndef GLINT_TRACER_GPU_GPU_H
#define GLINT_TRACER_GPU_GPU_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum gpu_status {
    GPU_OK,
    GPU_LEFT_OUT,  // the program was built without devices (gpu_none.c)
    GPU_NO_LOADER, // libvulkan is not installed
    GPU_NO_DRIVER, // the loader is there, but no driver with a device that can compute
    GPU_NO_DEVICE, // no device with the name or number asked for
    GPU_NO_MEMORY, // the device, or this process, has too little
    GPU_FAILED,    // another Vulkan call failed
    GPU_LOST,      // the device stopped answering
};

enum gpu_kind {
    GPU_DISCRETE,
    GPU_INTEGRATED,
    GPU_VIRTUAL,
    GPU_CPU,
};

enum {
    GPU_ERROR_BYTES = 512,
    GPU_BINDINGS = 20
};

struct gpu_device_info {
    char name[256];
    char driver[520]; // name and version as the driver reports them; may be empty
    uint32_t number;  // what `device` may name
    enum gpu_kind kind;
    uint64_t memory_bytes;  // of the largest heap that is the device's own
    uint64_t storage_bytes; // the largest size of a GPU_STORAGE buffer
    bool has_double;        // kernels may compute in double precision
    bool preferred;         // the one that an empty choice takes
};

// Where compiled kernels are kept between runs, under a key of device, driver and all that was compiled.
// Called on the gpu's thread. An entry that cannot be read is NULL, and one that cannot be kept is lost:
// neither is an error.
struct gpu_keep {
    void *(*read)(void *context, const uint64_t key[2], size_t *count); // from malloc; NULL: there is none
    void (*write)(void *context, const uint64_t key[2], const void *bytes, size_t count);
    void *context; // outlives the gpu
    // For tests: also on a CPU device, and even if it holds only what the driver writes beforehand.
    bool always;
};

struct gpu_options {
    // A number, or part of a device's name (case ignored). NULL or empty: discrete before integrated
    // before virtual before CPU, then the lower number.
    const char *device;
    bool storage;  // GPU_WORDS are storage buffers on a CPU device too: to test there what runs on GPUs
    bool tells;    // gpu_program_tell reports figures, if the driver has them
    bool validate; // core validation, where the layer is installed; its messages are counted
    // Where validation messages are counted, leaks found by gpu_destroy included; may be NULL. Must
    // outlive the gpu.
    uint32_t *validation_messages;
    struct gpu_keep keep; // zeroed: not kept
    // Vulkan instance extensions that a window needs (tracer/gpu/gpu_screen.h); NULL: no window.
    const char *const *screen_extensions;
    uint32_t screen_extension_count;
};

struct gpu;
struct gpu_buffer;
struct gpu_program;

// Fills at most `capacity` devices, *count becomes the number of devices. `error` gets text unless GPU_OK.
enum gpu_status gpu_list(struct gpu_device_info *items, uint32_t capacity, uint32_t *count,
                         char error[GPU_ERROR_BYTES]);
// On GPU_OK *out is a gpu; else NULL, with text in `error`.
enum gpu_status gpu_create(const struct gpu_options *options, struct gpu **out, char error[GPU_ERROR_BYTES]);
// false: the device was given work whose end could not be awaited. The resources of that work are never
// freed, and the program must end without running its libraries' exit handlers.
bool gpu_destroy(struct gpu *gpu);
const struct gpu_device_info *gpu_info(const struct gpu *gpu);
// What failed last; the text lives until the next failure. Never NULL.
const char *gpu_error(const struct gpu *gpu);
enum gpu_status gpu_last_status(const struct gpu *gpu);

enum gpu_use {
    GPU_WORDS,      // read-only array of 16-byte words: texels on CPU devices, storage elsewhere
    GPU_TEXELS_U8,  // uniform texels, RGBA8 normalised
    GPU_TEXELS_F32, // uniform texels, RGBA32F
    GPU_STORAGE,    // read and written by kernels
    GPU_UNIFORM,    // small, rewritten often
    GPU_HOST,       // in this process' memory, filled by gpu_copy and read by gpu_contents
};

// A buffer of at least one word, of undefined content. NULL on failure.
struct gpu_buffer *gpu_buffer_create(struct gpu *gpu, enum gpu_use use, uint64_t bytes);
void gpu_buffer_destroy(struct gpu *gpu, struct gpu_buffer *buffer);
uint64_t gpu_buffer_bytes(const struct gpu_buffer *buffer);
// Copy between this process and a buffer; the range must lie inside it. They wait for the device.
bool gpu_write(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, const void *data, uint64_t bytes);
// The same for data made on the fly: `put` writes bytes [offset, offset + bytes) of the buffer to `to`, whole
// words of 16, in pieces of ascending offsets.
typedef void gpu_put(void *context, uint64_t offset, void *to, uint64_t bytes);
bool gpu_fill(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, uint64_t bytes, gpu_put *put,
              void *context);
bool gpu_read(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, void *data, uint64_t bytes);
// The contents of a buffer in this process' memory: GPU_HOST, and buffers that a CPU device's kernels read or
// write; else NULL. Defined after a gpu_wait that follows the copies or dispatches that write it.
const void *gpu_contents(const struct gpu_buffer *buffer);
// True if GPU_WORDS are texels: tells which variant of a kernel to use.
bool gpu_fetches_texels(const struct gpu *gpu);

struct kernel; // shaders/kernel.h

struct gpu_program_source {
    const struct kernel *kernel; // entry point `main`
    const uint32_t *constants;   // specialization constants with the ids 0, 1, 2 ...
    uint32_t constant_count;
    uint32_t push_bytes;                      // of push constants, at most 128
    struct gpu_buffer *buffers[GPU_BINDINGS]; // by binding; NULL: the kernel has no such binding
};

// Compiles a kernel and ties it to its buffers, which must outlive it. NULL on failure.
struct gpu_program *gpu_program_create(struct gpu *gpu, const struct gpu_program_source *source);
void gpu_program_destroy(struct gpu *gpu, struct gpu_program *program);
// Ties a kernel to other buffers, of the same uses and at the same bindings. No dispatch may be recorded or
// running.
void gpu_program_bind(struct gpu *gpu, struct gpu_program *program,
                      struct gpu_buffer *const buffers[GPU_BINDINGS]);

// How many pipelines were made so far: programs with the same kernel and constants share one.
uint32_t gpu_pipelines_made(const struct gpu *gpu);

// The driver's figures about the compiled kernel, in its own words: registers, private memory, size of the
// code (VK_KHR_pipeline_executable_properties). Calls `tell` for each figure; false: it says nothing.
typedef void gpu_tell(void *context, const char *name, double value);
bool gpu_program_tell(struct gpu *gpu, const struct gpu_program *program, gpu_tell *tell, void *context);

// Records a dispatch of groups_x times groups_y workgroups after those recorded before; each sees what
// earlier ones wrote. `push` holds the program's push constants.
bool gpu_dispatch(struct gpu *gpu, struct gpu_program *program, uint32_t groups_x, uint32_t groups_y,
                  const void *push);
// The same for a dispatch that may run beside the next one recorded: neither sees what the other writes.
bool gpu_dispatch_beside(struct gpu *gpu, struct gpu_program *program, uint32_t groups_x, uint32_t groups_y,
                         const void *push);
// Record a copy between two buffers, and a fill with zeros, after what was recorded before; ranges are
// multiples of four bytes and must lie inside. Later recordings see the result.
bool gpu_copy(struct gpu *gpu, struct gpu_buffer *from, struct gpu_buffer *to, uint64_t bytes);
bool gpu_clear(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, uint64_t bytes);
// Sends what was recorded to the device. gpu_wait waits for it; *seconds, unless NULL, gets the time from the
// first dispatch's start to the last one's end on the device's own clock.
bool gpu_submit(struct gpu *gpu);
bool gpu_wait(struct gpu *gpu, double *seconds);
// On a device that compiles a kernel at its first dispatch (lavapipe), starts compiling by an empty dispatch,
// while this thread goes on: gpu_write and gpu_fill do not wait for it, other calls do.
bool gpu_compile(struct gpu *gpu, struct gpu_program *program, const void *push);

#endif
