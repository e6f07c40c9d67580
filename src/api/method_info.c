/* SPDX-License-Identifier: MIT
 * The rows of methods and options, made public. */
#include <string.h>

#include "api/context.h"
#include "api/structs.h"
#include "params/methods.h"
#include "params/options.h"

mgt_status mgt_method_info(mgt_method method, mgt_method_properties *properties, size_t size)
{
    const reporter r = creation_reporter();
    if ((size_t)method >= method_count)
        return report_error(&r, MGT_ERROR_ARGUMENT, "method.info", "there is no method %d", (int)method);
    return struct_give_sized(&r, &method_properties_kind, &method_of(method)->properties, properties, size);
}

mgt_status mgt_option_check(const mgt_scene *scene, const char *option)
{
    const reporter r = creation_reporter();
    mgt_scene own;
    const field_row *field = option ? field_find(quality_fields, option, strlen(option)) : NULL;
    if (!field)
        return report_error(&r, MGT_ERROR_ARGUMENT, "option.check", "there is no option %s", option ? option : "without a name");
    const mgt_status status = scene_take(&r, &own, scene);
    if (status != MGT_OK || field_applies(quality_fields, field, &own.quality, false))
        return status;
    char words[160];
    field_conditions(quality_fields, field, words, sizeof words);
    return report_error(&r, MGT_ERROR_SCENE, "option.check", "%s: it is for %s alone", option, words);
}
