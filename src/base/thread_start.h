/* SPDX-License-Identifier: MIT
 * Starts threads whose stack does not depend on the process's limit. */
#ifndef MANGATA_BASE_THREAD_START_H
#define MANGATA_BASE_THREAD_START_H

#include <pthread.h>

/* Stack size that rendering may rely on, bytes. It is the usual limit of processes. */
enum { THREAD_STACK_BYTES = 8 << 20 };

/* Starts a thread with a stack of at least THREAD_STACK_BYTES. Otherwise it would have the process's limit (RLIMIT_STACK), which may be too small. Returns 0 or
 * an errno. */
int thread_start(pthread_t *thread, void *(*run)(void *), void *argument);

#endif
