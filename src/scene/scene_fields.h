/* SPDX-License-Identifier: MIT
 *
 * The scene format as one table: keys, types, ranges, units, meanings. Reading, messages, the render hash's text, the
 * JSON Schema and the documentation all walk it.
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
    bool otherwise; /* the file has an item in its other form */
} scene_list;

typedef struct scene_keyframe {
    double time; /* seconds, as mgt_scene.time */
    mgt_camera camera;
} scene_keyframe;

typedef struct scene_camera {
    mgt_camera still;
    scene_list path; /* of scene_keyframe; empty: the still camera */
} scene_camera;

typedef struct scene_clock {
    double start; /* seconds */
    double fps;
    uint32_t frames;
    double shutter; /* share of a frame's interval */
} scene_clock;

typedef struct scene_spectrum {
    spectrum_settings settings;
    uint32_t count, seed;
    char *file; /* owned; NULL: none */
} scene_spectrum;

/* A whole sea from the wind alone. */
typedef struct scene_wind {
    double speed; /* m/s at 10 m; 0: none */
    double direction_deg;
    double fetch, depth; /* m; 0: a fully developed sea, deep water */
    uint32_t count, seed;
} scene_wind;

/* Waves that have left their wind. */
typedef struct scene_swell {
    double height;        /* significant, m */
    double period;        /* of the peak, s */
    double direction_deg; /* where it comes from */
    double spread;        /* s of cos^2s of half the angle */
    uint32_t count, seed;
} scene_swell;

scene_swell scene_swell_defaults(void); /* but for the height */

/* Named waters: each sets absorption and scattering. */
typedef enum scene_clarity { CLARITY_PURE, CLARITY_CLEAR, CLARITY_COASTAL, CLARITY_MURKY } scene_clarity;

typedef struct scene_foam {
    double amount, share, persistence;
} scene_foam;

typedef struct scene_water {
    scene_list waves; /* of mgt_wave */
    scene_spectrum spectrum;
    scene_wind wind;  /* in place of both */
    scene_list swell; /* of scene_swell, beside all others */
    double height;    /* factor on those of all waves */
    scene_list sea;   /* not of the format: `waves`, those of a spectrum and those of swells, times the factor; made by scene_sea_fill() where it is needed */
    double index_of_refraction;
    double level;
    float choppiness;
    scene_foam foam;
    scene_clarity clarity; /* only while it is read: what it says is then in the next two */
    float absorption[3], scattering[3];
    float body_albedo[3];
} scene_water;

/* Where a mesh stands: scaled, turned about z, then x, then y, and moved. */
typedef struct scene_pose {
    double position[3];
    double rotation_deg[3];
    double scale[3];
} scene_pose;

typedef struct scene_material {
    bool given;        /* stands in the file, in place of the materials of a mesh's own file */
    mgt_material look; /* but for its texture */
    char *texture;     /* owned; NULL: none */
} scene_material;

typedef enum scene_shape { SHAPE_MESH, SHAPE_PLANE, SHAPE_BOX, SHAPE_SPHERE, SHAPE_STEPS, SHAPE_POOL, SHAPE_FLOOR } scene_shape;
extern const char *const scene_shape_names[]; /* ends with NULL */

typedef struct scene_object {
    char *name, *mesh, *heights; /* owned; NULL: none */
    scene_shape shape;
    double size[3];
    uint32_t triangles, count;
    double rim_width, rim_height;
    bool dry;
    double lowest, highest;
    scene_pose pose;
    scene_list instances; /* of scene_pose */
    scene_material material;
} scene_object;

/* auto: as water.wind and the light say. */
typedef enum scene_when { WHEN_AUTO, WHEN_OFF, WHEN_ON } scene_when;

typedef struct scene_exposure {
    bool automatic;
    double stops; /* when not automatic */
} scene_exposure;

typedef struct scene_post {
    scene_exposure exposure;
    double exposure_offset; /* when automatic */
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
    scene_list objects; /* of scene_object */
    scene_post post;
    mgt_quality quality;         /* with options that its method does not take: another may */
    struct scene_models *models; /* not of the format: what the objects are made of, shared by copies; NULL: none, or not loaded */
} scene_values;

/* What mgt_scene_init() and the format's own defaults say. */
scene_values scene_values_defaults(void);
mgt_material scene_material_defaults(void);
void scene_values_free(scene_values *values);

/* A copy with lists and text of its own, to be freed with scene_values_free(); models are shared. False when memory runs out; *out is then empty. */
bool scene_values_copy(scene_values *out, const scene_values *values);

/* Whether the waves are not simply the ones written out. */
static inline bool scene_water_has_sea(const scene_water *water)
{
    return water->spectrum.settings.kind != SPECTRUM_NONE || water->wind.speed > 0 || water->swell.count > 0 || water->height != 1;
}

/* What `auto` stands for. */
static inline bool scene_values_aerial(const scene_values *values)
{
    return values->sky.aerial == WHEN_ON || (values->sky.aerial == WHEN_AUTO && values->water.wind.speed > 0);
}
bool scene_values_by_night(const scene_values *values, scene_when when);

/* All waves as they are rendered. Belongs to `water`. */
static inline scene_list scene_water_all(const scene_water *water) { return scene_water_has_sea(water) ? water->sea : water->waves; }

/* ---- the table ------------------------------------------------------------------------------------------ */

enum { SCENE_SHAPE_TRIANGLES = 4194304 }; /* of a built-in shape */

/* The format: a mapping whose struct is scene_values. */
const field_row *scene_root_field(void);

/* The text behind scene_file_canonical(). */
char *scene_values_canonical(const scene_values *values, size_t *length);

#endif
