#include "cli/options_measure.h"

#include "cli/cli.h"
#include "core/number.h"

#include <math.h>
#include <string.h>

static bool read_number(struct cli *cli, int arg, const char *name, const char *text, double least,
                        double most, double *out) {
    double value = 0;
    if (number_parse(str_from(text), &value) != NUMBER_OK || !(value >= least && value <= most)) {
        if (isinf(most))
            cli_usage(cli, arg, "--%s takes a number of at least %g, not '%s'", name, least, text);
        else
            cli_usage(cli, arg, "--%s takes a number from %g to %g, not '%s'", name, least, most, text);
        return false;
    }
    *out = value;
    return true;
}

int cli_read_word(struct cli *cli, int arg, const char *name, const char *text, const char *const *words) {
    struct strbuf list;
    for (int i = 0; words[i]; i++)
        if (strcmp(words[i], text) == 0)
            return i;
    strbuf_init(&list);
    for (int i = 0; words[i]; i++)
        strbuf_format(&list, "%s%s", i == 0 ? "" : words[i + 1] ? ", " : " or ", words[i]);
    cli_usage(cli, arg, "--%s takes %s, not '%s'", name, list.data ? list.data : "", text);
    strbuf_finish(&list);
    return -1;
}

static bool read_bound(struct cli *cli, int arg, enum metric metric, const char *name, const char *text) {
    struct measure_bounds *bounds = &cli->options.measure.bounds;
    const double most =
        metric == METRIC_SSIM || metric == METRIC_FLIP || metric == METRIC_SHARE ? 1 : (double)INFINITY;
    bounds->has[metric] =
        read_number(cli, arg, name, text, metric == METRIC_SSIM ? -1 : 0, most, &bounds->bound[metric]);
    return bounds->has[metric];
}

static bool read_choice(struct cli *cli, int arg, enum cli_measure_option option, const char *name,
                        const char *value) {
    static const char *const spaces[] = {"auto", "displayed", "linear", NULL};
    static const char *const tones[] = {"clip", "normalize", NULL};
    static const char *const transfers[] = {"none", "srgb", NULL};
    static const char *const maps[] = {"difference", "flip", NULL};
    struct cli_measure *m = &cli->options.measure;
    const char *const *words = option == CLI_MEASURE_SPACE      ? spaces
                               : option == CLI_MEASURE_TONE     ? tones
                               : option == CLI_MEASURE_TRANSFER ? transfers
                                                                : maps;
    const int word = cli_read_word(cli, arg, name, value, words);
    if (word < 0)
        return false;
    if (option == CLI_MEASURE_SPACE) {
        m->space = (enum cli_space)word;
        m->space_arg = arg;
    } else if (option == CLI_MEASURE_TONE) {
        m->display.tone = word == 0 ? IR_TONE_CLIP : IR_TONE_NORMALIZE;
        m->has_display = true;
    } else if (option == CLI_MEASURE_TRANSFER) {
        m->display.transfer = word == 0 ? IR_TRANSFER_NONE : IR_TRANSFER_SRGB;
        m->has_display = true;
    } else {
        m->heatmap_flip = word == 1;
    }
    return true;
}

bool cli_measure_apply(struct cli *cli, int arg, enum cli_measure_option option, const char *name,
                       const char *value) {
    struct cli_measure *m = &cli->options.measure;
    double number = 0;
    if (option < CLI_MEASURE_NOT_FINITE)
        return read_bound(cli, arg, (enum metric)(option - CLI_MEASURE_BOUND), name, value);
    switch (option) {
    case CLI_MEASURE_NOT_FINITE:
        if (!read_number(cli, arg, name, value, 0, 1e9, &number))
            return false;
        m->bounds.not_finite = (uint64_t)number;
        return true;
    case CLI_MEASURE_THRESHOLD:
        return m->has_threshold = read_number(cli, arg, name, value, 0, (double)INFINITY, &m->threshold);
    case CLI_MEASURE_PPD:
        return read_number(cli, arg, name, value, 1, 1000, &m->pixels_per_degree);
    case CLI_MEASURE_HEATMAP:
        if (!str_ends_with_nocase(str_from(value), ".png")) {
            cli_usage(cli, arg, "--heatmap writes a PNG: '%s' must end in .png", value);
            return false;
        }
        m->heatmap = value;
        return true;
    case CLI_MEASURE_MAX_ERROR:
        m->max_error = value;
        m->max_error_arg = arg;
        return true;
    case CLI_MEASURE_MAX_TIME:
        return read_number(cli, arg, name, value, 1e-6, 1e9, &m->max_time_ms);
    case CLI_MEASURE_TIME:
        m->time_arg = arg;
        return read_number(cli, arg, name, value, 1e-3, 1e6, &m->time_s);
    case CLI_MEASURE_NOISE:
        m->noise_arg = arg;
        return read_number(cli, arg, name, value, 1e-6, 1, &m->noise);
    case CLI_MEASURE_BUDGET:
        return read_number(cli, arg, name, value, 1, 1e6, &m->budget_s);
    case CLI_MEASURE_MAX_OFF:
        cli->options.audit_arg = arg;
        return cli->options.has_max_off = read_number(cli, arg, name, value, 0, 1, &cli->options.max_off);
    default:
        return read_choice(cli, arg, option, name, value);
    }
}
