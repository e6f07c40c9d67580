/* SPDX-License-Identifier: MIT */
/* Metadata as JSON text, for sidecars. */
#ifndef MANGATA_IMAGE_METADATA_JSON_H
#define MANGATA_IMAGE_METADATA_JSON_H

#include "image/metadata.h"

/* The list as one JSON object of strings in the list's order, followed by a newline. The caller frees it. The list must have passed metadata_check(). NULL: out
 * of memory. */
char *metadata_json_text(const metadata_list *metadata);

#endif
