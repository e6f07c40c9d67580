/* SPDX-License-Identifier: MIT
 * Threads with a stack that does not depend on the process's limit. */
#ifndef MANGATA_BASE_THREAD_START_H
#define MANGATA_BASE_THREAD_START_H

#include <pthread.h>

/* Bytes of stack that rendering a frame may rely on: the usual limit of processes. */
enum { THREAD_STACK_BYTES = 8 << 20 };

/* Starts a thread with that much stack or more. Threads otherwise have the process's limit (RLIMIT_STACK), which may be too small. Returns an errno, or 0. */
int thread_start(pthread_t *thread, void *(*run)(void *), void *argument);

#endif
