/* SPDX-License-Identifier: MIT */
/* SIGINT, SIGTERM and SIGHUP end the process at once while files are read; later they set a flag, so that work stops at a clean place. */
#ifndef MANGATA_CLI_COMMON_INTERRUPT_H
#define MANGATA_CLI_COMMON_INTERRUPT_H

#include <signal.h>
#include <stdbool.h>

/* Until interrupt_install() a signal ends the process at once, with one line and 128 + its number: there is nothing to tidy up while files are read. */
void interrupt_while_reading(void);

/* Installs the handlers; a signal that the parent set to be ignored (nohup) stays ignored. SIGPIPE becomes a write error. */
void interrupt_install(void);

/* The flag: 0, or the signal that came. */
const volatile sig_atomic_t *interrupt_flag(void);

/* 128 + the signal that came. */
int interrupt_exit_code(void);

/* An mgt_progress_function that goes on until then. */
bool interrupt_keep_going(void *user, double fraction);

#endif
