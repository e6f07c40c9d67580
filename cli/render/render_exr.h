/* SPDX-License-Identifier: MIT */
/* The options of --exr, and what they need: packing, alpha, planar depth, crop and camera of an EXR file. */
#ifndef MANGATA_CLI_RENDER_RENDER_EXR_H
#define MANGATA_CLI_RENDER_RENDER_EXR_H

#include <stdio.h>

#include "cli/common/options.h"
#include "image/picture.h"

/* What one word alone can choose. */
enum { EXR_BITS, EXR_PACKING, EXR_MATTES, EXR_KINDS };

/* The value of --exr. All zero: the default. */
typedef struct exr_choice {
    bool half; /* 16-bit floats */
    exr_packing packing;
    char words[EXR_KINDS][16];    /* the words that have chosen the two and `crypto`; "": none yet */
    bool alpha, z, acescg, parts; /* channel A, channel Z of planar depth, ACEScg instead of linear sRGB, a part for each layer */
    uint32_t crypto;              /* mattes by N × N rays per pixel, this being N; 0: no mattes */
    uint32_t crypto_names;        /* render_crypto_names() of the scene; 0: it has not been loaded */
} exr_choice;

/* Reads words such as "half,piz,alpha,z,acescg,parts,cryptomatte:8". `place` is an exr_choice. */
option_set option_exr;

/* Whether the choice is the default. */
static inline bool exr_choice_is_plain(const exr_choice *c) { return !(c->half || c->packing || c->alpha || c->z || c->acescg || c->parts || c->crypto); }

/* Writes the words that differ from the default, each after a blank. */
void exr_choice_write(FILE *stream, const exr_choice *choice);

/* Packing and attributes of a picture of the scene. `fps` is the number of frames per second. */
exr_desc exr_desc_of(const exr_choice *choice, const mgt_scene *scene, double fps);

/* Converts the depths of the crop from metres along each ray to metres along the direction of view, in place. Infinite depths stay. */
void exr_planar_depth(float *depth, const mgt_scene *scene);

/* Converts linear sRGB to ACEScg in place, 3 floats per pixel. */
void exr_to_acescg(float *color, size_t pixels);

#endif
