/* SPDX-License-Identifier: MIT
 *
 * Everything a frame depends on: image, camera, light, sky, water, objects, display and quality. */
#ifndef MANGATA_SCENE_H
#define MANGATA_SCENE_H

#include "mangata/objects.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One sine wave, which raises the water by amplitude · sin(kx·x + kz·z + omega·t + phase). It travels against (kx, kz) where omega is positive.
 * Scene files and Podee et al. 2021, Eq. 1, call kx, kz and omega a, b and c. */
typedef struct mgt_wave {
    double amplitude; /* metres, 0 … 1000 */
    double kx, kz;    /* wave vector, radians per metre, ±1e5 */
    double omega;     /* angular frequency, radians per second, ±1e5 */
    double phase;     /* radians, ±1e9 */
} mgt_wave;

/* The picture, and the part of it that is rendered. */
typedef struct mgt_image {
    uint32_t width, height;                           /* of the whole image, pixels, 1 … MGT_MAX_IMAGE_SIDE */
    uint32_t crop_x, crop_y, crop_width, crop_height; /* the part, within the image; crop_width or crop_height 0: up to the edge */
} mgt_image;

/* A pinhole camera. Coordinates are within ±1e9. */
typedef struct mgt_camera {
    double position[3]; /* metres; under water where it is below water.level */
    double target[3];   /* metres; a point in front, which must differ from position */
    double up[3];       /* must not be parallel to the view */
    double fov_y_deg;   /* vertical field of view, (0, 179) */
} mgt_camera;

typedef enum mgt_source { MGT_SOURCE_SUN = 0, MGT_SOURCE_MOON = 1 } mgt_source;

/* One spherical light at infinity. Direction to it: (sin az·cos el, sin el, −cos az·cos el). */
typedef struct mgt_light {
    mgt_source body;           /* kind of sky around it, limb darkening */
    double elevation_deg;      /* [−90, 90]; below 0 no direct light meets the water */
    double azimuth_deg;        /* ±1e6 */
    double angular_radius_deg; /* [1e-4, 20] */
    float radiance[3];         /* kcd/m², linear sRGB, [0, 1e12]; with MGT_SKY_ATMOSPHERE as seen outside the atmosphere */
} mgt_light;

typedef enum mgt_sky_model {
    MGT_SKY_ATMOSPHERE = 0, /* precomputed Rayleigh, Mie and ozone scattering of the light, day to night */
    MGT_SKY_GRADIENT = 1,   /* horizon to zenith */
    MGT_SKY_BLACK = 2       /* the papers' experiments: only the glitter */
} mgt_sky_model;

/* The sky around the light. Luminances are [0, 1e9]. */
typedef struct mgt_sky {
    mgt_sky_model model;
    float turbidity;  /* aerosol amount over clear air, [1, 10]: scales Mie scattering (atmosphere) */
    float zenith[3];  /* kcd/m², linear sRGB (gradient) */
    float horizon[3]; /* kcd/m², linear sRGB (gradient) */
    float night[3];   /* kcd/m², added everywhere: airglow and stars (atmosphere) */
} mgt_sky;

/* The surface and what it is made of. Absorption and scattering dim what is seen through water: scenes with objects. */
typedef struct mgt_water {
    const mgt_wave *waves;      /* wave_count of them, the caller's, read during the call; NULL where wave_count is 0 (a flat mirror) */
    size_t wave_count;          /* 0 … MGT_MAX_WAVES */
    double index_of_refraction; /* of water in air, [1, 3]; 1.333 */
    double level;               /* metres: the height of the mean surface, ±1e6 */
    float absorption[3];        /* absorption coefficient, 1/metre, linear sRGB, [0, 1000] */
    float scattering[3];        /* scattering coefficient, 1/metre, linear sRGB, [0, 1000] */
    float body_albedo[3];       /* fraction of the light entering deep water that it sends up again, linear sRGB, [0, 1]; not with a black sky */
    float choppiness;           /* [0, 1]: horizontal shift towards the crests, as a fraction of that of trochoidal (Gerstner) waves; 0: plain sines */
} mgt_water;

typedef enum mgt_tone_map { MGT_TONE_NONE = 0, MGT_TONE_REINHARD, MGT_TONE_ACES, MGT_TONE_AGX } mgt_tone_map;

/* How radiance becomes displayed colour; used by the 8-bit targets alone, float targets stay scene-linear. */
typedef struct mgt_post {
    bool auto_exposure; /* exposure from light and sky (never from the picture, so that films do not pump) */
    double exposure_ev; /* stops, ±60: added to the automatic exposure or, without it, 2^ev per kcd/m² */
    mgt_tone_map tone_map;
    float glare; /* fraction of the light that the eye scatters, [0, 1] */
} mgt_post;

