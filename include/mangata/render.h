/* SPDX-License-Identifier: MIT
 *
 * Contexts, targets and the calls that render and inspect frames. */
#ifndef MANGATA_RENDER_H
#define MANGATA_RENDER_H

#include "mangata/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

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

MGT_API const char *mgt_backend_name(mgt_backend backend);
MGT_API const char *mgt_isa_name(mgt_isa isa);
MGT_API const char *mgt_log_level_name(mgt_log_level level);
MGT_API bool mgt_backend_from_name(const char *name, mgt_backend *backend);
MGT_API bool mgt_isa_from_name(const char *name, mgt_isa *isa);
MGT_API bool mgt_log_level_from_name(const char *name, mgt_log_level *level);

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
    uint32_t gl_device;   /* OpenGL of its own: which EGL device, counted from 0 */
    mgt_log_function log; /* NULL: silent */
    void *log_user;
    mgt_progress_function progress; /* NULL: none */
    void *progress_user;
    mgt_gl_get_proc gl_get_proc; /* OpenGL: functions of the context that is current on this thread, used instead of one of its own (mangata/gl.h);
                                    NULL: a context of its own without a window, through EGL */
} mgt_context_desc;

typedef struct mgt_context mgt_context;

/* The CPU, all its threads and lanes, no callbacks. */
MGT_API void mgt_context_desc_init(mgt_context_desc *desc, size_t size);

/* Creates a context with its threads. `desc` may be NULL (all defaults). On failure *context is NULL and the status says why;
 * mgt_last_error(NULL) gives the detail. The caller owns the context and destroys it. */
MGT_API mgt_status mgt_context_create(mgt_context **context, const mgt_context_desc *desc);

/* Frees the context and joins its threads. NULL is allowed. Not from a callback of the context, nor while another thread uses it. */
MGT_API void mgt_context_destroy(mgt_context *context);

/* Detail of the last failure on this context; NULL: of the last call on this thread that takes no context, empty where that succeeded. Such calls are
 * mgt_context_create(), mgt_mesh_create(), mgt_texture_create(), mgt_supports(), mgt_option_check(), mgt_method_info(), mgt_sea_wave_count(),
 * mgt_sea_waves(), mgt_sea_scene(), mgt_water_query() and mgt_water_trace(). Never NULL; valid until the next such call. A function that gets NULL for its
 * context only returns MGT_ERROR_ARGUMENT. */
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

/* ---- targets and rendering ------------------------------------------------------------------------------ */

typedef enum mgt_layer {
    MGT_LAYER_COLOR = 0, /* 3 channels: radiance in kcd/m², or displayed colour in 8-bit formats */
    MGT_LAYER_COVERAGE,  /* 1: fraction of pixel area × shutter time whose mirrored ray meets the light, [0, 1]: Podee et al. 2021,
                            Eq. 17, over the light's radiance */
    MGT_LAYER_MASK,      /* 1: fraction of the pixel that is the water's surface */
    MGT_LAYER_DEPTH,     /* 1: metres along the ray at time t to the water, or to an object before it; +inf where there is neither */
    MGT_LAYER_NORMAL,    /* 3: world space unit normal of the same: the water's mean shading normal, upwards; (0,0,0) where there is neither */
    /* What a method spent and why. */
    MGT_LAYER_SAMPLES,    /* 1: samples of the pixel; for adaptive evaluations of all waves (see mgt_quality.samples) */
    MGT_LAYER_IMPORTANCE, /* 1: adaptive: what decides where samples go, from the analytic picture. Cells: predicted error of its coverage; podee:
                             Eq. 1 where it is above the threshold. Others: 0 */
    MGT_LAYER_DETAIL,     /* 1: adaptive: coverage of the added samples alone, 0 where there are none. Others: 0 */
    /* Scenes with objects, and cameras under water, have the next two layers; elsewhere they are 0. Textures and views of OpenGL do not take them. */
    MGT_LAYER_REFRACTION,       /* 3: radiance that arrives through the water's surface, before the Fresnel transmittance is applied; 0 where no water */
    MGT_LAYER_REFRACTION_ERROR, /* 1: estimated distance, in pixels, from what is shown to what the refracted ray meets; +inf where it is unknown */
    /* All scenes; textures of OpenGL take it, too. */
    MGT_LAYER_FOAM /* 1: fraction of the pixel that foam covers, [0, 1]; of methods that work on whole pictures their base's */
} mgt_layer;

