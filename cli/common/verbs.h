/* SPDX-License-Identifier: MIT */
/* The verbs of the command. */
#ifndef MANGATA_CLI_COMMON_VERBS_H
#define MANGATA_CLI_COMMON_VERBS_H

/* Each carries out the words after its name, prints errors and returns the exit code. */
int verb_render(int count, char **arguments);
int verb_merge(int count, char **arguments);
int verb_diff(int count, char **arguments);
int verb_compare(int count, char **arguments);
int verb_figures(int count, char **arguments);
int verb_scene(int count, char **arguments);
int verb_waves(int count, char **arguments);
int verb_bench(int count, char **arguments);
int verb_info(int count, char **arguments);
int verb_view(int count, char **arguments);

#endif
