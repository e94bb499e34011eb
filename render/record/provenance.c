#include "render/record/provenance.h"

#include "grammar/ir.h"
#include "render/record/record.h"

#include <stdio.h>
#include <string.h>

// The device as files name it.
static str provenance_device(struct arena *arena, const struct gpu *gpu) {
    if (!gpu)
        return STR("reference");
    const struct gpu_device_info *info = gpu_info(gpu);
    str text = info->driver[0] ? arena_format(arena, "%s, %s", info->name, info->driver)
                               : arena_copy(arena, str_from(info->name));
    char *bytes = arena_copy(arena, text).ptr ? arena_alloc(arena, text.len + 1) : NULL;
    for (size_t i = 0; i < text.len; i++)
        bytes[i] = text.ptr[i] >= ' ' && text.ptr[i] < 0x7f ? text.ptr[i] : ' ';
    return (str){bytes, text.len};
}

static bool has_place(enum image_format format) {
    return format != IMAGE_PFM && format != IMAGE_WEBP;
}

// A frame with a time limit takes all samples of all pixels even if the scene lets some end sooner: no option
// asks for that.
static bool is_repeatable(const struct provenance *made) {
    const struct session *s = made->session;
    return !made->gpu || s->options.error >= 0 || !(s->scene->image.error > 0) ||
           s->image->samples <= s->scene->image.min_samples;
}

static struct record_command command_of(const struct provenance *made) {
    const struct session *s = made->session;
    const struct session_options *o = &s->options;
    const struct ir_cameras *cameras = &s->scene->cameras;
    const bool is_named = made->camera > 0 && made->camera < cameras->count;
    const bool audits = made->audits && made->gpu;
    return (struct record_command){.scene = o->overlay_count ? STR("-") : o->path,
                                   .camera = is_named ? cameras->items[made->camera].name : STR(""),
                                   .sets = o->sets,
                                   .set_count = o->set_count,
                                   .asset_paths = o->asset_paths,
                                   .asset_path_count = o->asset_path_count,
                                   .width = s->image->width,
                                   .height = s->image->height,
                                   .samples = s->image->samples,
                                   .noise = made->gpu && o->error > 0 && s->image->error > 0 ? o->error : 0,
                                   .is_reference = !made->gpu,
                                   .as_file = made->as_file,
                                   .audit = audits,
                                   .max_off = audits ? made->max_off : -1,
                                   .coding = made->coding};
}

struct image_texts provenance_texts(const struct provenance *made, struct arena *arena) {
    if (!has_place(made->format) || !is_repeatable(made))
        return (struct image_texts){0};
    const struct record record = {.command = command_of(made),
                                  .version = STR(GLINT_VERSION),
                                  .device = provenance_device(arena, made->gpu),
                                  .session = made->session,
                                  .is_double = made->is_double,
                                  .scaled_width = made->scaled_width,
                                  .scaled_height = made->scaled_height,
                                  .format = made->format};
    return record_texts(&record, arena);
}

void provenance_line(const struct provenance *made, struct arena *arena, char *line, size_t size) {
    const struct image_texts texts = provenance_texts(made, arena);
    struct strbuf text;
    strbuf_init(&text);
    for (uint32_t i = 0; i < texts.count; i++)
        strbuf_format(&text, "%s%s: %s", i ? "\t" : "", texts.items[i].keyword, texts.items[i].text);
    const bool fits = text.len < size && !text.failed;
    snprintf(line, size, "%s", fits && text.len ? text.data : "");
    strbuf_finish(&text);
}

struct image_texts provenance_of_line(const char *line, enum image_format format, struct image_coding coding,
                                      struct arena *arena) {
    struct image_text *items = ARENA_ARRAY(arena, struct image_text, RECORD_FIELDS);
    struct image_texts texts = {items, 0};
    struct strbuf text;
    strbuf_init(&text);
    for (int field = 0; *line && has_place(format) && field < RECORD_FIELDS; field++) {
        const size_t head = strlen(record_keywords[field]), length = strcspn(line, "\t");
        if (strncmp(line, record_keywords[field], head) != 0 || head + 2 > length)
            continue;
        strbuf_clear(&text);
        strbuf_add(&text, line + head + 2, length - head - 2);
        if (field == RECORD_COMMAND)
            record_add_coding(&text, format, &coding);
        items[texts.count++] =
            (struct image_text){record_keywords[field], arena_copy(arena, strbuf_view(&text)).ptr};
        line += length + (line[length] == '\t');
    }
    strbuf_finish(&text);
    return texts;
}
