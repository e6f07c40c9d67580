/* SPDX-License-Identifier: MIT
 * Jobs and uniform numbers of the refraction passes, shared by both backends. */
#ifndef MANGATA_FRAME_REFRACTION_DATA_H
#define MANGATA_FRAME_REFRACTION_DATA_H

#include "frame/gbuffer_job.h"
#include "frame/world.h"

/* The job for the layers that the camera sees. */
gbuffer_job refraction_job(const frame *f);

/* The job for the layer that the camera's mirror image sees, which is what the surface mirrors. */
gbuffer_job refraction_mirrored_job(const frame *f);

/* Whether the surface mirrors more than the sky. Above water these are objects; a camera under water sees mirrored water, too. */
bool refraction_mirrors(const frame *f, const world *w);

/* Fills `out` with all waves of the scene, relative to the world's origin. */
void refraction_wave_list(const frame *f, const world *w, SearchWave *out);

/* Uniform numbers of the hit search; `layer` has the shape of the layers. */
NarrowData refraction_narrow_data(const frame *f, const world *w, const gbuffer *layer);

/* A triangle's plane: its unit normal, and the scalar product of the normal and a point of the plane. */
void refraction_plane(const world *w, size_t triangle, float plane[4]);

#endif
