// The ZIP form of a package, through minizip.
#include "app/pack.h"

#include "core/arena.h"
#include "core/output.h"

#include <errno.h>
#include <minizip/zip.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum {
    CHUNK_BYTES = 1 << 16,
    MADE_BY_UNIX = 3 << 8 | 20, // so that the permissions below mean something (APPNOTE 4.4.2)
    NAMES_ARE_UTF8 = 1 << 11,   // APPNOTE 4.4.4, general purpose bit 11
    FILE_MODE = 0100644,        // regular file
    LARGE_BYTES = 0x7fffffff,   // from here on ZIP64
    COMPRESSION_LEVEL = 6,
};

static void fail(struct pack_error *error, const char *what, const char *path) {
    snprintf(error->text, sizeof error->text, "%s '%s': %s", what, path,
             errno ? strerror(errno) : "the archive cannot be written");
}

// minizip opens and closes what core/output opened and will rename.
static voidpf give_stream(voidpf opaque, const void *name, int mode) {
    (void)name;
    (void)mode;
    return ((struct output *)opaque)->stream;
}

static int keep_open(voidpf opaque, voidpf stream) {
    (void)opaque;
    return fflush(stream);
}

static bool copy_bytes(zipFile zip, FILE *in, char *buffer) {
    for (;;) {
        size_t count = fread(buffer, 1, CHUNK_BYTES, in);
        if (count && zipWriteInFileInZip(zip, buffer, (unsigned)count) != ZIP_OK)
            return false;
        if (count < CHUNK_BYTES)
            return !ferror(in);
    }
}

static bool add_file(zipFile zip, const char *folder, str target, char *buffer, struct pack_error *error) {
    char path[4096];
    char name[4096];
    snprintf(path, sizeof path, "%s/%.*s", folder, STR_ARG(target));
    snprintf(name, sizeof name, "%.*s", STR_ARG(target));
    errno = 0;
    FILE *in = fopen(path, "rb");
    if (!in || fseeko(in, 0, SEEK_END) != 0) {
        fail(error, "cannot read", path);
        if (in)
            fclose(in);
        return false;
    }
    bool large = ftello(in) >= LARGE_BYTES;
    rewind(in);
    zip_fileinfo info = {.tmz_date = {.tm_mday = 1, .tm_mon = 0, .tm_year = 1980},
                         .external_fa = (uLong)FILE_MODE << 16};
    bool good = zipOpenNewFileInZip4_64(zip, name, &info, NULL, 0, NULL, 0, NULL, Z_DEFLATED,
                                        COMPRESSION_LEVEL, 0, -MAX_WBITS, DEF_MEM_LEVEL, Z_DEFAULT_STRATEGY,
                                        NULL, 0, MADE_BY_UNIX, NAMES_ARE_UTF8, large) == ZIP_OK &&
                copy_bytes(zip, in, buffer) && zipCloseFileInZip(zip) == ZIP_OK;
    if (!good)
        fail(error, "cannot pack", name);
    fclose(in);
    return good;
}

bool pack_zip(const struct pack_plan *plan, const char *folder, const char *out, struct pack_error *error) {
    struct output output;
    zlib_filefunc64_def functions;
    char *buffer = malloc(CHUNK_BYTES);
    if (!buffer || !output_open(&output, out)) {
        errno = buffer ? output.error : ENOMEM;
        fail(error, "cannot write", out);
        free(buffer);
        return false;
    }
    fill_fopen64_filefunc(&functions);
    functions.zopen64_file = give_stream;
    functions.zclose_file = keep_open;
    functions.opaque = &output;
    errno = 0;
    zipFile zip = zipOpen2_64(out, APPEND_STATUS_CREATE, NULL, &functions);
    bool good = zip != NULL;
    for (uint32_t i = 0; good && i < plan->count; i++)
        good = add_file(zip, folder, plan->items[i].target, buffer, error);
    if (!zip || (zipClose(zip, NULL) != ZIP_OK && good)) {
        fail(error, "cannot write", out);
        good = false;
    }
    if (!good) {
        output_abandon(&output);
    } else if (!output_commit(&output)) {
        errno = output.error;
        fail(error, "cannot write", out);
        good = false;
    }
    free(buffer);
    return good;
}
