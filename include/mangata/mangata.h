/* SPDX-License-Identifier: MIT
 *
 * Mangata: reflections of the sun and the moon on water, anti-aliased in space and time.
 *
 * In one breath: create a context, fill a scene from mgt_scene_defaults(), point one or more targets at
 * your memory, call mgt_render().
 *
 * Conventions of every function here
 *   Units       metres, seconds, degrees where the name says so and radians elsewhere; luminance in kcd/m².
 *   Axes        right-handed, y up. The mean water surface is y = 0. Azimuth 0 is -z ("north"), 90 is +x ("east").
 *   Pixels      (0,0) is the top left pixel; +x of the image is cross(forward, up).
 *   Structs     every public struct begins with `struct_size`. Fill structs with their mgt_*_defaults()
 *               function, which also sets it; a struct whose size this library does not know is refused.
 *   Errors      functions return an mgt_status; mgt_last_error() and the log say what was wrong. After a
 *               failure no object has changed; pixels of the targets may have been written in part.
 *   Threads     a context is used by one thread at a time; different contexts are independent.
 *   Determinism the pixels depend on the scene alone: not on threads, tiles, crop, instruction set (AVX2,
 *               AVX-512 and the scalar build agree to the bit) or what was rendered before.
 */
#ifndef MANGATA_MANGATA_H
#define MANGATA_MANGATA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define MGT_API
#else
#define MGT_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define MGT_VERSION_MAJOR 0
#define MGT_VERSION_MINOR 1
#define MGT_VERSION_PATCH 0
#define MGT_VERSION_STRING "0.1.0"

/* Limits that are checked. */
#define MGT_MAX_WAVES 512
#define MGT_MAX_OBJECTS 65536
#define MGT_MAX_TRIANGLES 67108864 /* of a mesh, and of all objects of a scene together */
#define MGT_MAX_IMAGE_SIDE 32768

typedef enum mgt_status {
    MGT_OK = 0,
    MGT_ERROR_ARGUMENT,    /* a pointer, size or enum that makes no call possible */
    MGT_ERROR_SCENE,       /* a scene value out of its range; mgt_last_error() names the field */
    MGT_ERROR_MEMORY,      /* an allocation failed */
    MGT_ERROR_UNAVAILABLE, /* the backend or instruction set does not exist here */
    MGT_ERROR_UNSUPPORTED, /* meaningful, but not built yet */
    MGT_ERROR_THREAD,      /* a thread could not be started */
    MGT_CANCELLED          /* the progress callback asked to stop */
} mgt_status;

/* Lower-case English text for a status; never NULL. */
MGT_API const char *mgt_status_text(mgt_status status);

/* Version of the library in use, "major.minor.patch". */
MGT_API const char *mgt_version(void);

/* ---- context ------------------------------------------------------------------------------------------ */

typedef enum mgt_backend {
    MGT_BACKEND_CPU = 0,
    MGT_BACKEND_GL = 1,
    MGT_BACKEND_AUTO = 2, /* hardware GL where there is one, else the CPU */
    MGT_BACKEND_NULL = 3  /* checks arguments and fills targets with zero: for tests of a host's own code */
} mgt_backend;

typedef enum mgt_isa {
    MGT_ISA_AUTO = 0, /* the best that this processor runs */
    MGT_ISA_SCALAR,   /* one lane, the plain reference */
    MGT_ISA_SSE2,     /* four lanes without fma: compatible, but not bit-identical to the others */
    MGT_ISA_AVX2,     /* eight lanes, AVX2 + FMA */
    MGT_ISA_AVX512,   /* sixteen lanes, AVX-512 F, DQ, BW, VL */
    MGT_ISA_NEON      /* four lanes */
} mgt_isa;

typedef enum mgt_log_level { MGT_LOG_DEBUG, MGT_LOG_INFO, MGT_LOG_WARNING, MGT_LOG_ERROR } mgt_log_level;

/* One log message. `id` is stable between versions ("render.scene", …) so that tests may assert on it; `text` is for
 * people. Both live only during the call. May be called from the thread inside an mgt_ function only. */
