// Hashes and ranks of mattes, and the table of what else is known of pixels.
#include "render/aov/aov.h"
#include "render/aov/matte.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

// Of Appleby's own MurmurHash3_x86_32 with seed 0.
static void hashes(void **state) {
    static const struct {
        const char *name;
        uint32_t hash;
    } known[] = {{"", 0},
                 {"a", 0x3c2569b2},
                 {"hello", 0x248bfa47},
                 {"hello, world", 0x149bbb7f},
                 {"The quick brown fox jumps over the lazy dog", 0x2e4ff723}};
    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        assert_int_equal(matte_hash(str_from(known[i].name)), known[i].hash);
    char key[8];
    matte_key(STR("CryptoObject"), key);
    assert_string_equal(key, "3ae39a5"); // as in files of other programs
}

// No float that a reader could change on its way.
static void hashes_are_normal_floats(void **state) {
    (void)state;
    assert_int_equal(matte_bits(0x00000001), 0x00800001);
    assert_int_equal(matte_bits(0x7f800000), 0x7f000000);
    assert_int_equal(matte_bits(0xff812345), 0xff012345);
    assert_int_equal(matte_bits(0x3f800000), 0x3f800000);
}

static void rank_is(const struct matte *m, int rank, uint32_t bits, float coverage) {
    uint32_t got;
    memcpy(&got, &m->ranks[2 * rank], sizeof got);
    assert_int_equal(got, bits);
    assert_true(m->ranks[2 * rank + 1] == coverage);
}

static void ranks_are_by_coverage(void **state) {
    static const uint32_t seen[8] = {9, 7, 0, 7, 5, 7, 5, 3};
    struct matte m;
    (void)state;
    assert_true(matte_init(&m, 1, 1));
    for (int i = 0; i < 8; i++)
        matte_add(&m, 0, seen[i]);
    assert_true(matte_end(&m, 8));
    rank_is(&m, 0, 7, 0.375F);
    rank_is(&m, 1, 5, 0.25F);
    rank_is(&m, 2, 3, 0.125F);
    rank_is(&m, 3, 9, 0.125F);
    rank_is(&m, 4, 0, 0);
    matte_finish(&m);
}

static void the_least_ranks_are_left_out(void **state) {
    struct matte m;
    (void)state;
    assert_true(matte_init(&m, 1, 1));
    for (uint32_t name = 1; name <= MATTE_KEPT; name++)
        for (uint32_t i = 0; i < name; i++)
            matte_add(&m, 0, name);
    assert_true(matte_end(&m, 36));
    for (uint32_t rank = 0; rank < MATTE_RANKS; rank++)
        rank_is(&m, (int)rank, MATTE_KEPT - rank, (float)(MATTE_KEPT - rank) / 36.0F);
    matte_finish(&m);
}

static void names_are_of_one_table(void **state) {
    (void)state;
    const char *at = AOV_NAMES;
    for (int i = 0; i < AOVS; i++) {
        const struct aov_info *info = aov_info((enum aov)i);
        assert_int_equal(strncmp(at, info->name, strlen(info->name)), 0);
        at += strlen(info->name);
        assert_int_equal(*at, i + 1 < AOVS ? '|' : '\0');
        at += *at != '\0';
        assert_int_equal(aov_named(str_from(info->name)), i);
        assert_true(info->channel_count >= 1 && info->channel_count <= AOV_CHANNELS_MOST);
    }
    assert_int_equal(aov_named(STR("dept")), AOVS);
    assert_int_equal(aov_named(STR("")), AOVS);
    assert_false(aov_needs_hits(1U << AOV_ERROR | 1U << AOV_SAMPLES));
    assert_true(aov_needs_hits(1U << AOV_ERROR | 1U << AOV_COST));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hashes),
        cmocka_unit_test(hashes_are_normal_floats),
        cmocka_unit_test(ranks_are_by_coverage),
        cmocka_unit_test(the_least_ranks_are_left_out),
        cmocka_unit_test(names_are_of_one_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
