// glint test: the cases of a folder, and what became of them. Private to cli/test.
//
// Ownership: all lies in cli->arena except the pictures for the page, which test_finish frees. Thread safety:
// as cli.h.
#ifndef GLINT_CLI_COMMANDS_TEST_TEST_H
#define GLINT_CLI_COMMANDS_TEST_TEST_H

#include "cli/cli.h"
#include "files/files.h"
#include "load/settings/test_file.h"
#include "picture/metrics/metrics.h"

enum test_state {
    TEST_PENDING,
    TEST_SAME,    // every pixel
    TEST_WITHIN,  // its bounds
    TEST_DIFFERS, // or has another size
    TEST_MISSING, // there is no reference
    TEST_FAILED,  // no picture could be made, or the reference is damaged
    TEST_LIBRARY, // a scene that only defines things for others, without a picture of its own
    TEST_STATES,
};
extern const char *const test_state_words[TEST_STATES];

struct test_size {
    uint32_t width, height; // in pixels; 0: there is no picture
};

enum test_shown {
    TEST_SHOWN_PICTURE,
    TEST_SHOWN_REFERENCE,
    TEST_SHOWN_DIFFERENCE,
    TEST_SHOWN_COUNT,
};

struct test_case {
    str name;     // the scene's path in the folder, or the picture's in the file, without ending
    str scene;    // its path
    str picture;  // the reference's path
    str found_in; // the folder that was searched for the scene; empty: the file names it
    str named_in; // the root that the scene must be below, if the file names it
    struct test_settings settings;
    bool is_there;   // the reference was there when the cases were listed
    bool is_foreign; // the file there is not a picture, not even a damaged one
    bool is_unread;  // that is not known either: the system did not let it be read, as `reason` says
    enum image_format format;
    // What became of it.
    enum test_state state;
    bool is_written; // a new reference
    str reason;      // in words; empty: the figures say it
    str record;      // how the reference's record differs from the new one; empty: not at all
    struct test_size now, was;
    int32_t samples;
    bool is_measured;
    struct measure_result result;
    double seconds;
    struct strbuf shown[TEST_SHOWN_COUNT]; // PNG files for the page; empty: none
};

struct test_run {
    struct cli *cli;
    str folder;         // without '/' at its end
    str file_path;      // of the bounds; empty: there are none
    struct files files; // with the roots below which paths named by the file must be
    struct test_file file;
    struct {
        struct test_case *items;
        uint32_t count, capacity;
    } cases;
    struct test_list unused; // pictures that no scene has
    uint32_t left_out;       // by --only
    uint32_t loads;          // scenes that were read
    int format;              // 1: JSON
    double seconds;
};

// test_plan.c: an exit code.
int test_plan(struct test_run *run);

// test_render.c: makes the pictures one after another; `judge` gets each as a file in memory, valid only
// during the call, or none if the case failed. An exit code.
struct test_made {
    struct strbuf file;
    struct image_display display;
};
typedef int (*test_judge_fn)(struct test_run *run, struct test_case *test, const struct test_made *made);
int test_render(struct test_run *run, test_judge_fn judge);

// test_judge.c: fills in what became of a case. false: no memory.
bool test_judge(struct test_run *run, struct test_case *test, const struct test_made *made);
// Whether a metric has a bound that is broken.
bool test_breaks(const struct test_case *test, enum metric metric);

struct test_counts {
    uint32_t all, good, written, of[TEST_STATES];
};
struct test_counts test_count(const struct test_run *run);
// Whether the exit status is 0.
bool test_passed(const struct test_run *run);

// The figures that matter, or the reason that there are none: "share 0.031 (at most 0.005), the worst at
// 12,30".
void test_figures(const struct test_case *test, struct strbuf *out);
void test_line(const struct test_run *run, const struct test_case *test, struct strbuf *out);
void test_closing(const struct test_run *run, struct strbuf *out);
// "46 pictures: 45 within their bounds, 1 differs"
void test_sums(const struct test_run *run, struct strbuf *out);
void test_json(const struct test_run *run, struct strbuf *out);
void test_junit(const struct test_run *run, struct strbuf *out);
void test_html(const struct test_run *run, struct strbuf *out);

#endif
