#include "load/what_file.h"

#include "grammar/mesh_format.h"
#include "picture/formats/formats.h"

#include <string.h>

#define ARCHIVE  "unpack it, and name the scene in it"
#define PICTURE  "a picture can be the 'image' of a background; 'glint compare' compares pictures"
#define LANGUAGE "glint reads scenes in its own language, YAML or XML: see docs/reference.md"

// Magic numbers come before endings, which can lie.
struct row {
    const char *ending; // NULL: no ending says it
    const char *magic;  // its first bytes; NULL: none says it
    const char *what;
    const char *advice; // NULL: that of a mesh of another format
};

static const struct row files[] = {
    {".zip", "PK\003\004", "a ZIP archive", ARCHIVE},
    {".gz", "\037\213", "a gzip archive", ARCHIVE},
    {".xz", "\3757zXZ", "an xz archive", ARCHIVE},
    {".bz2", "BZh", "a bzip2 archive", ARCHIVE},
    {".zst", "\050\265\057\375", "a Zstandard archive", ARCHIVE},
    {".7z", "7z\274\257\047\034", "a 7-Zip archive", ARCHIVE},
    {".rar", "Rar!\032", "a RAR archive", ARCHIVE},
    {".tar", NULL, "a tar archive", ARCHIVE},
    {".glb", "glTF", "a glTF scene", NULL},
    {".gltf", NULL, "a glTF scene", NULL},
    {".fbx", "Kaydara FBX", "an FBX scene", NULL},
    {".blend", "BLENDER", "a Blender file", "export the meshes from Blender"},
    {".dae", NULL, "a COLLADA scene", NULL},
    {".3ds", NULL, "a 3DS mesh", NULL},
    {".off", "OFF\n", "an OFF mesh", NULL},
    {".usd", "PXR-USDC", "a USD scene", NULL},
    {".usda", "#usda", "a USD scene", NULL},
    {".usdc", NULL, "a USD scene", NULL},
    {".usdz", NULL, "a USD archive", NULL},
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

// Recognised by its first bytes or, without text, by its ending. Pictures that glint knows are in the table
// of picture formats.
static bool is_picture(str path, str text, struct what_file *out) {
    for (int i = 0; i < IMAGE_FORMATS; i++) {
        const struct image_format_info *info = image_format_info((enum image_format)i);
        bool is = info->magic && str_starts_with(text, str_from(info->magic));
        for (const char *const *ending = info->endings; !text.len && *ending; ending++)
            is |= str_ends_with_nocase(path, *ending);
        if (is) {
            *out = (struct what_file){str_from(info->what), str_from(PICTURE)};
            return true;
        }
    }
    return false;
}

static bool is_other(str path, str text, struct arena *arena, struct what_file *out) {
    for (int i = 0; i < FILE_COUNT; i++) {
        const struct row *row = &files[i];
        if (text.len ? !row->magic || !str_starts_with(text, str_from(row->magic))
                     : !row->ending || !str_ends_with_nocase(path, row->ending))
            continue;
        *out = (struct what_file){str_from(row->what), str_from(row->advice)};
        if (!row->advice)
            out->advice = arena_format(arena, "glint reads %.*s: a 3D program can convert other meshes",
                                       STR_ARG(mesh_format_words(arena)));
        return true;
    }
    return false;
}

bool what_file(str path, str text, struct arena *arena, struct what_file *out) {
    const enum mesh_format_id id = mesh_format_of_text(text);
    if (id != MESH_FORMAT_COUNT) {
        const struct mesh_format *format = &mesh_formats[id];
        *out = (struct what_file){
            str_from(format->called),
            arena_format(arena, "a mesh by itself is a scene if its name shows what it is: let it end in %s",
                         format->endings[0])};
        return true;
    }
    const str nothing = STR("");
    if (text.len && (is_other(path, text, arena, out) || is_picture(path, text, out)))
        return true;
    return !says_glint(text) && (is_other(path, nothing, arena, out) || is_picture(path, nothing, out));
}
