/* SPDX-License-Identifier: MIT */
/* The options of --exr, and the attributes and values that compositors expect. */
#include "cli/render/render_exr.h"

#include <math.h>
#include <string.h>

#include "cli/common/numbers.h"
#include "cli/render/render_crypto.h"
#include "cpu/object_ids.h"
#include "params/names.h"

/* Radiance is in kcd/m². */
enum { NITS = 1000 };

static const char *const exr_words[] = {"float", "half", "zip", "piz", "none", "alpha", "z", "acescg", "parts", "cryptomatte", NULL};

/* Reads a word such as "cryptomatte:8". False: it is another one. */
static bool take_side(exr_choice *choice, const char *word, size_t length)
{
    static const char start[] = "cryptomatte:";
    uint64_t side;
    char digits[8] = "";
    const size_t before = sizeof start - 1;
    if (length <= before || length >= before + sizeof digits || strncmp(word, start, before) != 0)
        return false;
    memcpy(digits, word + before, length - before);
    if (!number_parse_u64(digits, OBJECT_SIDE_MAX, &side) || side == 0)
        return false;
    choice->crypto = (uint32_t)side;
    return true;
}

static bool take_word(exr_choice *choice, const char *word, size_t length)
{
    int i = 0;
    while (exr_words[i] && (strlen(exr_words[i]) != length || strncmp(exr_words[i], word, length) != 0))
        i++;
    switch (i) {
    case 0:
    case 1:
        choice->half = i == 1;
        return true;
    case 2:
    case 3:
    case 4:
        choice->packing = i == 2 ? EXR_PACKING_ZIP : i == 3 ? EXR_PACKING_PIZ : EXR_PACKING_NONE;
        return true;
    case 5:
        return choice->alpha = true;
    case 6:
        return choice->z = true;
    case 7:
        return choice->acescg = true;
    case 8:
        return choice->parts = true;
    case 9:
        choice->crypto = CRYPTO_SIDE_DEFAULT;
        return true;
    default:
        return take_side(choice, word, length);
    }
}

/* What a word chooses that another word chooses otherwise; EXR_KINDS: nothing of the kind. */
static int kind_of(const char *word, size_t length)
{
    static const struct {
        const char *word;
        int kind;
    } kinds[] = {{"half", EXR_BITS}, {"float", EXR_BITS}, {"zip", EXR_PACKING}, {"piz", EXR_PACKING}, {"none", EXR_PACKING}};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (strlen(kinds[i].word) == length && strncmp(kinds[i].word, word, length) == 0)
            return kinds[i].kind;
    return length >= 11 && strncmp(word, "cryptomatte", 11) == 0 ? EXR_MATTES : EXR_KINDS;
}

/* Prints an error where an earlier word has chosen otherwise. */
static int note_word(const option *o, exr_choice *choice, const char *word, size_t length)
{
    const int kind = kind_of(word, length);
    if (kind == EXR_KINDS)
        return EXIT_CODE_OK;
    char *before = choice->words[kind];
    if (*before && (strlen(before) != length || strncmp(before, word, length) != 0))
        return console_error(EXIT_CODE_USAGE, "--%s: %s and %.*s contradict each other", o->name, before, (int)length, word);
    snprintf(before, sizeof choice->words[0], "%.*s", (int)length, word);
    return EXIT_CODE_OK;
}

int option_exr(const option *o, void *place, const char *value)
{
    for (const char *word = value;; word++) {
        const size_t length = strcspn(word, ",");
        if (!take_word(place, word, length))
            return console_error(EXIT_CODE_USAGE, "--%s %s: allowed are %s, or cryptomatte:N with N from 1 to %d, with commas between them", o->name, value,
                                 names_list(exr_words).text, OBJECT_SIDE_MAX);
        const int code = note_word(o, place, word, length);
        word += length;
        if (code != EXIT_CODE_OK || !*word)
            return code;
    }
}