typedef enum mgt_format {
    MGT_FORMAT_R32F = 0,  /* one float: layers of 1 channel */
    MGT_FORMAT_RGB32F,    /* three floats: layers of 3 channels */
    MGT_FORMAT_RGBA32F,   /* four floats, alpha 1: layers of 3 channels */
    MGT_FORMAT_RGBA8_SRGB /* displayed colour with exposure, glare, tone map and sRGB transfer, alpha 255: color only */
} mgt_format;

MGT_API const char *mgt_layer_name(mgt_layer layer);
MGT_API const char *mgt_format_name(mgt_format format);
MGT_API bool mgt_layer_from_name(const char *name, mgt_layer *layer);
MGT_API bool mgt_format_from_name(const char *name, mgt_format *format);

/* 3 or 1; 0: no such layer. */
MGT_API uint32_t mgt_layer_channels(mgt_layer layer);

typedef struct mgt_target {
    size_t struct_size;
    mgt_layer layer;
    mgt_format format;
    void *pixels;         /* the caller's memory: top left pixel of the crop */
    ptrdiff_t row_stride; /* bytes from a row to the next one below; negative for bottom-up; 0: tightly packed */
} mgt_target;

/* Displayed colour, 8 bits, tightly packed; no pixels yet. */
MGT_API void mgt_target_init(mgt_target *target, size_t size);

/* Checks a scene as mgt_render() would, without rendering, also whether its method draws it (MGT_ERROR_UNSUPPORTED). The detail of an error is in
 * mgt_last_error(context). */
MGT_API mgt_status mgt_scene_check(mgt_context *context, const mgt_scene *scene);

/* Whether `backend` itself renders a layer of the scene as it stands: its method, refraction, objects and camera. AUTO: whether CPU or OpenGL does. False
 * also for a scene that is not valid. What OpenGL does not render, mgt_render() of an OpenGL context renders on the CPU, with the same pixels as a CPU
 * context, and logs "render.cpu" once a method (a warning; for MGT_BACKEND_AUTO an information); views and textures refuse it. Only mgt_context_create()
 * knows whether a context of the backend can be created here. Any thread. */
MGT_API bool mgt_supports(mgt_backend backend, const mgt_scene *scene, mgt_layer layer);

/* Whether a render of the scene reads an option of its quality, by the option's key in scene files ("time_samples"). MGT_ERROR_SCENE: the method or another
 * option does not read it, and mgt_last_error(NULL) says which do; or the scene is not valid. MGT_ERROR_ARGUMENT: a pointer is NULL, or there is no such option.
 * Any thread. */
MGT_API mgt_status mgt_option_check(const mgt_scene *scene, const char *option);

/* Renders one frame into `count` targets (1 … 16). Blocks until done. The same scene gives the same bytes. */
MGT_API mgt_status mgt_render(mgt_context *context, const mgt_scene *scene, const mgt_target *targets, size_t count);

/* Displayed colour of radiance that the caller holds, as mgt_render() makes it for scene.post: exposure, glare, tone map and sRGB, on the CPU whatever
 * the backend. For means over several sample ranges. `radiance`: the whole image, 3 floats a pixel, tightly packed, finite and ≥ 0.
 * `target`: MGT_LAYER_COLOR in MGT_FORMAT_RGBA8_SRGB, of the crop. MGT_ERROR_ARGUMENT: a number of `radiance` is another one. */
MGT_API mgt_status mgt_display(mgt_context *context, const mgt_scene *scene, const float *radiance, const mgt_target *target);

/* The exposure of the scene's displayed colour, 2^stops per kcd/m²: post.exposure_ev without auto_exposure gives the same colours. The sky that it follows from
 * is kept for the next frame. On failure *stops is unchanged. */
