/* SPDX-License-Identifier: MIT
 * Controls: every value of the scene and every setting of the viewer that can be changed, by name. Panels and scripts read and change values through them. */
#ifndef MANGATA_VIEWER_UI_CONTROLS_H
#define MANGATA_VIEWER_UI_CONTROLS_H

#include "viewer/scene/document.h"
#include "viewer/scene/settings.h"
#include "viewer/scene/wave_shape.h"

/* The document and the settings that controls belong to. It owns neither. */
typedef struct control_board {
    document *document;
    settings *settings;
} control_board;

/* How a panel shows a control. The allowed range may be wider than the useful one that a slider has. */
typedef struct control_hint {
    const char *name; /* name of the control without list indices: "water.waves[].amplitude" */
    const char *label;
    double low, high; /* the slider's range; both 0: the control has none */
    bool logarithmic;
    const char *format; /* printf() format of the value; NULL: as many digits as it needs */
    const char *zero;   /* text that is shown in place of 0; NULL: 0 itself */
} control_hint;

/* A control. Its pointers are valid until the document's lists or the board change. */
typedef struct control {
    char name[64];
    const field_row *field;
    void *value;              /* the value in the document or in the settings; NULL: it is one of a wave's shape */
    mgt_wave *wave;           /* the wave whose shape the value belongs to; NULL: it does not belong to one */
    const control_hint *hint; /* NULL: none */
    bool of_scene;            /* false: a setting */
} control;

/* Finds a control. False: there is none of that name. */
bool control_find(const control_board *board, const char *name, control *out);

/* All controls, with those of every wave and keyframe. The caller frees the array with free(). NULL: out of memory. */
control *control_list(const control_board *board, size_t *count);

/* The value of a control as text, in the form that control_set() and `--set` read. */
typedef struct control_text {
    char text[224];
} control_text;
control_text control_print(const control *c);

/* Sets a value by text. The name of a list, an item or a mapping of the scene is set as `--set` does. False: nothing has changed, and `error` says in one line
 * what is wrong and what is allowed. */
bool control_set(const control_board *board, const char *name, const char *text, char *error, size_t error_size);

/* The numbers of a control, of which control_width() is the count, 1 or 3. The number of a choice or a switch is its place in the list of words, from 0.
 * control_write() clamps to the allowed range. */
int control_width(const control *c);
void control_read(const control *c, double numbers[3]);
void control_write(const control_board *board, const control *c, const double numbers[3]);

/* Sets a control by one number, which all of its numbers get. False: there is none of that name. */
bool control_set_number(const control_board *board, const char *name, double number);

/* A random value within the useful range. A choice gets another one than it has. `state` is that of the generator and changes. */
control_text control_random(const control *c, uint64_t *state);

/* The next random number in [0, 1) of that generator. */
double random_fraction(uint64_t *state);

#endif
