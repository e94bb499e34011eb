// One sample: its paths, ray by ray (docs/language.md, "Depth and weight").
#include "core/heap.h"
#include "reference/reference_internal.h"

#include <stdlib.h>

// ---- rays that wait

enum {
    RAYS_A_QUESTION = 16, // few, because a ray may have to visit thousands of bodies
};

void reference_queue_finish(struct queue *queue) {
    free(queue->items);
    *queue = (struct queue){0};
}

// A heap by throughput, or a stack.
static void push(struct queue *q, const struct branch *branch) {
    struct branch *items = heap_grow(q->items, q->count, &q->capacity, sizeof *items);
    if (!items) {
        q->failed = true;
        return;
    }
    q->items = items;
    size_t at = q->count++;
    while (q->heaviest_first && at > 0 && q->items[(at - 1) / 2].throughput < branch->throughput) {
        q->items[at] = q->items[(at - 1) / 2];
        at = (at - 1) / 2;
    }
    q->items[at] = *branch;
}

static struct branch pop(struct queue *q) {
    if (!q->heaviest_first)
        return q->items[--q->count];
    struct branch top = q->items[0];
    struct branch last = q->items[--q->count];
    size_t at = 0;
    for (size_t child = 1; child < q->count; child = 2 * at + 1) {
        if (child + 1 < q->count && q->items[child + 1].throughput > q->items[child].throughput)
            child++;
        if (q->items[child].throughput <= last.throughput)
            break;
        q->items[at] = q->items[child];
        at = child;
    }
    q->items[at] = last;
    return top;
}

// ---- following

struct following {
    const struct reference *r;
    const struct reference_settings *settings;
    struct queue *queue;
    struct log *log;
    struct sample *sample;
    struct points points;
};

static void add(struct following *f, vec3 value, const struct branch *b) {
    f->sample->radiance = vec3_add(f->sample->radiance, vec3_times(vec3_mul(value, b->throughput), b->tint));
}

static void see(struct following *f, vec3 value) {
    f->sample->brightest = fmax(f->sample->brightest, reference_brightest(value));
}

// What is seen if nothing is hit.
static vec3 seen_beyond(const struct reference *r, vec3 direction) {
    return vec3_add(reference_background(r, direction), reference_seen_discs(r, direction));
}

// A ray that leaves a surface: it waits, or is cut. Returns the throughput cut.
static double send(struct following *f, const struct branch *child) {
    const struct reference_settings *settings = f->settings;
    const double weight = child->throughput * reference_brightest(child->tint);
    if (!(weight > 0))
        return 0;
    if (weight < settings->min_weight) {
        f->sample->cut_by_weight++;
    } else if (child->depth > settings->max_depth) {
        f->sample->cut_by_depth++;
        if (settings->cut_sees_background)
            add(f, seen_beyond(f->r, child->direction), child);
    } else {
        push(f->queue, child);
        return 0;
    }
    f->sample->left_weight += weight;
    return weight;
}

static struct branch child_of(const struct branch *from, uint32_t segment, enum reference_kind kind) {
    struct branch child = *from;
    child.depth++;
    child.parent = segment;
    child.kind = kind;
    child.key = point_key(from->key, kind == REFERENCE_REFRACTED ? POINT_REFRACTED : POINT_REFLECTED);
    return child;
}

static double send_rays(struct following *f, const struct branch *from, const struct surface *s,
                        uint32_t segment, bool *total) {
    struct branch back = child_of(from, segment, REFERENCE_REFLECTED);
    struct branch through = child_of(from, segment, REFERENCE_REFRACTED);
    struct split split;
    reference_split(f->r, s, from->direction, &split);
    *total = s->is->refraction > 0 && !split.through;
    f->sample->total_reflections += *total;
    double cut = 0;
    through.throughput *= reference_refraction(s, &split);
    if (through.throughput > 0) {
        through.direction = split.bent;
        through.inside = s->after;
        through.start = reference_leave(f->r, s, vec3_neg(s->geometric));
        through.cone = reference_bent_cone(s, from->cone, from->direction, through.direction);
        cut += send(f, &through);
    }
    back.throughput *= reference_reflection(s, &split);
    if (back.throughput > 0) {
        back.tint = vec3_times(back.tint, reference_mirror_color(s, from->direction, &split));
        back.start = reference_leave(f->r, s, s->geometric);
        back.direction = reference_mirrored(f->r, s, from->direction);
        back.cone = reference_mirrored_cone(s, from->cone);
        cut += send(f, &back);
    }
    return cut;
}

static struct reference_segment *log_segment(struct following *f, const struct branch *b) {
    struct log *log = f->log;
    if (!log || log->count++ >= log->capacity)
        return NULL;
    struct reference_segment *segment = &log->segments[log->count - 1];
    *segment = (struct reference_segment){.kind = b->kind,
                                          .parent = b->parent,
                                          .depth = b->depth,
                                          .weight = b->throughput,
                                          .origin = vec3_add(b->start.at, f->r->origin),
                                          .direction = b->direction,
                                          .body = HIT_NONE,
                                          .light = IR_NO_INDEX,
                                          .medium = reference_filling(f->r, &b->inside),
                                          .tint = b->tint,
                                          .material = IR_NO_INDEX};
    return segment;
}

