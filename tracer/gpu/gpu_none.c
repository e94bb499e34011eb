// The devices of a program that is built without them (GLINT_DEVICE=OFF): there are none. Functions that take
// a gpu are never called, because no gpu is ever made; they fail as on a device that does not answer.
#include "tracer/gpu/gpu_screen.h"

#include <stdio.h>

static enum gpu_status say(char error[GPU_ERROR_BYTES]) {
    snprintf(error, GPU_ERROR_BYTES, "this glint is built to check scenes: it draws on no device");
    return GPU_LEFT_OUT;
}

enum gpu_status gpu_list(struct gpu_device_info *items, uint32_t capacity, uint32_t *count,
                         char error[GPU_ERROR_BYTES]) {
    (void)items;
    (void)capacity;
    *count = 0;
    return say(error);
}

enum gpu_status gpu_create(const struct gpu_options *options, struct gpu **out, char error[GPU_ERROR_BYTES]) {
    (void)options;
    *out = NULL;
    return say(error);
}

// ---- of a gpu

bool gpu_destroy(struct gpu *gpu) {
    (void)gpu;
    return true;
}

const struct gpu_device_info *gpu_info(const struct gpu *gpu) {
    static const struct gpu_device_info none;
    (void)gpu;
    return &none;
}

const char *gpu_error(const struct gpu *gpu) {
    (void)gpu;
    return "there is no device";
}

enum gpu_status gpu_last_status(const struct gpu *gpu) {
    (void)gpu;
    return GPU_LOST;
}

struct gpu_buffer *gpu_buffer_create(struct gpu *gpu, enum gpu_use use, uint64_t bytes) {
    (void)gpu, (void)use, (void)bytes;
    return NULL;
}

void gpu_buffer_destroy(struct gpu *gpu, struct gpu_buffer *buffer) {
    (void)gpu, (void)buffer;
}

uint64_t gpu_buffer_bytes(const struct gpu_buffer *buffer) {
    (void)buffer;
    return 0;
}

bool gpu_write(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, const void *data,
               uint64_t bytes) {
    (void)gpu, (void)buffer, (void)offset, (void)data, (void)bytes;
    return false;
}

bool gpu_fill(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, uint64_t bytes, gpu_put *put,
              void *context) {
    (void)gpu, (void)buffer, (void)offset, (void)bytes, (void)put, (void)context;
    return false;
}

bool gpu_read(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, void *data, uint64_t bytes) {
    (void)gpu, (void)buffer, (void)offset, (void)data, (void)bytes;
    return false;
}

const void *gpu_contents(const struct gpu_buffer *buffer) {
    (void)buffer;
    return NULL;
}

bool gpu_fetches_texels(const struct gpu *gpu) {
    (void)gpu;
    return false;
}

struct gpu_program *gpu_program_create(struct gpu *gpu, const struct gpu_program_source *source) {
    (void)gpu, (void)source;
    return NULL;
}

void gpu_program_destroy(struct gpu *gpu, struct gpu_program *program) {
    (void)gpu, (void)program;
}

void gpu_program_bind(struct gpu *gpu, struct gpu_program *program,
                      struct gpu_buffer *const buffers[GPU_BINDINGS]) {
    (void)gpu, (void)program, (void)buffers;
}

uint32_t gpu_pipelines_made(const struct gpu *gpu) {
    (void)gpu;
    return 0;
}

bool gpu_program_tell(struct gpu *gpu, const struct gpu_program *program, gpu_tell *tell, void *context) {
    (void)gpu, (void)program, (void)tell, (void)context;
    return false;
}

bool gpu_dispatch(struct gpu *gpu, struct gpu_program *program, uint32_t groups_x, uint32_t groups_y,
                  const void *push) {
    (void)gpu, (void)program, (void)groups_x, (void)groups_y, (void)push;
    return false;
}

bool gpu_dispatch_beside(struct gpu *gpu, struct gpu_program *program, uint32_t groups_x, uint32_t groups_y,
                         const void *push) {
    return gpu_dispatch(gpu, program, groups_x, groups_y, push);
}

bool gpu_copy(struct gpu *gpu, struct gpu_buffer *from, struct gpu_buffer *to, uint64_t bytes) {
    (void)gpu, (void)from, (void)to, (void)bytes;
    return false;
}

bool gpu_clear(struct gpu *gpu, struct gpu_buffer *buffer, uint64_t offset, uint64_t bytes) {
    (void)gpu, (void)buffer, (void)offset, (void)bytes;
    return false;
}

bool gpu_submit(struct gpu *gpu) {
    (void)gpu;
    return false;
}

bool gpu_wait(struct gpu *gpu, double *seconds) {
    (void)gpu, (void)seconds;
    return false;
}

bool gpu_compile(struct gpu *gpu, struct gpu_program *program, const void *push) {
    (void)gpu, (void)program, (void)push;
    return false;
}

struct gpu_screen *gpu_screen_create(struct gpu *gpu, gpu_make_surface *make, void *context) {
    (void)gpu, (void)make, (void)context;
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
