// glint-meshgen: makes the meshes, the sky and the font of the scenes that ship.
//
//     glint-meshgen list             the names, one a line
//     glint-meshgen NAME OUT         writes one
//     glint-meshgen --verify [NAME]  proves the meshes closed, outward and without flaws
//
// Exit: 0 done, 1 a mesh has a flaw, 2 usage, 3 a file could not be written.
#include "files/output.h"
#include "tools/meshgen/generators.h"
#include "tools/meshgen/png.h"
#include "tools/meshgen/verify.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    EXIT_FLAW = 1,
    EXIT_USAGE = 2,
    EXIT_WRITE = 3,
    SKY_WIDTH = 4096,
    FINE_SKY_WIDTH = 8192, // 1 920 pixels of a camera that sees 80 degrees across
    PLANKS_SIDE = 1024,
    GLOBE_WIDTH = 2048,
};

struct product {
    const char *name;
    const char *title;
    void (*generate)(struct mesh *mesh); // NULL where it is not a mesh
    bool (*write)(struct strbuf *bytes); // of what is not a mesh
    const char *mtllib;
};

static bool write_sky_of(int width, struct strbuf *bytes) {
    unsigned char *pixels = sky_generate(width, width / 2);
    bool ok = pixels && png_encode(pixels, width, width / 2, bytes);
    free(pixels);
    return ok;
}

static bool write_sky(struct strbuf *bytes) {
    return write_sky_of(SKY_WIDTH, bytes);
}

static bool write_fine_sky(struct strbuf *bytes) {
    return write_sky_of(FINE_SKY_WIDTH, bytes);
}

static bool write_planks(struct strbuf *bytes) {
    unsigned char *pixels = planks_generate(PLANKS_SIDE);
    bool ok = pixels && png_encode(pixels, PLANKS_SIDE, PLANKS_SIDE, bytes);
    free(pixels);
    return ok;
}

static bool write_globe(struct strbuf *bytes) {
    unsigned char *pixels = globe_generate(GLOBE_WIDTH, GLOBE_WIDTH / 2);
    bool ok = pixels && png_encode(pixels, GLOBE_WIDTH, GLOBE_WIDTH / 2, bytes);
    free(pixels);
    return ok;
}

static bool write_fox_mtl(struct strbuf *bytes) {
    fox_write_mtl(bytes);
    return true;
}

static const struct product PRODUCTS[] = {
    {"sculpture", "a ribbon along a trefoil knot", sculpture_generate, NULL, NULL},
    {"gem", "a round brilliant", gem_generate, NULL, NULL},
    {"fox", "a sitting fox", fox_generate, NULL, "fox.mtl"},
    {"fox-mtl", "the fox's colours", NULL, write_fox_mtl, NULL},
    {"vase", "a vase", vase_generate, NULL, NULL},
    {"tumbler", "a drinking glass", tumbler_generate, NULL, NULL},
    {"drink", "what is in the drinking glass", drink_generate, NULL, NULL},
    {"rocks", "a low, heavy glass", rocks_generate, NULL, NULL},
    {"whisky", "what is in the low glass", whisky_generate, NULL, NULL},
    {"ice", "a cube of ice", ice_generate, NULL, NULL},
    {"word", "the word glint", word_generate, NULL, NULL},
    {"pawn", "chess: a pawn", pawn_generate, NULL, NULL},
    {"rook", "chess: a rook", rook_generate, NULL, NULL},
    {"bishop", "chess: a bishop", bishop_generate, NULL, NULL},
    {"queen", "chess: a queen", queen_generate, NULL, NULL},
    {"king", "chess: a king", king_generate, NULL, NULL},
    {"plinth", "chess: what a knight sits on", plinth_generate, NULL, NULL},
    {"column", "a column", column_generate, NULL, NULL},
    {"bowl", "a bowl", bowl_generate, NULL, NULL},
    {"urn", "an urn", urn_generate, NULL, NULL},
    {"ring", "a thick ring", ring_generate, NULL, NULL},
    {"hoop", "a thin ring", hoop_generate, NULL, NULL},
    {"water", "water with ripples", water_generate, NULL, NULL},
    {"sky", "sky, mountains and lake", NULL, write_sky, NULL},
    {"sky-fine", "the same for large pictures", NULL, write_fine_sky, NULL},
    {"planks", "planks of wood, to be repeated", NULL, write_planks, NULL},
    {"font", "a font for labels", NULL, font_generate, NULL},
    {"globe", "land and sea of a globe", NULL, write_globe, NULL},
};

