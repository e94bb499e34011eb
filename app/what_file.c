#include "app/what_file.h"

#include "picture/formats/formats.h"

#include <string.h>

#define ARCHIVE  "unpack it, and name the scene in it"
#define MESH     "glint reads meshes in Wavefront OBJ: a 3D program can convert it"
#define PICTURE  "a picture can be the 'image' of a background; 'glint compare' compares pictures"
#define LANGUAGE "glint reads scenes in its own language, YAML or XML: see docs/reference.md"

// Magic numbers before endings, which can lie.
static const struct what_file files[] = {
    {".zip", "PK\003\004", "a ZIP archive", ARCHIVE},
    {".gz", "\037\213", "a gzip archive", ARCHIVE},
    {".xz", "\3757zXZ", "an xz archive", ARCHIVE},
    {".bz2", "BZh", "a bzip2 archive", ARCHIVE},
    {".zst", "\050\265\057\375", "a Zstandard archive", ARCHIVE},
    {".7z", "7z\274\257\047\034", "a 7-Zip archive", ARCHIVE},
    {".rar", "Rar!\032", "a RAR archive", ARCHIVE},
    {".tar", NULL, "a tar archive", ARCHIVE},
    {".ply", "ply\n", "a PLY mesh", MESH},
    {NULL, "ply\r", "a PLY mesh", MESH},
    {".stl", NULL, "an STL mesh", MESH},
    {NULL, "solid ", "an STL mesh", MESH},
    {".glb", "glTF", "a glTF scene", MESH},
    {".gltf", NULL, "a glTF scene", MESH},
    {".fbx", "Kaydara FBX", "an FBX scene", MESH},
    {".blend", "BLENDER", "a Blender file", "export the meshes from Blender as Wavefront OBJ"},
    {".dae", NULL, "a COLLADA scene", MESH},
    {".3ds", NULL, "a 3DS mesh", MESH},
    {".off", "OFF\n", "an OFF mesh", MESH},
    {".usd", "PXR-USDC", "a USD scene", MESH},
    {".usda", "#usda", "a USD scene", MESH},
    {".usdc", NULL, "a USD scene", MESH},
    {".usdz", NULL, "a USD archive", MESH},
    {".mtl", "newmtl", "a material file of a mesh",
     "name the mesh (.obj), which names its material files itself"},
    {".gif", "GIF8", "a GIF picture", "save it as PNG to use it as the 'image' of a background"},
    {".pdf", "%PDF", "a PDF document", LANGUAGE},
    {".pov", NULL, "a POV-Ray scene", LANGUAGE},
    {".inc", NULL, "a POV-Ray file", LANGUAGE},
    {".pbrt", NULL, "a PBRT scene", LANGUAGE},
    {".nff", NULL, "an NFF scene", LANGUAGE},
    {".toml", NULL, "a TOML file", LANGUAGE},
    {NULL, "\177ELF", "a program", LANGUAGE},
};

enum {
    FILE_COUNT = sizeof files / sizeof files[0],
    HEAD_BYTES = 4096,
};

// A scene begins with the version of the language, whatever its file is called.
static bool says_glint(str text) {
    static const char word[] = "glint";
    str head = str_slice(text, 0, text.len < HEAD_BYTES ? text.len : HEAD_BYTES);
    for (size_t at = 0; at + sizeof word - 1 <= head.len; at++)
        if (memcmp(head.ptr + at, word, sizeof word - 1) == 0)
            return true;
    return false;
}

// A picture that glint knows is in the table of their formats.
static bool is_picture(str path, str text, struct what_file *out) {
    for (int i = 0; i < IMAGE_FORMATS; i++) {
        const struct image_format_info *info = image_format_info((enum image_format)i);
        bool is = info->magic && str_starts_with(text, str_from(info->magic));
        for (const char *const *ending = info->endings; !text.len && *ending; ending++)
            is |= str_ends_with_nocase(path, *ending);
        if (is) {
            *out = (struct what_file){.what = info->what, .advice = PICTURE};
            return true;
        }
    }
    return false;
}

static bool is_other(str path, str text, struct what_file *out) {
    for (int i = 0; i < FILE_COUNT; i++)
        if (text.len ? files[i].magic && str_starts_with(text, str_from(files[i].magic))
                     : files[i].ending && str_ends_with_nocase(path, files[i].ending)) {
            *out = files[i];
            return true;
        }
    return false;
}

// An empty text is one of which nothing is known.
bool what_file(str path, str text, struct what_file *out) {
    const str nothing = STR("");
    if (text.len && (is_other(path, text, out) || is_picture(path, text, out)))
        return true;
    return !says_glint(text) && (is_other(path, nothing, out) || is_picture(path, nothing, out));
}