typedef void (*mgt_log_function)(void *user, mgt_log_level level, const char *id, const char *text);

/* Called from the rendering thread several times a second while mgt_render() runs; fraction in [0, 1].
 * Return false to stop: mgt_render() then returns MGT_CANCELLED. */
typedef bool (*mgt_progress_function)(void *user, double fraction);

/* Address of an OpenGL function, NULL where there is none: eglGetProcAddress and glfwGetProcAddress have this type. */
typedef void (*mgt_gl_function)(void);
typedef mgt_gl_function (*mgt_gl_get_proc)(const char *name);

typedef struct mgt_context_desc {
    size_t struct_size;
    mgt_backend backend;
    mgt_isa isa;          /* highest instruction set to use; a missing one fails with MGT_ERROR_UNAVAILABLE */
    uint32_t threads;     /* 0: as many as the CPUs this process may use (affinity and cgroup quota); at most 1024 */
    mgt_log_function log; /* NULL: silent */
    void *log_user;
    mgt_progress_function progress; /* NULL: none */
    void *progress_user;
    mgt_gl_get_proc gl_get_proc; /* OpenGL: functions of the context that is current on this thread, used instead of one of its own (mangata_gl.h);
                                    NULL: a context of its own without a window, through EGL */
    uint32_t gl_device;          /* OpenGL of its own: which EGL device, counted from 0 */
} mgt_context_desc;

typedef struct mgt_context mgt_context;

MGT_API mgt_context_desc mgt_context_desc_defaults(void);

/* Creates a context with its threads. `desc` may be NULL (all defaults). On failure *context is NULL and the status says why;
 * mgt_last_error(NULL) gives the detail (per thread). The caller owns the context and destroys it. */
MGT_API mgt_status mgt_context_create(mgt_context **context, const mgt_context_desc *desc);

/* Frees the context and joins its threads. NULL is allowed. */
MGT_API void mgt_context_destroy(mgt_context *context);

/* Detail of the last failure on this context (NULL: of the last failed mgt_context_create on this thread). Never NULL; valid until the next call. */
MGT_API const char *mgt_last_error(const mgt_context *context);

typedef struct mgt_context_info {
    size_t struct_size;
    mgt_backend backend; /* what runs, never AUTO */
    mgt_isa isa;         /* what runs, never AUTO */
    uint32_t lanes;      /* pixels computed at once */
    uint32_t threads;
    char renderer[128]; /* OpenGL: GL_RENDERER and GL_VERSION; else empty */
    bool software;      /* OpenGL by a software rasteriser */
} mgt_context_info;

/* What the context resolved to. `info->struct_size` must be set by the caller. */
MGT_API mgt_status mgt_context_get_info(const mgt_context *context, mgt_context_info *info);

/* Whether this build and this processor run `isa` (AUTO: always). */
MGT_API bool mgt_isa_available(mgt_isa isa);

/* ---- meshes and textures ------------------------------------------------------------------------------ */

/* Triangles and pictures that scenes refer to. They belong to no context and never change: any number of threads, contexts and scenes may use one at
 * once. What a context uploads or builds for them it keeps while frames go on using them. A mesh or texture must outlive every mgt_render() that uses
 * it; contexts do not read it after that. */
typedef struct mgt_mesh mgt_mesh;
typedef struct mgt_texture mgt_texture;

typedef struct mgt_mesh_desc {
    size_t struct_size;
    const float *positions; /* 3 a vertex, metres, within ±1e6 */
    const float *normals;   /* 3 a vertex, of any length; NULL: those of the triangles */
    const float *texcoords; /* 2 a vertex, (0, 0) the top left of a texture, (1, 1) its bottom right; it repeats. NULL: all (0, 0) */
    uint32_t vertex_count;
    const uint32_t *indices; /* 3 a triangle, below vertex_count; counter-clockwise seen from outside. Both sides are drawn */
    uint32_t triangle_count; /* 1 … MGT_MAX_TRIANGLES */
} mgt_mesh_desc;

