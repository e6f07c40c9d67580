/* SPDX-License-Identifier: MIT */
/* Still pictures: writers of PNG, EXR and PFM from the caller's memory, and the reader into float pixels. */
#ifndef MANGATA_IMAGE_PICTURE_H
#define MANGATA_IMAGE_PICTURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/metadata.h"
#include "image/output_file.h"

typedef enum picture_format { PICTURE_UNKNOWN = 0, PICTURE_PNG, PICTURE_EXR, PICTURE_PFM, PICTURE_MP4, PICTURE_MOV, PICTURE_Y4M, PICTURE_SUMS } picture_format;

/* By the extension, upper or lower case. */
picture_format picture_format_of(const char *path);

/* ---- writers: whole or not at all; nothing is copied but a few rows ------------------------------------------------- */

/* One float layer in the caller's memory. */
typedef struct picture_layer {
    const char *name;      /* "color", "coverage", "mask", "depth", "normal"; others as [A-Za-z0-9_]+ */
    const char *channel;   /* EXR, of 1 channel: its whole name, such as "A"; NULL: after `name` */
    const char *part;      /* EXR of several parts: the name of its part; NULL: `name` */
    bool exact;            /* EXR: 32 bits in files of half floats too, for distances and counts */
    uint32_t channels;     /* channels to write: 1 or 3 */
    const float *pixels;   /* top left pixel */
    uint32_t pixel_floats; /* floats from a pixel to its right neighbour: 1, 3, 4, …; 0: `channels` */
    ptrdiff_t row_stride;  /* bytes from a row to the next one below, may be negative; 0: tightly packed */
} picture_layer;

/* 8-bit sRGB PNG (sRGB chunk, metadata as tEXt, or iTXt where not ASCII, no time). `rgba`: four bytes a pixel, top left first;
 * alpha is not written. `row_stride` in bytes as above. */
file_status picture_write_png(const char *path, uint32_t width, uint32_t height, const uint8_t *rgba, ptrdiff_t row_stride, const metadata_list *metadata,
                              const output_options *options, file_error *error);

/* The same with alpha. */
file_status picture_write_png_alpha(const char *path, uint32_t width, uint32_t height, const uint8_t *rgba, ptrdiff_t row_stride, const metadata_list *metadata,
                                    const output_options *options, file_error *error);

/* Scanline EXR, 32-bit float, ZIP. Channels by layer: color R,G,B · coverage, mask coverage.Y, mask.Y · depth depth.Z ·
 * normal normal.X,.Y,.Z · any other NAME.Y or NAME.R,.G,.B. Metadata as string attributes. Layer names must differ. */
file_status picture_write_exr(const char *path, uint32_t width, uint32_t height, const picture_layer *layers, size_t layer_count, const metadata_list *metadata,
                              const output_options *options, file_error *error);

typedef enum exr_packing { EXR_PACKING_ZIP = 0, EXR_PACKING_PIZ, EXR_PACKING_NONE } exr_packing;

/* How an EXR is packed and what it says of its pixels in the format's own attributes. All zero: ZIP, 32 bits,
 * pixels that are the whole picture, no attributes. */
typedef struct exr_desc {
    exr_packing packing;
    bool half;                        /* 16 bits; finite values beyond ±65504 become these */
    bool parts;                       /* a part for each layer, or for the layers of one `part`; metadata stand in the first */
    const metadata_entry *attributes; /* further string attributes of the part of the layer that comes last, by their whole names */
    size_t attribute_count;
    uint32_t x, y;                          /* of the pixels' corner in the whole picture: data window and display window */
    uint32_t display_width, display_height; /* of the whole picture; 0: as large as the pixels */
    bool described;                         /* whether all that follows is written */
    bool acescg;                            /* primaries of ACES (AP1), else of sRGB: chromaticities */
    double nits;                            /* of white, 1 1 1: whiteLuminance */
    double frames_per_second;               /* framesPerSecond; 0: not written */
    double exposure;                        /* seconds: expTime; 0: not written */
    double screen_width;                    /* of the picture, at distance 1 of the camera: screenWindowWidth */
    double world_to_camera[4][4];           /* worldToCamera, of row vectors: x right, y up, z in the direction of view */
    double world_to_ndc[4][4];              /* worldToNDC, of row vectors: (0, 0) to (1, 1) is the display window, y down */
} exr_desc;

/* The same, packed and described. */
file_status picture_write_exr_described(const char *path, uint32_t width, uint32_t height, const picture_layer *layers, size_t layer_count,
                                        const exr_desc *desc, const metadata_list *metadata, const output_options *options, file_error *error);

/* "Pf" (1 channel) or "PF" (3), little endian, bottom row first. Metadata go to the sidecar PATH.json, which appears after the
 * picture; with NULL none is written. */
file_status picture_write_pfm(const char *path, uint32_t width, uint32_t height, const picture_layer *layer, const metadata_list *metadata,
                              const output_options *options, file_error *error);

/* ---- reader -------------------------------------------------------------------------------------------------------- */

/* Float pixels, top row first, tightly packed. */
typedef struct float_image {
    uint32_t width, height;
    uint32_t channels; /* 1 … 4 */
    float *pixels;     /* width · height · channels; owned, see float_image_free */
} float_image;

/* Reads .png (8 and 16 bit, values as stored / 255 or / 65535; grey 1 channel, colour 3, alpha added only where it is not
 * opaque everywhere), .pfm or .exr (scanlines of half, float or uint; not DWA). `layer`: an EXR layer ("depth"), of
 * any part, channel ("depth.Z") or part, NULL for "color" or else the only layer there is; PNG and PFM hold one layer and ignore it. The kind is told by
 * the content, not by the extension. On failure *image is all zero. */
file_status picture_read(float_image *image, const char *path, const char *layer, file_error *error);

void float_image_free(float_image *image);

#endif
