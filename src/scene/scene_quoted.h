/* SPDX-License-Identifier: MIT
 *
 * Decodes quoted scalars of YAML.
 */
#ifndef MANGATA_SCENE_SCENE_QUOTED_H
#define MANGATA_SCENE_SCENE_QUOTED_H

#include <stddef.h>

/* Decodes the text between the quotes of a scalar (YAML 1.2.2, 7.3.1 and 7.3.2) in which a parser has found no fault. `quote`: '\'' or '"'. `out` has room for
 * 2 * length bytes. Returns the number of bytes written. One of them may be NUL, by the escape \0. */
size_t scene_unquote(const char *source, size_t length, char quote, char *out);

#endif
