// Generated scenes, laid out at random and with comments, through the formatter: the meaning stays, each
// comment stays at its entry, and formatting twice is formatting once.
//     format_generated [SCENES]
#include "grammar/print/ir_print.h"
#include "tests/format/format_kit.h"
#include "tests/generate/generate.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <cmocka.h>

static uint64_t scenes = 300;

static const str meshes[] = {{"meshes/ball.obj", 15}, {"1.0", 3}, {"a b/#1: [x].obj", 15}};
static const str includes[] = {{"base.yaml", 9}};
static const str images[] = {{"sky.jpg", 7}};

static void check_scene(uint64_t seed, bool xml) {
    struct arena arena;
    struct strbuf plain, noisy, out;
    char name[64];
    const struct generate_options options = {.seed = seed,
                                             .renderable = seed % 5 == 0,
                                             .meshes = {meshes, 3},
                                             .images = {images, 1},
                                             .includes = {includes, 1}};
    arena_init(&arena, (size_t)1 << 28);
    strbuf_init(&plain), strbuf_init(&noisy), strbuf_init(&out);
    const struct ir_scene *scene = generate_scene(&options, &arena);
    (xml ? ir_write_xml : ir_write_yaml)(scene, NULL, NULL, (struct ir_write_options){0}, &plain);
    add_noise(seed, xml, strbuf_view(&plain), &noisy);
    snprintf(name, sizeof name, "seed%llu.%s", (unsigned long long)seed, xml ? "xml" : "yaml");
    assert_formats(name, strbuf_view(&noisy), &out);
    strbuf_finish(&plain), strbuf_finish(&noisy), strbuf_finish(&out);
    arena_finish(&arena);
}

static void test_generated(void **state) {
    (void)state;
    clock_t start = clock();
    for (uint64_t seed = 0; seed < scenes; seed++)
        check_scene(seed / 2, seed % 2);
    print_message("%llu scenes, %.1f s of processor time\n", (unsigned long long)scenes,
                  (double)(clock() - start) / CLOCKS_PER_SEC);
}

int main(int count, char **arguments) {
    if (count > 1)
        scenes = strtoull(arguments[1], NULL, 10);
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_generated)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
