/* SPDX-License-Identifier: MIT
 * Log messages and errors. */
#ifndef MANGATA_BASE_REPORT_H
#define MANGATA_BASE_REPORT_H

#include "mangata/mangata.h"

/* The log and the text of mgt_last_error() that functions report to. */
typedef struct reporter {
    mgt_log_function log;
    void *log_user;
    char *error; /* REPORTER_TEXT bytes */
} reporter;

#define REPORTER_TEXT 512

/* Writes the text of a failure and logs it: as an error, unless it is MGT_CANCELLED. Returns `status`. */
mgt_status report_error(const reporter *r, mgt_status status, const char *id, const char *format, ...) __attribute__((format(printf, 4, 5)));
void report(const reporter *r, mgt_log_level level, const char *id, const char *format, ...) __attribute__((format(printf, 4, 5)));

/* The reporter of functions without a context. It logs nothing and writes the text of mgt_last_error(NULL), which this call clears. */
reporter creation_reporter(void);

/* The text of mgt_last_error(NULL) on this thread. */
const char *creation_error_text(void);

#endif
