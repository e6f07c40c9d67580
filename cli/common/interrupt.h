/* SPDX-License-Identifier: MIT */
/* Handling of SIGINT, SIGTERM and SIGHUP. While files are read they end the process at once. Later they set a flag, so that work can stop at a clean place. A
 * signal that the parent has set to be ignored, as nohup does, stays ignored. */
#ifndef MANGATA_CLI_COMMON_INTERRUPT_H
#define MANGATA_CLI_COMMON_INTERRUPT_H

#include <signal.h>
#include <stdbool.h>

/* From this call to interrupt_install() a signal ends the process at once with one line on stderr and exit code 128 + its number. Nothing needs to be cleaned
 * up while files are read. */
void interrupt_while_reading(void);

/* From this call on the signals set the flag. SIGPIPE and SIGXFSZ are ignored, so that they become write errors. */
void interrupt_install(void);

/* The flag: 0, or the number of the first signal that has come. */
const volatile sig_atomic_t *interrupt_flag(void);

/* 128 + that number. */
int interrupt_exit_code(void);

/* An mgt_progress_function that cancels once the flag is set. `user` is not used. */
bool interrupt_keep_going(void *user, double fraction);

#endif
