/* SPDX-License-Identifier: MIT */
/* Command lines: one table a verb drives the parsing and the help. */
#ifndef MANGATA_CLI_COMMON_OPTIONS_H
#define MANGATA_CLI_COMMON_OPTIONS_H

#include <stddef.h>
#include <stdint.h>

#include "cli/common/console.h"

/* What the help calls the value of an option that names a method: it lists them. */
#define OPTION_VALUE_METHOD "METHOD"

typedef struct option option;

/* Takes an option's value into `place`, which lies in the verb's request where the row says. An exit code; errors are printed. */
typedef int option_set(const option *o, void *place, const char *value);

struct option {
    const char *name;  /* without the dashes */
    char letter;       /* 0: none */
    const char *value; /* what the help calls its value; NULL: a flag */
    const char *help;  /* may hold newlines */
    option_set *set;
    size_t offset;        /* of what it sets in the request */
    const char *allowed;  /* what a wrong value is told, where no number says it */
    uint64_t least, most; /* of option_number and option_size */
    bool operand;         /* "--name value" in one word is an operand; of verbs with changes */
};

/* A scene of a few words, in place of a file: an operand that scene_file_open() takes. */
#define OPTION_SEA                                                                                                                 \
    {                                                                                                                              \
        "sea", 0, "KEY=VALUE,...",                                                                                                 \
            "a sea in place of a scene's file: wind=12 in m/s, and if wanted\ndirection, fetch, depth, count, seed, swell, ...:\n" \
            "docs/seas.md",                                                                                                        \
            .operand = true                                                                                                        \
    }

/* Rows of a table whose request has `progress`, and `shard`. */
#define OPTION_PROGRESS(request)                                                                                                         \
    {                                                                                                                                    \
        "progress", 0, "MODE", "auto (default: a bar on a terminal), json, text, openjd\nor none", .set = option_progress,               \
                                                                                                   .offset = offsetof(request, progress) \
    }
#define OPTION_SHARD(request, what)                                                      \
    {                                                                                    \
        "shard", 0, "I/N", what, .set = option_shard, .offset = offsetof(request, shard) \
    }

/* A verb's command line. --help, --json, -v/--verbose and --quiet are known everywhere and not listed. A request begins with its console. */
typedef struct option_table {
    const char *verb;  /* "render" */
    const char *usage; /* "SCENE -o OUT [options]" */
    const char *summary;
    const option *options;
    size_t count;
    const char *notes;  /* printed below the options; may be NULL */
    option operand;     /* takes the words that are no options */
    size_t quality;     /* of the request's quality_options, where the verb takes these as well; 0: it does not */
    size_t changes;     /* of the request's scene_changes; 0: none */
    int (*run)(void *); /* what the verb does with the request; an exit code */
} option_table;

/* --set and --size of a scene, in order, the size last; and --sea. */
typedef struct scene_changes {
    const char **items; /* KEY=VALUE */
    size_t count;
    uint32_t width, height; /* 0: not given */
    char size[2][32];       /* as items */
    char **operands;        /* those made of an option and its value; owned */
    size_t operand_count;
} scene_changes;

void scene_changes_free(scene_changes *changes);

/* What options usually set. */
option_set option_given;     /* a bool */
option_set option_text;      /* a const char *, borrowed */
option_set option_number;    /* a uint64_t */
option_set option_samples;   /* a uint32_t, in the range that the option of quality of this name has */
option_set option_frames;    /* a frame_list */
option_set option_change;    /* scene_changes: KEY=VALUE */
option_set option_size;      /* scene_changes: WxH */
option_set option_quality;   /* quality_options: the option of this name */
option_set option_progress;  /* a progress_mode */
option_set option_shard;     /* a work_shard */
option_set option_one_scene; /* an operand, once: a const char * */

/* Says that --name is not `value` but what is allowed. EXIT_CODE_USAGE. */
int option_wrong(const option *o, const char *value, const char *allowed);

/* Reads the words after the verb into `request`. An exit code, or OPTIONS_HELP: the help has been printed and there is nothing more to do.
 * In every case the changes are to be freed. */
enum { OPTIONS_HELP = -1 };
int options_read(const option_table *table, void *request, int count, char **arguments);

/* The same, then runs the verb and frees the changes. An exit code. */
int options_run(const option_table *table, void *request, int count, char **arguments);

/* The nearest of `count` names, or NULL when none is near. `name_at(names, i)` gives the names. */
const char *nearest_name(const char *text, const void *names, size_t count, const char *(*name_at)(const void *, size_t));

#endif
