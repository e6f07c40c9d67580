/* SPDX-License-Identifier: MIT */
/* How far a render is: a bar on a terminal, JSON lines for programs, or nothing; always on stderr. */
#ifndef MANGATA_CLI_COMMON_PROGRESS_H
#define MANGATA_CLI_COMMON_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef enum progress_mode { PROGRESS_NONE = 0, PROGRESS_BAR, PROGRESS_JSON, PROGRESS_TEXT, PROGRESS_OPENJD } progress_mode;

typedef struct progress {
    progress_mode mode;
    bool shown;  /* a bar stands on the line */
    int percent; /* text and openjd: the last one printed */
    uint64_t frames, frames_done;
    uint32_t frame;
    double started, last_shown;
    double work, work_done, work_now; /* of frames that take unlike times: of all, of those done, of this one; work 0: all alike */
} progress;

/* "auto" (a bar on a terminal), "json", "text" ("Progress: 34%"), "openjd" (lines of Open Job Description) or "none". */
#define PROGRESS_MODES "auto, json, text, openjd or none"
bool progress_mode_from_name(const char *name, progress_mode *mode);

/* "auto", the default of every verb. */
progress_mode progress_mode_auto(void);

/* A bar is not for a quiet verb; lines for programs are. */
progress_mode progress_mode_heard(progress_mode mode, bool quiet);

progress progress_start(progress_mode mode, uint64_t frames);
void progress_frame(progress *p, uint32_t frame);   /* a frame begins */
void progress_update(progress *p, double fraction); /* of that frame */
void progress_frame_done(progress *p, const char *path, double seconds);
void progress_clear(progress *p); /* takes the bar off the terminal, before other text or the end */

/* Monotonic seconds. */
double seconds_now(void);

#endif
