// What the viewer does when something happens.
#include "core/clock.h"
#include "core/strbuf.h"
#include "grammar/ir.h"
#include "grammar/ir_copies.h"
#include "grammar/ir_walk.h"
#include "grammar/print/ir_print.h"
#include "grammar/schema.h"
#include "load/where.h"
#include "window/viewer_private.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// ---- the eye

static struct steer_pose pose_of(const struct view_camera *camera) {
    return (struct steer_pose){camera->position, camera->right, camera->up, camera->forward};
}

static void viewer_aim(struct viewer *v) {
    v->eye.position = v->steer.pose.position;
    v->eye.right = v->steer.pose.right;
    v->eye.up = v->steer.pose.up;
    v->eye.forward = v->steer.pose.forward;
    v->is_stale = true;
    v->has_hits = false;
    v->moved = clock_seconds();
}

static vec3 up_of(const struct viewer *v) {
    const struct ir_cameras *cameras = &v->live->session->scene->cameras;
    return v->camera < cameras->count ? cameras->items[v->camera].up : (vec3){0, 1, 0};
}

void viewer_go_back(struct viewer *v) {
    v->eye = v->scene.camera;
    steer_place(&v->steer, pose_of(&v->eye), up_of(v));
    steer_resize(&v->steer, v->height, 2 * atan(v->eye.tan_half_fov));
    viewer_aim(v);
}

static void take_camera(struct viewer *v, uint32_t number) {
    struct session *session = v->live->session;
    struct view view;
    if (number >= session->scene->cameras.count || !session_view(session, number, &view))
        return;
    v->camera = number;
    v->scene.camera = view.camera;
    viewer_go_back(v);
}

// ---- what is at a pixel

static void put_place(struct session *session, span at, struct strbuf *out) {
    if (span_is_none(at))
        return;
    const struct source_place place = source_locate(&session->sources, at);
    strbuf_format(out, "%.*s:%u:%u: ", STR_ARG(place.path), place.line, place.column);
}

static void say_hit(struct viewer *v, const struct render_segment *hit) {
    struct session *session = v->live->session;
    struct where where;
    struct strbuf text;
    strbuf_init(&text);
    const bool found = hit->body != HIT_NONE && where_find(session, hit->body, hit->triangle, &where);
    if (found)
        put_place(session, where.at, &text);
    const size_t begin = text.len;
    if (hit->light != IR_NO_INDEX) {
        ir_copies_label(session->origin.copies, ir_walk_pool(&SCHEMA_LIGHT), hit->light, &text);
        strbuf_format(&text, ", at %.6g", hit->distance);
    } else {
        where_body_words(found ? &where : NULL, &text);
    }
    if (found) {
        strbuf_cstr(&text, ", ");
        where_material_words(&where, &text);
        if (where.mesh_line)
            strbuf_format(&text, ", %.*s:%u", STR_ARG(where.mesh), where.mesh_line);
        strbuf_format(&text, ", at %.6g", hit->distance);
    }
    v->host->say(v->host->context, strbuf_view(&text));
    snprintf(v->said, sizeof v->said, "%.*s", STR_ARG(str_slice(strbuf_view(&text), begin, text.len)));
    if (found && !span_is_none(where.material_at)) {
        strbuf_clear(&text);
        put_place(session, where.material_at, &text);
        where_material_words(&where, &text);
        v->host->say(v->host->context, strbuf_view(&text));
    }
    strbuf_finish(&text);
}

static void pick(struct viewer *v, double x, double y) {
    struct render_segment segment;
    struct render_log log = {.segments = &segment, .capacity = 1};
    if (x < 0 || y < 0 || x >= v->width || y >= v->height || !viewer_set_up(v, v->width, v->height, 1) ||
        renderer_log(v->live->shot.renderer, &v->eye, (uint32_t)x, (uint32_t)y, 0, &log) != RENDER_DONE ||
        log.count == 0)
        return;
    if (segment.body != HIT_NONE) {
        v->steer.pivot = segment.point;
        v->steer.has_pivot = true;
    }
    say_hit(v, &segment);
}

