/* SPDX-License-Identifier: MIT */
/* Command lines. A verb's table of options drives both parsing and help. */
#ifndef MANGATA_CLI_COMMON_OPTIONS_H
#define MANGATA_CLI_COMMON_OPTIONS_H

#include <stddef.h>
#include <stdint.h>

#include "cli/common/console.h"

/* Name in the help of a value that is a method. If a table has it, the help lists all methods. */
#define OPTION_VALUE_METHOD "METHOD"

typedef struct option option;

/* Reads an option's value into `place`, the member of the verb's request at the row's offset. Returns an exit code; errors are printed. */
typedef int option_set(const option *o, void *place, const char *value);

struct option {
    const char *name;  /* without the dashes */
    char letter;       /* 0: none */
    const char *value; /* name of its value in the help; NULL: it has none */
    const char *help;  /* may hold newlines */
    option_set *set;
    size_t offset;        /* offset in the request of what it sets */
    const char *allowed;  /* text about the allowed values, for the message of option_wrong() */
    uint64_t least, most; /* range of option_number(); option_size() reads `least` */
    bool operand;         /* "--name value" as one word is an operand; only in tables with `changes` */
};

/* A sea of a few words instead of a scene's file. It becomes an operand that scene_file_open() takes. */
#define OPTION_SEA                                                                                                                 \
    {                                                                                                                              \
        "sea", 0, "KEY=VALUE,...",                                                                                                 \
            "a sea in place of a scene's file: wind=12 in m/s, and if wanted\ndirection, fetch, depth, count, seed, swell, ...:\n" \
            "docs/seas.md",                                                                                                        \
            .operand = true                                                                                                        \
    }

/* Rows of an option table whose request has the member `progress` or `shard`. */
#define OPTION_PROGRESS(request)                                                                                                         \
    {                                                                                                                                    \
        "progress", 0, "MODE", "auto (default: a bar on a terminal), json, text, openjd\nor none", .set = option_progress,               \
                                                                                                   .offset = offsetof(request, progress) \
    }
#define OPTION_SHARD(request, what)                                                      \
    {                                                                                    \
        "shard", 0, "I/N", what, .set = option_shard, .offset = offsetof(request, shard) \
    }

/* The command line of a verb. The options of every verb, --help, --json, -v/--verbose and -q/--quiet, are not in the table. A request must begin with a
 * console. */
typedef struct option_table {
    const char *verb;      /* name of the verb, such as "render" */
    const char *usage;     /* the words after it, such as "SCENE -o OUT [options]" */
    const char *summary;   /* printed before the options */
    const option *options; /* the verb's own options */
    size_t count;          /* their number */
    const char *notes;     /* printed after the options; NULL: none */
    option operand;        /* its `set` takes each word that is not an option */
    size_t quality;        /* offset of the request's quality_options; 0: the verb has no options of quality */
    size_t changes;        /* offset of the request's scene_changes; 0: it has none */
    int (*run)(void *);    /* carries out the request; returns an exit code */
} option_table;

/* Changes of a scene: --set in the order given, then --size. It also owns the operands of --sea. */
typedef struct scene_changes {
    const char **items; /* KEY=VALUE; the array is owned */
    size_t count;
    uint32_t width, height; /* 0: not given */
    char size[2][32];       /* the items of --size */
    char **operands;        /* operands made of an option and its value; owned */
    size_t operand_count;
} scene_changes;

void scene_changes_free(scene_changes *changes);

/* Functions for options, and the types of their `place`. */
option_set option_given;     /* a bool */
option_set option_text;      /* a const char *, borrowed */
option_set option_number;    /* a uint64_t */
option_set option_samples;   /* a uint32_t, in the range of the option of quality of the same name */
option_set option_frames;    /* a frame_list */
option_set option_change;    /* a scene_changes, gets KEY=VALUE */
option_set option_size;      /* a scene_changes, gets WxH */
option_set option_quality;   /* a quality_options, gets its option of the same name */
option_set option_progress;  /* a progress_mode */
option_set option_shard;     /* a work_shard */
option_set option_one_scene; /* a const char *, for an operand that is given once */

/* Prints that `value` is wrong and what is allowed. Returns EXIT_CODE_USAGE. */
int option_wrong(const option *o, const char *value, const char *allowed);

/* Reads the words after the verb into `request`, which borrows them. Returns an exit code, or OPTIONS_HELP: the help has been printed, and there is nothing
 * more to do. The caller frees the request's scene_changes in every case. */
enum { OPTIONS_HELP = -1 };
int options_read(const option_table *table, void *request, int count, char **arguments);

/* The same, then runs the verb and frees the scene_changes. Returns an exit code. */
int options_run(const option_table *table, void *request, int count, char **arguments);

/* The most similar of `count` names, at an edit distance of at most 2. NULL: there is none. `name_at(names, i)` returns name i. */
const char *nearest_name(const char *text, const void *names, size_t count, const char *(*name_at)(const void *, size_t));

#endif
