/* SPDX-License-Identifier: MIT
 * Messages: the journal and the line over the picture. */
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

void viewer_report(viewer *v, bool is_error, const char *format, ...)
{
    notice *n = &v->message;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(n->text, sizeof n->text, format, arguments);
    va_end(arguments);
    n->is_error = is_error;
    n->until = v->script ? 0 : seconds_now() + (is_error ? 8 : 4); /* what a script sees does not depend on the time it takes */
    viewer_log(v, "%s", n->text);
}
