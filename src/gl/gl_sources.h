/* SPDX-License-Identifier: MIT
 * The texts of kernels and passes, and how they become one GLSL source.
 *
 * They are embedded in the library by scripts/embed_text. The first `#include "folder/name"` of a name is replaced by the text of that name; the folder is
 * ignored. Later ones are dropped. `#line LINE NUMBER` marks every change of file, so that a compiler's message leads back to it. */
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

/* Texts that replace embedded ones, in one block of memory. */
typedef struct gl_replacements {
    gl_text *texts;
    size_t count;
} gl_replacements;

/* Copies `sources` into `out`. `count` may be 0. Returns false when out of memory. */
bool gl_replacements_copy(gl_replacements *out, const mgt_gl_source *sources, size_t count);
void gl_replacements_free(gl_replacements *r);

/* Whether a text of this name is embedded. */
bool gl_text_exists(const char *name);

enum { MAX_FILES = 64 };

/* A whole source, and the files that the numbers of its #line directives stand for. */
typedef struct gl_source {
    char *text;
    size_t length, capacity;
    const char *files[MAX_FILES]; /* [0] stands for the lines before the first file */
    int file_count;
    const char *kernel;  /* name of the text that #include "method.k" stands for, or NULL */
    const char *missing; /* name of the text that includes an unknown file, or that is unknown itself; NULL: none */
    bool out_of_memory;
} gl_source;

/* Assembles the text `main` behind "#version 450 core" and `defines` (whole lines). `kernel`: what #include "method.k" stands for, or NULL. Free with
 * gl_source_free() even after a failure. */
bool gl_source_assemble(gl_source *out, const gl_replacements *replaced, const char *main, const char *kernel, const char *defines);
void gl_source_free(gl_source *s);

/* A 64-bit hash of the source's text. */
uint64_t gl_source_hash(const gl_source *s);

/* Writes the first error of a driver's log to `out` in the form "glitter.k:12: …". It knows the forms "0:12(5): error: …", "0(12) : error …" and
 * "ERROR: 0:12: …". If there is none of these, it writes the log's first line. */
void gl_source_explain(const gl_source *s, const char *log, char *out, size_t size);

#endif
