/* SPDX-License-Identifier: MIT */
/* A temporary folder for the tests of src/image, and small helpers to look into it. */
#ifndef MANGATA_TESTS_IMAGE_TEST_FOLDER_H
#define MANGATA_TESTS_IMAGE_TEST_FOLDER_H

#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* asprintf, memmem */
#endif
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dirent.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct test_folder {
    char path[256];
} test_folder;

static inline const char *in_folder(const test_folder *folder, const char *name, char out[512])
{
    snprintf(out, 512, "%s/%s", folder->path, name);
    return out;
}

/* Number of entries, hidden ones too: what a writer leaves behind shows here. */
static inline int folder_entries(const char *path)
{
    int count = 0;
    DIR *stream = opendir(path);
    assert_non_null(stream);
    for (struct dirent *entry; (entry = readdir(stream));)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(stream);
    return count;
}

static inline void folder_clear(const char *path)
{
    char *name;
    DIR *stream = opendir(path);
    if (!stream)
        return;
    for (struct dirent *entry; (entry = readdir(stream));) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
            continue;
        if (asprintf(&name, "%s/%s", path, entry->d_name) < 0)
            continue;
        if (unlink(name) != 0) {
            folder_clear(name);
            rmdir(name);
        }
        free(name);
    }
    closedir(stream);
}

static inline int folder_setup(void **state)
{
    test_folder *folder = malloc(sizeof *folder);
    const char *base = getenv("TMPDIR");
    snprintf(folder->path, sizeof folder->path, "%s/mangata-test-XXXXXX", base && *base ? base : "/tmp");
    if (!mkdtemp(folder->path))
        return -1;
    *state = folder;
    return 0;
}

static inline int folder_teardown(void **state)
{
    test_folder *folder = *state;
    folder_clear(folder->path);
    rmdir(folder->path);
    free(folder);
    return 0;
}

/* The whole file; the caller frees it. */
static inline unsigned char *file_bytes(const char *path, size_t *size)
{
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    fseek(stream, 0, SEEK_END);
    *size = (size_t)ftell(stream);
    rewind(stream);
    unsigned char *bytes = malloc(*size + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, stream), *size);
    bytes[*size] = 0;
    fclose(stream);
    return bytes;
}

static inline void write_bytes(const char *path, const void *bytes, size_t size)
{
    unlink(path); /* some file systems flush a file that is truncated and written again, which costs a disk access */
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(bytes, 1, size, stream), size);
    assert_int_equal(fclose(stream), 0);
}

static inline bool file_exists(const char *path)
{
    struct stat info;
    return lstat(path, &info) == 0;
}

static inline void assert_same_bytes(const char *path_a, const char *path_b)
{
    size_t size_a, size_b;
    unsigned char *a = file_bytes(path_a, &size_a), *b = file_bytes(path_b, &size_b);
    assert_int_equal(size_a, size_b);
    assert_memory_equal(a, b, size_a);
    free(a);
    free(b);
}

/* A small fixed generator, so that runs agree. */
static inline uint32_t test_random(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

#endif
