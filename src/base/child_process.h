/* SPDX-License-Identifier: MIT
 *
 * Starting a program with chosen descriptors, no blocked signals and no handlers.
 */
#ifndef MANGATA_BASE_CHILD_PROCESS_H
#define MANGATA_BASE_CHILD_PROCESS_H

#include <stdbool.h>
#include <sys/types.h>

typedef struct child_descriptors {
    int standard[3]; /* become standard input, output and error; -1: /dev/null */
    int extra;       /* becomes the descriptor `extra_place` of the child; -1: none */
    int extra_place;
} child_descriptors;

/* Starts `program`, a path, with the caller's environment; `arguments` end with NULL. `own_group`: the child leads a process group of its own, which signals of a
 * terminal do not reach. Returns 0 or an errno; *pid is written on success only. Any thread. */
int child_process_start(pid_t *pid, const char *program, char *const *arguments, const child_descriptors *descriptors, bool own_group);

#endif
