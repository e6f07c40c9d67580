/* SPDX-License-Identifier: MIT */
/* The options of every verb that renders: backend, threads, instruction set and device. */
#ifndef MANGATA_CLI_COMMON_CONTEXT_OPTIONS_H
#define MANGATA_CLI_COMMON_CONTEXT_OPTIONS_H

#include "cli/common/options.h"
#include "mangata/mangata.h"

typedef struct context_options {
    mgt_backend backend;
    mgt_isa isa;
    uint32_t threads, gl_device; /* as in mgt_context_desc */
    bool gl_device_given;
} context_options;

/* Reads "backend", "gl-device", "threads" or "isa". `place` is a context_options. */
option_set option_context;

/* Rows of an option table whose request has a member `context`. */
#define CONTEXT_OPTION_GL_DEVICE(request)                                                                                                                     \
    {                                                                                                                                                         \
        "gl-device", 0, "N", "OpenGL: which device of those that mangata info lists (default 0)", .set = option_context, .offset = offsetof(request, context) \
    }
#define CONTEXT_OPTION_THREADS(request)                                                                                                              \
    {                                                                                                                                                \
        "threads", 0, "N", "threads (default 0: one for each CPU this process may use)", .set = option_context, .offset = offsetof(request, context) \
    }
#define CONTEXT_OPTION_ISA(request)                                                                                                            \
    {                                                                                                                                          \
        "isa", 0, "NAME", "highest instruction set: auto (default), scalar, sse2, avx2,\navx512 or neon", .set = option_context,               \
                                                                                                          .offset = offsetof(request, context) \
    }

/* Refuses a device of OpenGL for the CPU. Returns an exit code. */
int context_options_check(const context_options *options);

/* Reads "backend" for verbs that draw, for which the null backend is not allowed. `place` is a context_options. */
option_set option_drawing_backend;

/* Creates the context, which the caller destroys, and fills `info`. Its log goes to `out`, which must outlive it. Returns an exit code; errors are printed. */
int context_open(const context_options *options, const console *out, mgt_progress_function progress, void *progress_user, mgt_context **context,
                 mgt_context_info *info);

/* A target over the caller's memory, without padding between rows. */
mgt_target target_of(mgt_layer layer, mgt_format format, void *pixels);

#endif
