/* SPDX-License-Identifier: MIT
 * Jobs and uniform numbers of the refraction passes, shared by both backends. */
#ifndef MANGATA_FRAME_REFRACTION_DATA_H
#define MANGATA_FRAME_REFRACTION_DATA_H

#include "frame/gbuffer_job.h"
#include "frame/world.h"

/* The layers of the camera, and those of its mirror image, whose far one is what the surface mirrors. */
gbuffer_job refraction_job(const frame *f);
gbuffer_job refraction_mirrored_job(const frame *f);

/* Whether the surface mirrors more than the sky: objects, or under water the water. */
bool refraction_mirrors(const frame *f, const world *w);

/* All waves, as NarrowData counts them. */
void refraction_wave_list(const frame *f, const world *w, SearchWave *out);

/* `layer`: the shape of the layers. */
NarrowData refraction_narrow_data(const frame *f, const world *w, const gbuffer *layer);

/* A triangle's unit normal, and its product with a point of it. */
void refraction_plane(const world *w, size_t triangle, float plane[4]);

#endif
