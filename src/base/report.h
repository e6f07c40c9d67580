/* SPDX-License-Identifier: MIT
 * Log messages and errors. */
#ifndef MANGATA_BASE_REPORT_H
#define MANGATA_BASE_REPORT_H

#include "mangata/mangata.h"

/* Where functions report: the log of a context and the text of mgt_last_error(). */
typedef struct reporter {
    mgt_log_function log;
    void *log_user;
    char *error; /* REPORTER_TEXT bytes */
} reporter;

#define REPORTER_TEXT 512

/* Writes the detail of a failure, logs it, as an error unless it was asked for (MGT_CANCELLED), and returns `status`, so that callers can `return report_error(…)`. */
mgt_status report_error(const reporter *r, mgt_status status, const char *id, const char *format, ...) __attribute__((format(printf, 4, 5)));
void report(const reporter *r, mgt_log_level level, const char *id, const char *format, ...) __attribute__((format(printf, 4, 5)));

/* For what is created without a context: the text of mgt_last_error(NULL), emptied. */
reporter creation_reporter(void);

/* Its text. */
const char *creation_error_text(void);

#endif
