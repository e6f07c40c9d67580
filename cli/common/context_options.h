/* SPDX-License-Identifier: MIT */
/* What renders: the options that every verb which renders has. */
#ifndef MANGATA_CLI_COMMON_CONTEXT_OPTIONS_H
#define MANGATA_CLI_COMMON_CONTEXT_OPTIONS_H

#include "cli/common/options.h"
#include "mangata/mangata.h"

typedef struct context_options {
    mgt_backend backend;
    mgt_isa isa;
    uint32_t threads, gl_device;
} context_options;

/* "backend", "gl-device", "threads" or "isa" into context_options. */
option_set option_context;

/* Rows of a table whose request has `context`. */
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

/* "backend" for verbs that draw: all but null. */
option_set option_drawing_backend;

/* Creates the context, whose log goes to `out`, and says what it is. An exit code; errors are printed. */
int context_open(const context_options *options, const console *out, mgt_progress_function progress, void *progress_user, mgt_context **context,
                 mgt_context_info *info);

/* A target of whole rows in the caller's memory. */
mgt_target target_of(mgt_layer layer, mgt_format format, void *pixels);

#endif
