// The two forms of a glTF file: JSON as it is, and GLB, a header with chunks.
#include "assets/gltf/gltf_internal.h"
#include "diag/codes/file.h"

enum {
    HEADER_BYTES = 12,
    CHUNK_HEADER_BYTES = 8,
    CHUNK_JSON = 0x4E4F534A,
    CHUNK_BIN = 0x004E4942,
};

static uint32_t word(str bytes, size_t at) {
    const unsigned char *p = (const unsigned char *)bytes.ptr + at;
    return (uint32_t)p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

bool gltf_is_binary(str bytes) {
    return str_starts_with(bytes, STR("glTF"));
}

// The chunk at *at, which moves past it; false: the fault is reported.
static bool take_chunk(struct gltf *gltf, str bytes, size_t *at, uint32_t *kind, str *chunk) {
    if (bytes.len - *at < CHUNK_HEADER_BYTES) {
        gltf_add(gltf, DIAG_GLTF_SYNTAX, 0, "the file ends at byte %zu, inside the header of a chunk",
                 bytes.len);
        return false;
    }
    const uint32_t length = word(bytes, *at);
    *kind = word(bytes, *at + 4);
    *at += CHUNK_HEADER_BYTES;
    if (length > bytes.len - *at) {
        gltf_add(gltf, DIAG_GLTF_SYNTAX, 0, "the chunk at byte %zu has %u bytes, and the file only %zu more",
                 *at - CHUNK_HEADER_BYTES, length, bytes.len - *at);
        return false;
    }
    if (length % 4)
        gltf_add(gltf, DIAG_GLTF_RULE, 0, "the chunk at byte %zu has %u bytes, which is not a multiple of 4",
                 *at - CHUNK_HEADER_BYTES, length);
    *chunk = str_slice(bytes, *at, *at + length);
    *at += length;
    return true;
}

static bool check_header(struct gltf *gltf, str *bytes) {
    if (bytes->len < HEADER_BYTES) {
        gltf_add(gltf, DIAG_GLTF_SYNTAX, 0, "the file ends at byte %zu, inside its header", bytes->len);
        return false;
    }
    const uint32_t version = word(*bytes, 4), length = word(*bytes, 8);
    if (version != 2) {
        gltf_add(gltf, DIAG_GLTF_SYNTAX, 0, "the file is GLB version %u; glint reads version 2", version);
        return false;
    }
    if (length < HEADER_BYTES || length > bytes->len) {
        gltf_add(gltf, DIAG_GLTF_SYNTAX, 0, "the header says %u bytes, and the file has %zu", length,
                 bytes->len);
        return false;
    }
    if (length < bytes->len)
        gltf_add(gltf, DIAG_GLTF_RULE, 0,
                 "the header says %u bytes, and the file has %zu: the rest is ignored", length, bytes->len);
    *bytes = str_slice(*bytes, 0, length);
    return true;
}

bool gltf_take_chunks(struct gltf *gltf, str bytes, str *text) {
    size_t at = HEADER_BYTES;
    uint32_t kind;
    gltf->is_binary = true;
    if (!check_header(gltf, &bytes) || !take_chunk(gltf, bytes, &at, &kind, text))
        return false;
    if (kind != CHUNK_JSON) {
        gltf_add(gltf, DIAG_GLTF_SYNTAX, 0, "the first chunk, at byte 12, is not JSON");
        return false;
    }
    for (str chunk; at < bytes.len;) {
        const size_t begin = at;
        if (!take_chunk(gltf, bytes, &at, &kind, &chunk))
            return false;
        if (kind == CHUNK_BIN && !gltf->has_chunk && begin == HEADER_BYTES + CHUNK_HEADER_BYTES + text->len) {
            gltf->chunk = chunk;
            gltf->has_chunk = true;
        } else if (kind == CHUNK_BIN) {
            gltf_add(gltf, DIAG_GLTF_RULE, 0,
                     "the binary chunk at byte %zu is not the second one, and is ignored", begin);
        }
    }
    return true;
}
