#include "tests/sweep/sweep_scene.h"

#include "tests/sweep/sweep_internal.h"

#include <stdio.h>

static sweep_maker *const makers[SWEEP_FAMILIES] = {
#define X(NAME, name, title) sweep_make_##name,
#include "tests/sweep/families.def"
#undef X
};

static void put_list(struct strbuf *out, const char *name, const struct strbuf *items) {
    if (items->len)
        strbuf_format(out, "%s:\n%.*s", name, STR_ARG(strbuf_view(items)));
    out->failed = out->failed || items->failed;
}

static void put_scene(struct sweep_writer *w) {
    struct strbuf *out = &w->scene->text;
    strbuf_format(out,
                  "glint: 1\ndescription: %s\nimage: {width: 640, height: 480, samples: %u}\ntrace: "
                  "{max_depth: %u%s}\n",
                  sweep_families[w->scene->family].title, w->samples, w->depth,
                  w->scene->closed ? ", depth_limit: black" : "");
    sweep_put_vector(out, "background: {color", w->background);
    strbuf_format(out, ", intensity: %.17g}\n", w->intensity);
    strbuf_str(out, strbuf_view(&w->head));
    out->failed = out->failed || w->head.failed;
    put_list(out, "lights", &w->lights);
    put_list(out, "spheres", &w->spheres);
    put_list(out, "rectangles", &w->rectangles);
    put_list(out, "models", &w->models);
}

// A third of the scenes are along the axes, as people write them.
static void place(struct sweep_writer *w) {
    static const mat3 as_it_is = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const mat3 turn = sweep_rotation(w);
    w->turn = sweep_chance(w, 0.33) ? as_it_is : turn;
    w->scale = 1;
    if (sweep_chance(w, 0.5))
        w->offset = sweep_around(w, 0, 10);
}

void sweep_scene_make(struct sweep_scene *scene, uint64_t seed, enum sweep_family family, uint32_t number) {
    const struct sweep_family_info *info = &sweep_families[family];
    *scene = (struct sweep_scene){.family = family, .number = number};
    snprintf(scene->name, sizeof scene->name, "%s-%u.glint.yaml", info->name, number);
    struct sweep_writer w = {.scene = scene, .random = seed, .depth = 4, .samples = 1, .intensity = 1};
    // Families that are added change no scene of the others: the name begins the numbers.
    for (const char *c = info->name; *c; c++)
        w.random = sweep_bits(&w) ^ (unsigned char)*c;
    w.random = sweep_bits(&w) ^ number;
    place(&w);
    w.background = sweep_color(&w);
    makers[family](&w);
    put_scene(&w);
    struct strbuf *const parts[] = {&w.head, &w.lights, &w.spheres, &w.rectangles, &w.models};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        strbuf_finish(parts[i]);
}

void sweep_scene_finish(struct sweep_scene *scene) {
    strbuf_finish(&scene->text);
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        strbuf_finish(&scene->meshes[i].text);
}
