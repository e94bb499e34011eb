// One `glint render`: what its two tracers, the device's and the reference, share. Private to cli.
#ifndef GLINT_CLI_COMMANDS_RENDERING_H
#define GLINT_CLI_COMMANDS_RENDERING_H

#include "cli/cli.h"
#include "cli/progress.h"
#include "grammar/ir.h"
#include "render/audit.h"
#include "render/deadline.h"
#include "render/parts/part_file.h"
#include "render/shot.h"
#include "render/stats/stats.h"

struct cli_opening;
struct layers;
struct reference_shot;

struct rendering {
    struct cli *cli;
    struct session session;
    // While the background's pixels are still being decoded, what is found goes into another sink: this is
    // the session's own.
    struct diag_sink loaded;
    bool is_apart;
    int settled;                 // the exit code of what the load and the output say
    struct cli_opening *opening; // of the device, beside the reading of files
    struct timeline *timeline;   // NULL: not asked for
    struct gpu *gpu;
    struct shot shot;
    struct image image;
    struct stats stats;
    struct progress progress;
    struct cli_output *outputs; // at least one; their paths are without the camera's name
    uint32_t output_count;
    bool all_cameras;
    uint32_t camera;              // of the picture that is written
    struct image_display display; // of the last picture that was encoded
    struct strbuf *kept;          // for who wants the picture's file, and none written; NULL: the outputs are
    struct layers *layers;        // while a camera's picture has some; NULL: none
    struct strbuf note;           // what the picture states of itself; empty: nothing
    struct strbuf audit_note;     // what the audit says of it
    // --time: what ends the frame, and the session's image with the samples that were made.
    struct deadline deadline;
    double written; // clock: when the last picture was
    struct ir_image image_made;
    // Of what this job renders: all of the picture, unless the command line asks for less.
    struct part part;
    bool is_part, in_bands;
    bool *done;         // by camera: --skip-done found it; NULL: not asked
    const char *record; // of the picture that parts make (part_file.h); NULL: there are none
};

// Where a camera's picture goes: the path of one of the outputs.
const char *render_output_of(struct rendering *r, const struct cli_output *output, uint32_t camera);
// What the user typed for an output; "": nothing.
const char *render_typed(const struct cli_output *output);
// A path without its ending.
str render_stem_of(str path);
// Reads the outputs of the command line into the job; CLI_OK, or CLI_USAGE with the mistake reported.
int render_take_outputs(struct rendering *r);
// Whether the formats of the outputs hold pictures of this size: CLI_OK, or CLI_USAGE with the mistake in the
// command line's sink.
int render_judge_size(struct rendering *r);
// How the options have a format coded; what they ask of others is left out.
struct image_coding render_coding(const struct cli_options *options, enum image_format format);
// The picture as a file of a format, appended to `out`.
void render_encode(struct rendering *r, enum image_format format, struct strbuf *out);
// Whether one of them is standard output.
bool render_uses_stdout(const struct rendering *r);
// These return an exit code.
int render_interrupted(struct rendering *r);
// A smaller picture that was chosen, to the size asked for.
int render_scale_up(struct rendering *r);
// Every output of a camera's picture; and says on standard error which files there are.
int render_write_pictures(struct rendering *r, uint32_t camera);
void render_tell_written(struct rendering *r, uint32_t camera);
// What --stats reports: JSON to standard output, unless the picture goes there; text to standard error.
int render_tell_stats(const struct rendering *r, str text);
// Ends the progress and reports why there is no picture.
int render_failed(struct rendering *r, enum shot_status status);

// Whether the command line asks for the picture's own error.
// The picture's own error, where the command line asks for it; an exit code. It is in the
// statistics and in the picture's note.
int render_audit(struct rendering *r);
bool render_wants_audit(const struct cli_options *options);
// After the picture was written: says what was found, and whether it is within --max-off; an exit code.
int render_tell_audit(const struct rendering *r);

// What is known of where pixels ended; NULL: they do not end by their error.
const struct render_estimate *render_estimate_of(const struct rendering *r);
// Where pixels end by their error: appends to the picture's note what it states of itself. An exit code.
int render_note_estimate(struct rendering *r);

// ---- render_aov.c: --aov. All do nothing without it, and return exit codes.

// Once the scene is known: whether it can be made at all.
int render_judge_aovs(struct rendering *r);
// After the frame: makes all of it by the tracer that made the picture, the reference if `shot` is not NULL,
// as layers of the job's image where an output is OpenEXR.
int render_make_aovs(struct rendering *r, struct reference_shot *shot);
// Whether the files beside the picture may be written.
int render_judge_aov_names(struct rendering *r, uint32_t camera);
// After the pictures: files beside the OpenEXR picture, or the first output that is a file.
int render_write_aovs(struct rendering *r, uint32_t camera);
void render_drop_aovs(struct rendering *r);

// Says that the scene's image.error ended no pixel, and why; nothing where a finding says so.
void render_tell_unused_error(const struct rendering *r);

// ---- parts of a picture (cli/parts)

// Whether the command line asks for less than a picture, or for a file of parts.
bool render_wants_part(const struct rendering *r);
// Before and after the scene was read: what part of which picture is rendered. CLI_OK, or CLI_USAGE with the
// mistake in the command line's sink.
int render_judge_part(struct rendering *r);
int render_plan_part(struct rendering *r);
// After the shot was opened or turned: has it render the part. false: see gpu_error.
bool render_aim_at_part(struct rendering *r);
// As render_take_frame, of the part.
enum shot_status render_take_part(struct rendering *r, const struct render_progress *progress);
// What the part says of how it was made, besides its place.
void render_fill_part(struct rendering *r);
// The part as a file.
void render_encode_part(struct rendering *r, struct strbuf *out);

// ---- a picture, or a part of one, in bands (cli/bands)

// Before the scene was read: whether what is asked for can be made in bands, if they are asked for. CLI_OK,
// or CLI_USAGE with the mistake in the command line's sink.
int render_judge_bands(struct rendering *r);
// After render_plan_part: sets job->in_bands, for what is asked for, and for what does not fit memory. As
// above.
int render_plan_bands(struct rendering *r);
// The part of the picture that a shot begins with; width 0: all of it.
struct shot_region render_first_region(struct rendering *r);
// Whether what --partial writes may be written. An exit code.
int render_judge_partial(struct rendering *r, uint32_t camera);
// All bands of a camera's picture, and its files. An exit code: CLI_STOPPED if a signal came.
int render_in_bands(struct rendering *r, uint32_t camera);
// cli/commands/pictures/done.c, --skip-done: whether the outputs can say that they are done; as
// render_judge_part.
int render_judge_done(const struct rendering *r);
// Finds the cameras whose outputs are all there, says so, and moves `first`
// past those at the beginning. The session is settled, and the device open.
void render_find_done(struct rendering *r, uint32_t *first, uint32_t end);

// One frame, that ends in time if the command line says when. `cameras` is how many pictures
// are still to be made, this one included.
enum shot_status render_take_frame(struct rendering *r, uint32_t cameras,
                                   const struct render_progress *progress);
// After the picture was written: says what --time left out; nothing without it. An exit code: fewer samples
// than
// --max-error asks for are a failure.
int render_tell_time(const struct rendering *r);

// cmd_render.c: a job with its outputs, from reading the scene to the pictures; frees what it took, the
// session included. Returns an exit code.
int render_whole(struct rendering *r);

// render_reference.c: session and output are ready; `first` to before `end` are the cameras. Returns an exit
// code.
int render_by_reference(struct rendering *r, uint32_t first, uint32_t end);

#endif