static void log_surface(const struct following *f, struct reference_segment *segment, const struct surface *s,
                        const struct lighting *lighting) {
    if (!segment)
        return;
    segment->body = s->body;
    segment->triangle = s->triangle;
    segment->material = s->material;
    segment->enters = s->enters;
    segment->passes = s->passes;
    segment->distance = s->distance;
    segment->point = vec3_add(s->point, f->r->origin);
    segment->geometric = s->geometric;
    segment->shading = s->shading;
    segment->considered = lighting->considered;
    segment->lit = lighting->lit;
    segment->radiance = lighting->sum;
    segment->texel = s->texel;
}

// A surface between equal media, or of a body of lower priority: the ray goes straight on, unseen.
static void pass(struct following *f, struct branch *b, const struct surface *s, uint32_t segment) {
    b->start = reference_leave(f->r, s, vec3_neg(s->geometric));
    b->inside = s->after;
    b->cone.width = s->width;
    b->parent = segment;
    f->sample->rays[b->kind]--; // the ray continues, and counts there
    f->sample->unseen++;
    push(f->queue, b);
}

static void show_surface(struct following *f, const struct branch *b, const struct surface *s,
                         struct reference_segment *segment) {
    struct lighting lighting;
    reference_light(f->r, s, b->direction, &b->inside, &f->points, b->key, &lighting);
    f->sample->shadow += lighting.shadow_rays;
    f->sample->unseen += lighting.unseen;
    see(f, lighting.sum);
    add(f, lighting.sum, b);
    log_surface(f, segment, s, &lighting);
    bool total;
    struct surface facet = *s;
    reference_roughen(f->r, &facet, b->direction, &f->points, b->key);
    double cut = send_rays(f, b, &facet, f->log ? f->log->count - 1 : 0, &total);
    if (segment) {
        segment->total_reflection = total;
        segment->cut_weight = cut;
    }
}

// A light nearer than what the ray hits, so that the ray does not reach the hit.
static bool see_light(struct following *f, struct branch *b, double t_max,
                      struct reference_segment *segment) {
    double t;
    const uint32_t light = reference_seen_light(f->r, b->start.at, b->direction, t_max, &t);
    if (light == IR_NO_INDEX)
        return false;
    const vec3 radiance = f->r->input.view->lights[light].radiance;
    b->tint = vec3_times(b->tint, reference_left(f->r, &b->inside, t * vec3_length(b->direction)));
    see(f, radiance);
    add(f, radiance, b);
    if (segment) {
        segment->tint = b->tint;
        segment->radiance = radiance;
        segment->distance = t;
        segment->light = light;
    }
    return true;
}

static void follow_ray(struct following *f, struct branch *b) {
    struct ray ray = {b->start, b->direction, INFINITY, b->cone};
    struct intersection hit;
    struct reference_segment *segment = log_segment(f, b);
    f->sample->rays[b->kind]++;
    if (b->depth > f->sample->deepest)
        f->sample->deepest = b->depth;
    reference_intersect(f->r, &ray, &hit);
    if (see_light(f, b, hit.primitive == NO_PRIMITIVE ? INFINITY : hit.t, segment))
        return;
    if (hit.primitive == NO_PRIMITIVE) {
        vec3 seen = seen_beyond(f->r, b->direction);
        add(f, seen, b);
        if (segment)
            segment->radiance = seen;
        return;
    }
    struct surface s;
    reference_surface(f->r, &ray, &hit, &s);
    reference_cross(f->r, &b->inside, &s);
    b->tint = vec3_times(b->tint, reference_left(f->r, &b->inside, s.distance));
    f->sample->body = s.body;
    f->sample->triangle = s.triangle;
    if (segment)
        segment->tint = b->tint;
    if (s.is_over) {
        f->sample->is_nested = true;
        f->sample->radiance = (vec3){NAN, NAN, NAN};
    } else if (s.passes) {
        const struct lighting none = {.considered = 0};
        log_surface(f, segment, &s, &none);
        pass(f, b, &s, f->log ? f->log->count - 1 : 0);
    } else {
        show_surface(f, b, &s, segment);
    }
}

static uint64_t rays_of(const struct sample *s) {
    return s->rays[0] + s->rays[1] + s->rays[2] + s->shadow + s->unseen;
}

void reference_follow(const struct reference *r, const struct reference_settings *settings,
                      const struct points *points, struct queue *queue, struct log *log, struct sample *out) {
    struct following f = {r, settings, queue, log, out, *points};
    const struct camera_ray ray = reference_lens_ray(r, settings, points);
    struct branch first = {.start = reference_start(ray.start),
                           .direction = ray.direction,
                           .cone = reference_camera_cone(r, settings, ray.direction),
                           .throughput = 1,
                           .tint = {1, 1, 1},
                           .inside = r->around_camera,
                           .key = point_root(points->x, points->y),
                           .parent = REFERENCE_NO_SEGMENT};
    *out = (struct sample){.body = HIT_NONE};
    queue->count = 0;
    queue->heaviest_first = !settings->as_file;
    push(queue, &first);
    while (queue->count && !queue->failed && !out->cancelled) {
        struct branch next = pop(queue);
        out->cancelled =
            queue->goes_on && ++queue->rays % RAYS_A_QUESTION == 0 && !queue->goes_on(queue->context);
        if (rays_of(out) < settings->segments) {
            follow_ray(&f, &next);
            continue;
        }
        out->cut_by_segments++;
        out->left_weight += next.throughput * reference_brightest(next.tint);
    }
    out->over_segments = settings->as_file && (out->cut_by_segments > 0 || rays_of(out) > settings->segments);
    see(&f, out->radiance);
}