typedef struct mgt_texture_desc {
    size_t struct_size;
    uint32_t width, height; /* pixels, 1 … 16384 */
    const uint8_t *pixels;  /* RGBA, 8 bits each, sRGB; the top row first; alpha is not read */
    ptrdiff_t row_stride;   /* bytes from a row to the next one; 0: tightly packed */
} mgt_texture_desc;

MGT_API mgt_mesh_desc mgt_mesh_desc_defaults(void);
MGT_API mgt_texture_desc mgt_texture_desc_defaults(void);

/* Copies what the description points to. On failure *mesh is NULL, the status says why and mgt_last_error(NULL) gives the detail. Triangles without
 * area are dropped; it is an error if none is left, or if a number is not finite. The caller owns the result and destroys it. */
MGT_API mgt_status mgt_mesh_create(mgt_mesh **mesh, const mgt_mesh_desc *desc);
MGT_API mgt_status mgt_texture_create(mgt_texture **texture, const mgt_texture_desc *desc);
MGT_API void mgt_mesh_destroy(mgt_mesh *mesh); /* NULL is allowed, as below */
MGT_API void mgt_texture_destroy(mgt_texture *texture);

/* ---- scene -------------------------------------------------------------------------------------------- */

/* One sine wave of P1 Eq. 1: y += amplitude · sin(a·x + b·z + c·t + phase). */
typedef struct mgt_wave {
    double amplitude; /* metres, ≥ 0 */
    double a, b;      /* wave vector, radians per metre */
    double c;         /* radians per second */
    double phase;     /* radians */
} mgt_wave;

typedef struct mgt_image {
    uint32_t width, height;                           /* whole image, pixels, 1 … MGT_MAX_IMAGE_SIDE */
    uint32_t crop_x, crop_y, crop_width, crop_height; /* what is rendered; width or height 0: up to the edge */
} mgt_image;

typedef struct mgt_camera {
    double position[3]; /* metres; under water where it is below water.level */
    double target[3];   /* a point in front; must differ from position */
    double up[3];       /* must not be parallel to the view */
    double fov_y_deg;   /* vertical field of view, (0, 179) */
} mgt_camera;

typedef enum mgt_body { MGT_BODY_SUN = 0, MGT_BODY_MOON = 1 } mgt_body;

/* One spherical light at infinity. Direction to it: (sin az·cos el, sin el, −cos az·cos el). */
typedef struct mgt_light {
    mgt_body body;             /* kind of sky around it, limb darkening */
    double elevation_deg;      /* [−90, 90]; below 0 no direct light meets the water */
    double azimuth_deg;        /* any */
    double angular_radius_deg; /* (0, 20] */
    float radiance[3];         /* kcd/m², linear sRGB, ≥ 0; with MGT_SKY_ATMOSPHERE as seen outside the atmosphere */
} mgt_light;

typedef enum mgt_sky_model {
    MGT_SKY_ATMOSPHERE = 0, /* precomputed Rayleigh, Mie and ozone scattering of the light, day to night */
    MGT_SKY_GRADIENT = 1,   /* horizon to zenith */
    MGT_SKY_BLACK = 2       /* the papers' experiments: only the glitter */
} mgt_sky_model;

typedef struct mgt_sky {
    mgt_sky_model model;
    float turbidity;  /* aerosol amount over clear air, [1, 10]: scales Mie scattering (atmosphere) */
    float zenith[3];  /* kcd/m², linear sRGB (gradient) */
    float horizon[3]; /* kcd/m², linear sRGB (gradient) */
    float night[3];   /* kcd/m², added everywhere: airglow and stars (atmosphere) */
} mgt_sky;

typedef struct mgt_water {
    const mgt_wave *waves;      /* wave_count of them, read during the call; NULL when wave_count is 0 (a flat mirror) */
    size_t wave_count;          /* 0 … MGT_MAX_WAVES */
    double index_of_refraction; /* of the water, in air: [1.0, 3.0]; 1.333 */
    double level;               /* metres: the height of the mean surface, ±1e6 */
    float absorption[3];        /* light that a metre of water absorbs, and … */
    float scattering[3];        /* … light that it scatters, 1/metre, linear sRGB, [0, 1000]. For what is seen through it: where there are objects */
    float body_albedo[3];       /* share of the light entering the water that deep water sends up again, [0, 1], linear sRGB;
                              shows only with a sky other than black */
} mgt_water;

