#include "picture/read/jpeg_check.h"

#include <string.h>

enum marker {
    MARKER_SOF0 = 0xC0,
    MARKER_SOF2 = 0xC2, // progressive
    MARKER_DHT = 0xC4,
    MARKER_JPG = 0xC8,
    MARKER_DAC = 0xCC,
    MARKER_SOF15 = 0xCF,
    MARKER_RST0 = 0xD0,
    MARKER_RST7 = 0xD7,
    MARKER_SOI = 0xD8,
    MARKER_EOI = 0xD9,
    MARKER_SOS = 0xDA,
    MARKER_DQT = 0xDB,
    MARKER_APP2 = 0xE2,
};

enum {
    COMPONENTS_MAX = 4,
    TABLES = 4,
    CODE_LENGTHS = 16,
    CODES_MAX = 256,
};

struct component {
    unsigned char id;
    unsigned char quantization;
};

struct walk {
    const unsigned char *data;
    size_t size;
    size_t at;
    bool progressive;
    bool has_scan;
    bool profile;
    uint32_t width, height; // 0: no frame yet
    unsigned component_count;
    struct component components[COMPONENTS_MAX];
    bool dc_table[TABLES], ac_table[TABLES], quantization[TABLES]; // defined so far
};

struct segment {
    const unsigned char *data; // behind the length
    size_t size;
};

static const char *read_huffman_tables(struct walk *w, struct segment s) {
    while (s.size > 0) {
        if (s.size < 1 + CODE_LENGTHS)
            return "a Huffman table is too short";
        unsigned class = s.data[0] >> 4;
        unsigned id = s.data[0] & 15;
        size_t codes = 0;
        // Codes of one length cannot be more than that length has room for.
        size_t room = 1;
        for (int i = 1; i <= CODE_LENGTHS; i++) {
            room = 2 * room;
            if (s.data[i] > room)
                return "a Huffman table has more codes than are possible";
            room -= s.data[i];
            codes += s.data[i];
        }
        if (class > 1 || id >= TABLES || codes > CODES_MAX || s.size < 1 + CODE_LENGTHS + codes)
            return "a Huffman table is damaged";
        (class ? w->ac_table : w->dc_table)[id] = true;
        s.data += 1 + CODE_LENGTHS + codes;
        s.size -= 1 + CODE_LENGTHS + codes;
    }
    return NULL;
}

static const char *read_quantization_tables(struct walk *w, struct segment s) {
    while (s.size > 0) {
        unsigned wide = s.data[0] >> 4;
        unsigned id = s.data[0] & 15;
        size_t size = 1 + (wide ? 128 : 64);
        if (wide > 1 || id >= TABLES || s.size < size)
            return "a quantization table is damaged";
        w->quantization[id] = true;
        s.data += size;
        s.size -= size;
    }
    return NULL;
}

static const char *read_frame(struct walk *w, struct segment s, unsigned marker) {
    if (marker > MARKER_SOF2)
        return "it is lossless, hierarchical or arithmetically coded; save it as baseline or progressive";
    if (w->width)
        return "it has two frames";
    if (s.size < 6 || s.size != 6 + 3 * (size_t)s.data[5])
        return "its frame header is damaged";
    if (s.data[0] != 8)
        return "it does not have 8 bits per channel";
    w->progressive = marker == MARKER_SOF2;
    w->height = (uint32_t)s.data[1] << 8 | s.data[2];
    w->width = (uint32_t)s.data[3] << 8 | s.data[4];
    w->component_count = s.data[5];
    if (w->width == 0 || w->height == 0)
        return "its width or height is 0";
    if (w->component_count < 1 || w->component_count > COMPONENTS_MAX)
        return "it does not have 1 to 4 channels";
    for (unsigned i = 0; i < w->component_count; i++) {
        w->components[i] = (struct component){s.data[6 + 3 * i], s.data[8 + 3 * i]};
        if (w->components[i].quantization >= TABLES)
            return "its frame header is damaged";
    }
    return NULL;
}

