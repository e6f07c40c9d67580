/* SPDX-License-Identifier: MIT */
/* Packing, alpha, planar depth, crop and camera of an EXR. */
#ifndef MANGATA_CLI_RENDER_RENDER_EXR_H
#define MANGATA_CLI_RENDER_RENDER_EXR_H

#include <stdio.h>

#include "cli/common/options.h"
#include "image/picture.h"

/* --exr. */
typedef struct exr_choice {
    bool half;
    exr_packing packing;
    bool alpha, z, acescg, parts;
    uint32_t crypto;       /* N of N × N rays a pixel for mattes; 0: none */
    uint32_t crypto_names; /* what the mattes are named after, once the scene is known */
} exr_choice;

/* "half,piz,alpha,z,acescg,parts,cryptomatte:8" into an exr_choice. */
option_set option_exr;

static inline bool exr_choice_is_plain(const exr_choice *c) { return !(c->half || c->packing || c->alpha || c->z || c->acescg || c->parts || c->crypto); }

/* The words that are not the default, each behind a space; nothing where there are none. */
void exr_choice_write(FILE *stream, const exr_choice *choice);

/* How the picture of the scene is packed and described. `fps` frames a second. */
exr_desc exr_desc_of(const exr_choice *choice, const mgt_scene *scene, double fps);

/* Turns the crop's depths from metres along each ray into metres along the direction of view; infinities stay. */
void exr_planar_depth(float *depth, const mgt_scene *scene);

/* Turns linear sRGB into ACEScg, 3 floats a pixel. */
void exr_to_acescg(float *color, size_t pixels);

#endif
