/* SPDX-License-Identifier: MIT
 * A fixed set of threads that share the indices of a loop. */
#define _GNU_SOURCE
#include "base/thread_pool.h"

#include <errno.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "base/thread_start.h"

struct thread_pool {
    pthread_mutex_t lock;
    pthread_cond_t start, finish;
    uint64_t generation; /* number of loops, by which a sleeping thread recognises a new one */
    uint32_t running;    /* number of threads inside the current loop */
    bool quit;
    thread_loop loop;
    atomic_size_t next;
    atomic_bool stopped;
    uint32_t size;
    uint32_t started;
    pthread_t *threads;
};

typedef struct worker {
    thread_pool *pool;
    uint32_t number;
} worker;

/* The cgroup's quota in whole CPUs, by version 2 or else version 1; 0: there is none. */
static uint32_t cgroup_cpus(void)
{
    long long quota = 0, period = 0;
    FILE *f = fopen("/sys/fs/cgroup/cpu.max", "r");
    if (f) {
        if (fscanf(f, "%lld %lld", &quota, &period) != 2)
            quota = 0;
        fclose(f);
    } else if ((f = fopen("/sys/fs/cgroup/cpu/cpu.cfs_quota_us", "r"))) {
        if (fscanf(f, "%lld", &quota) != 1)
            quota = 0;
        fclose(f);
        if ((f = fopen("/sys/fs/cgroup/cpu/cpu.cfs_period_us", "r"))) {
            if (fscanf(f, "%lld", &period) != 1)
                period = 0;
            fclose(f);
        }
    }
    return quota > 0 && period > 0 ? (uint32_t)((quota + period - 1) / period) : 0;
}

uint32_t thread_pool_usable_cpus(void)
{
    uint32_t cpus = 1;
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) != 0) {
        const long online = sysconf(_SC_NPROCESSORS_ONLN); /* a machine that may have more CPUs than a set holds */
        cpus = online > 1 ? (uint32_t)online : 1;
    } else if (CPU_COUNT(&set) > 0) {
        cpus = (uint32_t)CPU_COUNT(&set);
    }
    const uint32_t quota = cgroup_cpus();
    return quota > 0 && quota < cpus ? quota : cpus;
}

static void share_loop(thread_pool *pool, uint32_t number)
{
    const thread_loop *loop = &pool->loop;
    for (;;) {
        const size_t index = atomic_fetch_add_explicit(&pool->next, 1, memory_order_relaxed);
        if (index >= loop->count || atomic_load_explicit(&pool->stopped, memory_order_relaxed))
            return;
        loop->body(loop->argument, index, number);
    }
}

static void *worker_main(void *argument)
{
    worker w = *(worker *)argument;
    free(argument);
    uint64_t seen = 0;
    pthread_mutex_lock(&w.pool->lock);
    for (;;) {
        while (w.pool->generation == seen && !w.pool->quit)
            pthread_cond_wait(&w.pool->start, &w.pool->lock);
        if (w.pool->quit)
            break;
        seen = w.pool->generation;
        pthread_mutex_unlock(&w.pool->lock);
        share_loop(w.pool, w.number);
        pthread_mutex_lock(&w.pool->lock);
        if (--w.pool->running == 0)
            pthread_cond_signal(&w.pool->finish);
    }
    pthread_mutex_unlock(&w.pool->lock);
    return NULL;
}

int thread_start(pthread_t *thread, void *(*run)(void *), void *argument)
{
    pthread_attr_t attributes;
    size_t stack = 0;
    if (pthread_attr_init(&attributes) != 0)
        return ENOMEM;
    if (pthread_attr_getstacksize(&attributes, &stack) == 0 && stack < THREAD_STACK_BYTES)
        pthread_attr_setstacksize(&attributes, THREAD_STACK_BYTES);
    const int code = pthread_create(thread, &attributes, run, argument);
    pthread_attr_destroy(&attributes);
    return code;
}

static bool start_worker(thread_pool *pool)
{
    worker *w = malloc(sizeof *w);
    errno = ENOMEM;
    if (!w)
        return false;
    *w = (worker){pool, pool->started + 1};
    if (thread_start(&pool->threads[pool->started], worker_main, w) != 0) {
        free(w);
        errno = EAGAIN;
        return false;
    }
    pool->started++;
    return true;
}

thread_pool *thread_pool_create(uint32_t threads)
{
    thread_pool *pool = calloc(1, sizeof *pool);
    errno = ENOMEM;
    if (!pool)
        return NULL;
    pool->size = threads;
    pthread_mutex_init(&pool->lock, NULL);
    pthread_cond_init(&pool->start, NULL);
    pthread_cond_init(&pool->finish, NULL);
    pool->threads = calloc(threads, sizeof *pool->threads);
    bool good = pool->threads != NULL;
    while (good && pool->started + 1 < threads)
        good = start_worker(pool);
    if (!good) {
        const int code = errno;
        thread_pool_destroy(pool);
        errno = code;
        return NULL;
    }
    return pool;
}

void thread_pool_destroy(thread_pool *pool)
{
    if (!pool)
        return;
    pthread_mutex_lock(&pool->lock);
    pool->quit = true;
    pthread_cond_broadcast(&pool->start);
    pthread_mutex_unlock(&pool->lock);
    for (uint32_t i = 0; i < pool->started; i++)
        pthread_join(pool->threads[i], NULL);
    pthread_cond_destroy(&pool->finish);
    pthread_cond_destroy(&pool->start);
    pthread_mutex_destroy(&pool->lock);
    free(pool->threads);
    free(pool);
}

uint32_t thread_pool_size(const thread_pool *pool) { return pool->size; }

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Takes part in the loop on the caller's thread, and reports progress ten times a second. */
static void share_loop_reporting(thread_pool *pool)
{
    const thread_loop *loop = &pool->loop;
    double last = seconds();
    for (;;) {
        const size_t index = atomic_fetch_add_explicit(&pool->next, 1, memory_order_relaxed);
        if (index >= loop->count || atomic_load_explicit(&pool->stopped, memory_order_relaxed))
            return;
        loop->body(loop->argument, index, 0);
        const double now = seconds();
        if (now - last < 0.1)
            continue;
        last = now;
        if (!loop->progress(loop->argument, (double)index / (double)loop->count))
            atomic_store(&pool->stopped, true);
    }
}

bool thread_pool_run(thread_pool *pool, const thread_loop *loop)
{
    pthread_mutex_lock(&pool->lock);
    pool->loop = *loop;
    atomic_store(&pool->next, 0);
    atomic_store(&pool->stopped, false);
    pool->running = pool->started;
    pool->generation++;
    pthread_cond_broadcast(&pool->start);
    pthread_mutex_unlock(&pool->lock);

    if (loop->progress)
        share_loop_reporting(pool);
    else
        share_loop(pool, 0);

    pthread_mutex_lock(&pool->lock);
    while (pool->running > 0)
        pthread_cond_wait(&pool->finish, &pool->lock);
    pthread_mutex_unlock(&pool->lock);
    return !atomic_load(&pool->stopped);
}

typedef struct index_loop {
    void (*body)(void *, size_t);
    void *argument;
} index_loop;

static void index_step(void *argument, size_t index, uint32_t by)
{
    (void)by;
    const index_loop *l = argument;
    l->body(l->argument, index);
}

void thread_pool_each(void *pool, size_t count, void (*body)(void *, size_t), void *argument)
{
    index_loop l = {body, argument};
    thread_pool_run(pool, &(thread_loop){.count = count, .body = index_step, .argument = &l});
}
