/* SPDX-License-Identifier: MIT
 * Messages: the log and the line over the picture. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "cli/common/progress.h"
#include "viewer/app/viewer.h"

static void keep(journal *j, const char *text)
{
    snprintf(j->lines[j->next], sizeof j->lines[0], "%.255s", text);
    j->next = (j->next + 1) % LOG_LINES;
    j->count += j->count < LOG_LINES;
}

void viewer_log(viewer *v, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    keep(&v->journal, text);
    console_note(&v->request->out, "%s", text);
}

static void show(viewer *v, bool is_error)
{
    /* In a script the message is not shown, so that the window does not depend on the script's speed. */
    v->message.is_error = is_error;
    v->message.until = v->script ? 0 : seconds_now() + (is_error ? 8 : 4);
}

void viewer_tell(viewer *v, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(v->message.text, sizeof v->message.text, format, arguments);
    va_end(arguments);
    show(v, false);
}

void viewer_report(viewer *v, bool is_error, const char *format, ...)
{
    notice *n = &v->message;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(n->text, sizeof n->text, format, arguments);
    va_end(arguments);
    show(v, is_error);
    viewer_log(v, "%s", n->text);
}
