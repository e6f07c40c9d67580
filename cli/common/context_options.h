/* SPDX-License-Identifier: MIT */
/* What renders: the options that every verb which renders has. */
#ifndef MANGATA_CLI_COMMON_CONTEXT_OPTIONS_H
#define MANGATA_CLI_COMMON_CONTEXT_OPTIONS_H

#include "cli/common/console.h"
#include "mangata/mangata.h"

typedef struct context_options {
    mgt_backend backend;
    mgt_isa isa;
    uint32_t threads, gl_device;
} context_options;

/* Rows of an option_table. */
#define CONTEXT_OPTION_GL_DEVICE                                                                 \
    {                                                                                            \
        "gl-device", 0, "N", "OpenGL: which device of those that mangata info lists (default 0)" \
    }
#define CONTEXT_OPTION_THREADS                                                          \
    {                                                                                   \
        "threads", 0, "N", "threads (default 0: one for each CPU this process may use)" \
    }
#define CONTEXT_OPTION_ISA                                                   \
    {                                                                        \
        "isa", 0, "NAME",                                                    \
            "highest instruction set: auto (default), scalar, sse2, avx2,\n" \
            "avx512 or neon"                                                 \
    }

/* Sets "backend", "gl-device", "threads" or "isa". NULL, or what is allowed. */
const char *context_option_set(context_options *options, const char *name, const char *value);

/* Creates the context, whose log goes to `out`, and says what it is. An exit code; errors are printed. */
int context_open(const context_options *options, const console *out, mgt_progress_function progress, void *progress_user, mgt_context **context,
                 mgt_context_info *info);

#endif