static const struct component *find_component(const struct walk *w, unsigned char id) {
    for (unsigned i = 0; i < w->component_count; i++)
        if (w->components[i].id == id)
            return &w->components[i];
    return NULL;
}

// Which tables a scan uses: a baseline one both, a progressive one those of its coefficients.
static const char *read_scan(struct walk *w, struct segment s) {
    if (w->width == 0)
        return "it has no frame header";
    if (s.size < 1 || s.data[0] < 1 || s.data[0] > w->component_count || s.size != 4 + 2 * (size_t)s.data[0])
        return "a scan header is damaged";
    unsigned char first = s.data[s.size - 3];
    bool uses_dc = !w->progressive || first == 0;
    bool uses_ac = !w->progressive || first != 0;
    for (unsigned i = 0; i < s.data[0]; i++) {
        const struct component *component = find_component(w, s.data[1 + 2 * i]);
        unsigned dc = s.data[2 + 2 * i] >> 4;
        unsigned ac = s.data[2 + 2 * i] & 15;
        if (!component || dc >= TABLES || ac >= TABLES)
            return "a scan header is damaged";
        if ((uses_dc && !w->dc_table[dc]) || (uses_ac && !w->ac_table[ac]) ||
            !w->quantization[component->quantization])
            return "a scan uses a table that the file does not have";
    }
    w->has_scan = true;
    return NULL;
}

// Moves to the marker behind a scan's data; restart markers belong to them, and 0 behind 0xFF is no marker.
static bool skip_scan_data(struct walk *w) {
    while (w->at + 1 < w->size) {
        const unsigned char *mark = memchr(w->data + w->at, 0xFF, w->size - 1 - w->at);
        if (!mark)
            return false;
        w->at = (size_t)(mark - w->data);
        if (mark[1] != 0 && mark[1] != 0xFF && !(mark[1] >= MARKER_RST0 && mark[1] <= MARKER_RST7))
            return true;
        w->at += mark[1] == 0xFF ? 1 : 2;
    }
    return false;
}

static const char *read_segment(struct walk *w, unsigned marker, struct segment s) {
    if (marker == MARKER_DHT)
        return read_huffman_tables(w, s);
    if (marker == MARKER_DQT)
        return read_quantization_tables(w, s);
    if (marker >= MARKER_SOF0 && marker <= MARKER_SOF15 && marker != MARKER_JPG && marker != MARKER_DAC)
        return read_frame(w, s, marker);
    if (marker == MARKER_SOS)
        return read_scan(w, s);
    w->profile |= marker == MARKER_APP2 && s.size >= 12 && memcmp(s.data, "ICC_PROFILE", 12) == 0;
    return NULL;
}

static const char *walk_file(struct walk *w) {
    for (;;) {
        while (w->at + 1 < w->size && w->data[w->at] == 0xFF && w->data[w->at + 1] == 0xFF)
            w->at++; // fill bytes
        if (w->size - w->at < 2)
            return w->has_scan ? "the file ends within the picture" : "the file ends before the picture";
        unsigned marker = w->data[w->at + 1];
        if (w->data[w->at] != 0xFF || marker == 0 || marker == MARKER_SOI)
            return "a marker is missing";
        if (marker == MARKER_EOI)
            return w->has_scan ? NULL : "it contains no picture";
        w->at += 2;
        if (w->size - w->at < 2)
            return "the file ends within a segment";
        size_t length = (size_t)w->data[w->at] << 8 | w->data[w->at + 1];
        if (length < 2 || length > w->size - w->at)
            return "the file ends within a segment";
        const char *fault = read_segment(w, marker, (struct segment){w->data + w->at + 2, length - 2});
        if (fault)
            return fault;
        w->at += length;
        if (marker == MARKER_SOS && !skip_scan_data(w))
            return "the file ends within the picture";
    }
}

const char *jpeg_read_header(str bytes, struct picture_header *out) {
    struct walk w = {.data = (const unsigned char *)bytes.ptr, .size = bytes.len, .at = 2};
    const char *fault = walk_file(&w);
    out->width = w.width;
    out->height = w.height;
    out->ignored = w.profile ? "colour profile is" : NULL;
    return fault;
}