// ---- the camera as text

static void mark_written(struct ir_head *head, const struct schema_element *schema, const char *row) {
    head->written |= (uint64_t)1 << schema_find_row(schema, str_from(row));
}

static void unmark_written(struct ir_head *head, const struct schema_element *schema, const char *row) {
    head->written &= ~((uint64_t)1 << schema_find_row(schema, str_from(row)));
}

// The scene's camera from the eye's place, as the scene's file would have it.
static void print_camera(struct viewer *v) {
    const struct ir_scene *ir = v->live->session->scene;
    struct ir_camera camera = {.name = STR("main"), .fov = 2 * atan(v->eye.tan_half_fov) * 180 / acos(-1)};
    struct ir_scene scene = {0};
    struct strbuf text;
    if (v->camera < ir->cameras.count)
        camera = ir->cameras.items[v->camera];
    else
        mark_written(&camera.head, &SCHEMA_CAMERA, "fov");
    camera.position = v->eye.position;
    camera.direction = v->eye.forward;
    camera.view = IR_VIEW_DIRECTION;
    mark_written(&camera.head, &SCHEMA_CAMERA, "position");
    unmark_written(&camera.head, &SCHEMA_CAMERA, "look_at");
    unmark_written(&camera.head, &SCHEMA_CAMERA, "rotation");
    mark_written(&camera.head, &SCHEMA_CAMERA, "direction");
    scene.cameras.items = &camera;
    scene.cameras.count = 1;
    mark_written(&scene.head, &SCHEMA_SCENE, "camera");
    strbuf_init(&text);
    (v->wish->is_xml ? ir_write_xml : ir_write_yaml)(&scene, NULL, NULL,
                                                     (struct ir_write_options){.bare = true}, &text);
    v->host->say(v->host->context, str_trim(strbuf_view(&text)));
    strbuf_finish(&text);
}

// ---- actions

static void say(struct viewer *v, const char *words) {
    snprintf(v->said, sizeof v->said, "%s", words);
}

static void act(struct viewer *v, struct steer_action action) {
    switch (action.what) {
    case STEER_NOTHING:
        break;
    case STEER_QUIT:
        v->quits = true;
        break;
    case STEER_CAMERA:
        take_camera(v, action.number);
        break;
    case STEER_BACK:
        viewer_go_back(v);
        break;
    case STEER_WRITE:
        v->wants_write = true;
        say(v, "the picture is written when it has all its samples");
        break;
    case STEER_PRINT:
        print_camera(v);
        say(v, "the camera is in the terminal");
        break;
    case STEER_NEXT:
        v->mode = (enum viewer_mode)((v->mode + 1) % VIEWER_MODES);
        break;
    case STEER_OVERLAY:
        v->hides_overlay = !v->hides_overlay;
        break;
    case STEER_KEYS:
        v->shows_keys = !v->shows_keys;
        break;
    case STEER_PICK:
        pick(v, action.x, action.y);
        break;
    }
}

bool viewer_write(struct viewer *v) {
    const uint32_t own = (uint32_t)v->live->session->image->samples;
    if (!v->wants_write || v->is_stale || v->is_coarse || v->shown.samples < own)
        return true;
    v->wants_write = false;
    const bool done =
        v->host->write(v->host->context, &v->shown.image, v->live->shot.display, v->shown.samples);
    say(v, done ? "the picture is written" : "the picture cannot be written: the terminal says why");
    return viewer_show(v);
}

bool viewer_act(struct viewer *v) {
    const double now = clock_seconds();
    viewer_take_events(v);
    const uint32_t count = v->action_count;
    for (uint32_t i = 0; i < count; i++)
        act(v, v->actions[i]);
    v->action_count = 0;
    if (steer_step(&v->steer, now - v->stepped))
        viewer_aim(v);
    v->stepped = now;
    // The wheel only changes a number in the text.
    return count > 0 || v->steer.speed != v->shown_speed;
}
