// Whether the picture or part that a job would make is there already, as a file.
//
// A file counts if it is whole and says of itself what the new one would say (render/record): the same scene
// by its hash, version of glint, device, settings and size; for a part also the same pixels. Anything else,
// including a file that cannot be read, is made again. Ownership: text lies in the job's arena. Thread
// safety: as the job.
#ifndef GLINT_RENDER_JOB_JOB_DONE_H
#define GLINT_RENDER_JOB_JOB_DONE_H

#include "render/job/job.h"

// Through job->camera. The job need not be open, but its device must be, and the background's pixels loaded.
bool job_picture_is_done(const struct job *job, const char *path, enum image_format format,
                         struct image_coding coding);
// The same for the job's part, whose size, region, samples and display are known.
bool job_part_is_done(const struct job *job, const char *path);
// Whether a whole picture with these texts is there.
bool job_texts_are_done(const char *path, const struct image_texts *texts, struct arena *arena);

#endif