typedef enum mgt_pattern {
    MGT_PATTERN_NONE = 0,
    MGT_PATTERN_TILES = 1,   /* a grid of tiles with joints between them */
    MGT_PATTERN_CHECKER = 2, /* fields of two colours in turn */
    MGT_PATTERN_STRIPES = 3  /* bands of two colours across the first texture coordinate */
} mgt_pattern;

/* What a surface is made of: diffuse (Lambert) and glossy (GGX). Colours are linear sRGB in [0, 1]. */
typedef struct mgt_material {
    float base_color[3];
    float roughness;            /* GGX α = roughness², [0.02, 1] */
    float metallic;             /* [0, 1]; 0: reflects 4% at normal incidence and is diffuse below */
    const mgt_texture *texture; /* times base_color; NULL: none */
    mgt_pattern pattern;        /* replaces base_color by pattern_color here and there */
    float pattern_color[3];     /* of the joints, of every other field, of every other stripe */
    float pattern_size;         /* side of a tile, field or stripe in texture coordinates (metres for meshes that are laid out so), > 0 */
    float pattern_joint;        /* width of a joint in tiles, [0, 1) */
} mgt_material;

/* A mesh somewhere in the scene. */
typedef struct mgt_object {
    const mgt_mesh *mesh;
    double transform[3][4]; /* from the mesh to the world: position = transform · (x, y, z, 1); it may mirror but not flatten */
    mgt_material material;
} mgt_object;

typedef enum mgt_tone_map { MGT_TONE_NONE = 0, MGT_TONE_REINHARD, MGT_TONE_ACES, MGT_TONE_AGX } mgt_tone_map;

/* How radiance becomes displayed colour; used by the 8-bit targets alone, float targets stay scene-linear. */
typedef struct mgt_post {
    bool auto_exposure; /* exposure from light and sky (never from the picture, so that films do not pump) */
    double exposure_ev; /* stops, added to the automatic exposure or, without it, 2^ev per kcd/m² */
    mgt_tone_map tone_map;
    float glare; /* share of the light that the eye scatters, [0, 1] */
} mgt_post;

typedef enum mgt_method {
    MGT_METHOD_NONE = 0,      /* one sample at the pixel's centre at time t */
    MGT_METHOD_SSAA,          /* spatial_samples² jittered samples × time_samples */
    MGT_METHOD_PODEE_UNIFORM, /* Podee et al. 2021, one covariance for the waves above the Nyquist limit (Eq. 3) */
    MGT_METHOD_PODEE_PIXEL,   /* the same with the per-pixel covariance (Eqs. 4–7) */
    MGT_METHOD_MANGATA,       /* this library's own model */
    MGT_METHOD_REFERENCE,     /* brute force in double precision (CPU backend only) */
    /* Rivals, for comparison: docs/methods.md says what is theirs and what is different here. */
    MGT_METHOD_MSAA32,    /* 32 samples of visibility, one shading */
    MGT_METHOD_LEAN,      /* Olano and Baker 2010: a tiled map of slope moments */
    MGT_METHOD_LEADR,     /* Dupuy et al. 2013: the same with masking and shadowing */
    MGT_METHOD_TOKUYOSHI, /* Tokuyoshi and Kaplanyan 2019: geometric specular anti-aliasing */
    MGT_METHOD_BRUNETON,  /* Bruneton et al. 2010: Gaussian slopes and a point-like sun */
    MGT_METHOD_FXAA,      /* Lottes 2009: `none`, its edges blended afterwards */
    MGT_METHOD_TAA,       /* Karis 2014: `none` jittered over eight frames, history reprojected and clamped */
    MGT_METHOD_TNDF,      /* after Tessari et al. 2020: one Gaussian of slopes over pixel and shutter */
    /* Samples where they show: an analytic picture first, then more of it where that one is likely to be wrong. On the CPU
       whatever the backend. */
    MGT_METHOD_ADAPTIVE
} mgt_method;

