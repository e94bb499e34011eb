// The one list of what a material is, as the tracers see it: struct scene_material is declared from it, and
// whether two media are alike is asked of it.
//
//     FIELD(KIND, name, SHARE)
//
// KIND: NUMBER, FLAG, WHOLE, COLOR (linear), COLORS (of a checker's even and odd cells), IMAGES (of
// ASSETS_IMAGES), BITS. SHARE: MEDIUM where light knows a medium by it, so that bodies of materials that
// differ in it are two media where they overlap; else BESIDE. A list of another layout (of a record, of the
// reference) is a macro for each kind.
#ifndef GLINT_SCENE_MATERIAL_FIELDS_H
#define GLINT_SCENE_MATERIAL_FIELDS_H

// clang-format off
#define SCENE_MATERIAL_FIELDS(FIELD) \
    FIELD(NUMBER, diffuse_weight, MEDIUM) \
    FIELD(NUMBER, specular_weight, MEDIUM) \
    FIELD(NUMBER, reflection, MEDIUM) \
    FIELD(NUMBER, refraction, MEDIUM) \
    FIELD(COLORS, diffuse, MEDIUM)   /* of the odd cells too, where it is a checker; else equal */ \
    FIELD(FLAG, checker, MEDIUM) \
    FIELD(NUMBER, cell, MEDIUM)      /* edge of a checker's cells, scene units; 1 without */ \
    FIELD(FLAG, soft, MEDIUM)        /* the checker is filtered */ \
    FIELD(COLOR, specular, MEDIUM) \
    FIELD(COLOR, emission, MEDIUM) \
    FIELD(IMAGES, images, MEDIUM)    /* of the diffuse and of the specular colour: in place of it */ \
    FIELD(NUMBER, specular_exponent, MEDIUM) \
    FIELD(NUMBER, refractive_index, MEDIUM) \
    FIELD(FLAG, fresnel, MEDIUM) \
    FIELD(NUMBER, alpha, MEDIUM)     /* of the distribution of micro normals: roughness squared; 0: smooth */ \
    FIELD(WHOLE, priority, BESIDE) \
    FIELD(COLOR, absorption, MEDIUM) /* per scene unit, at most SCENE_ABSORPTION_MAX: exp(-absorption * way) is left of light */ \
    FIELD(BITS, features, BESIDE)    /* FEATURE_ bits that it asks for (grammar/ir_features.h) */
// clang-format on

#endif
