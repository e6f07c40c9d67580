/* SPDX-License-Identifier: MIT
 * Which scenes methods and backends can render. */
#ifndef MANGATA_API_SUPPORTS_H
#define MANGATA_API_SUPPORTS_H

#include <stdbool.h>

#include "mangata/mangata.h"

/* Whether the method can draw a scene at sea level. A method without refraction draws neither objects nor from under water. */
bool method_draws(const mgt_scene *scene);

/* What OpenGL lacks to render a scene at sea level, as a subject and a verb that "on the CPU alone" completes; NULL: nothing. It lacks methods whose rows say
 * so, refraction that needs data structures of the CPU, and pixels that would keep the GPU busy for too long at once. */
const char *gl_lacks(const mgt_scene *scene);

/* What OpenGL lacks to render a layer of such a scene, in the same form. */
const char *gl_lacks_layer(const mgt_scene *scene, mgt_layer layer);

#endif
