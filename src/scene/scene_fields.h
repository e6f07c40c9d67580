/* SPDX-License-Identifier: MIT
 *
 * The scene format as one table of keys, types, ranges, units and meanings. The reader, messages, the text for the render hash, the JSON Schema and the
 * documentation use it.
 */
#ifndef MANGATA_SCENE_SCENE_FIELDS_H
#define MANGATA_SCENE_SCENE_FIELDS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "params/field.h"
#include "scene/scene_text.h"
#include "sea/spectrum_model.h"

/* ---- the values of a file ------------------------------------------------------------------------------ */

typedef struct scene_list {
    void *items; /* owned */
    size_t count;
    bool otherwise; /* an item of the file has the other form, see field_row.other */
} scene_list;

typedef struct scene_keyframe {
    double time; /* mgt_scene.time of this camera, seconds */
    mgt_camera camera;
} scene_keyframe;

typedef struct scene_camera {
    mgt_camera still;
    scene_list path; /* items are scene_keyframe; empty: the camera is `still` */
} scene_camera;

typedef struct scene_clock {
    double start; /* time of frame 0, seconds */
    double fps;
    uint32_t frames;
    double shutter; /* fraction of a frame's interval in which the shutter is open */
} scene_clock;

typedef struct scene_spectrum {
    spectrum_settings settings;
    uint32_t count, seed;
    char *file; /* owned; NULL: none */
} scene_spectrum;

/* A whole sea by the wind alone. */
typedef struct scene_wind {
    double speed;         /* at 10 m, m/s; 0: there is no wind */
    double direction_deg; /* where it comes from */
    double fetch;         /* m; 0: the sea is fully developed */
    double depth;         /* m; 0: deep water */
    uint32_t count, seed;
} scene_wind;

/* Swell: waves that have left the wind that made them. */
typedef struct scene_swell {
    double height;        /* significant wave height, m */
    double period;        /* period of the peak, s */
    double direction_deg; /* where it comes from */
    double spread;        /* s of cos^2s of half the angle */
    uint32_t count, seed;
} scene_swell;

scene_swell scene_swell_defaults(void); /* the height has no default */

/* Named waters, each with its absorption and scattering. */
typedef enum scene_clarity { CLARITY_PURE, CLARITY_CLEAR, CLARITY_COASTAL, CLARITY_MURKY } scene_clarity;

typedef struct scene_foam {
    double amount, share, persistence;
} scene_foam;

typedef struct scene_water {
    scene_list waves; /* items are mgt_wave */
    scene_spectrum spectrum;
    scene_wind wind;  /* replaces `waves` and `spectrum`; speed 0: there is none */
    scene_list swell; /* items are scene_swell, whose waves are added to all others */
    double height;    /* factor on the heights of all waves */
    scene_list sea;   /* all waves as they are rendered: `waves` and those of spectrum, wind and swells, times `height`; no key, scene_sea_fill() makes it */
    double index_of_refraction;
    double level;
    float choppiness;
    scene_foam foam;
    scene_clarity clarity; /* named water; reading it sets `absorption` and `scattering`, and nothing reads it later */
    float absorption[3], scattering[3];
    float body_albedo[3];
} scene_water;

/* The pose of a mesh. It is scaled, rotated about z, x and y in this order, and moved. */
typedef struct scene_pose {
    double position[3];
    double rotation_deg[3];
    double scale[3];
} scene_pose;

typedef struct scene_material {
    bool given;        /* the scene file has it; it replaces the materials of a mesh's file */
    mgt_material look; /* the material without its texture, which `texture` names */
    char *texture;     /* owned; NULL: there is none */
} scene_material;

typedef enum scene_shape { SHAPE_MESH, SHAPE_PLANE, SHAPE_BOX, SHAPE_SPHERE, SHAPE_STEPS, SHAPE_POOL, SHAPE_FLOOR } scene_shape;
extern const char *const scene_shape_names[]; /* NULL-terminated */

typedef struct scene_object {
    char *name, *mesh, *heights; /* owned; NULL: none */
    scene_shape shape;
    double size[3];
    uint32_t triangles, count;
    double rim_width, rim_height;
    bool dry;
    double lowest, highest;
    scene_pose pose;
    scene_list instances; /* items are scene_pose */
    scene_material material;
} scene_object;

/* off, on, or auto, which the wind and for stars and night tint also the light decide. */
typedef enum scene_when { WHEN_AUTO, WHEN_OFF, WHEN_ON } scene_when;

typedef struct scene_exposure {
    bool automatic;
    double stops; /* exposure if it is not automatic */
} scene_exposure;

typedef struct scene_post {
    scene_exposure exposure;
    double exposure_offset; /* added to the automatic exposure, stops */
    mgt_tone_map tone_map;
    float glare;
    scene_when night_tint;
} scene_post;

typedef struct scene_sky {
    mgt_sky look;
    scene_when aerial, stars;
} scene_sky;

typedef struct scene_values {
    uint32_t version;
    char *description; /* owned; NULL: none */
    mgt_image image;
    scene_camera camera;
    scene_clock time;
    mgt_light light;
    scene_sky sky;
    scene_water water;
    scene_list objects; /* items are scene_object */
    scene_post post;
    mgt_quality quality;         /* it may have options that its method does not take, for other methods */
    struct scene_models *models; /* models of the objects, which copies share; NULL: none, or not loaded. No key of the format */
} scene_values;

/* The defaults of mgt_scene_init() and of the format. */
scene_values scene_values_defaults(void);
mgt_material scene_material_defaults(void);
void scene_values_free(scene_values *values);

/* Makes a copy with its own lists and texts, which scene_values_free() frees. Models are shared. False: out of memory, and *out is empty. */
bool scene_values_copy(scene_values *out, const scene_values *values);

/* Whether the waves are more than the explicit ones, so that `sea` is needed. */
static inline bool scene_water_has_sea(const scene_water *water)
{
    return water->spectrum.settings.kind != SPECTRUM_NONE || water->wind.speed > 0 || water->swell.count > 0 || water->height != 1;
}

/* Whether the air is seen, with `auto` resolved. */
static inline bool scene_values_aerial(const scene_values *values)
{
    return values->sky.aerial == WHEN_ON || (values->sky.aerial == WHEN_AUTO && values->water.wind.speed > 0);
}
/* Whether stars or night tint are on, with `auto` resolved. */
bool scene_values_by_night(const scene_values *values, scene_when when);

/* All waves as they are rendered. `water` owns them. */
static inline scene_list scene_water_all(const scene_water *water) { return scene_water_has_sea(water) ? water->sea : water->waves; }

/* ---- the table ------------------------------------------------------------------------------------------ */

enum { SCENE_SHAPE_TRIANGLES = 4194304 }; /* largest number of triangles of a built-in shape */

/* The row of the format: a mapping whose struct is scene_values. */
const field_row *scene_root_field(void);

/* The text of scene_file_canonical(). */
char *scene_values_canonical(const scene_values *values, size_t *length);

#endif