MGT_API mgt_status mgt_exposure(mgt_context *context, const mgt_scene *scene, double *stops);

/* ---- sums of samples ------------------------------------------------------------------------------------ */

/* The sums of a pixel fill 12 words. They are six integers of 128 bits, low word first, that count multiples of 2⁻⁵⁶: the sums of red, green and blue
 * radiance, coverage, mask and foam. The pixels are the crop's, row by row, tightly packed. Sums have the same bits in whatever order and ranges samples are
 * added, so that a picture whose samples several machines or several runs share ends as mgt_render() makes it. */
enum { MGT_SUM_WORDS = 12 };

/* Adds samples of the crop's pixels to `sums`, which begin as zeros: quality.sample_count of them from quality.sample_first on. Of adaptive these numbers
 * count the slots of the whole picture. Methods: reference, ssaa, and adaptive by podee with sample_slots; another one is MGT_ERROR_UNSUPPORTED.
 * Always on the CPU, which the log of an OpenGL context says ("render.cpu"). A context of MGT_BACKEND_NULL adds nothing. After a failure, or when it is
 * cancelled, `sums` are useless. */
MGT_API mgt_status mgt_sum_samples(mgt_context *context, const mgt_scene *scene, uint64_t *sums);

/* Adds the sums `more` to `sums`; both hold `pixels` pixels. If either is NULL, nothing happens. Any thread. */
MGT_API void mgt_sums_add(uint64_t *sums, const uint64_t *more, size_t pixels);

/* mgt_render(), on the CPU, with these sums of the scene's range of samples in place of samples of its own. It still renders what is no mean of samples:
 * depth, normal, objects, and the lights of quality.light_cells. Displayed colour with glare needs the sums of a whole picture: those of a crop are
 * MGT_ERROR_UNSUPPORTED. */
MGT_API mgt_status mgt_render_sums(mgt_context *context, const mgt_scene *scene, const uint64_t *sums, const mgt_target *targets, size_t count);

/* What method `mangata` knows of one pixel. Near the horizon a pixel shows two to eight hits, one above the other: water, coverage and radiance are then
 * their mean, and slopes, covariances and the path are those of the lowest one. Slopes are (∂y/∂x, ∂y/∂z). The light plane is r·L = 1, its axes as in the
 * kernels: e horizontal, f up. Of a moving camera slopes, covariances and the path are those of the last half of the shutter. Objects are not seen, and
 * quality.path_segments counts as 1. */
typedef struct mgt_pixel_info {
    size_t struct_size;
    double water;                       /* fraction of the pixel that is water; where it is 0 all else but radiance is 0 */
    double coverage;                    /* as the layer's, without what foam hides */
    double radiance[3];                 /* kcd/m², as the layer `color`, with foam and air; not defined for a camera under water */
    double position[3];                 /* of the hit in the world, metres, water.level included */
    double distance;                    /* along the ray, metres */
    double slope_open[2];               /* mean slope when the shutter opens */
    double slope_close[2];              /* mean slope when it closes */
    double unresolved[3];               /* slope covariance xx, xz, zz of the waves that the pixel does not resolve */
    double bend[3];                     /* slope covariance of the resolved waves' curvature over the pixel, relative to the mirror slope */
    double mirror_slope[2];             /* the slope that mirrors the light's centre */
    double path[2][2];                  /* mean mirror ray on the light plane, at both ends of the shutter; the light's centre is (0, 0) */
    double light_radius;                /* of the light on that plane */
    double covariance[3];               /* of the Gaussian about the path there: ee, ef, ff */
    uint32_t resolved, mixed, filtered; /* waves of the pixel's tile by class */
} mgt_pixel_info;

/* Computes the pixel (x, y) of the whole image on the CPU, whatever the backend and the scene's method. `info->struct_size` must be set by the caller. */
MGT_API mgt_status mgt_inspect_pixel(mgt_context *context, const mgt_scene *scene, uint32_t x, uint32_t y, mgt_pixel_info *info);

#ifdef __cplusplus
}
#endif
#endif
