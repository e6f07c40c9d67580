/* SPDX-License-Identifier: MIT
 * The viewer's settings besides the scene: one plain struct, described by a table of the same kind as the scene format's. */
#ifndef MANGATA_VIEWER_SCENE_SETTINGS_H
#define MANGATA_VIEWER_SCENE_SETTINGS_H

#include "viewer/picture/display.h"
#include "scene/scene_fields.h"

typedef enum resolution_mode { RESOLUTION_AUTO = 0, RESOLUTION_FULL, RESOLUTION_HALF, RESOLUTION_THIRD, RESOLUTION_QUARTER } resolution_mode;
typedef enum frame_mode { FRAME_FILLS = 0, FRAME_AS_SCENE } frame_mode;

typedef struct view_settings {
    int compare; /* compare_mode */
    double wipe; /* fraction of the width that shows A */
    double difference_scale;
    int layer;                    /* mgt_layer */
    double near_depth, far_depth; /* depths at the ends of the palette, metres */
    double coverage_end;          /* coverage at the palette's upper end */
    double lean_end;              /* horizontal part of a normal whose colour is full */
    int resolution;               /* resolution_mode */
    int frame;                    /* frame_mode */
    double zoom, center_x, center_y;
} view_settings;

typedef struct clock_settings {
    double time;  /* seconds of the scene's clock, when the shutter closes */
    int play;     /* off, on */
    double speed; /* seconds of the scene per second; negative: time runs backwards */
    int loop;     /* play the scene's frames in a loop: off, on */
} clock_settings;

typedef struct wave_settings {
    uint32_t count; /* number of the scene's first waves that are used */
} wave_settings;

typedef enum move_mode { MOVE_ORBIT = 0, MOVE_FLY } move_mode;

typedef struct move_settings {
    int mode;         /* move_mode */
    int path;         /* the camera follows camera.path: off, on */
    double speed;     /* metres a second */
    double clearance; /* least height of the camera above the water at its place, metres */
} move_settings;

typedef struct panel_settings {
    int shown, timings, judge, inspector, keys, legend, log; /* off, on */
    double scale;                                            /* of text and controls */
} panel_settings;

typedef struct inspect_settings {
    uint32_t x, y; /* pixel of the picture */
} inspect_settings;

typedef struct settings {
    mgt_quality sides[SIDE_COUNT]; /* these keep options that their method does not have, for a later choice of another method */
    view_settings view;
    clock_settings clock;
    wave_settings waves;
    move_settings move;
    panel_settings panel;
    inspect_settings inspect;
} settings;

settings settings_defaults(void);

/* The fields of settings as one mapping. */
const field_row *settings_root_field(void);

/* Whether a field is a choice of "off" and "on". */
bool field_is_switch(const field_row *field);

extern const char *const layer_choices[]; /* in the order of mgt_layer */

#endif
