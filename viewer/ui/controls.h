/* SPDX-License-Identifier: MIT
 * The one table of everything that can be changed: every value of the scene and every setting of the viewer, by name. The panels, scripts and
 * the random test all go through it. */
#ifndef MANGATA_VIEWER_UI_CONTROLS_H
#define MANGATA_VIEWER_UI_CONTROLS_H

#include "viewer/scene/document.h"
#include "viewer/scene/settings.h"
#include "viewer/scene/wave_shape.h"

/* What controls belong to. */
typedef struct control_board {
    document *document;
    settings *settings;
} control_board;

/* How a control is best offered: a range that is useful where the allowed one is wide. */
typedef struct control_hint {
    const char *name; /* list indices left out: "water.waves[].amplitude" */
    const char *label;
    double low, high;
    bool logarithmic;
    const char *format; /* NULL: as long as it needs to be */
    const char *zero;   /* what stands in place of 0; NULL: 0 */
} control_hint;

typedef struct control {
    char name[64];
    const field_row *field;
    void *value;              /* in the document or the settings; of a wave's shape: NULL */
    mgt_wave *wave;           /* of a wave's shape */
    const control_hint *hint; /* NULL: none */
    bool of_scene;
} control;

/* False where no control has this name. */
bool control_find(const control_board *board, const char *name, control *out);

/* All controls, those of every wave and keyframe included, in an array for the caller to free(); NULL when memory runs out. */
control *control_list(const control_board *board, size_t *count);

/* The value as text, as control_set() and `--set` read it. */
typedef struct control_text {
    char text[224];
} control_text;
control_text control_print(const control *c);

/* Sets by text; what is no control itself (a list, an item, a whole mapping of the scene) by the rules of `--set`. False with one line in
 * `error` that says what is wrong and what is allowed. */
bool control_set(const control_board *board, const char *name, const char *text, char *error, size_t error_size);

/* Numbers of a control: 1 or 3; choices and switches count from 0. control_write() keeps to what is allowed. */
int control_width(const control *c);
void control_read(const control *c, double numbers[3]);
void control_write(const control_board *board, const control *c, const double numbers[3]);

/* Sets by one number. False where no control has this name. */
bool control_set_number(const control_board *board, const char *name, double number);

/* Some other value within the useful range, from a generator's state. */
control_text control_random(const control *c, uint64_t *state);

/* The next random number in [0, 1) of that generator. */
double random_fraction(uint64_t *state);

#endif
