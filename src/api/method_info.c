/* SPDX-License-Identifier: MIT
 * The rows of the methods, made public. */
#include <string.h>

#include "params/methods.h"

mgt_status mgt_method_info(mgt_method method, mgt_method_properties *properties, size_t size)
{
    if ((size_t)method >= method_count || !properties || size < sizeof properties->struct_size || size > sizeof *properties)
        return MGT_ERROR_ARGUMENT;
    mgt_method_properties known = method_of(method)->properties;
    known.struct_size = size;
    memcpy(properties, &known, size);
    return MGT_OK;
}
