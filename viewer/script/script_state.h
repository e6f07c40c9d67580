/* SPDX-License-Identifier: MIT
 * The state of a script, shared by its engine and its commands. */
#ifndef MANGATA_VIEWER_SCRIPT_SCRIPT_STATE_H
#define MANGATA_VIEWER_SCRIPT_SCRIPT_STATE_H

#include "viewer/app/viewer.h"

enum { LINE_SIZE = 8192, WORDS = 8 };

/* What a command does with the window's pixels after the frame is drawn. CAPTURE_VARY_… are the steps of the command vary. */
typedef enum capture {
    CAPTURE_NONE,
    CAPTURE_FILE,
    CAPTURE_MARK,
    CAPTURE_CHANGE,
    CAPTURE_SAME,
    CAPTURE_VARY_BEFORE,
    CAPTURE_VARY_AFTER,
    CAPTURE_VARY_UNDONE,
    CAPTURE_VARY_REDONE
} capture;

typedef struct window_pixels {
    uint8_t *bytes; /* owned */
    uint32_t width, height;
} window_pixels;

struct script {
    FILE *stream;
    const char *path;
    int line;               /* number of the line in `text`, from 1 */
    char text[LINE_SIZE];   /* the current line */
    char *words[WORDS + 1]; /* words of the command, in `text`; the last one may be the rest of the line */
    int count;              /* number of words */

    int frames_left;   /* frames to wait before the next command */
    bool settling;     /* the next command waits until the picture is finished */
    uint64_t samples;  /* samples that a finished picture has; 0: all */
    double give_up_at; /* seconds_now() at which the script fails if it still waits */
    capture capture;
    char file[LINE_SIZE];              /* the file of CAPTURE_FILE */
    window_pixels mark, before, after; /* pixels at the mark, and before and after the change of `vary` */

    char vary_name[64];                 /* vary: the control under test */
    char *values_before, *values_after; /* vary: text of the values of all controls; owned */
    int vary_tries;                     /* vary: number of values that have been tried */
    size_t vary_step;                   /* vary: step of the history before the change */
    uint64_t chance;                    /* state of the generator of random values */

    int random_left; /* changes that the command random still makes */
    char spared[64]; /* controls whose names begin with this are not changed; empty: all are */
    bool dragging;
    float drag_from[2], drag_to[2];          /* window coordinates */
    int drag_button, drag_frames, drag_at;   /* button; frames of the drag; the current one */
    int held_key, held_modifiers, held_left; /* key and modifiers of the command hold; frames that it is still held */
    uint32_t judging;                        /* the next command waits for figures against so many samples; 0: it does not */
    bool saving;                             /* the next command waits until the picture or the film is saved */
    bool waiting_reload;                     /* the command wait-reload waits until the scene file has been read again */
    struct stat reload_stamp;                /* stamp of the file before the change */
    double point[3];                         /* the marked point of the water, metres */
    mgt_camera camera;                       /* the marked camera */
};

typedef struct script_command {
    const char *name;
    int least, most; /* number of words, the name included; word number `most` is the rest of the line */
    void (*run)(viewer *v);
} script_command;

extern const script_command script_commands[];
extern const size_t script_command_count;

/* Prints the line "FILE:LINE: …" to the standard error, and ends the viewer with exit code 1. */
void script_fail(viewer *v, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Makes the next command wait for `frames` frames. */
void script_wait(script *s, int frames);

/* Makes the next command wait until the picture is finished with `samples` samples (0: all). After two minutes the script fails. */
void script_settle(script *s, uint64_t samples);

/* Waits for one sample of the picture, then does something with the window's pixels. */
void script_capture(script *s, capture what);

/* The same for the command vary. If the picture has few samples, it waits for all of them. */
void script_capture_vary(viewer *v, capture what);

/* The error that is shown over the picture; empty: none. */
const char *script_any_error(const viewer *v);

#endif
