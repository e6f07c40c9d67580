/* SPDX-License-Identifier: MIT */
/* What renders: the options that every verb which renders has. */
#include "cli/common/context_options.h"

#include <string.h>

#include "params/names.h"
#include "cli/common/numbers.h"

const char *context_option_set(context_options *options, const char *name, const char *value)
{
    uint64_t n = 0;
    if (strcmp(name, "backend") == 0)
        return mgt_backend_from_name(value, &options->backend) ? NULL : "cpu, gl, auto or null";
    if (strcmp(name, "isa") == 0) {
        static names_text allowed;
        allowed = names_list(isa_names);
        return mgt_isa_from_name(value, &options->isa) ? NULL : allowed.text;
    }
    if (strcmp(name, "gl-device") == 0) {
        if (!number_parse_u64(value, 1023, &n))
            return "a number from 0 to 1023";
        options->gl_device = (uint32_t)n;
        return NULL;
    }
    if (!number_parse_u64(value, 1024, &n))
        return "a number from 0 (all CPUs) to 1024";
    options->threads = (uint32_t)n;
    return NULL;
}

int context_open(const context_options *options, const console *out, mgt_progress_function progress, void *progress_user, mgt_context **context,
                 mgt_context_info *info)
{
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = options->backend;
    desc.gl_device = options->gl_device;
    desc.isa = options->isa;
    desc.threads = options->threads;
    desc.log = console_log;
    desc.log_user = (void *)out;
    desc.progress = progress;
    desc.progress_user = progress_user;
    const mgt_status status = mgt_context_create(context, &desc);
    if (status != MGT_OK)
        return console_library_error(NULL, status);
    info->struct_size = sizeof *info;
    mgt_context_get_info(*context, info);
    return EXIT_CODE_OK;
}