/* How what lies on the other side of the surface is found: scenes with objects. docs/refraction.md says what is whose. */
typedef enum mgt_refraction {
    MGT_REFRACTION_TWO_PHASE = 0,  /* this library's own: Liu et al. 2020 in true space, with the waves' heights, iterated */
    MGT_REFRACTION_HYBRID,         /* the same, and rays are traced where it is uncertain */
    MGT_REFRACTION_LIU,            /* Liu et al. 2020: both phases as printed, mistakes of print mended */
    MGT_REFRACTION_BROAD,          /* its broad phase alone: a flat surface */
    MGT_REFRACTION_NARROW,         /* its narrow phase alone */
    MGT_REFRACTION_SCREEN_SPACE,   /* McGuire and Mara 2014: rays marched through the depth buffer */
    MGT_REFRACTION_DISTANCE_FIELD, /* Rodgman and Chen 2001: rays marched through voxels of distances */
    MGT_REFRACTION_OFF,            /* straight through */
    MGT_REFRACTION_TRUTH           /* rays traced through the waves as they are, many a pixel (CPU backend only) */
} mgt_refraction;

/* How method adaptive finds the pixels that need more, and what it gives them. */
typedef enum mgt_adaptive {
    MGT_ADAPTIVE_CELLS = 0, /* pixels of method mangata, split into four again and again where the predicted error is largest */
    MGT_ADAPTIVE_PODEE = 1  /* Podee et al., Adaptive Supersampling: samples in proportion to an importance of the approximate picture */
} mgt_adaptive;

/* How podee-* integrates its Gaussian over the light disk and the shutter. */
typedef enum mgt_kernels {
    MGT_KERNELS_EXACT = 0, /* the ellipse itself, in closed form */
    MGT_KERNELS_1 = 1,     /* so many circular Gaussians, fitted (P1 App. C), from tables of 64 MiB that the context keeps */
    MGT_KERNELS_3 = 3,
    MGT_KERNELS_5 = 5,
    MGT_KERNELS_9 = 9,
    MGT_KERNELS_FELINE = 32, /* circular Gaussians placed by the formulae of McCormack et al. 1999 */
    MGT_KERNELS_RIEMANN = 33 /* a sum over the disk when the shutter closes: P1's fallback, everywhere */
} mgt_kernels;

