// Media where only a rule says what is seen (docs/language.md, "Media", "Colour of media" and "Depth and
// weight"), in both precisions: which of two of equal priority fills the place of the camera, what of two
// colours counts as a ray's weight, light that stays in its medium, and materials that differ in one
// attribute.
#include "analytic_kit.h"

#include <stdio.h>
#include <string.h>

enum {
    TEXT = 4096,
};

static void check_both(struct analytic *a, struct analytic_picture picture, const char *trace,
                       double single) {
    static const char *const words[] = {"single", "double"};
    const char *given = picture.scene, *title = picture.name;
    for (int i = 0; i < 2; i++) {
        char scene[2 * TEXT], name[256];
        snprintf(scene, sizeof scene, "trace: {precision: %s%s}\n%s", words[i], trace, given);
        snprintf(name, sizeof name, "%s, %s precision", title, words[i]);
        picture.scene = scene;
        picture.name = name;
        picture.tolerance = i ? 1e-6 : single;
        analytic_check(a, &picture);
    }
}

// ---- the camera in two balls that cross, of one priority and the index of air, so that rays go straight

struct crossing {
    vec3 center[2];
    double radius[2];
    double left[2][3]; // of light, after a way of 1
    vec3 camera;
};

// Where the page's ray comes from.
static const vec3 above = {0.0152, 0.9997, 0.0215};

static bool crossing_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct crossing *c = context;
    double up[2], out[2];
    for (int i = 0; i < 2; i++) {
        up[i] = analytic_sphere(origin, above, c->center[i], c->radius[i], 0);
        out[i] = analytic_sphere(origin, direction, c->center[i], c->radius[i], 0);
    }
    // Entered last, so it fills the place until the ray leaves it; what is left of the other one's way is the
    // other one's.
    const int last = up[0] < up[1] ? 0 : 1;
    const double rest = fmax(out[1 - last] - out[last], 0);
    analytic_sky(origin, direction, rgb);
    for (int k = 0; k < 3; k++)
        rgb[k] *= pow(c->left[last][k], out[last]) * pow(c->left[1 - last][k], rest);
    return true;
}

static void check_crossing(struct analytic *a, const char *name, vec3 camera) {
    const struct crossing c = {
        {{0, 0.5, 0}, {0.25, -0.5, 0}}, {2, 2}, {{0.5, 0.9, 1}, {0.9, 0.5, 0.75}}, camera};
    for (int turned = 0; turned < 2; turned++) {
        char scene[TEXT], title[200];
        int length =
            snprintf(scene, sizeof scene, "%sspheres:\n%s", analytic_sky_lights, analytic_sky_sphere);
        for (int i = 0; i < 2; i++) {
            const int k = turned ? 1 - i : i;
            length +=
                snprintf(scene + length, sizeof scene - (size_t)length,
                         "  - {center: [%g, %g, 0], radius: %g, material: {albedo: [0, 0, 0, 1], "
                         "refractive_index: 1, attenuation_color: [%g, %g, %g]}}\n",
                         c.center[k].x, c.center[k].y, c.radius[k], c.left[k][0], c.left[k][1], c.left[k][2]);
        }
        snprintf(title, sizeof title, "%s, %s first in the file", name,
                 turned ? "the lower one" : "the upper one");
        const struct analytic_picture picture = {
            .name = title,
            .scene = scene,
            .camera = {.position = camera, .forward = {0.4, 0.1, -1}, .fov = 100},
            .color = crossing_color,
            .context = &c};
        check_both(a, picture, ", shadows: false", 3e-5);
    }
}

// ---- one colour for all pixels

struct plain {
    double value[3];
};

static bool plain_color(const void *context, vec3 origin, vec3 direction, double rgb[3]) {
    const struct plain *plain = context;
    (void)origin;
    (void)direction;
    memcpy(rgb, plain->value, sizeof plain->value);
    return true;
}

static void check_plain(struct analytic *a, const char *name, const char *scene, vec3 position, vec3 forward,
                        const char *trace, struct plain plain) {
    const struct analytic_picture picture = {.name = name,
                                             .scene = scene,
                                             .camera = {position, forward, {0.1, 0.1, 1}, 1e-4},
                                             .width = 4,
                                             .height = 4,
                                             .color = plain_color,
                                             .context = &plain};
    check_both(a, picture, trace, 1e-5);
}

// Of each ball a channel goes through whole; of both none: the weight is that of what came through both.
static void check_weight(struct analytic *a) {
    static const char scene[] =
        "background: {color: 1}\n"
        "spheres:\n"
        "  - {center: [0, 0, -3], radius: 1, material: {albedo: [0, 0, 0, 1], refractive_index: 1, "
        "attenuation_color: [1, 0.5, 0.25]}}\n"
        "  - {center: [0, 0, -6], radius: 1, material: {albedo: [0, 0, 0, 1], refractive_index: 1, "
        "attenuation_color: [0.25, 0.5, 1]}}\n";
    // Ways of 2: (1, 1/4, 1/16) times (1/16, 1/4, 1). The ray that leaves the second ball weighs 1/16.
    const vec3 from = {0, 0, 0}, to = {0, 0, -1};
    check_plain(a, "two colours, a weight below their product", scene, from, to, ", min_weight: 0.0624",
                (struct plain){{0.0625, 0.0625, 0.0625}});
    check_plain(a, "two colours, a weight above their product", scene, from, to, ", min_weight: 0.0626",
                (struct plain){{0, 0, 0}});
}

