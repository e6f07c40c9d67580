/* SPDX-License-Identifier: MIT
 * The library's version, and texts of mgt_status. */
#include "mangata/mangata.h"

const char *mgt_version(void) { return MGT_VERSION_STRING; }

const char *mgt_status_text(mgt_status status)
{
    switch (status) {
    case MGT_OK:
        return "ok";
    case MGT_ERROR_ARGUMENT:
        return "invalid argument";
    case MGT_ERROR_SCENE:
        return "invalid scene";
    case MGT_ERROR_MEMORY:
        return "out of memory";
    case MGT_ERROR_UNAVAILABLE:
        return "not available here";
    case MGT_ERROR_UNSUPPORTED:
        return "not supported";
    case MGT_ERROR_THREAD:
        return "a thread could not be started";
    case MGT_CANCELLED:
        return "cancelled";
    case MGT_ERROR_LOST:
        return "the device was lost";
    }
    return "unknown status";
}