typedef struct mgt_quality {
    mgt_method method;
    uint32_t spatial_samples;    /* N of N×N strata a pixel: ssaa, reference; 1 … 1024 */
    uint32_t time_samples;       /* M strata of the shutter: ssaa (1: the instant t), reference; 1 … 65536 */
    uint64_t sample_first;       /* ssaa, reference: first of the N·N·M samples to take, … */
    uint64_t sample_count;       /* … and how many; 0: all that remain. The mean over the range is returned */
    uint64_t seed;               /* of the jitter */
    bool ndf_mean_drop;          /* podee-pixel: leave the mean slope B out of the path (P1 Eq. 4 as printed) */
    mgt_kernels kernels;         /* podee-*: what stands for the elliptical Gaussian on the light plane */
    double elongation_limit;     /* podee-* with kernels: ellipses longer than this, major over minor axis, are summed without time as by
                                 MGT_KERNELS_RIEMANN, 1 … 1e6; 0: as many as there are kernels (P1 §3.6), and 1e6 for 1 kernel and Feline */
    uint32_t path_segments;      /* podee-*: straight pieces of the shutter, each with its own Gaussian, 1 … 64; 0: 1 */
    double transition_width;     /* podee-*: cycles per pixel below the Nyquist limit of 0.5 in which waves turn from resolved to unresolved
                                 (Eq. 20), up to 0.5; 0: 0.3 */
    bool transition_hard;        /* podee-*: no transition, waves turn at 0.5 cycles per pixel (Fig. 11) */
    mgt_adaptive adaptive;       /* adaptive: the scheme; at most one of the next three says when it ends */
    double samples;              /* adaptive: evaluations of all waves per pixel of water, on average, 1 … 4096; cells and points count as what they
                                 cost, a ray of podee, traced at both ends of the shutter, as one. 0: 8 where no other end is given */
    double target_rmse;          /* adaptive, cells: ends where the predicted RMSE of coverage over the image is this, 1e-6 … 1; 0: none */
    double budget_ms;            /* adaptive, cells: ends after so much time, 0.1 … 1e7. The one setting whose pixels depend on the machine; 0: none */
    double importance_center;    /* adaptive, podee: c of Eq. 1, a coverage, up to 1; 0: 0.1 */
    double importance_width;     /* adaptive, podee: ρ of Eq. 1, 1e-6 … 1; 0: 0.04 */
    double importance_threshold; /* adaptive, podee: pixels whose importance (1 at its peak) is not above it get no samples, up to 1; 0: 0.05,
                                 a little more than the importance of a pixel without light by the defaults */
    mgt_refraction refraction;
    double tess_error;           /* two-phase, hybrid, liu, broad: pixels that a triangle bent by refraction may be off by, 0.01 … 100; 0: 0.1 */
    uint32_t refraction_samples; /* N of N×N places of a pixel that rays of refraction go through, 1 … 64; 1 is the pixel's centre; 0: 1, and 4 for truth */
    bool caustics;               /* light that the waves bundle on what lies under them */
    uint64_t sample_slots;       /* adaptive, podee: M of Eq. 3, how many samples the picture gets, up to 2^32; 0: as `samples` says */
} mgt_quality;

/* Everything a frame depends on. Plain data, read during mgt_render() only. */
typedef struct mgt_scene {
    size_t struct_size;
    mgt_image image;
    mgt_camera camera;      /* when the shutter closes */
    mgt_camera camera_open; /* when it opens; used when camera_moves */
    bool camera_moves;
    double time;           /* seconds, when the shutter closes */
    double shutter;        /* seconds the shutter is open, ≥ 0; light is integrated over [time − shutter, time] */
    double frame_interval; /* seconds since the frame before, ≥ 0; method taa alone looks back. 0: the shutter, or 1/30 where that is 0 too */
    mgt_light light;
    mgt_sky sky;
    mgt_water water;
    const mgt_object *objects; /* object_count of them, read during the call; NULL when there are none */
    size_t object_count;       /* 0 … MGT_MAX_OBJECTS */
    mgt_post post;
    mgt_quality quality;
} mgt_scene;

/* A 1280×720 noon view of a flat sea without waves by the default method: every field legal. */
MGT_API mgt_scene mgt_scene_defaults(void);

/* Radius (degrees), radiance outside the atmosphere and limb of a body, placed at elevation 30°, azimuth 0. */
MGT_API mgt_light mgt_light_defaults(mgt_body body);

/* Checks a scene as mgt_render() would, without rendering. The detail of an error is in mgt_last_error(context). */
MGT_API mgt_status mgt_scene_check(mgt_context *context, const mgt_scene *scene);

/* ---- targets and rendering ------------------------------------------------------------------------------ */

typedef enum mgt_layer {
    MGT_LAYER_COLOR = 0, /* 3 channels: radiance in kcd/m², or displayed colour in 8-bit formats */
    MGT_LAYER_COVERAGE,  /* 1: share of pixel area × shutter time whose mirror ray meets the light, [0, 1] (P1 Eq. 17 / L_l) */
    MGT_LAYER_MASK,      /* 1: share of the pixel that is water */
    MGT_LAYER_DEPTH,     /* 1: metres along the ray to the first hit at time t; +inf where there is no water */
    MGT_LAYER_NORMAL,    /* 3: world space unit normal, the mean shading normal at time t; (0,0,0) where no water */
    /* What a method spent and why; not in textures and views of OpenGL. */
    MGT_LAYER_SAMPLES,    /* 1: samples of the pixel; for adaptive evaluations of all waves (see mgt_quality.samples) */
    MGT_LAYER_IMPORTANCE, /* 1: adaptive: what samples are given for, of the analytic picture; cells: predicted error of its coverage, podee: Eq. 1
                             where it is above the threshold. Others: 0 */
    MGT_LAYER_DETAIL,     /* 1: adaptive: coverage of the added samples alone, 0 where there are none. Others: 0 */
    /* Scenes with objects; not in textures and views of OpenGL. Elsewhere 0. */
    MGT_LAYER_REFRACTION,      /* 3: radiance that comes through the water's surface, before Fresnel's share of it is taken; 0 where no water */
    MGT_LAYER_REFRACTION_ERROR /* 1: pixels by which what is shown may be beside what the refracted ray meets; +inf where it is not known at all */
} mgt_layer;

