/* SPDX-License-Identifier: MIT
 * A host's OpenGL state: set to what no drawing code expects, and compared before and after a call.
 */
#ifndef MANGATA_TESTS_GL_STATE_H
#define MANGATA_TESTS_GL_STATE_H

#include <stdbool.h>
#include <stddef.h>

enum { STATE_VALUES = 1024 };

typedef struct gl_state {
    size_t count;
    struct {
        const char *name;
        int index; /* of a binding point or of a component */
        double value;
    } values[STATE_VALUES];
} gl_state;

/* Every value that drawing and computing depend on. */
void gl_state_read(gl_state *state);

/* Prints what differs and returns how many values do. */
size_t gl_state_compare(const gl_state *before, const gl_state *after);

/* Discards rasterization, masks writes, binds objects of its own to every kind of point, … and a query counts samples meanwhile. */
void gl_state_make_hostile(void);

/* Back to what a new context has, for what the former changes. */
void gl_state_make_friendly(void);

#endif
