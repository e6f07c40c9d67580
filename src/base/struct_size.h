/* SPDX-License-Identifier: MIT
 * Sizes that callers say their structs have. */
#ifndef MANGATA_BASE_STRUCT_SIZE_H
#define MANGATA_BASE_STRUCT_SIZE_H

#include <stdbool.h>
#include <stddef.h>

/* A later version's struct is at most so many bytes larger; a greater size is no version's. */
enum { LATER_BYTES = 1024 };

/* least: of the first version, or of the part that a call needs; known: of this version. */
static inline bool struct_size_fits(size_t size, size_t least, size_t known) { return size >= least && size <= known + LATER_BYTES; }

#endif
