// One `glint render`: a job (render/job) and, around it, the command line's files and the messages. Private
// to cli.
#ifndef GLINT_CLI_COMMANDS_RENDERING_H
#define GLINT_CLI_COMMANDS_RENDERING_H

#include "cli/cli.h"
#include "cli/progress.h"
#include "grammar/ir.h"
#include "render/job/job.h"

struct cli_opening;

struct rendering {
    struct cli *cli;
    struct job job;
    // The session's own sink. While the background's pixels are still being decoded, findings go to another
    // one.
    struct diag_sink loaded;
    bool is_apart;
    int settled;                 // the exit code of the load and the output
    struct cli_opening *opening; // of the device, while files are read
    struct progress progress;
    struct cli_output *outputs; // at least one; their paths are without the camera's name
    uint32_t output_count;
    bool all_cameras;
    double written;     // clock: when the last picture was
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
// How the options want a format coded; options for other formats are left out.
struct image_coding render_coding(const struct cli_options *options, enum image_format format);
// The picture as a file of a format, appended to `out`.
void render_encode(struct rendering *r, enum image_format format, struct strbuf *out);
// Whether one of them is standard output.
bool render_uses_stdout(const struct rendering *r);
// These return an exit code.
// Scales a smaller picture that was chosen to the size asked for.
int render_scale_up(struct rendering *r);
// Writes every output of a camera's picture, and lists the files on standard error.
int render_write_pictures(struct rendering *r, uint32_t camera);
void render_tell_written(struct rendering *r, uint32_t camera);
// Ends the progress and reports why there is no picture.
int render_failed(struct rendering *r, enum shot_status status);
// The same for any job, with or without the scene's notes.
int render_not_drawn(struct cli *cli, const struct job *job, enum shot_status status, bool notes);

// Reports, after a camera's picture was written: what its audit found, what --time left out, how long frames
// took. An exit code: it is a failure if the audit breaks --max-off, or if there are fewer samples than
// --max-error asks for.
int render_tell_end(const struct rendering *r);
// Only the audit, for any job.
int render_tell_audit(const struct cli *cli, const struct job *job);
// Says that the scene's image.error ended no pixel, and why, unless a finding says so.
void render_tell_unused_error(const struct rendering *r);

// ---- render_aov.c: --aov. All do nothing without it, and return exit codes.

// The first output that is OpenEXR; NULL: none is.
const struct cli_output *render_exr_output(const struct rendering *r);
// Once the scene is known: whether the outputs can be made at all.
int render_judge_aovs(struct rendering *r);
// Whether the files beside the picture may be written.
int render_judge_aov_names(struct rendering *r, uint32_t camera);
int render_no_memory_for_aovs(struct rendering *r);
// After the pictures: files beside the OpenEXR picture, or the first output that is a file.
int render_write_aovs(struct rendering *r, uint32_t camera);

// ---- parts of a picture (cli/parts)

// Whether the command line asks for less than a picture, or for a file of parts.
bool render_wants_part(const struct rendering *r);
// Before and after the scene was read: which part of the picture is rendered. CLI_OK, or CLI_USAGE with the
// mistake in the command line's sink.
int render_judge_part(struct rendering *r);
int render_plan_part(struct rendering *r);
// The part as a file.
void render_encode_part(struct rendering *r, struct strbuf *out);

// ---- a picture, or a part of one, in bands (cli/bands)

// Before the scene was read: whether what is asked for can be made in bands, if they are asked for. CLI_OK,
// or CLI_USAGE with the mistake in the command line's sink.
int render_judge_bands(struct rendering *r);
// After render_plan_part: sets job->in_bands if bands are asked for, or if the picture does not fit in
// memory. As above.
int render_plan_bands(struct rendering *r);
// Whether what --partial writes may be written. An exit code.
int render_judge_partial(struct rendering *r, uint32_t camera);
// Renders all bands of a camera's picture, and writes its files. An exit code: CLI_STOPPED if a signal came.
int render_in_bands(struct rendering *r, uint32_t camera);
// cli/commands/pictures/done.c, --skip-done: whether the outputs can say that they are done; as
// render_judge_part.
int render_judge_done(const struct rendering *r);
// Whether the file at `path` equals what an output would be through the job's camera.
bool render_output_is_done(const struct rendering *r, const struct cli_output *output, const char *path);
// Finds the cameras whose outputs are all there, says so, and moves `first`
// past those at the beginning. The session is settled, and the device open.
void render_find_done(struct rendering *r, uint32_t *first, uint32_t end);

#endif
