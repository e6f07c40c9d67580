/* SPDX-License-Identifier: MIT
 *
 * Scene files, pictures and metrics: the library libmangata-io, beside libmangata, for programs that want files. Numbers in files and texts have a decimal
 * point, whatever the locale of the program. */
#ifndef MANGATA_IO_H
#define MANGATA_IO_H

#include "mangata/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mgt_io_status {
    MGT_IO_OK = 0,
    MGT_IO_MISSING,  /* there is no such file, or it cannot be read */
    MGT_IO_BAD,      /* a scene or a picture is not a legal one */
    MGT_IO_ARGUMENT, /* an argument, or a change that is no "key=value" */
    MGT_IO_MEMORY    /* an allocation failed */
} mgt_io_status;

/* What was wrong, and where. */
typedef struct mgt_io_error {
    size_t struct_size;
    uint32_t line, column; /* from 1; 0: of the file as a whole, or of none */
    char file[1024];       /* as the call got it; "": the error is of no file; a longer name is cut short */
    char text[1024];       /* one line of UTF-8: what is wrong, what is allowed; without file and place. One of a change begins with "change key=value: " */
} mgt_io_error;

/* Version of this library, "major.minor.patch". Objects of scenes are made here and rendered by libmangata, which must be of the same version. */
MGT_API const char *mgt_io_version(void);

MGT_API void mgt_io_error_init(mgt_io_error *error, size_t size);

/* ---- scene files ---------------------------------------------------------------------------------------- */

/* A scene file that has been read and checked. Any thread may ask it; several at once. */
typedef struct mgt_scene_file mgt_scene_file;

/* Reads a scene file of at most 16 MiB (YAML or JSON, docs/scenes.md); "-" is standard input. Each change is "key=value", the key a path in the format
 * ("light.elevation_deg", "water.waves[0].amplitude", "quality.method"), the value a piece of YAML; they are applied in order, before defaults are filled in.
 * `changes` may be NULL where there are none, `error` may be NULL. On failure *file is NULL. The caller frees the file. */
MGT_API mgt_io_status mgt_scene_file_load(mgt_scene_file **file, const char *path, const char *const *changes, size_t change_count, mgt_io_error *error);

/* The same from `length` bytes of text; `name` stands for the file's name in errors, and its folder is where other files are looked for. */
MGT_API mgt_io_status mgt_scene_file_parse(mgt_scene_file **file, const char *text, size_t length, const char *name, const char *const *changes,
                                           size_t change_count, mgt_io_error *error);

/* The same from a few words about a sea, such as "wind=12,direction=30" (docs/seas.md). */
MGT_API mgt_io_status mgt_scene_file_sea(mgt_scene_file **file, const char *words, const char *const *changes, size_t change_count, mgt_io_error *error);

/* NULL is allowed. */
MGT_API void mgt_scene_file_free(mgt_scene_file *file);

/* The scene as frame `frame` (0 …) shows it: time = start + frame / fps when the shutter closes. `scene` is initialised by this call to `size` bytes, as by
 * mgt_scene_init(); its waves and objects point into `file` and live as long. Errors leave *scene untouched.
 * MGT_IO_BAD: the frame has no legal camera; MGT_IO_ARGUMENT: a pointer is missing, `frame` is above 2^31 − 1, or `size` is less than that of struct_size
 * or no version's. */
MGT_API mgt_io_status mgt_scene_file_frame(const mgt_scene_file *file, uint32_t frame, mgt_scene *scene, size_t size);

MGT_API uint32_t mgt_scene_file_frame_count(const mgt_scene_file *file); /* ≥ 1; of NULL 0 */
MGT_API double mgt_scene_file_fps(const mgt_scene_file *file);           /* > 0; of NULL 0 */

/* A warning about values that are legal but probably a mistake: one line, "" where there is none. Lives as long as the file. */
MGT_API const char *mgt_scene_file_warning(const mgt_scene_file *file);

/* ---- pictures ------------------------------------------------------------------------------------------- */

/* Float pixels, top row first, tightly packed. */
typedef struct mgt_io_picture {
    size_t struct_size;
    uint32_t width, height, channels; /* channels 1 … 4 */
    float *pixels;                    /* width · height · channels; owned: mgt_io_picture_free() */
} mgt_io_picture;

/* Reads .png (values / 255 or / 65535 as stored), .pfm or .exr. `layer`: an EXR layer or channel; NULL: color, or else the only one.
 * `picture->struct_size` must be set by the caller. On failure nothing is owned, and `pixels` is NULL. */
MGT_API mgt_io_status mgt_io_picture_read(mgt_io_picture *picture, const char *path, const char *layer, mgt_io_error *error);
MGT_API void mgt_io_picture_free(mgt_io_picture *picture);

/* ---- metrics -------------------------------------------------------------------------------------------- */

/* Scores of a clip A against a clip B, the reference: docs/command.md#diff. 0 is best, but for energy, SSIM and the flicker ratio, where 1 is. */
typedef struct mgt_metrics_desc {
    size_t struct_size;
    uint32_t width, height;
    uint32_t channels;        /* 1 or 3 */
    bool srgb_encoded;        /* the values are sRGB-encoded; false: linear */
    double pixels_per_degree; /* of the viewer's eye, for FLIP; 0: 67.0206, as in its papers */
    const char *metrics;      /* words with commas between them, "rmse,flip,ssim,flicker"; NULL: all that need no other program */
} mgt_metrics_desc;

MGT_API void mgt_metrics_desc_init(mgt_metrics_desc *desc, size_t size);

/* The names of metrics, from 0 on; NULL: there are no more. */
MGT_API const char *mgt_metric_name(uint32_t metric);

/* Measures `frames` pictures of each clip, `a[i]` and `b[i]` with width · height · channels floats, top row first, tightly packed. `scores` gets a number for each
 * metric by its place in mgt_metric_name(): NaN where it was not asked for or is not defined. All are NaN where a value of any frame is finite in one clip only,
 * NaN in either, or infinite with unlike signs; equal infinities are equal. `map`: NULL, or width · height floats that get the error map of the last frame by
 * `map_metric`, which is measured: rmse, relrmse, flip, hdr-flip, ssim (1 − SSIM) or flicker (of the step to that frame); NaN at pixels with such values.
 * MGT_IO_ARGUMENT, with nothing measured: the other metrics have no map. Threads: as many as the caller likes, of different calls. */
MGT_API mgt_io_status mgt_metrics_measure(const mgt_metrics_desc *desc, const float *const *a, const float *const *b, size_t frames, double *scores,
                                          uint32_t map_metric, float *map, mgt_io_error *error);

#ifdef __cplusplus
}
#endif
#endif
