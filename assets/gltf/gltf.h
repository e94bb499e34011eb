// glTF 2.0 (ISO/IEC 12113:2022) as the file has it: JSON or GLB to arrays whose references are valid.
//
// gltf_open reads the JSON and checks it; gltf_load_buffers loads the bytes; gltf_read_primitive checks every
// number that is drawn. After each step, everything that later steps rely on holds: indices are below their
// counts, ranges are inside their buffers, nodes are trees. What glint cannot show is counted (enum
// gltf_loss), and reported by the caller. Errors: reported at the place in the JSON and counted in
// gltf->errors; after one the next step must not be taken. Ownership: everything is in the arena, which must
// be guarded, and points into the text. Units: metres and radians, as the file has them; numbers are doubles.
// Thread safety: one thread.
#ifndef GLINT_ASSETS_GLTF_GLTF_H
#define GLINT_ASSETS_GLTF_GLTF_H

#include "assets/gltf/json.h"
#include "core/vec3.h"
#include "diag/diag.h"

#define GLTF_NONE UINT32_MAX

// Where findings go. Bytes are those of gltf->json.text.
struct gltf_report {
    void *context;
    void (*add)(void *context, diag_code code, size_t begin, size_t end, const char *message);
};

// A feature of a file that is not in the picture: how often it occurs, and where first.
enum gltf_loss {
#define X(NAME, sentence) GLTF_LOSS_##NAME,
#include "assets/gltf/losses.def"
#undef X
    GLTF_LOSSES
};

struct gltf_loss_count {
    uint32_t count;
    json_index first;
};

struct gltf_buffer {
    json_index node;
    str uri;   // decoded from JSON; empty: the binary chunk of a GLB file
    str bytes; // after gltf_load_buffers
    uint64_t length;
};

struct gltf_view {
    json_index node;
    uint32_t buffer;
    uint64_t offset, length;
    uint32_t stride; // 0: elements lie side by side
};

enum gltf_component {
    GLTF_INT8 = 5120,
    GLTF_UINT8 = 5121,
    GLTF_INT16 = 5122,
    GLTF_UINT16 = 5123,
    GLTF_UINT32 = 5125,
    GLTF_FLOAT = 5126,
};

struct gltf_sparse {
    uint32_t count; // 0: not sparse
    uint32_t index_view, value_view;
    uint64_t index_offset, value_offset;
    unsigned index_type; // gltf_component
    json_index node;
};

struct gltf_accessor {
    json_index node;
    uint32_t view; // GLTF_NONE: zeros
    uint64_t offset;
    uint32_t count;
    unsigned component;  // gltf_component
    uint32_t components; // 1 to 4, 9, 16
    bool is_matrix;
    bool normalized;
    const uint32_t *indices; // all elements, once read as indices
    const double *elements;  // all elements, once read; normalized integers: from 0, or -1, to 1
    struct gltf_sparse sparse;
};

enum gltf_mode {
    GLTF_POINTS,
    GLTF_LINES,
    GLTF_LINE_LOOP,
    GLTF_LINE_STRIP,
    GLTF_TRIANGLES,
    GLTF_TRIANGLE_STRIP,
    GLTF_TRIANGLE_FAN,
};

enum {
    GLTF_COORDINATE_SETS = 2 // TEXCOORD_0 and TEXCOORD_1
};

struct gltf_primitive {
    json_index node;
    uint32_t position, normal, indices; // accessors; GLTF_NONE: none
    uint32_t coordinates[GLTF_COORDINATE_SETS];
    uint32_t material;
    unsigned mode; // gltf_mode
};

struct gltf_mesh {
    json_index node;
    str name;
    uint32_t first, count; // of its primitives
};

struct gltf_node {
    json_index node;
    str name;
    uint32_t mesh, camera, light; // GLTF_NONE: none
    uint32_t parent;
    affine3 local;
    affine3 world; // by gltf_place_nodes
    bool is_shown; // in the default scene
};

struct gltf_camera {
    json_index node;
    str name;
    bool is_orthographic;
    double yfov, aspect; // radians; 0: none
    double ymag;         // half the height
};

enum gltf_light_kind {
    GLTF_LIGHT_POINT,
    GLTF_LIGHT_DIRECTIONAL,
    GLTF_LIGHT_SPOT
};

struct gltf_light {
    json_index node;
    str name;
    unsigned kind; // gltf_light_kind
    double color[3];
    double intensity;    // candela or lux
    double inner, outer; // of a spot: half angles, radians
    bool has_range;
};

struct gltf_image {
    json_index node;
    str name;
    str uri;       // decoded from JSON; empty: in `view`
    uint32_t view; // GLTF_NONE: none
    str mime;
};

enum gltf_wrap {
    GLTF_WRAP_REPEAT = 10497,
    GLTF_WRAP_CLAMP = 33071,
    GLTF_WRAP_MIRROR = 33648
};

