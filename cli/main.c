/* SPDX-License-Identifier: MIT */
/* The mangata command: finds the verb and runs it. */
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

#include "base/thread_start.h"
#include "cli/common/console.h"
#include "cli/common/interrupt.h"
#include "cli/common/options.h"
#include "cli/common/verbs.h"

typedef struct verb {
    const char *name, *summary;
    int (*run)(int count, char **arguments);
} verb;

static const verb verbs[] = {
    {"render", "render frames of a scene into pictures or a film", verb_render},
    {"merge", "make the picture whose samples were rendered in parts", verb_merge},
    {"diff", "measure how far pictures are from other pictures", verb_diff},
    {"compare", "compare methods with the reference: tables and a page", verb_compare},
    {"figures", "make the tables and plates of the papers again", verb_figures},
    {"scene", "check scene files; print the schema of their format", verb_scene},
    {"waves", "write a scene whose waves are drawn from a wind's or a buoy's spectrum", verb_waves},
    {"bench", "measure how fast the methods render a scene", verb_bench},
    {"info", "list version, instruction sets, threads and libraries", verb_info},
    {"view", "open a scene in the interactive viewer", verb_view},
};
enum { VERB_COUNT = sizeof verbs / sizeof verbs[0] };

static const char *verb_name_at(const void *unused, size_t i)
{
    (void)unused;
    return verbs[i].name;
}

static void print_help(FILE *stream)
{
    fputs("usage: mangata VERB [options]\n\nRenders reflections of the sun and the moon on water, anti-aliased in space and time.\n\nverbs:\n", stream);
    for (size_t i = 0; i < VERB_COUNT; i++)
        fprintf(stream, "  %-8s%s\n", verbs[i].name, verbs[i].summary);
    fputs("\noptions:\n  --version   print the version\n  -h, --help  show this help; mangata VERB --help describes a verb\n", stream);
}

static int run(int argc, char **argv)
{
    if (argc < 2) {
        console_error(0, "no verb given; see mangata --help");
        return EXIT_CODE_USAGE;
    }
    const char *word = argv[1];
    if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || (strcmp(word, "help") == 0 && argc == 2)) {
        print_help(stdout);
        return EXIT_CODE_OK;
    }
    if (strcmp(word, "--version") == 0) {
        printf("mangata %s\n", mgt_version());
        return EXIT_CODE_OK;
    }
    const bool help = strcmp(word, "help") == 0;
    if (help)
        word = argv[2];
    for (size_t i = 0; i < VERB_COUNT; i++) {
        static char help_option[] = "--help";
        char *help_arguments[] = {help_option, NULL};
        if (strcmp(word, verbs[i].name) == 0)
            return help ? verbs[i].run(1, help_arguments) : verbs[i].run(argc - 2, argv + 2);
    }
    const char *near = nearest_name(word, NULL, VERB_COUNT, verb_name_at);
    if (near)
        return console_error(EXIT_CODE_USAGE, "unknown %s %s; did you mean %s?", word[0] == '-' ? "option" : "verb", word, near);
    return console_error(EXIT_CODE_USAGE, "unknown %s %s; see mangata --help", word[0] == '-' ? "option" : "verb", word);
}

typedef struct command_line {
    int count;
    char **words;
    int code;
} command_line;

static void *run_in_thread(void *argument)
{
    command_line *line = argument;
    line->code = run(line->count, line->words);
    return NULL;
}

/* Runs the command in a thread of its own where the process's stack is too small for a frame. */
static int run_with_room(int argc, char **argv)
{
    struct rlimit limit;
    pthread_t thread;
    command_line line = {argc, argv, EXIT_CODE_FAILED};
    const bool small = getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < THREAD_STACK_BYTES;
    if (!small || thread_start(&thread, run_in_thread, &line) != 0)
        return run(argc, argv);
    pthread_join(thread, NULL);
    return line.code;
}

int main(int argc, char **argv)
{
    console_begin();
    interrupt_while_reading();
    return console_finish(run_with_room(argc, argv));
}
