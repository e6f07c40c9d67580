/* SPDX-License-Identifier: MIT
 * The rows of the methods, made public. */
#include "api/context.h"
#include "api/structs.h"
#include "params/methods.h"

mgt_status mgt_method_info(mgt_method method, mgt_method_properties *properties, size_t size)
{
    const reporter r = creation_reporter();
    if ((size_t)method >= method_count)
        return report_error(&r, MGT_ERROR_ARGUMENT, "method.info", "there is no method %d", (int)method);
    if (properties && size >= sizeof size)
        properties->struct_size = size;
    return struct_give(&r, &method_properties_kind, &method_of(method)->properties, size >= sizeof size ? properties : NULL);
}
