/* SPDX-License-Identifier: MIT
 * The context, and functions that calls on it share. */
#ifndef MANGATA_API_CONTEXT_H
#define MANGATA_API_CONTEXT_H

#include <stdatomic.h>

#include "frame/backend.h"

struct mgt_context {
    const backend_functions *backend;
    void *state;
    reporter report;
    mgt_context_info info;
    mgt_context_desc desc;
    void *cpu;            /* state of cpu_backend for what only the CPU does; NULL until it is needed */
    uint32_t told_of_cpu; /* bit 1 << method: announce_cpu() has logged the method */
    char error[REPORTER_TEXT];
    atomic_bool busy; /* a call that uses the state is running */
};

/* Begins a call that uses the context's state, and clears its last error. False: `context` is NULL, or such a call is already running, on another thread or
 * around a callback. The caller then returns MGT_ERROR_ARGUMENT and does nothing else. */
bool context_enter(mgt_context *context);

/* Ends the call. Returns `status`. */
mgt_status context_leave(mgt_context *context, mgt_status status);

/* Moves a valid scene so that its mean surface is y = 0. Returns MGT_OK, or MGT_ERROR_UNSUPPORTED if its method cannot draw it. */
mgt_status scene_ready(const reporter *r, mgt_scene *own);

/* Logs once per method that the CPU renders instead of OpenGL. The message is a warning unless the backend is MGT_BACKEND_AUTO. `lacks`: a subject and a verb,
 * such as "the method runs". */
void announce_cpu(mgt_context *context, mgt_method method, const char *lacks);

/* Sets *state to the state of the CPU backend: the context's own, or a second one if the context has another backend. */
mgt_status cpu_state(mgt_context *context, void **state);

#endif