typedef enum mgt_method {
    MGT_METHOD_NONE = 0,      /* one sample at the pixel's centre at time t */
    MGT_METHOD_SSAA,          /* spatial_samples² jittered samples × time_samples */
    MGT_METHOD_PODEE_UNIFORM, /* Podee et al. 2021, one covariance for the waves above the Nyquist limit (Eq. 3) */
    MGT_METHOD_PODEE_PIXEL,   /* the same with the per-pixel covariance (Eqs. 4–7) */
    MGT_METHOD_MANGATA,       /* this library's own model */
    MGT_METHOD_REFERENCE,     /* brute force in double precision (CPU backend only) */
    /* Baselines, for comparison: docs/methods.md says what is theirs and what is different here. */
    MGT_METHOD_MSAA32,     /* 32 samples of visibility, one shading */
    MGT_METHOD_LEAN,       /* Olano and Baker 2010: a tiled map of slope moments */
    MGT_METHOD_LEADR,      /* Dupuy et al. 2013: the same with masking and shadowing */
    MGT_METHOD_TOKUYOSHI,  /* Tokuyoshi and Kaplanyan 2019: geometric specular anti-aliasing */
    MGT_METHOD_BRUNETON,   /* Bruneton et al. 2010: Gaussian slopes and a point-like sun */
    MGT_METHOD_FXAA,       /* Lottes 2009: `none`, its edges blended afterwards */
    MGT_METHOD_TAA,        /* Karis 2014: `none` jittered over eight frames, history reprojected and clamped */
    MGT_METHOD_TNDF,       /* after Tessari et al. 2020: one Gaussian of slopes over pixel and shutter */
    MGT_METHOD_ADAPTIVE,   /* an analytic picture first, then samples where it is likely to be wrong: docs/adaptive.md */
    MGT_METHOD_GGX_MOMENTS /* as in game engines: GGX from the footprint's slope moments, the light as a representative point (Karis 2013) */
} mgt_method;

/* The waves that a method shades from. */
typedef enum mgt_method_waves {
    MGT_WAVES_POINT = 0, /* all waves at single instants, as point samples meet them */
    MGT_WAVES_INSTANT,   /* at the instant t: those that a pixel resolves, and the slope statistics of the others */
    MGT_WAVES_SHUTTER    /* the same at both ends of the open shutter */
} mgt_method_waves;

/* What can be said of a method without rendering. */
typedef struct mgt_method_properties {
    size_t struct_size;
    const char *name;        /* as commands and files spell it, without the number of ssaaN; static, as the description */
    const char *description; /* one line */
    mgt_method_waves waves;
    uint32_t backends; /* bits 1 << mgt_backend that run it; an OpenGL context renders the others on the CPU */
    uint32_t layers;   /* bits 1 << mgt_layer that it computes; the others are written as constants */
} mgt_method_properties;

/* Fills `properties`; `size` is sizeof *properties, which becomes its struct_size. MGT_ERROR_ARGUMENT, with nothing written: the library knows no such method,
 * or no version of the struct has that size. Methods are numbered from 0 without gaps. Any thread. */
MGT_API mgt_status mgt_method_info(mgt_method method, mgt_method_properties *properties, size_t size);

/* How objects on the other side of the surface are found. docs/refraction.md says which paper each one follows. */
typedef enum mgt_refraction {
    MGT_REFRACTION_TWO_PHASE = 0,  /* this library's own: Liu et al. 2020 in true space, with the waves' heights, iterated */
    MGT_REFRACTION_HYBRID,         /* the same, and rays are traced where it is uncertain */
    MGT_REFRACTION_LIU,            /* Liu et al. 2020: both phases as printed, misprints corrected */
    MGT_REFRACTION_BROAD,          /* its broad phase alone: a flat surface */
    MGT_REFRACTION_NARROW,         /* its narrow phase alone */
    MGT_REFRACTION_SCREEN_SPACE,   /* McGuire and Mara 2014: rays marched through the depth buffer */
    MGT_REFRACTION_DISTANCE_FIELD, /* Rodgman and Chen 2001: rays marched through voxels of distances */
    MGT_REFRACTION_OFF,            /* straight through */
    MGT_REFRACTION_PATH_TRACED     /* rays traced through the waves as they are, many a pixel (CPU backend only) */
} mgt_refraction;

