/* SPDX-License-Identifier: MIT */
/* report.html: the whole comparison in one file, made from the texts of cli/compare/page. */
#ifndef MANGATA_CLI_COMPARE_COMPARE_PAGE_H
#define MANGATA_CLI_COMPARE_COMPARE_PAGE_H

#include "cli/compare/compare_job.h"

/* The files of cli/compare/page, which scripts/embed_text embeds. */
typedef struct page_text {
    const char *name, *text;
} page_text;
extern const page_text page_texts[];
extern const size_t page_text_count;

/* Writes DIR/report.html. Prints errors and returns an exit code. */
int compare_page_write(compare_job *job);

#endif