struct gltf_sampler {
    unsigned magnify; // 0: not given
    unsigned wrap[2]; // gltf_wrap
};

struct gltf_texture {
    json_index node;
    uint32_t image; // GLTF_NONE: only by an extension
    struct gltf_sampler sampler;
};

// Where a material names a texture.
struct gltf_texture_use {
    json_index node; // 0: there is none
    uint32_t texture;
    uint32_t set;       // of coordinates
    bool has_transform; // KHR_texture_transform
    double offset[2], rotation, scale[2];
};

enum gltf_alpha {
    GLTF_ALPHA_OPAQUE,
    GLTF_ALPHA_MASK,
    GLTF_ALPHA_BLEND
};

struct gltf_material {
    json_index node;
    str name;
    bool is_named; // it goes by `name`, not by its number
    double base[4];
    double metallic, roughness;
    double emission[3]; // times its strength
    struct gltf_texture_use base_texture, metal_texture, emission_texture, normal_texture, occlusion_texture;
    unsigned alpha; // gltf_alpha
    bool is_unlit;
    double index; // of refraction
    double transmission, thickness;
    json_index transmission_texture;
    double attenuation_distance; // infinite: clear
    double attenuation_color[3];
};

#define GLTF_LIST(type)                                                                                      \
    struct {                                                                                                 \
        type *items;                                                                                         \
        uint32_t count, capacity;                                                                            \
    }

struct gltf {
    struct arena *arena;
    const struct gltf_report *report; // NULL: findings are only counted
    uint32_t errors, warnings;
    struct json json;
    uint64_t most_elements; // for an accessor without bytes, which costs a file nothing; set by the caller
    bool is_binary;         // GLB
    str chunk;              // its BIN chunk; empty: none
    bool has_chunk;
    str generator;
    GLTF_LIST(struct gltf_buffer) buffers;
    GLTF_LIST(struct gltf_view) views;
    GLTF_LIST(struct gltf_accessor) accessors;
    GLTF_LIST(struct gltf_primitive) primitives; // of all meshes
    GLTF_LIST(struct gltf_mesh) meshes;
    GLTF_LIST(struct gltf_node) nodes;
    GLTF_LIST(struct gltf_camera) cameras;
    GLTF_LIST(struct gltf_light) lights;
    GLTF_LIST(struct gltf_image) images;
    GLTF_LIST(struct gltf_texture) textures;
    GLTF_LIST(struct gltf_material) materials;
    uint32_t *order; // the nodes of the default scene, each after its parent, in the order of the file
    uint32_t order_count;
    struct gltf_loss_count losses[GLTF_LOSSES];
};

// Whether the bytes begin as a GLB file does.
bool gltf_is_binary(str bytes);
// Reads a .gltf or .glb file: everything but the bytes of buffers. false: there were errors.
bool gltf_open(struct gltf *gltf, str bytes, const struct gltf_report *report, struct arena *arena);

// Loads the bytes of a file that the glTF file names; false: the fault was reported.
struct gltf_files {
    void *context;
    bool (*read)(void *context, str uri, json_index at, str *bytes);
};
// The bytes of all buffers. false: there were errors.
bool gltf_load_buffers(struct gltf *gltf, const struct gltf_files *files);

// What a primitive draws.
struct gltf_geometry {
    const double *positions;                         // three a vertex
    const double *normals;                           // three per vertex; NULL: none
    const double *coordinates[GLTF_COORDINATE_SETS]; // two per vertex; NULL: none
    uint32_t vertices;
    const uint32_t *corners; // three per triangle; strips and fans are taken apart
    uint32_t triangles;
};
// Reads it once there are buffers, and checks that it can be drawn: numbers are finite, and indices name
// vertices. The accessors' numbers stay in the arena of the document; the corners are in the given one.
// Points and lines have no triangles. false: there were errors.
bool gltf_read_primitive(struct gltf *gltf, const struct gltf_primitive *primitive, struct arena *arena,
                         struct gltf_geometry *out);
// How many triangles it has: 0 for points and lines.
uint64_t gltf_triangle_count(const struct gltf *gltf, const struct gltf_primitive *primitive);

// The bytes of a view; the empty string for none, or before there are buffers.
str gltf_view_bytes(const struct gltf *gltf, uint32_t view);

// The decoded text after the comma of a `data:` address, in the arena; false: it is not base64.
bool gltf_decode_data(str uri, struct arena *arena, str *bytes, str *mime);
bool gltf_is_data(str uri);
// A reference with its %XX decoded, in the arena.
str gltf_decode_uri(str uri, struct arena *arena);

// ---- findings

void gltf_add(struct gltf *gltf, diag_code code, json_index at, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
void gltf_lose(struct gltf *gltf, enum gltf_loss what, json_index at);
// Reports the losses that were counted, each once, and forgets them.
void gltf_report_losses(struct gltf *gltf);
// The place of a value as words: "accessors[3].max".
const char *gltf_where(const struct gltf *gltf, json_index at);

#endif
