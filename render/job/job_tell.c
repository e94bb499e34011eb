// What is known of a job's picture: for its file, and for people.
#include "core/hash128.h"
#include "grammar/ir.h"
#include "render/job/job.h"
#include "render/stats/reference_stats.h"

#include <stdio.h>
#include <sys/resource.h>

const struct render_estimate *job_estimate(const struct job *job) {
    return !job_by_reference(job) && job->shot && job->shot->settings.error > 0
               ? renderer_estimate(job->shot->renderer)
               : NULL;
}

// ---- its file

struct image_display job_display(const struct job *job) {
    return image_display_of(job->session->image);
}

struct provenance job_provenance(const struct job *job, enum image_format format,
                                 struct image_coding coding) {
    return (struct provenance){.session = job->session,
                               .gpu = job_by_reference(job) ? NULL : job->gpu,
                               .camera = job->camera,
                               .is_double = job_by_reference(job) || (job->shot && job->shot->flat.is_double),
                               .as_file = job->wish.as_file,
                               .audits = job->stats.has_audit,
                               .max_off = job->wish.max_off,
                               .scaled_width = job->is_scaled ? job->image.width : 0,
                               .scaled_height = job->is_scaled ? job->image.height : 0,
                               .format = format,
                               .coding = coding};
}

static void make_keys(const struct shot *shot, struct part *part) {
    const struct reference_input input = {.scene = &shot->session->resolved, .view = &shot->view};
    struct hash128 h;
    reference_input_key(&input, part->scene);
    hash128_begin(&h);
    hash128_text(&h, STR(GLINT_VERSION));
    hash128_whole(&h, shot->flat.is_double);
    hash128_whole(&h, shot->settings.features);
    hash128_whole(&h, shot->settings.path_segments);
    hash128_end(&h, part->settings);
}

void job_describe_part(struct job *job, struct part *part) {
    const struct provenance made = job_provenance(job, IMAGE_PNG, (struct image_coding){0});
    make_keys(job->shot, part);
    snprintf(part->device, sizeof part->device, "%s", gpu_info(job->gpu)->name);
    provenance_line(&made, job->arena, part->record, sizeof part->record);
}

// ---- statistics

static void fill_statistics(struct job *job) {
    const struct shot *shot = job->shot;
    struct stats *s = &job->stats;
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    s->peak_memory_bytes = usage.ru_maxrss * 1024;
    s->timeline = job->wish.timeline;
    s->has_rays = job->wish.counts;
    s->begun = job->wish.time.begun;
    s->read_seconds = job->session->read_seconds;
    s->assets_seconds = job->session->assets_seconds;
    s->flatten_seconds = shot->flatten_seconds;
    s->build_seconds = shot->flat.build_seconds;
    s->upload_seconds = shot->upload_seconds;
    s->scene_bytes = renderer_scene_bytes(shot->renderer);
    s->portion_bytes = renderer_portion_bytes(shot->renderer);
    s->triangles = shot->flat.triangle_count;
    s->dropped = shot->flat.dropped_triangles;
    s->spheres = shot->flat.sphere_count;
    s->triangle_depth = shot->flat.triangle_depth;
    s->features = shot->settings.features;
    s->is_double = shot->flat.is_double;
    s->camera = shot->view.camera.name;
    s->width = shot->settings.width;
    s->height = shot->settings.height;
    s->samples = s->last.samples;
    snprintf(s->device, sizeof s->device, "%s", gpu_info(job->gpu)->name);
}

void job_report(struct job *job, bool is_json, struct strbuf *out) {
    if (job_by_reference(job)) {
        (is_json ? reference_stats_json : reference_stats_text)(&job->reference, &job->reference_statistics,
                                                                out);
        return;
    }
    fill_statistics(job);
    (is_json ? stats_json : stats_text)(&job->stats, out);
}
