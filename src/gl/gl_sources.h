/* SPDX-License-Identifier: MIT
 * The texts of kernels and passes, and how they become one GLSL source.
 *
 * They are embedded in the library by scripts/embed_text. `#include "folder/name"` is replaced by the text of that name, whatever its folder, where it
 * first occurs and dropped after that; `#line LINE NUMBER` marks every change of file, so that a compiler's message leads back to it. */
#ifndef MANGATA_GL_GL_SOURCES_H
#define MANGATA_GL_GL_SOURCES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "mangata/gl.h"

typedef struct gl_text {
    const char *name, *text;
} gl_text;

extern const gl_text gl_texts[];
extern const size_t gl_text_count;

/* Texts that stand in for embedded ones: one block of memory, or none. */
typedef struct gl_replacements {
    gl_text *texts;
    size_t count;
} gl_replacements;

/* Copies; false without memory. `count` may be 0. */
bool gl_replacements_copy(gl_replacements *out, const mgt_gl_source *sources, size_t count);
void gl_replacements_free(gl_replacements *r);

/* Whether a text of this name is embedded. */
bool gl_text_exists(const char *name);

enum { MAX_FILES = 64 };

/* A whole source, and which file each number of a #line names. */
typedef struct gl_source {
    char *text;
    size_t length, capacity;
    const char *files[MAX_FILES]; /* [0] is what stands before the first file */
    int file_count;
    const char *kernel;  /* of a method, or NULL */
    const char *missing; /* name of a file that was asked for and is not there, else NULL */
    bool out_of_memory;
} gl_source;

/* Assembles the text `main` behind "#version 450 core" and `defines` (whole lines). `kernel`: what #include "method.k" stands for, or NULL. Free with
 * gl_source_free() even after a failure. */
bool gl_source_assemble(gl_source *out, const gl_replacements *replaced, const char *main, const char *kernel, const char *defines);
void gl_source_free(gl_source *s);

/* A number that differs, but for one case in 10^19, where the text does. */
uint64_t gl_source_hash(const gl_source *s);

/* The first error of a driver's log as "glitter.k:12: …". Knows "0:12(5): error: …", "0(12) : error …" and "ERROR: 0:12: …"; a log without any
 * gives its first line. */
void gl_source_explain(const gl_source *s, const char *log, char *out, size_t size);

#endif
