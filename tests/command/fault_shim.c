/* SPDX-License-Identifier: MIT
 *
 * Makes one call of the command fail: preloaded, it counts the calls of a kind that the program's own code makes, not those of libraries and drivers.
 *
 *     FAULT_KIND   memory, thread, write, sync or rename
 *     FAULT_AT     which call fails, from 1; 0: none
 *     FAULT_COUNT  a file that gets the number of calls at the end
 */
#define _GNU_SOURCE

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

/* glibc's own names of what stands in for them here. */
extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *old, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);

typedef enum fault_kind { FAULT_NONE, FAULT_MEMORY, FAULT_THREAD, FAULT_WRITE, FAULT_SYNC, FAULT_RENAME } fault_kind;

static struct {
    fault_kind kind;
    uintptr_t low, high; /* the program's own code */
    unsigned long at;
    atomic_ulong count;
} shim;

static int note_program(struct dl_phdr_info *info, size_t size, void *unused)
{
    (void)size, (void)unused;
    for (int i = 0; i < info->dlpi_phnum; i++) {
        const ElfW(Phdr) *part = &info->dlpi_phdr[i];
        if (part->p_type == PT_LOAD && (part->p_flags & PF_X)) {
            shim.low = info->dlpi_addr + part->p_vaddr;
            shim.high = shim.low + part->p_memsz;
        }
    }
    return 1; /* the first one is the program */
}

__attribute__((constructor)) static void begin(void)
{
    static const char *const names[] = {"", "memory", "thread", "write", "sync", "rename"};
    const char *kind = getenv("FAULT_KIND"), *at = getenv("FAULT_AT");
    if (kind == NULL || strcmp(program_invocation_short_name, "mangata") != 0)
        return;
    dl_iterate_phdr(note_program, NULL);
    shim.at = at != NULL ? strtoul(at, NULL, 10) : 0;
    for (int i = 1; i < 6; i++)
        if (strcmp(kind, names[i]) == 0)
            shim.kind = (fault_kind)i;
}

__attribute__((destructor)) static void end(void)
{
    const char *path = getenv("FAULT_COUNT");
    char text[32];
    if (path == NULL || shim.kind == FAULT_NONE)
        return;
    const int length = snprintf(text, sizeof text, "%lu\n", (unsigned long)atomic_load(&shim.count));
    const long file = syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file >= 0)
        syscall(SYS_write, file, text, length);
}

static bool fails(fault_kind kind, const void *caller)
{
    return shim.kind == kind && (uintptr_t)caller >= shim.low && (uintptr_t)caller < shim.high && atomic_fetch_add(&shim.count, 1) + 1 == shim.at;
}

#pragma GCC visibility push(default)

#define CALLER __builtin_extract_return_addr(__builtin_return_address(0))

void *malloc(size_t size)
{
    if (!fails(FAULT_MEMORY, CALLER))
        return __libc_malloc(size);
    errno = ENOMEM;
    return NULL;
}

void *calloc(size_t count, size_t size)
{
    if (!fails(FAULT_MEMORY, CALLER))
        return __libc_calloc(count, size);
    errno = ENOMEM;
    return NULL;
}

void *realloc(void *old, size_t size)
{
    if (!fails(FAULT_MEMORY, CALLER))
        return __libc_realloc(old, size);
    errno = ENOMEM;
    return NULL;
}

void *aligned_alloc(size_t alignment, size_t size)
{
    if (!fails(FAULT_MEMORY, CALLER))
        return __libc_memalign(alignment, size);
    errno = ENOMEM;
    return NULL;
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument)
{
    static int (*next)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
    if (fails(FAULT_THREAD, CALLER))
        return EAGAIN;
    if (next == NULL)
        *(void **)&next = dlsym(RTLD_NEXT, "pthread_create");
    return next(thread, attributes, start, argument);
}

static int refuse(int code)
{
    errno = code;
    return -1;
}

ssize_t write(int file, const void *bytes, size_t size)
{
    return file > 2 && fails(FAULT_WRITE, CALLER) ? refuse(ENOSPC) : syscall(SYS_write, file, bytes, size);
}

ssize_t pwrite(int file, const void *bytes, size_t size, off_t offset)
{
    return fails(FAULT_WRITE, CALLER) ? refuse(ENOSPC) : syscall(SYS_pwrite64, file, bytes, size, offset);
}

int fsync(int file) { return fails(FAULT_SYNC, CALLER) ? refuse(EIO) : (int)syscall(SYS_fsync, file); }

int renameat(int from, const char *old, int to, const char *name)
{
    return fails(FAULT_RENAME, CALLER) ? refuse(EIO) : (int)syscall(SYS_renameat2, from, old, to, name, 0);
}

int renameat2(int from, const char *old, int to, const char *name, unsigned flags)
{
    return fails(FAULT_RENAME, CALLER) ? refuse(EIO) : (int)syscall(SYS_renameat2, from, old, to, name, flags);
}

#pragma GCC visibility pop
