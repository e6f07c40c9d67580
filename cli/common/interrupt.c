/* SPDX-License-Identifier: MIT */
/* Signal handlers. A handler has no argument for data of its own, so the flag is a variable of this file. */
#include "cli/common/interrupt.h"

#include <stddef.h>
#include <unistd.h>

static volatile sig_atomic_t signal_that_came;

static void note_signal(int signal)
{
    if (!signal_that_came)
        signal_that_came = signal;
}

static void end_at_once(int signal)
{
    static const char text[] = "mangata: stopped by a signal\n";
    /* If it fails, nothing can be done about it. */
    const ssize_t unused = write(STDERR_FILENO, text, sizeof text - 1);
    (void)unused;
    _exit(128 + signal);
}

static void install(int number, void (*handler)(int))
{
    struct sigaction old, action = {.sa_handler = handler};
    sigemptyset(&action.sa_mask);
    if (sigaction(number, NULL, &old) == 0 && old.sa_handler != SIG_IGN)
        sigaction(number, &action, NULL);
}

static void install_all(void (*handler)(int))
{
    install(SIGINT, handler);
    install(SIGTERM, handler);
    install(SIGHUP, handler);
}

void interrupt_while_reading(void) { install_all(end_at_once); }

void interrupt_install(void)
{
    install_all(note_signal);
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
