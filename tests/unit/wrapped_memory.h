/* SPDX-License-Identifier: MIT
 *
 * The names under which a test gets the allocations of our own code, where its link line has --wrap for each.
 */
#ifndef MANGATA_TESTS_WRAPPED_MEMORY_H
#define MANGATA_TESTS_WRAPPED_MEMORY_H

#include <stddef.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void __wrap_free(void *memory);

#endif
