/* SPDX-License-Identifier: MIT
 * Check of the sizes that callers give for their structs. */
#ifndef MANGATA_BASE_STRUCT_SIZE_H
#define MANGATA_BASE_STRUCT_SIZE_H

#include <stdbool.h>
#include <stddef.h>

/* Structs of later versions are at most so many bytes larger. A greater size is an error. */
enum { LATER_BYTES = 1024 };

/* `least`: size of the first version, or of the part that a call needs. `known`: size of this version. */
static inline bool struct_size_fits(size_t size, size_t least, size_t known) { return size >= least && size <= known + LATER_BYTES; }

#endif
