/* SPDX-License-Identifier: MIT */
/* Progress of a render on stderr: a bar on a terminal, lines for programs, or nothing. */
#ifndef MANGATA_CLI_COMMON_PROGRESS_H
#define MANGATA_CLI_COMMON_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef enum progress_mode { PROGRESS_NONE = 0, PROGRESS_BAR, PROGRESS_JSON, PROGRESS_TEXT, PROGRESS_OPENJD } progress_mode;

typedef struct progress {
    progress_mode mode;
    bool shown;                       /* the bar is on the terminal */
    int percent;                      /* the last percentage that was printed, by the modes text and openjd */
    uint64_t frames, frames_done;     /* number of frames in all, and of those done */
    uint32_t frame;                   /* the current frame */
    double started, last_shown;       /* seconds_now() */
    double work, work_done, work_now; /* work of all frames, of those done, and of the current one, in any unit; work 0: all frames count equally */
} progress;

/* Finds a mode by name: "auto" (see progress_mode_auto()), "json", "text" (lines "Progress: 34%"), "openjd" (lines of Open Job Description) or "none". False:
 * there is none of that name. */
#define PROGRESS_MODES "auto, json, text, openjd or none"
bool progress_mode_from_name(const char *name, progress_mode *mode);

/* The mode "auto", the default of every verb: a bar if stderr is a terminal, otherwise nothing. */
progress_mode progress_mode_auto(void);

/* The mode with or without --quiet, which turns off a bar, but not lines for programs. */
progress_mode progress_mode_heard(progress_mode mode, bool quiet);

/* Starts the progress of `frames` frames. */
progress progress_start(progress_mode mode, uint64_t frames);
void progress_frame(progress *p, uint32_t frame);                        /* a frame begins */
void progress_update(progress *p, double fraction);                      /* sets the fraction of that frame that is done; shows it ten times a second at most */
void progress_frame_done(progress *p, const char *path, double seconds); /* a frame has been written to `path`, after so many seconds */
void progress_clear(progress *p);                                        /* removes the bar from the terminal, before other text and at the end */

/* Seconds of the monotonic clock. */
double seconds_now(void);

#endif