/* How method adaptive finds the pixels that need more samples, and which samples it takes there. */
typedef enum mgt_adaptive {
    MGT_ADAPTIVE_CELLS = 0, /* pixels of method mangata, split into four again and again where the predicted error is largest */
    MGT_ADAPTIVE_PODEE = 1  /* Podee et al., Adaptive Supersampling: samples in proportion to an importance of the approximate picture */
} mgt_adaptive;

/* How podee-* integrates its Gaussian over the light disk and the shutter. */
typedef enum mgt_mixture {
    MGT_MIXTURE_EXACT = 0, /* the ellipse itself, in closed form */
    MGT_MIXTURE_1 = 1,     /* 1, 3, 5 or 9 circular Gaussians, fitted (Podee et al. 2021, App. C), from tables of 64 MiB that the context keeps */
    MGT_MIXTURE_3 = 3,
    MGT_MIXTURE_5 = 5,
    MGT_MIXTURE_9 = 9,
    MGT_MIXTURE_FELINE = 32, /* circular Gaussians placed by the formulae of McCormack et al. 1999 */
    MGT_MIXTURE_RIEMANN = 33 /* a sum over the disk when the shutter closes: the fallback of Podee et al. 2021, everywhere */
} mgt_mixture;

MGT_API const char *mgt_source_name(mgt_source body);
MGT_API const char *mgt_sky_model_name(mgt_sky_model model);
MGT_API const char *mgt_tone_map_name(mgt_tone_map tone_map);
MGT_API const char *mgt_method_name(mgt_method method);
MGT_API const char *mgt_method_waves_name(mgt_method_waves waves);
MGT_API const char *mgt_refraction_name(mgt_refraction refraction);
MGT_API const char *mgt_adaptive_name(mgt_adaptive adaptive);
MGT_API const char *mgt_mixture_name(mgt_mixture kernels);
MGT_API bool mgt_source_from_name(const char *name, mgt_source *body);
MGT_API bool mgt_sky_model_from_name(const char *name, mgt_sky_model *model);
MGT_API bool mgt_tone_map_from_name(const char *name, mgt_tone_map *tone_map);
MGT_API bool mgt_method_from_name(const char *name, mgt_method *method);
MGT_API bool mgt_method_waves_from_name(const char *name, mgt_method_waves *waves);
MGT_API bool mgt_refraction_from_name(const char *name, mgt_refraction *refraction);
MGT_API bool mgt_adaptive_from_name(const char *name, mgt_adaptive *adaptive);
MGT_API bool mgt_mixture_from_name(const char *name, mgt_mixture *kernels);

/* Settings of quality. Words before a colon name the methods, adaptive schemes or refraction methods that read the member. With others any value
 * but mgt_scene_init()'s is refused with MGT_ERROR_SCENE, "… is for method adaptive alone". Ignored instead are spatial_samples, time_samples, sample_first,
 * sample_count, ndf_mean_drop and tess_error; with podee-* elongation_limit where kernels are exact or riemann, and transition_width where transition_hard.
 * Scene files may hold options of any method; those of others than the one chosen are left out of the scenes that they make. */
