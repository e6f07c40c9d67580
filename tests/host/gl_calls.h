/* SPDX-License-Identifier: MIT
 * A getProcAddress that counts the calls which a steady loop must not make, and the library's allocations.
 */
#ifndef MANGATA_TESTS_GL_CALLS_H
#define MANGATA_TESTS_GL_CALLS_H

#include "mangata/mangata.h"

enum { CALL_KINDS = 48 };

typedef struct gl_calls {
    int kinds;
    const char *names[CALL_KINDS];
    long counts[CALL_KINDS];
} gl_calls;

/* In the place of eglGetProcAddress. */
mgt_gl_function gl_calls_get_proc(const char *name);

/* All counts so far. glClientWaitSync counts only where it has to wait. */
gl_calls gl_calls_read(void);

/* malloc, calloc and realloc of what is linked statically; by --wrap. */
long allocations_read(void);

#endif
