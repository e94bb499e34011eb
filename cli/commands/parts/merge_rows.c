#include "cli/commands/parts/merge_rows.h"

#include "cli/commands/pictures/row_files.h"
#include "core/heap.h"
#include "diag/codes/file.h"
#include "render/record/provenance.h"

#include <stdlib.h>
#include <string.h>

#define NONE UINT32_MAX

struct merging {
    struct cli *cli;
    const struct part *parts;
    const uint32_t *order; // from the top
    uint32_t count;
    uint32_t open; // the part whose file is open; NONE: none is
    struct spool file;
    float *row; // of the widest part
};

bool merge_is_by_rows(const struct rendering *r, const struct part *parts, uint32_t count) {
    bool all = image_rows_can(r->outputs[0].format);
    for (uint32_t i = 0; i < count && all; i++)
        all = parts[i].end_sample - parts[i].first_sample == parts[i].samples;
    return all;
}

static const char *name_of(const struct merging *m, uint32_t part) {
    return m->cli->operands[part + 1];
}

static int unreadable(const struct merging *m, uint32_t part, const char *error) {
    cli_error(m->cli, DIAG_FILE_UNREADABLE, name_of(m, part), NULL, "the file %s",
              error ? error : "needs more memory than there is");
    return CLI_FILE;
}

static int check(const struct merging *m) {
    int status = CLI_OK;
    for (uint32_t i = 0; i < m->count && status == CLI_OK; i++) {
        struct strbuf error;
        strbuf_init(&error);
        if (!part_check(name_of(m, i), &m->parts[i], &error))
            status = unreadable(m, i, error.data);
        strbuf_finish(&error);
    }
    return status;
}

// Parts lie side by side in the picture, and their files may be more than can be open at once.
static bool open_part(struct merging *m, uint32_t part) {
    if (m->open == part)
        return true;
    if (m->open != NONE)
        spool_close(&m->file);
    m->open = spool_read(&m->file, name_of(m, part)) ? part : NONE;
    return m->open == part;
}

// The rows of a part that are among [y, y + count) of the picture.
static bool take_part(struct merging *m, uint32_t part, uint32_t y, uint32_t count, float *rgb) {
    const struct part *p = &m->parts[part];
    const uint32_t begin = y > p->region.y ? y : p->region.y;
    const uint32_t below = p->region.y + p->region.height, end = below < y + count ? below : y + count;
    const size_t width = p->width, floats = 3 * (size_t)p->region.width;
    for (uint32_t at = begin; at < end; at++) {
        float *to = rgb + 3 * ((at - y) * width + p->region.x);
        if (!open_part(m, part) || !part_take_rows(&m->file, p, at - p->region.y, 1, m->row))
            return false;
        memcpy(to, m->row, floats * sizeof *to);
    }
    return true;
}

static bool take(void *context, uint32_t y, uint32_t count, float *rgb) {
    struct merging *m = context;
    bool good = true;
    for (uint32_t i = 0; i < m->count && good; i++)
        good = take_part(m, m->order[i], y, count, rgb);
    return good;
}

static int write_picture(struct rendering *r, struct merging *m) {
    const struct cli_output *output = &r->outputs[0];
    const struct image_display display = image_display_of(r->job.session->image);
    const struct image_coding coding = render_coding(&r->cli->options, output->format);
    const struct image_rows rows = {
        .width = r->job.image.width,
        .height = r->job.image.height,
        .take = take,
        .context = m,
        .texts = r->record ? provenance_of_line(r->record, output->format, coding, &r->cli->arena)
                           : (struct image_texts){0},
        .coding = coding};
    bool ended;
    const int status = row_file_write(r->cli, output->path, &rows, output->format, display, NULL, &ended);
    return ended ? unreadable(m, m->open == NONE ? 0 : m->open, "can no longer be read") : status;
}

int merge_rows(struct rendering *r, const struct part *parts, const uint32_t *order, uint32_t count) {
    struct merging m = {.cli = r->cli, .parts = parts, .order = order, .count = count, .open = NONE};
    int status = check(&m);
    m.row = heap_array(parts->width, 3 * sizeof *m.row);
    if (status == CLI_OK)
        status = m.row ? write_picture(r, &m) : unreadable(&m, 0, NULL);
    if (m.open != NONE)
        spool_close(&m.file);
    free(m.row);
    return status;
}
