/* SPDX-License-Identifier: MIT
 * What a script is doing, shared by its engine and its commands. */
#ifndef MANGATA_VIEWER_SCRIPT_SCRIPT_STATE_H
#define MANGATA_VIEWER_SCRIPT_SCRIPT_STATE_H

#include "viewer/app/viewer.h"

enum { LINE_SIZE = 8192, WORDS = 8 };

/* What is done with the window's pixels once a frame is drawn. */
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
    int line;
    char text[LINE_SIZE];
    char *words[WORDS + 1]; /* into text; the last one of a command may be the rest of the line */
    int count;

    int frames_left;   /* to let by before the next command */
    bool settling;     /* the next command waits until the picture is done */
    uint64_t samples;  /* that the picture needs to be done; 0: all */
    double give_up_at; /* seconds_now() when waiting ends */
    capture capture;
    char file[LINE_SIZE];
    window_pixels mark, before, after;

    char vary_name[64];                 /* the control under test */
    char *values_before, *values_after; /* of all controls; owned */
    int vary_tries;
    size_t vary_step; /* of the history, before the change */
    uint64_t chance;

    int random_left;
    char spared[64]; /* what the names of controls that stay begin with; empty: none */
    bool dragging;
    float drag_from[2], drag_to[2];
    int drag_button, drag_frames, drag_at;
    int held_key, held_modifiers, held_left;
    uint32_t judging; /* wait for figures against so many samples; 0: not */
    bool saving;      /* wait until the picture is on the disk */
    bool waiting_reload;
    struct stat reload_stamp;
    double point[3];   /* of the water, marked */
    mgt_camera camera; /* marked */
};

typedef struct script_command {
    const char *name;
    int least, most; /* words with the name; the last of `most` is the rest of the line */
    void (*run)(viewer *v);
} script_command;

extern const script_command script_commands[];
extern const size_t script_command_count;

/* Ends the viewer with one line, "FILE:LINE: …", and exit code 1. */
void script_fail(viewer *v, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Lets so many frames go by before the next command. */
void script_wait(script *s, int frames);

/* The same until the picture is done, with so many samples (0: all). */
void script_settle(script *s, uint64_t samples);

/* The same; then does something with the window's pixels. */
void script_capture(script *s, capture what);

/* The same for a control under test; few samples are all awaited. */
void script_capture_vary(viewer *v, capture what);

/* The error that stands over the picture; empty: none. */
const char *script_any_error(const viewer *v);

#endif