typedef enum mgt_format {
    MGT_FORMAT_R32F = 0,  /* one float: all but color and normal */
    MGT_FORMAT_RGB32F,    /* three floats: color, normal */
    MGT_FORMAT_RGBA32F,   /* four floats, alpha 1: color, normal */
    MGT_FORMAT_RGBA8_SRGB /* displayed colour with exposure, glare, tone map and sRGB transfer, alpha 255: color only */
} mgt_format;

typedef struct mgt_target {
    size_t struct_size;
    mgt_layer layer;
    mgt_format format;
    void *pixels;         /* the caller's memory: top left pixel of the crop */
    ptrdiff_t row_stride; /* bytes from a row to the next one below; negative for bottom-up; 0: tightly packed */
} mgt_target;

MGT_API mgt_target mgt_target_defaults(void);

/* Renders one frame into `count` targets (1 … 16). Blocks until done. The same scene gives the same bytes. */
MGT_API mgt_status mgt_render(mgt_context *context, const mgt_scene *scene, const mgt_target *targets, size_t count);

/* Displayed colour of radiance that the caller holds, as mgt_render() makes it for scene.post: exposure, glare, tone map and sRGB, on the CPU whatever
 * the backend. For means over several sample ranges. `radiance`: the whole image, 3 floats a pixel, tightly packed, finite and ≥ 0.
 * `target`: MGT_LAYER_COLOR in MGT_FORMAT_RGBA8_SRGB, of the crop. */
MGT_API mgt_status mgt_display(mgt_context *context, const mgt_scene *scene, const float *radiance, const mgt_target *target);

/* What method `mangata` knows of one pixel. Slopes are (∂y/∂x, ∂y/∂z). The light plane is r·L = 1, its axes as in the kernels: e horizontal, f up. */
typedef struct mgt_pixel_info {
    size_t struct_size;
    double water;                       /* share of the pixel that is water; where it is 0 all else is 0 */
    double coverage;                    /* as the layer's */
    double radiance[3];                 /* kcd/m² */
    double position[3];                 /* of the hit, metres */
    double distance;                    /* along the ray, metres */
    double slope_open[2];               /* mean slope when the shutter opens, … */
    double slope_close[2];              /* … and when it closes */
    double unresolved[3];               /* slope covariance xx, xz, zz of the waves that the pixel does not resolve */
    double bend[3];                     /* and of the resolved ones' bend over the pixel, relative to the mirror slope */
    double mirror_slope[2];             /* the slope that mirrors the light's centre */
    double path[2][2];                  /* mean mirror ray on the light plane, at both ends of the shutter; the light's centre is (0, 0) … */
    double light_radius;                /* … and its radius this */
    double covariance[3];               /* of the Gaussian about the path there: ee, ef, ff */
    uint32_t resolved, mixed, filtered; /* waves of the pixel's tile by class */
} mgt_pixel_info;

/* Computes the pixel (x, y) of the whole image on the CPU, whatever the backend and the scene's method. `info->struct_size` must be set by the caller. */
MGT_API mgt_status mgt_inspect_pixel(mgt_context *context, const mgt_scene *scene, uint32_t x, uint32_t y, mgt_pixel_info *info);

#ifdef __cplusplus
}
#endif
#endif
