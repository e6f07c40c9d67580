/* SPDX-License-Identifier: MIT
 * One row a method: all that names, checks, lists, prepares or runs methods reads it here. A new method is a row, a kernel and an entry in the CPU's array
 * of entry points. */
#ifndef MANGATA_PARAMS_METHODS_H
#define MANGATA_PARAMS_METHODS_H

#include "mangata/mangata.h"

/* How a picture comes about. */
typedef enum method_way {
    METHOD_CENTRE,    /* one shading a pixel, of the surface with all its waves */
    METHOD_SAMPLES,   /* a mean of jittered point samples */
    METHOD_FILTERED,  /* one shading a pixel, of the slopes that it covers */
    METHOD_PASS,      /* a pass over whole pictures of the method `base` */
    METHOD_REFERENCE, /* src/reference */
} method_way;

typedef enum method_pass { METHOD_PASS_NONE = 0, METHOD_PASS_FXAA, METHOD_PASS_TAA, METHOD_PASS_ADAPTIVE, METHOD_PASSES } method_pass;

/* Where waves turn from resolved to unresolved; src/frame/frame.c has the numbers. */
typedef enum method_transition { TRANSITION_MANGATA = 0, TRANSITION_PODEE, TRANSITION_BRUNETON } method_transition;

/* Bits: tables that are made before pixels are. */
enum { METHOD_LEAN_MAP = 1, METHOD_PODEE_TABLES = 2 };

/* A compute shader. `kernel` is what the line #include "method.k" in it stands for, and `result` the kernel's function. */
typedef struct method_shader {
    const char *pass, *kernel, *result;
} method_shader;

typedef struct method_row {
    mgt_method_properties properties; /* struct_size left 0 */
    method_way way;
    mgt_method base; /* of METHOD_PASS: of its pictures, and of what it does not change */
    method_pass pass;
    method_transition transition;
    bool keeps_phases;                /* unresolved waves count one by one, not as a sum */
    uint32_t hits;                    /* of a pixel in grazing water near the eye, which is filtered by the faces that it shows; 0: it is as other water is */
    uint32_t tables;                  /* METHOD_LEAN_MAP and others */
    bool numbered;                    /* the name is followed by the number of strata along a side, as in ssaa4 */
    uint32_t spatial, time;           /* samples by default; 0: 1 */
    uint32_t samples;                 /* layer `samples`, unless strata decide; 0: 1 */
    const method_shader *shader;      /* OpenGL; rows that point to the same one share a program. The CPU has entry points by method */
    const method_shader *with_tables; /* instead, where quality.kernels asks for tables; NULL: none */
} method_row;

enum { METHOD_SLOTS = 32 }; /* room for rows in arrays by method */

extern const method_row method_rows[]; /* by mgt_method, ended by one without a name */
extern const size_t method_count;
const method_row *method_of(mgt_method method);
/* Whether it takes samples by pixel and shutter: the options of ssaa. */
bool method_is_sampled(mgt_method method);
/* Samples of a pixel, of a method that takes some. */
uint64_t quality_samples(const mgt_quality *quality);
/* How many samples a range is taken from, those of a pixel or, of adaptive, the slots of the picture. 0: there are no ranges, and no sums. */
uint64_t quality_range(const mgt_quality *quality);

enum { METHOD_SIDE_DEFAULT = 4 }; /* N of "ssaa" */

/* A name such as "mangata" or "ssaa4", with the method's default numbers of samples; "ssaa" stands for "ssaa4". False: there is none. */
bool method_from_name(const char *name, mgt_quality *quality);

typedef struct method_text {
    char text[24];
} method_text;
method_text method_name(const mgt_quality *quality);

/* All names, for messages: "none, ssaaN (N from 1 to 1024), …". */
typedef struct method_names_text {
    char text[400];
} method_names_text;
method_names_text method_names(void);

#endif
