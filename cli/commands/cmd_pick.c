// glint pick SCENE X,Y: what is seen at a pixel, and the path of its ray.
#include "cli/commands/commands.h"
#include "cli/device.h"
#include "core/number.h"
#include "grammar/ir.h"
#include "render/pick.h"

#include <string.h>

struct place {
    uint32_t x, y;
};

static bool read_place(struct cli *cli, struct place *place) {
    const char *text = cli->operands[1];
    const char *comma = strchr(text, ',');
    int64_t x = -1, y = -1;
    if (comma && number_parse_integer((str){text, (size_t)(comma - text)}, &x) == NUMBER_OK &&
        number_parse_integer(str_from(comma + 1), &y) == NUMBER_OK && x >= 0 && y >= 0 && x <= INT32_MAX &&
        y <= INT32_MAX) {
        *place = (struct place){(uint32_t)x, (uint32_t)y};
        return true;
    }
    cli_usage(cli, cli_operand_place(cli, 1),
              "a pixel is two whole numbers from 0, counted from the top left, such as 320,200, not '%s'",
              text);
    return false;
}

static bool is_in_picture(struct cli *cli, const struct session *session, struct place place) {
    if (place.x < (uint32_t)session->image->width && place.y < (uint32_t)session->image->height)
        return true;
    cli_usage(cli, cli_operand_place(cli, 1), "the picture has %d x %d pixels, from 0,0 to %d,%d",
              session->image->width, session->image->height, session->image->width - 1,
              session->image->height - 1);
    return false;
}

static int tell(struct cli *cli, const struct pick *pick, bool json) {
    struct strbuf text;
    strbuf_init(&text);
    if (json)
        pick_json(pick, &text);
    else
        pick_text(pick, &text);
    int status = cli_print(cli, strbuf_view(&text));
    strbuf_finish(&text);
    return status;
}

static int pick_from(struct cli *cli, struct session *session, struct place place, bool json) {
    struct gpu *gpu = NULL;
    struct pick pick = {0};
    const uint32_t camera = session_camera(session, cli->options.camera);
    if (camera == IR_NO_INDEX)
        return cli_report(cli, session, true);
    if (!is_in_picture(cli, session, place))
        return CLI_USAGE;
    const uint32_t sample = (uint32_t)cli->options.sample;
    if (cli->options.sample >= session->image->samples)
        return cli_usage(cli, cli_option_place(cli, "sample"),
                         "the picture has %d sample%s per pixel, counted from 0", session->image->samples,
                         session->image->samples == 1 ? "" : "s");
    int status = cli_device_is_reference(cli) ? CLI_OK : cli_open_device(cli, &gpu);
    if (status == CLI_OK) {
        const enum shot_status taken = pick_take(&pick, session, gpu, camera, place.x, place.y, sample);
        const int reported = cli_report(cli, session, false);
        status = taken == SHOT_OK       ? tell(cli, &pick, json)
                 : taken == SHOT_DEVICE ? cli_device_failed(cli, gpu)
                                        : reported;
    }
    pick_finish(&pick);
    cli_close_device(cli, gpu);
    return status;
}

int cmd_pick(struct cli *cli) {
    static const char *const kinds[] = {"text", "json", NULL};
    struct place place;
    int kind;
    if (!cli_format(cli, kinds, &kind) || !read_place(cli, &place))
        return CLI_USAGE;
    struct session session;
    struct asset_store *store = asset_store_create();
    struct session_options options = cli_session_options(cli, cli->operands[0]);
    options.whole_picture = true;
    session_load(&session, &options, store);
    const bool good = session.state == SESSION_LOADED && session.sink.errors == 0;
    const int status = good ? pick_from(cli, &session, place, kind == 1) : cli_report(cli, &session, true);
    session_finish(&session);
    asset_store_destroy(store);
    return status;
}
