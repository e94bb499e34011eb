// The ZIP form of a package, through minizip.
#include "edit/pack/pack.h"

#include "core/arena.h"
#include "core/heap.h"
#include "files/files.h"
#include "files/output.h"

#include <errno.h>
#include <minizip/zip.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    CHUNK_BYTES = 1 << 16,
    MADE_BY_UNIX = 3 << 8 | 20, // gives the permissions below a meaning (APPNOTE 4.4.2)
    NAMES_ARE_UTF8 = 1 << 11,   // APPNOTE 4.4.4, general purpose bit 11
    FILE_MODE = 0100644,        // regular file
    LARGE_BYTES = 0x7fffffff,   // from here on ZIP64
    COMPRESSION_LEVEL = 6,
    ENTRY_BYTES = 46 + 32, // an entry in the archive's directory (APPNOTE 4.3.12), and what minizip adds
};

// If minizip or the system lacked memory, errno says so.
static void fail(struct pack_error *error, const struct output *output, const char *what, str path) {
    int reason = output->error ? output->error : errno;
    if (reason == ENOMEM)
        heap_exhausted(0);
    snprintf(error->text, sizeof error->text, "%s '%.*s': %s", what, STR_ARG(path),
             reason ? strerror(reason) : "the archive cannot be written");
}

// ---- minizip writes to what files/output opened and will rename

static voidpf open_output(voidpf opaque, const void *name, int mode) {
    (void)name;
    (void)mode;
    return opaque;
}

static uLong read_nothing(voidpf opaque, voidpf stream, void *bytes, uLong count) {
    (void)opaque;
    (void)stream;
    (void)bytes;
    (void)count;
    return 0;
}

static uLong write_output(voidpf opaque, voidpf stream, const void *bytes, uLong count) {
    struct output *output = stream;
    (void)opaque;
    output_write(output, bytes, count);
    return output->error ? 0 : count;
}

static ZPOS64_T tell_output(voidpf opaque, voidpf stream) {
    (void)opaque;
    return output_place(stream);
}

// minizip seeks to offsets that it got from tell, from the beginning.
static long seek_output(voidpf opaque, voidpf stream, ZPOS64_T offset, int origin) {
    struct output *output = stream;
    (void)opaque;
    output_move(output, origin == ZLIB_FILEFUNC_SEEK_CUR ? output_place(output) + offset : offset);
    return output->error || origin == ZLIB_FILEFUNC_SEEK_END ? -1 : 0;
}

static int keep_open(voidpf opaque, voidpf stream) {
    (void)opaque;
    (void)stream;
    return 0;
}

static int error_of(voidpf opaque, voidpf stream) {
    (void)opaque;
    return ((const struct output *)stream)->error;
}

// minizip does not check that it got memory for the header of an entry. The block freed here is given out
// again when as much is asked for.
static bool has_room(const char *name) {
    void *room = heap_alloc(ENTRY_BYTES + strlen(name));
    free(room);
    return room != NULL;
}

static bool put(zipFile zip, const char *name, str bytes) {
    zip_fileinfo info = {.tmz_date = {.tm_mday = 1, .tm_mon = 0, .tm_year = 1980},
                         .external_fa = (uLong)FILE_MODE << 16};
    bool large = bytes.len >= LARGE_BYTES;
    bool good = has_room(name) &&
                zipOpenNewFileInZip4_64(zip, name, &info, NULL, 0, NULL, 0, NULL, Z_DEFLATED,
                                        COMPRESSION_LEVEL, 0, -MAX_WBITS, DEF_MEM_LEVEL, Z_DEFAULT_STRATEGY,
                                        NULL, 0, MADE_BY_UNIX, NAMES_ARE_UTF8, large) == ZIP_OK;
    for (size_t at = 0; good && at < bytes.len; at += CHUNK_BYTES) {
        str chunk = str_slice(bytes, at, bytes.len - at < CHUNK_BYTES ? bytes.len : at + CHUNK_BYTES);
        good = zipWriteInFileInZip(zip, chunk.ptr, (unsigned)chunk.len) == ZIP_OK;
    }
    return good && zipCloseFileInZip(zip) == ZIP_OK;
}

struct packing {
    zipFile zip;
    struct output *output;
    const char *folder;
    str target;
    struct arena arena;
    struct pack_error *error;
    bool good;
};

static void read_and_put(void *context) {
    struct packing *p = context;
    struct files files;
    str bytes;
    str path = arena_format(&p->arena, "%s/%.*s", p->folder, STR_ARG(p->target));
    files_init(&files, &p->arena);
    enum file_status status = files_read_given(&files, path, UINT64_MAX / 4, &p->arena, &bytes);
    if (status != FILE_OK) {
        snprintf(p->error->text, sizeof p->error->text, "'%.*s' %s", STR_ARG(p->target),
                 file_status_text(&files, status));
        return;
    }
    errno = 0;
    p->good = put(p->zip, arena_copy(&p->arena, p->target).ptr, bytes);
    if (!p->good)
        fail(p->error, p->output, "cannot pack", p->target);
}

static bool add_file(struct packing packing) {
    arena_init(&packing.arena, SIZE_MAX / 2);
    if (arena_guarded(&packing.arena, read_and_put, &packing) != ARENA_FAULT_NONE) {
        errno = ENOMEM;
        fail(packing.error, packing.output, "cannot pack", packing.target);
    }
    arena_finish(&packing.arena);
    return packing.good;
}

bool pack_zip(const struct pack_plan *plan, const char *folder, const char *out, pack_is_stopped *is_stopped,
              struct pack_error *error) {
    struct output output;
    zlib_filefunc64_def functions = {open_output, read_nothing, write_output, tell_output,
                                     seek_output, keep_open,    error_of,     &output};
    if (!output_open(&output, out)) {
        fail(error, &output, "cannot write", str_from(out));
        return false;
    }
    errno = 0;
    zipFile zip = zipOpen2_64(out, APPEND_STATUS_CREATE, NULL, &functions);
    bool good = zip != NULL;
    for (uint32_t i = 0; good && i < plan->count; i++)
        good = !(is_stopped && is_stopped()) && add_file((struct packing){.zip = zip,
                                                                          .output = &output,
                                                                          .folder = folder,
                                                                          .target = plan->items[i].target,
                                                                          .error = error});
    if (!zip || (zipClose(zip, NULL) != ZIP_OK && good)) {
        fail(error, &output, "cannot write", str_from(out));
        good = false;
    }
    if (!good) {
        output_abandon(&output);
    } else if (!output_commit(&output)) {
        fail(error, &output, "cannot write", str_from(out));
        good = false;
    }
    return good;
}
