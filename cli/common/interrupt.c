/* SPDX-License-Identifier: MIT */
/* Signal handlers that only set a flag. A handler has no argument of its own, hence the one file-level variable. */
#include "cli/common/interrupt.h"

#include <stddef.h>

static volatile sig_atomic_t signal_that_came;

static void note_signal(int signal)
{
    if (!signal_that_came)
        signal_that_came = signal;
}

static void install(int number)
{
    struct sigaction old, action = {.sa_handler = note_signal};
    sigemptyset(&action.sa_mask);
    if (sigaction(number, NULL, &old) == 0 && old.sa_handler != SIG_IGN)
        sigaction(number, &action, NULL);
}

void interrupt_install(void)
{
    install(SIGINT);
    install(SIGTERM);
    install(SIGHUP);
    struct sigaction ignore = {.sa_handler = SIG_IGN};
    sigemptyset(&ignore.sa_mask);
    sigaction(SIGPIPE, &ignore, NULL);
    sigaction(SIGXFSZ, &ignore, NULL);
}

const volatile sig_atomic_t *interrupt_flag(void) { return &signal_that_came; }

int interrupt_exit_code(void) { return 128 + (int)signal_that_came; }

bool interrupt_keep_going(void *user, double fraction)
{
    (void)user, (void)fraction;
    return *interrupt_flag() == 0;
}