enum {
    PRODUCT_COUNT = sizeof PRODUCTS / sizeof PRODUCTS[0]
};

static const struct product *find_product(const char *name) {
    for (int i = 0; i < PRODUCT_COUNT; i++)
        if (!strcmp(PRODUCTS[i].name, name))
            return &PRODUCTS[i];
    fprintf(stderr, "glint-meshgen: there is no '%s'; `glint-meshgen list` names what there is\n", name);
    return NULL;
}

static int verify_product(const struct product *product) {
    struct mesh mesh;
    struct verify_result result;
    mesh_init(&mesh);
    product->generate(&mesh);
    bool ok = verify_mesh(&mesh, &result);
    if (!ok)
        fprintf(stderr, "glint-meshgen: %s cannot be made\n", product->name);
    else
        printf(
            "%-10s %6d triangles, %2d parts, volume %.4f: %d open edges, %d inward parts, %d flat triangles, "
            "%d bent faces, %d bad normals\n",
            product->name, mesh_triangle_count(&mesh), result.parts, result.volume, result.open_edges,
            result.inward_parts, result.flat_triangles, result.bent_faces, result.bad_normals);
    mesh_finish(&mesh);
    return ok && verify_passed(&result) ? EXIT_SUCCESS : EXIT_FLAW;
}

static int verify_all(const char *only) {
    int worst = EXIT_SUCCESS;
    if (only && !find_product(only))
        return EXIT_USAGE;
    for (int i = 0; i < PRODUCT_COUNT; i++)
        if (PRODUCTS[i].generate && (!only || !strcmp(only, PRODUCTS[i].name)) &&
            verify_product(&PRODUCTS[i]))
            worst = EXIT_FLAW;
    return worst;
}

static bool make(const struct product *product, struct strbuf *bytes) {
    struct mesh mesh;
    if (!product->generate)
        return product->write(bytes) && !bytes->failed;
    mesh_init(&mesh);
    product->generate(&mesh);
    mesh_write_obj(&mesh, product->title, product->mtllib, bytes);
    bool ok = !mesh.failed && !bytes->failed;
    mesh_finish(&mesh);
    return ok;
}

static int write_product(const char *name, const char *path) {
    const struct product *product = find_product(name);
    struct strbuf bytes;
    if (!product)
        return EXIT_USAGE;
    strbuf_init(&bytes);
    bool made = make(product, &bytes);
    int error = made ? output_whole(path, bytes.data, bytes.len) : 0;
    if (!made)
        fprintf(stderr, "glint-meshgen: %s cannot be made\n", product->name);
    else if (error)
        fprintf(stderr, "glint-meshgen: cannot write %s: %s\n", path, strerror(error));
    strbuf_finish(&bytes);
    return made && !error ? EXIT_SUCCESS : EXIT_WRITE;
}

int main(int argc, char **argv) {
    if (argc == 2 && !strcmp(argv[1], "list")) {
        for (int i = 0; i < PRODUCT_COUNT; i++)
            printf("%-10s %s\n", PRODUCTS[i].name, PRODUCTS[i].title);
        return EXIT_SUCCESS;
    }
    if ((argc == 2 || argc == 3) && !strcmp(argv[1], "--verify"))
        return verify_all(argc == 3 ? argv[2] : NULL);
    if (argc == 3)
        return write_product(argv[1], argv[2]);
    fprintf(stderr, "usage: glint-meshgen list | NAME OUT | --verify [NAME]\n");
    return EXIT_USAGE;
}
