/* SPDX-License-Identifier: MIT */
#include "cli/common/option_words.h"

#include <string.h>

const char **option_word_find(const option_word *words, size_t count, void *options, const char *name, size_t length)
{
    for (size_t i = 0; i < count; i++)
        if (strlen(words[i].name) == length && strncmp(words[i].name, name, length) == 0)
            return (const char **)(void *)((char *)options + words[i].place);
    return NULL;
}

const char *option_word_given(const option_word *words, size_t count, const void *options)
{
    for (size_t i = 0; i < count; i++)
        if (*(const char *const *)(const void *)((const char *)options + words[i].place))
            return words[i].name;
    return NULL;
}
