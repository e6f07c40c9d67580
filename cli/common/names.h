/* SPDX-License-Identifier: MIT */
/* The command's words for the library's enums. */
#ifndef MANGATA_CLI_COMMON_NAMES_H
#define MANGATA_CLI_COMMON_NAMES_H

#include "params/methods.h"

/* Each returns false for a word it does not know; the _words texts say what is allowed. */
bool backend_from_name(const char *name, mgt_backend *backend);
const char *backend_name(mgt_backend backend);

bool isa_from_name(const char *name, mgt_isa *isa);
const char *isa_name(mgt_isa isa);
extern const char isa_words[];

bool layer_from_name(const char *name, mgt_layer *layer);
const char *layer_name(mgt_layer layer);
uint32_t layer_channels(mgt_layer layer);
enum { LAYER_COUNT = MGT_LAYER_REFRACTION_ERROR + 1 };

#endif
