#include "sample.h"

#include "picture/write/image.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    IMAGE_SIDE = 8,
    FLOAT = 5126,
    INT8 = 5120,
    UINT8 = 5121,
    UINT16 = 5123,
    UINT32 = 5125,
};

struct making {
    enum sample_form form;
    struct strbuf bytes, views, accessors;
    uint32_t view_count, accessor_count;
};

// ---- bytes

static void pad(struct strbuf *out, char with) {
    while (out->len % 4)
        strbuf_char(out, with);
}

static void put(struct strbuf *out, const void *bytes, size_t count) {
    strbuf_str(out, (str){bytes, count});
}

static void put_word(struct strbuf *out, uint32_t word) {
    const unsigned char bytes[4] = {(unsigned char)word, (unsigned char)(word >> 8),
                                    (unsigned char)(word >> 16), (unsigned char)(word >> 24)};
    put(out, bytes, 4);
}

static void put_base64(struct strbuf *out, str bytes) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < bytes.len; i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; k++)
            bits = bits << 8 | (i + k < bytes.len ? (unsigned char)bytes.ptr[i + k] : 0);
        for (size_t k = 0; k < 4; k++)
            strbuf_char(out, i + k > bytes.len ? '=' : digits[bits >> (18 - 6 * k) & 63]);
    }
}

static uint32_t add_view(struct making *m, const void *bytes, size_t count, uint32_t stride) {
    pad(&m->bytes, '\0');
    strbuf_format(&m->views, "%s{\"buffer\": 0, \"byteOffset\": %zu, \"byteLength\": %zu",
                  m->view_count ? ",\n  " : "", m->bytes.len, count);
    if (stride)
        strbuf_format(&m->views, ", \"byteStride\": %u", stride);
    strbuf_char(&m->views, '}');
    put(&m->bytes, bytes, count);
    return m->view_count++;
}

static uint32_t add_accessor(struct making *m, uint32_t view, unsigned component, uint32_t count,
                             const char *type, const char *more) {
    strbuf_format(&m->accessors,
                  "%s{\"bufferView\": %u, \"componentType\": %u, \"count\": %u, \"type\": \"%s\"%s}",
                  m->accessor_count ? ",\n  " : "", view, component, count, type, more);
    return m->accessor_count++;
}

static uint32_t add_positions(struct making *m, const float (*p)[3], uint32_t count) {
    float low[3], high[3];
    char more[200];
    memcpy(low, p[0], sizeof low);
    memcpy(high, p[0], sizeof high);
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            low[k] = fminf(low[k], p[i][k]);
            high[k] = fmaxf(high[k], p[i][k]);
        }
    snprintf(more, sizeof more, ", \"min\": [%g, %g, %g], \"max\": [%g, %g, %g]", (double)low[0],
             (double)low[1], (double)low[2], (double)high[0], (double)high[1], (double)high[2]);
    return add_accessor(m, add_view(m, p, count * sizeof *p, 0), FLOAT, count, "VEC3", more);
}

// ---- shapes

// Accessors 0 to 3: positions, normals as bytes, coordinates as shorts, indices as bytes.
static void add_box(struct making *m) {
    float positions[24][3];
    int8_t normals[24][4] = {{0}};
    uint16_t coordinates[24][2];
    uint8_t indices[36];
    for (int face = 0; face < 6; face++) {
        const int axis = face / 2, sign = face % 2 ? 1 : -1;
        for (int i = 0; i < 4; i++) {
            const int at = 4 * face + i, u = i == 1 || i == 2, v = i >= 2;
            positions[at][axis] = 0.5F * (float)sign;
            positions[at][(axis + 1) % 3] = (float)(sign > 0 ? u : 1 - u) - 0.5F;
            positions[at][(axis + 2) % 3] = (float)v - 0.5F;
            normals[at][axis] = (int8_t)(127 * sign);
            coordinates[at][0] = (uint16_t)(65535 * u);
            coordinates[at][1] = (uint16_t)(65535 * (1 - v));
        }
        static const uint8_t corners[6] = {0, 1, 2, 0, 2, 3};
        for (int i = 0; i < 6; i++)
            indices[6 * face + i] = (uint8_t)(4 * face + corners[i]);
    }
    add_positions(m, (const float(*)[3])positions, 24);
    add_accessor(m, add_view(m, normals, sizeof normals, 4), INT8, 24, "VEC3", ", \"normalized\": true");
    add_accessor(m, add_view(m, coordinates, sizeof coordinates, 0), UINT16, 24, "VEC2",
                 ", \"normalized\": true");
    add_accessor(m, add_view(m, indices, sizeof indices, 0), UINT8, 36, "SCALAR", "");
}

