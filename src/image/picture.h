/* SPDX-License-Identifier: MIT */
/* Still pictures: writers of PNG, EXR and PFM from the caller's memory, and a reader that gives float pixels. */
#ifndef MANGATA_IMAGE_PICTURE_H
#define MANGATA_IMAGE_PICTURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "image/file_error.h"
#include "image/metadata.h"
#include "image/output_file.h"

typedef enum picture_format { PICTURE_UNKNOWN = 0, PICTURE_PNG, PICTURE_EXR, PICTURE_PFM, PICTURE_MP4, PICTURE_MOV, PICTURE_Y4M, PICTURE_SUMS } picture_format;

/* The format by a path's extension, in upper or lower case. */
picture_format picture_format_of(const char *path);

/* ---- writers: whole or not at all; nothing is copied but a few rows ------------------------------------------------- */

/* One float layer in the caller's memory. */
typedef struct picture_layer {
    const char *name;      /* "color", "coverage", "mask", "depth", "normal", or another name of [A-Za-z0-9_]+ */
    const char *channel;   /* EXR, layer of 1 channel: the channel's whole name, such as "A"; NULL: it follows from `name` */
    const char *part;      /* EXR of several parts: name of the layer's part; NULL: `name` */
    bool exact;            /* EXR: the layer has 32 bits in files of half floats, too; for distances and counts */
    uint32_t channels;     /* number of channels to write: 1 or 3 */
    const float *pixels;   /* top left pixel */
    uint32_t pixel_floats; /* floats from a pixel to its right neighbour: 1, 3, 4, …; 0: `channels` */
    ptrdiff_t row_stride;  /* bytes from a row to the next one below; may be negative; 0: rows are tightly packed */
} picture_layer;

/* Writes an 8-bit sRGB PNG with an sRGB chunk and without a time. Metadata are tEXt, or iTXt if they are not ASCII. `rgba`: four bytes per pixel, top left
 * first; alpha is not written. `row_stride`: see picture_layer. */
file_status picture_write_png(const char *path, uint32_t width, uint32_t height, const uint8_t *rgba, ptrdiff_t row_stride, const metadata_list *metadata,
                              const output_options *options, file_error *error);

/* Writes such a PNG with alpha. */
file_status picture_write_png_alpha(const char *path, uint32_t width, uint32_t height, const uint8_t *rgba, ptrdiff_t row_stride, const metadata_list *metadata,
                                    const output_options *options, file_error *error);

/* Writes a scanline EXR of 32-bit floats with ZIP. Channels by layer: color R,G,B · coverage, mask coverage.Y, mask.Y · depth depth.Z · normal normal.X,.Y,.Z ·
 * any other NAME.Y or NAME.R,.G,.B. Metadata are string attributes. Layer names must differ. */
file_status picture_write_exr(const char *path, uint32_t width, uint32_t height, const picture_layer *layers, size_t layer_count, const metadata_list *metadata,
                              const output_options *options, file_error *error);

typedef enum exr_packing { EXR_PACKING_ZIP = 0, EXR_PACKING_PIZ, EXR_PACKING_NONE } exr_packing;

/* Packing of an EXR, and its standard attributes. All zero: ZIP, 32 bits, the pixels are the whole picture, and there are no attributes. */
typedef struct exr_desc {
    exr_packing packing;
    bool half;                        /* 16 bits; finite values beyond ±65504 are clamped */
    bool parts;                       /* layers of one picture_layer.part share a part of the file; the first part has the metadata */
    const metadata_entry *attributes; /* further string attributes of the part of the last layer, by their whole names */
    size_t attribute_count;
    uint32_t x, y;                          /* top left pixel's place in the whole picture, for data window and display window */
    uint32_t display_width, display_height; /* size of the whole picture; 0: that of the pixels */
    bool described;                         /* all further members are written */
    bool acescg;                            /* chromaticities: primaries of ACES (AP1); false: of sRGB */
    double nits;                            /* whiteLuminance: luminance of white (1, 1, 1), cd/m² */
    double frames_per_second;               /* framesPerSecond; 0: not written */
    double exposure;                        /* expTime, seconds; 0: not written */
    double screen_width;                    /* screenWindowWidth: width of the picture at distance 1 from the camera */
    double world_to_camera[4][4];           /* worldToCamera, for row vectors: x right, y up, z in the direction of view */
    double world_to_ndc[4][4];              /* worldToNDC, for row vectors: (0, 0) to (1, 1) is the display window, y down */
} exr_desc;

/* Writes an EXR with this packing and these attributes. */
file_status picture_write_exr_described(const char *path, uint32_t width, uint32_t height, const picture_layer *layers, size_t layer_count,
                                        const exr_desc *desc, const metadata_list *metadata, const output_options *options, file_error *error);

/* Writes a PFM: "Pf" with 1 channel or "PF" with 3, little endian, bottom row first. Metadata go to the sidecar PATH.json; NULL: there is none. */
file_status picture_write_pfm(const char *path, uint32_t width, uint32_t height, const picture_layer *layer, const metadata_list *metadata,
                              const output_options *options, file_error *error);

/* ---- reader -------------------------------------------------------------------------------------------------------- */

/* A picture of float pixels, top row first, tightly packed. */
typedef struct float_image {
    uint32_t width, height;
    uint32_t channels; /* 1 … 4 */
    float *pixels;     /* width · height · channels values; owned, see float_image_free() */
} float_image;

/* Reads a picture. The format follows from the content, not from the extension. PNG: 8 or 16 bits, values divided by 255 or 65535; 1 channel for grey, 3 for
 * colour, and one more for alpha unless it is opaque everywhere. EXR: scanlines of half, float or uint, without DWA. `layer`: an EXR layer of any part
 * ("depth"), a channel ("depth.Z") or a part; NULL: "color", or the only layer; PNG and PFM ignore it. Colour of an
 * EXR whose chromaticities are not those of sRGB is converted to these. On failure *image is zeroed. */
file_status picture_read(float_image *image, const char *path, const char *layer, file_error *error);

/* Where the pixels of an EXR lie in its whole picture, the corner of its data window; 0, 0 for other pictures. False: it cannot be read. */
bool picture_origin(const char *path, int32_t origin[2]);

void float_image_free(float_image *image);

#endif
