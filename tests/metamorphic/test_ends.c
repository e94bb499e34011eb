// A signal ends a frame at the dispatch that runs, and none runs long, however heavy the scene is.
//
// Usage: test_ends SCENE, one that keeps any device busy for hours.
#include "cli/progress.h"
#include "core/clock.h"
#include "tests/pictures/picture_kit.h"

#include <signal.h>
#include <stdio.h>

static int failed;

static void expect(bool good, const char *what) {
    printf("%s %s\n", good ? "ok  " : "FAIL", what);
    failed += !good;
}

struct sender {
    struct progress progress;
    const struct render_statistics *statistics;
    int signal;
    double after_seconds; // of the device, since the first dispatch; 0: at the first one
    uint32_t dispatches;  // when the signal was sent; 0: not yet
    double first_seconds, device_seconds;
};

// Between two dispatches, as from a terminal, and then what the program does.
static bool send(void *context, double fraction) {
    struct sender *s = context;
    if (s->statistics->dispatches == 1)
        s->first_seconds = s->statistics->device_seconds;
    if (s->dispatches == 0 && s->statistics->device_seconds - s->first_seconds >= s->after_seconds) {
        s->dispatches = s->statistics->dispatches;
        s->device_seconds = s->statistics->device_seconds;
        raise(s->signal);
    }
    const struct render_progress report = progress_callback(&s->progress);
    return report.report(report.context, fraction);
}

static struct sender end_by(struct shot *shot, struct image *image, int signal_number, double seconds) {
    struct render_statistics statistics = {0};
    struct sender sender = {.statistics = &statistics, .signal = signal_number, .after_seconds = seconds};
    const struct render_progress progress = {send, &sender};
    progress_begin(&sender.progress, true);
    interrupt_catch();
    const enum shot_status status = shot_take(shot, image, &progress, &statistics);
    expect(status == SHOT_CANCELLED && interrupt_signal() == signal_number, "a signal cancels the frame");
    expect(sender.dispatches > 0 && statistics.dispatches == sender.dispatches,
           "there is no dispatch after the signal");
    return sender;
}

// A dispatch of few paths, whatever they take: the signal is heard before the first pass is over.
static void test_pieces(struct shot *shot, struct image *image) {
    shot->settings.dispatch_paths = 100;
    expect(renderer_change(shot->renderer, &shot->flat, &shot->settings), "pieces of 100 paths");
    const struct sender sender = end_by(shot, image, SIGTERM, 0);
    expect(sender.dispatches == 1, "the signal is heard after the first piece");
}

// How many paths a dispatch gets is up to their cost. Its bound is for a busy machine too; all of a portion's
// paths together take seconds.
static void test_pace(struct shot *shot, struct image *image) {
    const double mean_most = 0.2;
    shot->settings.dispatch_paths = 0;
    expect(renderer_change(shot->renderer, &shot->flat, &shot->settings), "as many as are over soon");
    const struct sender sender = end_by(shot, image, SIGINT, 1.5);
    const double seconds = sender.device_seconds - sender.first_seconds;
    const double mean = sender.dispatches > 1 ? seconds / (sender.dispatches - 1) : seconds;
    printf("%u dispatches in %.2f s\n", (unsigned)sender.dispatches, sender.device_seconds);
    expect(sender.dispatches > 1 && mean < mean_most, "dispatches are short");
}

int main(int argc, char **argv) {
    struct picture_kit kit;
    struct session session;
    struct shot shot;
    struct image image = {0};
    if (argc < 2)
        return 2;
    if (!picture_kit_open(&kit))
        return 77;
    const struct session_options options = {.path = str_from(argv[1]), .limits = limits_default()};
    session_load(&session, &options, kit.store);
    const bool good = session.state == SESSION_LOADED && shot_open(&shot, &session, kit.gpu, 0) == SHOT_OK &&
                      image_init(&image, shot.settings.width, shot.settings.height);
    expect(good, "the scene is on the device");
    if (good) {
        test_pieces(&shot, &image);
        test_pace(&shot, &image);
    }
    image_finish(&image);
    shot_close(&shot);
    session_finish(&session);
    expect(picture_kit_close(&kit) == 0, "the validation layer is silent");
    return failed != 0;
}