// Accessor 4: the triangles of an octahedron. 5 and 6: its corners, and indices of 32 bits.
static void add_gem(struct making *m) {
    static const float corners[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    float positions[24][3];
    uint32_t indices[24];
    for (uint32_t i = 0; i < 8; i++) {
        const uint32_t x = i & 1, y = i >> 1 & 1, z = i >> 2 & 1, odd = (x + y + z) & 1;
        const uint32_t at[3] = {x, odd ? 4 + z : 2 + y, odd ? 2 + y : 4 + z};
        for (uint32_t k = 0; k < 3; k++) {
            memcpy(positions[3 * i + k], corners[at[k]], sizeof corners[0]);
            indices[3 * i + k] = at[k];
        }
    }
    add_positions(m, (const float(*)[3])positions, 24);
    add_positions(m, corners, 6);
    add_accessor(m, add_view(m, indices, sizeof indices, 0), UINT32, 24, "SCALAR", "");
}

// Accessors 7 and 8: six points for a strip and a fan, and their order in 16 bits. 9: the same points, the
// last of which is moved by a sparse value.
static void add_strips(struct making *m) {
    static const float points[6][3] = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}};
    static const uint16_t order[6] = {0, 1, 2, 3, 4, 5};
    static const uint8_t moved = 5;
    static const float to[3] = {2, 2, 0};
    char more[300];
    add_positions(m, points, 6);
    add_accessor(m, add_view(m, order, sizeof order, 0), UINT16, 6, "SCALAR", "");
    const uint32_t indices = add_view(m, &moved, 1, 0), values = add_view(m, to, sizeof to, 0);
    snprintf(more, sizeof more,
             ", \"min\": [0, 0, 0], \"max\": [2, 2, 0], \"sparse\": {\"count\": 1, \"indices\": "
             "{\"bufferView\": %u, "
             "\"componentType\": 5121}, \"values\": {\"bufferView\": %u}}",
             indices, values);
    add_accessor(m, add_view(m, points, sizeof points, 0), FLOAT, 6, "VEC3", more);
}

// ---- images

static void make_image(int number, struct strbuf *out) {
    float rgb[3 * IMAGE_SIDE * IMAGE_SIDE];
    for (int i = 0; i < IMAGE_SIDE * IMAGE_SIDE; i++)
        for (int k = 0; k < 3; k++) {
            const float tone = 0.5F + 0.45F * sinf((float)(number + 7 * k));
            rgb[3 * i + k] = (i / 2 + i / 16) % 2 ? tone : 1 - tone;
        }
    const struct image image = {.width = IMAGE_SIDE, .height = IMAGE_SIDE, .rgb = rgb};
    strbuf_init(out);
    image_encode(&image, IMAGE_PNG, (struct image_display){0}, out);
}

static void put_images(struct making *m, struct sample *out, struct strbuf *json) {
    strbuf_cstr(json, " \"images\": [");
    for (int i = 0; i < SAMPLE_IMAGES; i++) {
        const str png = strbuf_view(&out->images[i]);
        strbuf_format(json, "%s{\"name\": \"image %d\", ", i ? ",\n  " : "", i);
        if (m->form == SAMPLE_GLB) {
            strbuf_format(json, "\"mimeType\": \"image/png\", \"bufferView\": %u}",
                          add_view(m, png.ptr, png.len, 0));
        } else if (m->form == SAMPLE_BESIDE) {
            strbuf_format(json, "\"uri\": \"image%%20%d.png\"}", i);
        } else {
            strbuf_cstr(json, "\"uri\": \"data:image/png;base64,");
            put_base64(json, png);
            strbuf_cstr(json, "\"}");
        }
    }
    strbuf_cstr(json, "],\n \"textures\": [");
    for (int i = 0; i < SAMPLE_IMAGES; i++)
        strbuf_format(json, "%s{\"source\": %d, \"sampler\": %d}", i ? ", " : "", i, i % 2);
    strbuf_cstr(json,
                "],\n \"samplers\": [{}, {\"magFilter\": 9728, \"wrapS\": 33648, \"wrapT\": 33648}],\n");
}

// ---- the scene