typedef struct mgt_quality {
    mgt_method method;
    uint32_t spatial_samples;    /* N of N×N strata a pixel: ssaa, reference; 1 … 1024 */
    uint32_t time_samples;       /* M strata of the shutter: ssaa (1: the instant t), reference; 1 … 65536 */
    uint64_t sample_first;       /* ssaa, reference: first of the N·N·M samples to take; the mean of those that are taken is returned.
                                    adaptive, podee: first of the sample_slots slots, which must be given, on the CPU */
    uint64_t sample_count;       /* how many samples to take; 0: all that remain */
    uint64_t seed;               /* of the jitter */
    bool ndf_mean_drop;          /* podee-pixel: leave the mean slope B out of the path (Podee et al. 2021, Eq. 4 as printed) */
    mgt_mixture kernels;         /* podee-*: how the elliptical Gaussian on the light plane is integrated */
    double elongation_limit;     /* podee-* with kernels: ellipses longer than this, major over minor axis, are summed without time as by
                                 MGT_MIXTURE_RIEMANN, 1 … 1e6; 0: as many as there are kernels (Podee et al. 2021, §3.6), and 1e6 for 1 kernel
                                 and Feline */
    uint32_t path_segments;      /* podee-*: straight pieces of the shutter, each with its own Gaussian, 1 … 64; 0: 1 */
    double transition_width;     /* podee-*: cycles per pixel below the Nyquist limit of 0.5 in which waves turn from resolved to unresolved
                                 (Eq. 20), up to 0.5; 0: 0.3 */
    bool transition_hard;        /* podee-*: no transition, waves turn at 0.5 cycles per pixel (Fig. 11) */
    mgt_adaptive adaptive;       /* adaptive: the scheme. At most one of samples, target_rmse, budget_ms, target_displayed and sample_slots
                                    is set; it says how much is sampled */
    double samples;              /* adaptive: evaluations of all waves per pixel of water, on average, 1 … 4096. Cells and points count by what they
                                 cost; a ray of podee, traced at both ends of the shutter, counts as one. 0: 8 where no other end is given */
    double target_rmse;          /* adaptive, cells: ends where the predicted RMSE of coverage over the image is this, 1e-6 … 1; 0: none */
    double budget_ms;            /* adaptive, cells: ends after so much time, 0.1 … 1e7. The one setting whose pixels depend on the machine; 0: none */
    double importance_center;    /* adaptive, podee: c of Eq. 1, a coverage, up to 1; 0: 0.1 */
    double importance_width;     /* adaptive, podee: ρ of Eq. 1, 1e-6 … 1; 0: 0.04 */
    double importance_threshold; /* adaptive, podee: pixels whose importance (1 at its peak) is not above it get no samples, up to 1; 0: 0.05,
                                 a little more than the importance of a pixel without light */
    mgt_refraction refraction;
    double tess_error;           /* two-phase, hybrid, liu, broad: pixels that a triangle bent by refraction may be off by, 0.01 … 100; 0: 0.1 */
    uint32_t refraction_samples; /* N of N×N rays of refraction a pixel, 1 … 64; 1: one through the pixel's centre; 0: 1, with 4 more at outlines for two-phase,
                                    and 4 for path-traced */
    bool caustics;               /* the light that waves focus on what lies below them */
    uint64_t sample_slots;       /* adaptive, podee: M of Eq. 3, how many samples the picture gets, up to 2^32; 0: as `samples` says */
    /* Options of single methods, and room for those of later versions, zero: 16 in all. */
#define MGT_METHOD_OPTION(name, method, least, most, preset, meaning) double name;
#include "mangata/method_options.h"
    double method_option_room[16
#define MGT_METHOD_OPTION(name, method, least, most, preset, meaning) -1
#include "mangata/method_options.h"
    ];
    double target_displayed; /* adaptive, cells: ends where the predicted RMSE of the displayed luminance (0 to 1, after exposure and tone map) over the
                                image is this, 1e-5 … 1; under a black sky that of coverage; 0: none. An alternative to samples, target_rmse, budget_ms */
} mgt_quality;

/* Everything a frame depends on. Plain data, read during mgt_render() only. */
typedef struct mgt_scene {
    size_t struct_size;
    mgt_image image;
    mgt_camera camera;      /* when the shutter closes */
    mgt_camera camera_open; /* when it opens; used when camera_moves */
    bool camera_moves;
    bool aerial;           /* aerial perspective: the air of MGT_SKY_ATMOSPHERE dims what lies behind it and adds the light that it scatters */
    bool stars;            /* the stars of the naked eye stand in MGT_SKY_ATMOSPHERE; by day it outshines them */
    bool night_tint;       /* 8-bit targets show by night what rods see: bluish, without hue. By day nothing changes */
    float foam;            /* fraction of the water that whitecaps cover, [0, 0.5]; 0: none. Only choppy water seen from above shows foam */
    double time;           /* seconds, when the shutter closes */
    double shutter;        /* seconds the shutter is open, ≥ 0; light is integrated over [time − shutter, time] */
    double frame_interval; /* seconds since the frame before, ≥ 0; only taa reads it. 0: the shutter, or 1/30 where that is 0 too */
    mgt_light light;
    mgt_sky sky;
    float foam_persistence; /* seconds that foam lasts, [0, 60]; 0: only where waves break right now */
    mgt_water water;
    const mgt_object *objects; /* object_count of them, read during the call; NULL when there are none */
    size_t object_count;       /* 0 … MGT_MAX_OBJECTS */
    mgt_post post;
    mgt_quality quality; /* the last member, so that it may grow at its end with the scene; the structs above never change */
} mgt_scene;

/* A legal scene by the default method: 1280 × 720 pixels, a camera 4 m above flat water that looks north, and the sun 30° above the northern horizon. */
MGT_API void mgt_scene_init(mgt_scene *scene, size_t size);

/* The default method. `size` is sizeof(mgt_quality), as with structs that begin with their size. */
MGT_API void mgt_quality_init(mgt_quality *quality, size_t size);

/* Radius (degrees), radiance outside the atmosphere and limb of a body, placed at elevation 30°, azimuth 0. */
MGT_API void mgt_light_init(mgt_light *light, mgt_source body);

#ifdef __cplusplus
}
#endif
#endif