// ---- light that comes to a surface inside of its own medium

static void check_own_light(struct analytic *a) {
    static const char *const shadows[] = {"", ", transparent_shadows: true"};
    static const char stone[] = "lights: [{position: [0, 2, 0]}]\n"
                                "rectangles:\n  - {corner: [-1, 0, -1], edge_u: [2, 0, 0], edge_v: [0, 0, "
                                "2], material: {diffuse_color: 1}}\n"
                                "spheres:\n  - {center: [0, 0, 0], radius: 9, material: {albedo: [0, 0, 0, "
                                "1], refractive_index: 1.33, "
                                "attenuation_color: [0.5, 0.8, 1]}}\n";
    static const char ball[] =
        "lights: [{position: [0, 0, 0]}]\n"
        "spheres:\n  - {center: [0, 0, 0], radius: 2, material: {albedo: [1, 0, 0, 0.5], diffuse_color: 1, "
        "refractive_index: 1.5, attenuation_color: [0.5, 0.8, 1]}}\n";
    for (int i = 0; i < 2; i++) {
        // A way of 2 from the lamp and one of 0.5 to the camera; 2 and 2.
        check_plain(a, i ? "a stone in water, clear shadows" : "a stone in water", stone, (vec3){0, 0.5, 0},
                    (vec3){0, -1, 0}, shadows[i], (struct plain){{pow(0.5, 2.5), pow(0.8, 2.5), 1}});
        check_plain(a, i ? "a coloured ball from within, clear shadows" : "a coloured ball from within", ball,
                    (vec3){0, 0, 0}, (vec3){0.3, 0.2, -1}, shadows[i],
                    (struct plain){{pow(0.5, 4), pow(0.8, 4), 1}});
    }
    check_plain(a, "a stone in water, no shadows", stone, (vec3){0, 0.5, 0}, (vec3){0, -1, 0},
                ", shadows: false", (struct plain){{pow(0.5, 0.5), pow(0.8, 0.5), 1}});
}

// ---- two balls, one in the other, whose materials differ in one attribute: four surfaces are seen

static void check_paint(struct analytic *a, const char *name, const char *outer, const char *inner,
                        bool differ) {
    char scene[TEXT];
    snprintf(
        scene, sizeof scene,
        "background: {color: 0}\nambient: 1\nspheres:\n"
        "  - {center: [0, 0, 0], radius: 2, material: {albedo: [0.5, 0, 0, 0.5], refractive_index: 1, %s}}\n"
        "  - {center: [0, 0, 0], radius: 1, material: {albedo: [0.5, 0, 0, 0.5], refractive_index: 1, %s}}\n",
        outer, inner);
    // Half is seen of each surface, and half goes on.
    const double all[] = {0.5 + 0.0625, 0.25 + 0.125}, one = 0.5 + 0.25;
    struct plain plain = {{differ ? all[0] : one, differ ? all[1] : 0, 0}};
    check_plain(a, name, scene, (vec3){3, 2, 5}, (vec3){-3, -2, -5}, "", plain);
}

static void check_images(struct analytic *a) {
    static const char red[] = "diffuse_color: {image: red.png}",
                      green[] = "diffuse_color: {image: green.png}";
    check_paint(a, "two glasses that differ in their image", red, green, true);
    check_paint(a, "two glasses of one image", red, red, false);
}

// ---- files

// Pixels from the top.
static bool write_pixels(struct analytic *a, const char *name, uint32_t height, const float *rgb) {
    struct image image;
    struct strbuf bytes;
    if (!image_init(&image, 1, height))
        return false;
    memcpy(image.rgb, rgb, (size_t)height * 3 * sizeof *rgb);
    strbuf_init(&bytes);
    image_encode(&image, IMAGE_PNG,
                 (struct image_display){.tone = IR_TONE_CLIP, .transfer = IR_TRANSFER_NONE}, &bytes);
    const str text = strbuf_view(&bytes);
    const bool good = !bytes.failed && analytic_write(a, name, text.ptr, text.len);
    strbuf_finish(&bytes);
    image_finish(&image);
    return good;
}

int main(int argc, char **argv) {
    static const float colors[] = {0, 1, 0, 1, 0, 0};
    struct analytic a;
    const int code = analytic_open(&a, argc, argv);
    if (code)
        return code;
    if (write_pixels(&a, "red.png", 1, colors + 3) && write_pixels(&a, "green.png", 1, colors)) {
        check_crossing(&a, "a camera below both tops, nearer to the lower one's", (vec3){0.2, 0.25, 0.1});
        check_crossing(&a, "a camera at the side, nearer to the upper one's top", (vec3){-1.3, -0.2, 0.3});
        check_weight(&a);
        check_own_light(&a);
        check_images(&a);
    }
    return analytic_close(&a);
}
