// The one list of what a material is, as the tracers see it. struct scene_material is declared and filled
// from it, whether two media are alike is asked of it, and a device's record is packed from it; the reference
// reads that struct.
//
//     FIELD(KIND, name, SHARE, RECORD, from)
//
// KIND: NUMBER, FLAG, WHOLE, COLOR (linear), COLORS (of a checker's even and odd cells), IMAGES (of
// ASSETS_IMAGES), BITS. SHARE: MEDIUM where light knows a medium by it, so that bodies of materials that
// differ in it are two media where they overlap; else BESIDE. RECORD: MATERIAL is a field of the same name in
// shaders/records.h, of COLORS also name_odd; FLAT the same, where it is a number per scene unit and becomes
// one per flat unit; APART what a device has elsewhere. `from`: an initialiser, in scene/materials.c.
#ifndef GLINT_SCENE_MATERIAL_FIELDS_H
#define GLINT_SCENE_MATERIAL_FIELDS_H

// clang-format off
#define SCENE_MATERIAL_FIELDS(FIELD) \
    FIELD(NUMBER, diffuse_weight, MEDIUM, MATERIAL, ir->albedo.diffuse) \
    FIELD(NUMBER, specular_weight, MEDIUM, MATERIAL, ir->albedo.specular) \
    FIELD(NUMBER, reflection, MEDIUM, MATERIAL, ir->albedo.reflection) \
    FIELD(NUMBER, refraction, MEDIUM, MATERIAL, ir->albedo.refraction) \
    /* For a checker's even and odd cells; without a checker both are equal. */ \
    FIELD(COLORS, diffuse, MEDIUM, MATERIAL, {paint_color(ir, 0, transfer), paint_color(ir, 1, transfer)}) \
    FIELD(FLAG, checker, MEDIUM, APART, has_checker(ir)) \
    /* Edge of a checker's cells, scene units; 1 without a checker. */ \
    FIELD(NUMBER, cell, MEDIUM, MATERIAL, has_checker(ir) ? ir->diffuse_color.checker.size : 1) \
    /* The checker is filtered. */ \
    FIELD(FLAG, soft, MEDIUM, APART, has_checker(ir) && ir->diffuse_color.checker.antialias) \
    FIELD(COLOR, specular, MEDIUM, MATERIAL, scene_linear_color(ir->specular_color.color, transfer)) \
    /* Times what is mirrored; of a metal straight on. */ \
    FIELD(COLOR, mirror, MEDIUM, MATERIAL, scene_linear_color(ir->reflection_color, transfer)) \
    FIELD(FLAG, metal, MEDIUM, MATERIAL, ir->metal) \
    FIELD(COLOR, emission, MEDIUM, MATERIAL, scene_linear_color(ir->emission, transfer)) \
    /* Images that replace the diffuse and the specular colour. scene_build_textures makes them. */ \
    FIELD(IMAGES, images, MEDIUM, APART, {{NULL}}) \
    FIELD(NUMBER, specular_exponent, MEDIUM, MATERIAL, ir->specular_exponent) \
    FIELD(NUMBER, refractive_index, MEDIUM, MATERIAL, ir->refractive_index) \
    FIELD(FLAG, fresnel, MEDIUM, MATERIAL, ir->fresnel && !ir->metal) \
    /* Parameter of the distribution of micro normals: 0 is smooth. */ \
    FIELD(NUMBER, alpha, MEDIUM, MATERIAL, ir->roughness * ir->roughness) \
    FIELD(WHOLE, priority, BESIDE, APART, ir->priority) \
    /* At most SCENE_ABSORPTION_MAX: after a distance d, exp(-absorption * d) of the light is left. */ \
    FIELD(COLOR, absorption, MEDIUM, FLAT, absorption_of(ir, transfer)) \
    /* FEATURE_ bits that it asks for (grammar/ir_features.h). */ \
    FIELD(BITS, features, BESIDE, APART, ir_material_features(ir))
// clang-format on

#endif
