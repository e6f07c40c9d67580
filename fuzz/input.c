/* SPDX-License-Identifier: MIT
 *
 * Gives each input to the target, with a limit by the clock of the core: on a busy machine that of the wall would find hangs that are none.
 */
#include <signal.h>
#include <sys/time.h>

#include "fuzz.h"

/* Under sanitizers, which take several times as long. */
enum { SECONDS = 20 };

static void out_of_time(int number)
{
    (void)number;
    fuzz_require(false, "an input takes too long");
}

static void limit(time_t seconds)
{
    const struct itimerval timer = {.it_value = {.tv_sec = seconds}};
    fuzz_require(setitimer(ITIMER_PROF, &timer, NULL) == 0, "no timer");
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static bool ready;
    if (!ready)
        fuzz_require(signal(SIGPROF, out_of_time) != SIG_ERR, "no signal");
    ready = true;
    limit(SECONDS);
    fuzz_input(bytes, size);
    limit(0);
    return 0;
}
