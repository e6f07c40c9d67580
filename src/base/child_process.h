/* SPDX-License-Identifier: MIT
 *
 * Finds programs and starts them with chosen descriptors, without blocked signals or signal handlers.
 */
#ifndef MANGATA_BASE_CHILD_PROCESS_H
#define MANGATA_BASE_CHILD_PROCESS_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

typedef struct child_descriptors {
    int standard[3]; /* descriptors that become standard input, output and error of the child; -1: /dev/null */
    int extra;       /* a further descriptor, which becomes `extra_place` in the child; -1: none */
    int extra_place;
} child_descriptors;

/* Finds an executable of this name in this program's folder, and writes its path. False: there is none. Any thread. */
bool program_beside(const char *name, char *path, size_t size);

/* Starts `program`, a path, with the caller's environment. `arguments` end with NULL. `own_group`: the child leads a process group of its own, which signals of
 * a terminal do not reach. Returns 0 or an errno. *pid is written on success only. Any thread. */
int child_process_start(pid_t *pid, const char *program, char *const *arguments, const child_descriptors *descriptors, bool own_group);

#endif
