/* SPDX-License-Identifier: MIT */
/* Options that are kept as words until all are known: a struct of `const char *`, NULL where an option is not given, and a table of its members. */
#ifndef MANGATA_CLI_COMMON_OPTION_WORDS_H
#define MANGATA_CLI_COMMON_OPTION_WORDS_H

#include <stddef.h>

typedef struct option_word {
    const char *name; /* without dashes */
    size_t place;     /* offset of the member */
} option_word;

/* The member for the option of this name; NULL: there is none. */
const char **option_word_find(const option_word *words, size_t count, void *options, const char *name, size_t length);

/* The name of the first option that is given; NULL: none is. */
const char *option_word_given(const option_word *words, size_t count, const void *options);

#endif