static void put_looks(struct strbuf *json) {
    strbuf_cstr(json, " \"materials\": [");
    for (int i = 0; i < SAMPLE_IMAGES; i++)
        strbuf_format(
            json,
            "{\"name\": \"painted %d\", \"pbrMetallicRoughness\": {\"baseColorTexture\": {\"index\": %d}, "
            "\"metallicFactor\": 0, \"roughnessFactor\": 0.6}},\n  ",
            i, i);
    strbuf_cstr(
        json,
        "{\"name\": \"glass\", \"pbrMetallicRoughness\": {\"metallicFactor\": 0, \"roughnessFactor\": 0}, "
        "\"extensions\": {\"KHR_materials_transmission\": {\"transmissionFactor\": 1}, "
        "\"KHR_materials_ior\": "
        "{\"ior\": 1.5}, \"KHR_materials_volume\": {\"thicknessFactor\": 1, \"attenuationDistance\": 1, "
        "\"attenuationColor\": [0.6, 0.9, 0.7]}}},\n  {\"name\": \"flat\", \"pbrMetallicRoughness\": "
        "{\"baseColorFactor\": [0.2, 0.6, 0.3, 1]}, \"extensions\": {\"KHR_materials_unlit\": {}}}],\n");
}

static void put_meshes(struct strbuf *json) {
    strbuf_cstr(json, " \"meshes\": [");
    for (int i = 0; i < SAMPLE_IMAGES; i++)
        strbuf_format(
            json,
            "{\"name\": \"box %d\", \"primitives\": [{\"attributes\": {\"POSITION\": 0, \"NORMAL\": 1, "
            "\"TEXCOORD_0\": 2}, \"indices\": 3, \"material\": %d}]},\n  ",
            i, i);
    strbuf_cstr(
        json,
        "{\"name\": \"gem\", \"primitives\": [{\"attributes\": {\"POSITION\": 4}, \"material\": 20}]},\n  "
        "{\"name\": \"gem\", \"primitives\": [{\"attributes\": {\"POSITION\": 5}, \"indices\": 6, "
        "\"material\": 20}]},"
        "\n  {\"primitives\": [{\"attributes\": {\"POSITION\": 7}, \"indices\": 8, \"mode\": 5, "
        "\"material\": 21}, "
        "{\"attributes\": {\"POSITION\": 9}, \"mode\": 6}]}],\n");
}

static void put_nodes(struct strbuf *json) {
    strbuf_cstr(json, " \"nodes\": [");
    for (int i = 0; i < SAMPLE_IMAGES; i++)
        strbuf_format(json, "{\"name\": \"box\", \"mesh\": %d, \"translation\": [%g, 0.5, %g]},\n  ", i,
                      (i % 5 - 2) * 1.5, (i / 5 - 2) * 1.5);
    strbuf_cstr(json,
                "{\"mesh\": 20, \"translation\": [-2, 1.2, 3.5]},\n  {\"mesh\": 21, \"translation\": [0, "
                "1.2, 3.5], \"scale\": "
                "[-1, 1, 1]},\n  {\"mesh\": 20, \"matrix\": [0, 0, -0.7, 0, 0, 0.7, 0, 0, 0.7, 0, 0, 0, 2, "
                "1.2, 3.5, 1]},\n  "
                "{\"name\": \"stretched\", \"scale\": [1, 2, 1], \"translation\": [3, 1, 4.2], \"children\": "
                "[24]},\n  "
                "{\"name\": \"leaning\", \"mesh\": 20, \"rotation\": [0, 0, 0.38268343, 0.92387953], "
                "\"scale\": [0.5, 0.5, 0.5]},"
                "\n  {\"mesh\": 22, \"translation\": [-4, 0, 4]},\n  {\"name\": \"eye\", \"camera\": 0, "
                "\"translation\": [0, 4, 9], "
                "\"rotation\": [-0.17364818, 0, 0, 0.98480775]},\n  {\"name\": \"above\", \"camera\": 1, "
                "\"translation\": [0, 9, 0], "
                "\"rotation\": [-0.70710678, 0, 0, 0.70710678]},\n  {\"name\": \"sun\", \"rotation\": [-0.5, "
                "0.1, 0, 0.86023253], "
                "\"extensions\": {\"KHR_lights_punctual\": {\"light\": 0}}},\n  {\"name\": \"lamp\", "
                "\"translation\": [3, 5, 5], "
                "\"extensions\": {\"KHR_lights_punctual\": {\"light\": 1}}},\n  {\"name\": \"lamp\", "
                "\"translation\": [-3, 5, 5], "
                "\"extensions\": {\"KHR_lights_punctual\": {\"light\": 2}}}],\n \"scenes\": [{\"nodes\": [");
    for (int i = 0; i <= 30; i++)
        if (i != 24)
            strbuf_format(json, "%s%d", i ? ", " : "", i);
    strbuf_cstr(
        json,
        "]}],\n \"scene\": 0,\n \"cameras\": [{\"type\": \"perspective\", \"perspective\": {\"yfov\": 0.8, "
        "\"aspectRatio\": 1.5, \"znear\": 0.1}}, {\"type\": \"orthographic\", \"orthographic\": {\"xmag\": "
        "6, "
        "\"ymag\": 4, \"znear\": 0.1, \"zfar\": 50}}],\n");
}

