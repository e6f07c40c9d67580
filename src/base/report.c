/* SPDX-License-Identifier: MIT
 * Log messages and errors. */
#include "base/report.h"

#include <stdarg.h>
#include <stdio.h>

/* The text of functions without a context, which could hold it. */
static _Thread_local char creation_error[REPORTER_TEXT];

reporter creation_reporter(void)
{
    creation_error[0] = 0;
    return (reporter){.error = creation_error};
}

static void send(const reporter *r, mgt_log_level level, const char *id, const char *text)
{
    if (r->log)
        r->log(r->log_user, level, id, text);
}

void report(const reporter *r, mgt_log_level level, const char *id, const char *format, ...)
{
    char text[REPORTER_TEXT];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    send(r, level, id, text);
}

mgt_status report_error(const reporter *r, mgt_status status, const char *id, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(r->error, REPORTER_TEXT, format, arguments);
    va_end(arguments);
    send(r, status == MGT_CANCELLED ? MGT_LOG_INFO : MGT_LOG_ERROR, id, r->error);
    return status;
}

const char *creation_error_text(void) { return creation_error; }
