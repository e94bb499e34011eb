// MTL, the material files of OBJ meshes: Kd, map_Kd, Ks, Ns, Ni, d, Tr and illum become materials of the
// scene language. Tf comes without the length that would turn its colour into that of a body's inside: it is
// reported.
//
//     diffuse_color Kd; albedo (1-t, 1 if Ks is not 0, max(Ks) if illum is 3..7, t) with t = 1-d
//     specular_color Ks; specular_exponent Ns; refractive_index Ni; fresnel if illum is 5 or 7 and Ni above 1
//     map_Kd: an image times Kd, where that is grey, with -s, -o and -clamp; with others of its options a
//     warning
//
// d wins over Tr if both are given. Of several materials with the same name, the first counts. Statements
// without effect get a warning, one for each kind of statement, unless they would change nothing (Ke 0 0 0).
// Values outside their range are clamped, with a warning. Ownership: the arena's; names are copied. Thread
// safety: one call belongs to one thread.
#ifndef GLINT_ASSETS_OBJ_READ_MTL_H
#define GLINT_ASSETS_OBJ_READ_MTL_H

#include "assets/file/asset_file.h"
#include "core/str_map.h"

// Where a material names its image.
struct mtl_image {
    struct asset_file *file; // NULL: it has none
    uint32_t line;
    uint32_t kd_line; // 0: it has no Kd
};

struct mtl_materials {
    struct ir_material *items; // with their names
    uint32_t count, capacity;
    struct {
        struct mtl_image *items;
        uint32_t count, capacity;
    } images;             // one for each of them
    struct str_map names; // 1 + index
};

void mtl_init(struct mtl_materials *materials, struct arena *arena);
// Appends the materials of file->text; `file` must outlive them. Faults are counted in file->errors.
void read_mtl(struct asset_file *file, struct mtl_materials *out);
// NULL: none of this name.
const struct ir_material *mtl_find(const struct mtl_materials *materials, str name);

#endif
