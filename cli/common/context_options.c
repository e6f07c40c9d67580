/* SPDX-License-Identifier: MIT */
/* The options of every verb that renders. */
#include "cli/common/context_options.h"

#include <stdio.h>
#include <string.h>

#include "params/names.h"
#include "cli/common/numbers.h"

int option_context(const option *o, void *place, const char *value)
{
    context_options *options = place;
    const bool device = strcmp(o->name, "gl-device") == 0;
    uint64_t n = 0;
    if (strcmp(o->name, "backend") == 0)
        return mgt_backend_from_name(value, &options->backend) ? EXIT_CODE_OK : option_wrong(o, value, "cpu, gl, auto or null");
    if (strcmp(o->name, "isa") == 0)
        return mgt_isa_from_name(value, &options->isa) ? EXIT_CODE_OK : option_wrong(o, value, names_list(isa_names).text);
    if (!number_parse_u64(value, device ? 1023 : 1024, &n))
        return option_wrong(o, value, device ? "a number from 0 to 1023" : "a number from 0 (all CPUs) to 1024");
    options->gl_device_given = options->gl_device_given || device;
    *(device ? &options->gl_device : &options->threads) = (uint32_t)n;
    return EXIT_CODE_OK;
}

int context_options_check(const context_options *options)
{
    if (!options->gl_device_given || options->backend != MGT_BACKEND_CPU)
        return EXIT_CODE_OK;
    return console_error(EXIT_CODE_USAGE, "--gl-device %u: it is for --backend gl or auto alone", options->gl_device);
}

int option_drawing_backend(const option *o, void *place, const char *value)
{
    context_options *options = place;
    return mgt_backend_from_name(value, &options->backend) && options->backend != MGT_BACKEND_NULL ? EXIT_CODE_OK : option_wrong(o, value, o->allowed);
}

/* Says which instruction sets there are instead. */
static int refuse_isa(mgt_isa isa)
{
    char sets[120] = "";
    for (int i = MGT_ISA_AUTO; i <= MGT_ISA_NEON; i++)
        if (mgt_isa_available((mgt_isa)i))
            snprintf(sets + strlen(sets), sizeof sets - strlen(sets), "%s%s", sets[0] ? ", " : "", mgt_isa_name((mgt_isa)i));
    return console_error(EXIT_CODE_UNAVAILABLE, "--isa %s: this processor or build does not have it; available are %s", mgt_isa_name(isa), sets);
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
    if (status == MGT_ERROR_UNAVAILABLE && (desc.backend == MGT_BACKEND_CPU || desc.backend == MGT_BACKEND_AUTO) && !mgt_isa_available(desc.isa))
        return refuse_isa(desc.isa);
    if (status != MGT_OK)
        return console_library_error(NULL, status);
    info->struct_size = sizeof *info;
    mgt_context_get_info(*context, info);
    return EXIT_CODE_OK;
}

mgt_target target_of(mgt_layer layer, mgt_format format, void *pixels)
{
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.layer = layer;
    target.format = format;
    target.pixels = pixels;
    return target;
}