static void put_head(struct strbuf *json) {
    strbuf_cstr(
        json,
        "{\"asset\": {\"version\": \"2.0\"},\n \"extensionsUsed\": [\"KHR_lights_punctual\", "
        "\"KHR_materials_transmission\", \"KHR_materials_ior\", \"KHR_materials_volume\", "
        "\"KHR_materials_unlit\", \"KHR_mesh_quantization\"],\n"
        " \"extensionsRequired\": [\"KHR_mesh_quantization\"],\n"
        " \"extensions\": {\"KHR_lights_punctual\": {\"lights\": [{\"type\": \"directional\", "
        "\"intensity\": 2}, "
        "{\"type\": \"point\", \"intensity\": 40, \"color\": [1, 0.9, 0.8]}, {\"type\": "
        "\"spot\", \"intensity\": 20, "
        "\"spot\": {\"innerConeAngle\": 0.2617993877991494, \"outerConeAngle\": 0.5235987755982988}}]}},\n");
}

static void put_buffer(struct making *m, struct strbuf *json) {
    pad(&m->bytes, '\0');
    strbuf_format(json, " \"bufferViews\": [%s],\n \"accessors\": [%s],\n \"buffers\": [{\"byteLength\": %zu",
                  m->views.data, m->accessors.data, m->bytes.len);
    if (m->form == SAMPLE_BESIDE)
        strbuf_cstr(json, ", \"uri\": \"sample%20data.bin\"");
    if (m->form == SAMPLE_EMBEDDED) {
        strbuf_cstr(json, ", \"uri\": \"data:application/octet-stream;base64,");
        put_base64(json, strbuf_view(&m->bytes));
        strbuf_char(json, '"');
    }
    strbuf_cstr(json, "}]}\n");
}

static void wrap(struct making *m, struct strbuf *json, struct strbuf *out) {
    pad(json, ' ');
    put(out, "glTF", 4);
    put_word(out, 2);
    put_word(out, (uint32_t)(12 + 8 + json->len + 8 + m->bytes.len));
    put_word(out, (uint32_t)json->len);
    put_word(out, 0x4E4F534A);
    strbuf_str(out, strbuf_view(json));
    put_word(out, (uint32_t)m->bytes.len);
    put_word(out, 0x004E4942);
    strbuf_str(out, strbuf_view(&m->bytes));
}

void sample_make(enum sample_form form, struct sample *out) {
    struct making m = {.form = form};
    struct strbuf json;
    memset(out, 0, sizeof *out);
    strbuf_init(&m.bytes);
    strbuf_init(&m.views);
    strbuf_init(&m.accessors);
    strbuf_init(&json);
    strbuf_init(&out->file);
    strbuf_init(&out->buffer);
    for (int i = 0; i < SAMPLE_IMAGES; i++)
        make_image(i, &out->images[i]);
    add_box(&m);
    add_gem(&m);
    add_strips(&m);
    put_head(&json);
    put_images(&m, out, &json);
    put_looks(&json);
    put_meshes(&json);
    put_nodes(&json);
    put_buffer(&m, &json);
    if (form == SAMPLE_GLB)
        wrap(&m, &json, &out->file);
    else
        strbuf_str(&out->file, strbuf_view(&json));
    if (form == SAMPLE_BESIDE)
        strbuf_str(&out->buffer, strbuf_view(&m.bytes));
    strbuf_finish(&m.bytes);
    strbuf_finish(&m.views);
    strbuf_finish(&m.accessors);
    strbuf_finish(&json);
}

void sample_finish(struct sample *sample) {
    strbuf_finish(&sample->file);
    strbuf_finish(&sample->buffer);
    for (int i = 0; i < SAMPLE_IMAGES; i++)
        strbuf_finish(&sample->images[i]);
}
