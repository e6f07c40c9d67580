/* SPDX-License-Identifier: MIT
 * A fixed set of threads that share the indices of a loop. */
#ifndef MANGATA_BASE_THREAD_POOL_H
#define MANGATA_BASE_THREAD_POOL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct thread_pool thread_pool;

/* Number of CPUs that this process may use by its affinity mask and its cgroup's quota; at least 1. */
uint32_t thread_pool_usable_cpus(void);

/* `threads` includes the caller, which works, too. NULL: out of memory or threads; errno is then ENOMEM or EAGAIN. */
thread_pool *thread_pool_create(uint32_t threads);
void thread_pool_destroy(thread_pool *pool);
uint32_t thread_pool_size(const thread_pool *pool);

typedef struct thread_loop {
    size_t count;
    /* Called once for every index below `count` on any thread. `worker` is below thread_pool_size(), and 0 on the caller's thread. */
    void (*body)(void *argument, size_t index, uint32_t worker);
    void *argument;
    /* Called repeatedly on the caller's thread with the fraction that is done. False: the loop stops early. NULL: no calls. */
    bool (*progress)(void *argument, double fraction);
} thread_loop;

/* Runs the loop. False: `progress` has stopped it. */
bool thread_pool_run(thread_pool *pool, const thread_loop *loop);

/* Runs a loop whose body takes no worker. `pool` is a thread_pool. */
void thread_pool_each(void *pool, size_t count, void (*body)(void *, size_t), void *argument);

#endif
