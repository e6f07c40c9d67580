/* SPDX-License-Identifier: MIT
 * What runs on the CPU alone. */
#ifndef MANGATA_API_SUPPORTS_H
#define MANGATA_API_SUPPORTS_H

#include <stdbool.h>

#include "mangata/mangata.h"

/* False where the method knows the water's surface alone, and the scene at sea level has objects or a camera under water. */
bool method_draws(const mgt_scene *scene);

/* NULL where the shaders know all of a scene at sea level, else what runs on the CPU alone. Left to it are methods whose rows say so, refraction that
 * needs the CPU's data structures, and pixels that would keep the GPU busy for too long at once. */
const char *gl_lacks(const mgt_scene *scene);

/* The same for one of its layers. */
const char *gl_lacks_layer(const mgt_scene *scene, mgt_layer layer);

#endif
