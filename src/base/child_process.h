/* SPDX-License-Identifier: MIT
 *
 * Finding a program, and starting it with chosen descriptors, no blocked signals and no handlers.
 */
#ifndef MANGATA_BASE_CHILD_PROCESS_H
#define MANGATA_BASE_CHILD_PROCESS_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

typedef struct child_descriptors {
    int standard[3]; /* become standard input, output and error; -1: /dev/null */
    int extra;       /* becomes the descriptor `extra_place` of the child; -1: none */
    int extra_place;
} child_descriptors;

/* Whether an executable of this name stands in this program's folder, and its path. Any thread. */
bool program_beside(const char *name, char *path, size_t size);

/* Starts `program`, a path, with the caller's environment; `arguments` end with NULL. `own_group`: the child leads a process group of its own, which signals of a
 * terminal do not reach. Returns 0 or an errno; *pid is written on success only. Any thread. */
int child_process_start(pid_t *pid, const char *program, char *const *arguments, const child_descriptors *descriptors, bool own_group);

#endif