void exr_choice_write(FILE *stream, const exr_choice *choice)
{
    fprintf(stream, "%s%s%s%s%s%s", choice->half ? " half" : "",
            choice->packing == EXR_PACKING_PIZ    ? " piz"
            : choice->packing == EXR_PACKING_NONE ? " none"
                                                  : "",
            choice->alpha ? " alpha" : "", choice->z ? " z" : "", choice->acescg ? " acescg" : "", choice->parts ? " parts" : "");
    if (choice->crypto)
        fprintf(stream, " cryptomatte %u of %08x", choice->crypto, choice->crypto_names);
}

/* ---- the camera ---- */

/* Unit vectors to the right, up and along the direction of view, and half the picture's size at distance 1. */
typedef struct camera_axes {
    double axis[3][3];
    double half_width, half_height;
} camera_axes;

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(double out[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void normalize(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

static camera_axes axes_of(const mgt_scene *scene)
{
    const mgt_camera *camera = &scene->camera;
    camera_axes c;
    for (int i = 0; i < 3; i++)
        c.axis[2][i] = camera->target[i] - camera->position[i];
    normalize(c.axis[2]);
    cross(c.axis[0], c.axis[2], camera->up);
    normalize(c.axis[0]);
    cross(c.axis[1], c.axis[0], c.axis[2]);
    c.half_height = tan(0.5 * camera->fov_y_deg * (acos(-1) / 180));
    c.half_width = c.half_height * scene->image.width / scene->image.height;
    return c;
}

exr_desc exr_desc_of(const exr_choice *choice, const mgt_scene *scene, double fps)
{
    const mgt_image *image = &scene->image;
    const camera_axes c = axes_of(scene);
    exr_desc desc = {.packing = choice->packing,
                     .half = choice->half,
                     .parts = choice->parts,
                     .x = image->crop_x,
                     .y = image->crop_y,
                     .display_width = image->width,
                     .display_height = image->height,
                     .described = true,
                     .acescg = choice->acescg,
                     .nits = NITS,
                     .frames_per_second = fps >= 0.01 && fps <= 1000 ? fps : 0,
                     .exposure = scene->shutter,
                     .screen_width = 2 * c.half_width};
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++)
            desc.world_to_camera[i][k] = c.axis[k][i];
        desc.world_to_camera[3][k] = -dot(scene->camera.position, c.axis[k]);
    }
    desc.world_to_camera[3][3] = 1;
    /* Coordinates are divided by the fourth column, the distance along the direction of view. Depth is 1 − 1 / distance. */
    for (int i = 0; i < 4; i++) {
        const double *row = desc.world_to_camera[i];
        desc.world_to_ndc[i][0] = 0.5 * (row[0] / c.half_width + row[2]);
        desc.world_to_ndc[i][1] = 0.5 * (row[2] - row[1] / c.half_height);
        desc.world_to_ndc[i][2] = row[2] - (i == 3);
        desc.world_to_ndc[i][3] = row[2];
    }
    return desc;
}

void exr_planar_depth(float *depth, const mgt_scene *scene)
{
    const mgt_image *image = &scene->image;
    const camera_axes c = axes_of(scene);
    for (uint32_t y = 0; y < image->crop_height; y++)
        for (uint32_t x = 0; x < image->crop_width; x++, depth++) {
            const double right = c.half_width * (2 * (image->crop_x + x + 0.5) / image->width - 1);
            const double down = c.half_height * (2 * (image->crop_y + y + 0.5) / image->height - 1);
            *depth = (float)(*depth / sqrt(1 + right * right + down * down));
        }
}

void exr_to_acescg(float *color, size_t pixels)
{
    /* The matrix follows from the primaries of both spaces, with white adapted from D65 to that of ACES by Bradford's matrix. */
    static const double matrix[3][3] = {{0.6130974024, 0.3395231462, 0.0473794514},
                                        {0.0701937225, 0.9163538791, 0.0134523985},
                                        {0.0206155929, 0.1095697729, 0.8698146342}};
    for (size_t p = 0; p < pixels; p++, color += 3) {
        const double rgb[3] = {color[0], color[1], color[2]};
        for (int k = 0; k < 3; k++)
            color[k] = (float)(matrix[k][0] * rgb[0] + matrix[k][1] * rgb[1] + matrix[k][2] * rgb[2]);
    }
}
