/* SPDX-License-Identifier: MIT */
/* Command lines: one table a verb drives the parsing and the help. */
#ifndef MANGATA_CLI_COMMON_OPTIONS_H
#define MANGATA_CLI_COMMON_OPTIONS_H

#include <stddef.h>

#include "cli/common/console.h"

/* What the help calls the value of an option that names a method: it lists them. */
#define OPTION_VALUE_METHOD "METHOD"

typedef struct option {
    const char *name;  /* without the dashes */
    char letter;       /* 0: none */
    const char *value; /* what the help calls its value; NULL: a flag */
    const char *help;  /* may hold newlines */
} option;

/* A verb's command line. --help, --json, -v/--verbose and --quiet are known everywhere and not listed. */
typedef struct option_table {
    const char *verb;  /* "render" */
    const char *usage; /* "SCENE -o OUT [options]" */
    const char *summary;
    const option *options;
    size_t count;
    const char *notes; /* printed below the options; may be NULL */
    bool quality;      /* it takes the options of quality as well */
} option_table;

typedef struct option_reader {
    const option_table *table;
    console *out; /* receives the common options */
    char **arguments;
    int count, next;
    bool operands_only; /* after "--" */
} option_reader;

enum { OPTION_END = -1, OPTION_OPERAND = -2, OPTION_ERROR = -3, OPTION_HELP = -4 };

/* Options of quality come as OPTION_QUALITY + their place in quality_fields. */
enum { OPTION_QUALITY = 1000 };

/* `arguments` are those after the verb. */
option_reader option_reader_start(const option_table *table, console *out, int count, char **arguments);

/* The next option's index in the table with its value in *value, or OPTION_OPERAND with the operand, or the end.
 * OPTION_ERROR: a line has been printed, exit with EXIT_CODE_USAGE. OPTION_HELP: the help has been printed. */
int option_reader_next(option_reader *reader, const char **value);

/* The nearest of `count` names, or NULL when none is near. `name_at(names, i)` gives the names. */
const char *nearest_name(const char *text, const void *names, size_t count, const char *(*name_at)(const void *, size_t));

#endif
