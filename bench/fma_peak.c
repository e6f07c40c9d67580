/* SPDX-License-Identifier: MIT
 * The most fused multiply-adds that this machine does in registers. */
#include "fma_peak.h"

#include <math.h>
#include <pthread.h>

#include "timing.h"

enum { THREAD_LIMIT = 64 };

typedef struct peak_worker {
    fma_rounds *run;
    long rounds;
    float result;
} peak_worker;

static void *work(void *argument)
{
    peak_worker *w = argument;
    w->result = w->run(1.0f, w->rounds);
    return NULL;
}

/* Seconds that the slowest of the threads takes, all started together. */
static double time_of(fma_rounds *run, long rounds, int threads)
{
    pthread_t ids[THREAD_LIMIT];
    peak_worker workers[THREAD_LIMIT];
    int started = 1;
    const double start = seconds_now();
    workers[0] = (peak_worker){run, rounds, 0};
    for (; started < threads; started++) {
        workers[started] = workers[0];
        if (pthread_create(&ids[started], NULL, work, &workers[started]) != 0)
            break;
    }
    work(&workers[0]);
    for (int i = 1; i < started; i++)
        pthread_join(ids[i], NULL);
    return started == threads ? seconds_now() - start : INFINITY;
}

double fma_peak(fma_rounds *run, int lanes, int threads, double seconds)
{
    if (threads < 1 || threads > THREAD_LIMIT)
        return 0;
    long rounds = 1 << 16;
    double once = time_of(run, rounds, 1);
    while (once < seconds / 20 && rounds < 1L << 40) {
        rounds *= 2;
        once = time_of(run, rounds, 1);
    }
    double best = INFINITY;
    for (int i = 0; i < 20; i++)
        best = fmin(best, time_of(run, rounds, threads));
    return 2.0 * FMA_CHAINS * lanes * (double)rounds * threads / best;
}
