/* SPDX-License-Identifier: MIT
 * One row per method. All code that names, checks, lists, prepares or runs methods reads these rows. A new method needs a row, a kernel, and an entry in the
 * CPU's array of entry points. */
#ifndef MANGATA_PARAMS_METHODS_H
#define MANGATA_PARAMS_METHODS_H

#include "mangata/mangata.h"

/* How a method renders. */
typedef enum method_way {
    METHOD_CENTRE,    /* each pixel is shaded once, at its centre, by the surface with all its waves */
    METHOD_SAMPLES,   /* each pixel is the mean of jittered point samples */
    METHOD_FILTERED,  /* each pixel is shaded once, by the distribution of the slopes that it covers */
    METHOD_PASS,      /* a pass works on whole pictures of the method `base` */
    METHOD_REFERENCE, /* the reference renders, see src/reference */
} method_way;

typedef enum method_pass { METHOD_PASS_NONE = 0, METHOD_PASS_FXAA, METHOD_PASS_TAA, METHOD_PASS_ADAPTIVE, METHOD_PASSES } method_pass;

/* The transition between resolved and unresolved waves. src/frame/frame.c has the numbers. */
typedef enum method_transition { TRANSITION_MANGATA = 0, TRANSITION_PODEE, TRANSITION_BRUNETON } method_transition;

/* Bits of the tables that a method needs. */
enum { METHOD_LEAN_MAP = 1, METHOD_PODEE_TABLES = 2 };

/* A compute shader. `kernel` is the file that its line #include "method.k" includes. `result` is the kernel's function. */
typedef struct method_shader {
    const char *pass, *kernel, *result;
} method_shader;

typedef struct method_row {
    mgt_method_properties properties; /* its struct_size is 0 */
    method_way way;
    mgt_method base; /* METHOD_PASS: the method that renders its pictures and the layers that the pass does not change */
    method_pass pass;
    method_transition transition;
    bool from_middle;            /* a moving camera is seen from the middle of its way, see CameraMotion; else from both ends of the shutter */
    bool keeps_phases;           /* unresolved waves are evaluated one by one, not as a sum */
    uint32_t hits;               /* number of hits, one above the other, of a pixel in grazing water near the camera; 0: no tile of the method is grazing */
    uint32_t tables;             /* METHOD_LEAN_MAP and METHOD_PODEE_TABLES */
    bool numbered;               /* the number of strata along a pixel's side follows the name, as in ssaa4 */
    uint32_t spatial, time;      /* default numbers of samples; 0: 1, or by the number behind the name */
    uint32_t samples;            /* value of the layer `samples` of methods without strata; 0: 1 */
    const method_shader *shader; /* OpenGL: the method's shader; rows with the same pointer share a program */
    const method_shader *with_tables; /* OpenGL: the shader if quality.kernels needs tables; NULL: `shader` */
} method_row;

enum { METHOD_SLOTS = 32 }; /* size of arrays by method */

extern const method_row method_rows[]; /* indices are mgt_method; the last row has no name */
extern const size_t method_count;
const method_row *method_of(mgt_method method);
/* Whether the method takes numbers of samples per pixel and shutter: spatial_samples and time_samples. */
bool method_is_sampled(mgt_method method);
/* Number of samples of a pixel, for methods that take samples. */
uint64_t quality_samples(const mgt_quality *quality);
/* Number of samples of each pixel, as in layer `samples` without a range. 0: pixels differ, as those of adaptive. */
uint64_t quality_pixel_samples(const mgt_quality *quality);
/* Number of samples that sample_first and sample_count select from: the samples of a pixel, or for method adaptive the sample slots of the picture. 0: the
 * method has neither ranges nor sums. */
uint64_t quality_range(const mgt_quality *quality);

enum { METHOD_SIDE_DEFAULT = 4, METHOD_SIDE_MOST = 1024 }; /* strata along a pixel's side of "ssaa", and the most of "ssaaN" */

/* Sets the method and its default numbers of samples by a name such as "mangata" or "ssaa4"; "ssaa" is "ssaa4". False: there is no such method. */
bool method_from_name(const char *name, mgt_quality *quality);

/* Whether a legal name says the number of strata, as "ssaa4" does and "ssaa" does not. */
bool method_name_has_number(const char *name);

typedef struct method_text {
    char text[24];
} method_text;
/* The method's name, with its number of strata if it is numbered. */
method_text method_name(const mgt_quality *quality);

/* All methods' names, for messages: "none, ssaaN (N from 1 to 1024), …". */
typedef struct method_names_text {
    char text[400];
} method_names_text;
method_names_text method_names(void);

#endif
