/* SPDX-License-Identifier: MIT
 *
 * The scene format as one table: keys, types, ranges, units, meanings.
 */
#include "scene/scene_fields.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The ranges are the library's own where it has them, so that a file which loads also renders. */
#define VERSION 1, 1
#define SIDE 1, MGT_MAX_IMAGE_SIDE
#define ANYWHERE -1e9, 1e9
#define NO_RANGE 0, 0

static const char *const bodies[] = {"sun", "moon", NULL};
static const char *const sky_models[] = {"atmosphere", "gradient", "black", NULL};
static const char *const spectrum_kinds[] = {"none", "pierson-moskowitz", "jonswap", "tma", "buoy", NULL};
static const char *const spectrum_spreadings[] = {"mitsuyasu", "hasselmann", "donelan-banner", "fixed", NULL};
static const char *const spectrum_slopes[] = {"spectrum", "cox-munk", NULL};
static const char *const tone_maps[] = {"none", "reinhard", "aces", "agx", NULL};

static void decide_body(void *parent)
{
    mgt_light *light = parent;
    *light = mgt_light_defaults(light->body);
}

static void prepare_keyframe(const void *parent, void *item)
{
    const scene_camera *camera = parent;
    scene_keyframe *keyframe = item;
    *keyframe = (scene_keyframe){.camera = camera->still};
}

static void prepare_wave(const void *parent, void *item)
{
    (void)parent;
    *(mgt_wave *)item = (mgt_wave){0};
}

static const scene_field image_fields[] = {
    {"width", FIELD_COUNT, offsetof(mgt_image, width), 0, SIDE, "pixels", .doc = "width of the whole image"},
    {"height", FIELD_COUNT, offsetof(mgt_image, height), 0, SIDE, "pixels", .doc = "height of the whole image"},
    {0}};

/* The rows of an mgt_camera inside a struct: a still camera and a keyframe share them. */
#define POSE(type, member, required)                                                                                  \
    {"position", FIELD_VECTOR, offsetof(type, member.position), FIELD_ABOVE_WATER | (required), ANYWHERE, "m",        \
     .doc = "where the camera stands; its y must be above 0, the mean water surface"},                                \
    {"target", FIELD_VECTOR, offsetof(type, member.target), (required), ANYWHERE, "m",                                \
     .doc = "a point in the middle of the picture"},                                                                  \
    {"up", FIELD_VECTOR, offsetof(type, member.up), 0, ANYWHERE, NULL,                                                \
     .doc = "a direction that is up in the picture, not parallel to the view"},                                       \
    {"fov_y_deg", FIELD_NUMBER, offsetof(type, member.fov_y_deg), FIELD_OPEN_MIN | FIELD_OPEN_MAX, 0, 179, "degrees", \
     .doc = "vertical field of view"}

static const scene_field keyframe_fields[] = {
    {"time", FIELD_NUMBER, offsetof(scene_keyframe, time), FIELD_REQUIRED, ANYWHERE, "s",
     .doc = "scene time, on the clock of time.start; each later than the one before"},
    POSE(scene_keyframe, camera, FIELD_REQUIRED),
    {0}};

static const scene_field camera_fields[] = {
    POSE(scene_camera, still, 0),
    {"path", FIELD_LIST, offsetof(scene_camera, path), 0, NO_RANGE, NULL,
     .doc = "keyframes of a moving camera, in place of position and target; up and fov_y_deg are then the keyframes' defaults",
     .fields = keyframe_fields, .item_size = sizeof(scene_keyframe), .max_items = 10000, .prepare = prepare_keyframe},
    {0}};

static const scene_field time_fields[] = {
    {"start", FIELD_NUMBER, offsetof(scene_clock, start), 0, -1e8, 1e8, "s", .doc = "scene time of frame 0"},
    {"fps", FIELD_NUMBER, offsetof(scene_clock, fps), 0, 0.01, 1000, "frames/s", .doc = "frames a second; frame f shows start + f/fps"},
    {"frames", FIELD_COUNT, offsetof(scene_clock, frames), FIELD_NO_PIXELS, 1, 1000000, NULL, .doc = "length of the film"},
    {"shutter", FIELD_NUMBER, offsetof(scene_clock, shutter), 0, 0, 1000, "frames",
     .doc = "how long light is gathered before a frame's time, as a share of 1/fps; 0: an instant"},
    {0}};

static const scene_field light_fields[] = {
    {"body", FIELD_CHOICE, offsetof(mgt_light, body), 0, NO_RANGE, NULL,
     .doc = "kind of light: sets the defaults of angular_radius_deg and radiance, and the limb darkening", .choices = bodies,
     .decide = decide_body},
    {"elevation_deg", FIELD_NUMBER, offsetof(mgt_light, elevation_deg), 0, -90, 90, "degrees",
     .doc = "height over the horizon; below 0 no direct light meets the water"},
    {"azimuth_deg", FIELD_NUMBER, offsetof(mgt_light, azimuth_deg), 0, -1e6, 1e6, "degrees", .doc = "0 is -z (\"north\"), 90 is +x (\"east\")"},
    {"angular_radius_deg", FIELD_NUMBER, offsetof(mgt_light, angular_radius_deg), 0, 1e-4, 20, "degrees", .doc = "radius of the disk in the sky"},
    {"radiance", FIELD_COLOR, offsetof(mgt_light, radiance), 0, 0, 1e12, "kcd/m²",
     .doc = "linear sRGB; with the atmosphere sky as seen outside the atmosphere"},
    {0}};

static const scene_field sky_fields[] = {
    {"model", FIELD_CHOICE, offsetof(mgt_sky, model), 0, NO_RANGE, NULL,
     .doc = "atmosphere: scattering, day to night; gradient: horizon to zenith; black: only the glitter", .choices = sky_models},
    {"turbidity", FIELD_SHARE, offsetof(mgt_sky, turbidity), 0, 1, 10, NULL, .doc = "aerosol amount over clear air (atmosphere)"},
    {"zenith", FIELD_COLOR, offsetof(mgt_sky, zenith), 0, 0, 1e9, "kcd/m²", .doc = "linear sRGB, straight up (gradient)"},
    {"horizon", FIELD_COLOR, offsetof(mgt_sky, horizon), 0, 0, 1e9, "kcd/m²", .doc = "linear sRGB, at the horizon (gradient)"},
    {"night", FIELD_COLOR, offsetof(mgt_sky, night), 0, 0, 1e9, "kcd/m²", .doc = "linear sRGB, airglow and stars, added everywhere (atmosphere)"},
    {0}};

static const scene_field wave_fields[] = {
    {"amplitude", FIELD_NUMBER, offsetof(mgt_wave, amplitude), FIELD_REQUIRED, 0, 1000, "m", .doc = "height of the crest over the mean surface"},
    {"a", FIELD_NUMBER, offsetof(mgt_wave, a), FIELD_REQUIRED, -1e5, 1e5, "rad/m", .doc = "wave vector along x"},
    {"b", FIELD_NUMBER, offsetof(mgt_wave, b), FIELD_REQUIRED, -1e5, 1e5, "rad/m", .doc = "wave vector along z"},
    {"c", FIELD_NUMBER, offsetof(mgt_wave, c), FIELD_REQUIRED, -1e5, 1e5, "rad/s", .doc = "angular speed"},
    {"phase", FIELD_NUMBER, offsetof(mgt_wave, phase), 0, ANYWHERE, "rad", .doc = "phase at x = z = 0, time 0"},
    {0}};

static const scene_field spectrum_fields[] = {
    {"model", FIELD_CHOICE, offsetof(scene_spectrum, settings.kind), 0, NO_RANGE, NULL,
     .doc = "which sea; none: no further waves; buoy: the table in file", .choices = spectrum_kinds},
    {"wind", FIELD_NUMBER, offsetof(scene_spectrum, settings.wind), 0, 0.5, 75, "m/s", .doc = "speed of the wind"},
    {"wind_height", FIELD_NUMBER, offsetof(scene_spectrum, settings.wind_height), 0, 0, 200, "m",
     .doc = "where the wind was measured; 0: 19.5 m for pierson-moskowitz, else 10 m, as in their papers"},
    {"fetch", FIELD_NUMBER, offsetof(scene_spectrum, settings.fetch), 0, 100, 1e7, "m",
     .doc = "stretch of open water that the wind has crossed (jonswap, tma)"},
    {"depth", FIELD_NUMBER, offsetof(scene_spectrum, settings.depth), 0, 0, 12000, "m", .doc = "of the water; 0: deep"},
    {"gamma", FIELD_NUMBER, offsetof(scene_spectrum, settings.gamma), 0, 1, 20, NULL, .doc = "how far the peak stands out (jonswap, tma)"},
    {"direction_deg", FIELD_NUMBER, offsetof(scene_spectrum, settings.direction_deg), 0, -1e6, 1e6, "degrees",
     .doc = "where the wind comes from: 0 is -z (\"north\"), 90 is +x (\"east\")"},
    {"directions", FIELD_CHOICE, offsetof(scene_spectrum, settings.directions), 0, NO_RANGE, NULL,
     .doc = "how waves spread around the wind; fixed: cos^2s of half the angle with s = spread", .choices = spectrum_spreadings},
    {"spread", FIELD_NUMBER, offsetof(scene_spectrum, settings.spread), 0, 0, 1000, NULL, .doc = "s of directions: fixed; 0: from everywhere"},
    {"slope", FIELD_CHOICE, offsetof(scene_spectrum, settings.slope), 0, NO_RANGE, NULL,
     .doc = "cox-munk: the short waves are scaled to the mean-square slope of a clean sea in this wind", .choices = spectrum_slopes},
    {"shortest", FIELD_NUMBER, offsetof(scene_spectrum, settings.shortest), 0, 0, 1000, "m",
     .doc = "length of the shortest wave; 0: 0.05 m, or a table's end"},
    {"count", FIELD_COUNT, offsetof(scene_spectrum, count), 0, 1, MGT_MAX_WAVES, NULL, .doc = "number of waves, with those of waves at most 512"},
    {"seed", FIELD_COUNT, offsetof(scene_spectrum, seed), 0, 0, 4294967295, NULL, .doc = "another seed: another sea of the same kind"},
    {"file", FIELD_TEXT, offsetof(scene_spectrum, file), 0, NO_RANGE, NULL, .doc = "table of a buoy, from the scene's folder (see waves.md)"},
    {0}};

static const scene_field water_fields[] = {
    {"waves", FIELD_LIST, offsetof(scene_water, waves), 0, NO_RANGE, NULL,
     .doc = "each adds amplitude·sin(a·x + b·z + c·t + phase) to the height; none: a flat mirror", .fields = wave_fields,
     .item_size = sizeof(mgt_wave), .max_items = MGT_MAX_WAVES, .prepare = prepare_wave},
    {"spectrum", FIELD_MAPPING, offsetof(scene_water, spectrum), FIELD_NO_PIXELS, NO_RANGE, NULL,
     .doc = "waves drawn from a wind's or a buoy's spectrum, beside those of waves", .fields = spectrum_fields},
    {"ior", FIELD_NUMBER, offsetof(scene_water, index_of_refraction), 0, 1, 3, NULL, .doc = "index of refraction"},
    {"body_albedo", FIELD_COLOR, offsetof(scene_water, body_albedo), 0, 0, 1, NULL,
     .doc = "share of the light entering the water that deep water sends up again, linear sRGB"},
    {0}};

static const scene_field post_fields[] = {
    {"exposure", FIELD_EXPOSURE, offsetof(scene_post, exposure), 0, -60, 60, "stops",
     .doc = "auto: from light and sky, the same for a whole film; a number: 2^exposure per kcd/m²"},
    {"exposure_offset", FIELD_NUMBER, offsetof(scene_post, exposure_offset), 0, -60, 60, "stops", .doc = "added to the automatic exposure"},
    {"tone_map", FIELD_CHOICE, offsetof(scene_post, tone_map), 0, NO_RANGE, NULL, .doc = "how radiance becomes displayed colour", .choices = tone_maps},
    {"glare", FIELD_SHARE, offsetof(scene_post, glare), 0, 0, 1, NULL, .doc = "share of the light that the eye scatters"},
    {0}};

static const scene_field scene_fields[] = {
    {"mangata", FIELD_COUNT, offsetof(scene_values, version), FIELD_REQUIRED, VERSION, NULL, .doc = "version of the format"},
    {"description", FIELD_TEXT, offsetof(scene_values, description), FIELD_NO_PIXELS, NO_RANGE, NULL, .doc = "free text"},
    {"image", FIELD_MAPPING, offsetof(scene_values, image), 0, NO_RANGE, NULL, .doc = "the picture", .fields = image_fields},
    {"camera", FIELD_MAPPING, offsetof(scene_values, camera), 0, NO_RANGE, NULL, .doc = "the view", .fields = camera_fields},
    {"time", FIELD_MAPPING, offsetof(scene_values, time), 0, NO_RANGE, NULL, .doc = "the clock", .fields = time_fields},
    {"light", FIELD_MAPPING, offsetof(scene_values, light), 0, NO_RANGE, NULL, .doc = "the sun or the moon", .fields = light_fields},
    {"sky", FIELD_MAPPING, offsetof(scene_values, sky), 0, NO_RANGE, NULL, .doc = "what the water mirrors", .fields = sky_fields},
    {"water", FIELD_MAPPING, offsetof(scene_values, water), 0, NO_RANGE, NULL, .doc = "the surface and what is under it", .fields = water_fields},
    {"post", FIELD_MAPPING, offsetof(scene_values, post), 0, NO_RANGE, NULL, .doc = "from radiance to 8-bit pictures", .fields = post_fields},
    {0}};

static const scene_field root_field = {"", FIELD_MAPPING, 0, 0, NO_RANGE, NULL, .doc = "a scene of Mangata", .fields = scene_fields};

const scene_field *scene_root_field(void)
{
    return &root_field;
}

scene_values scene_values_defaults(void)
{
    const mgt_scene scene = mgt_scene_defaults();
    scene_values values = {
        .version = 1,
        .image = scene.image,
        .camera = {.still = scene.camera},
        .time = {.start = 0, .fps = 30, .frames = 1, .shutter = 1},
        .light = scene.light,
        .sky = scene.sky,
        .water = {.spectrum = {.settings = {.wind = 8, .fetch = 5e4, .gamma = 3.3, .directions = DIRECTIONS_HASSELMANN, .spread = 10},
                               .count = 64,
                               .seed = 1},
                  .index_of_refraction = scene.water.index_of_refraction},
        .post = {.exposure = {.automatic = scene.post.auto_exposure, .stops = scene.post.auto_exposure ? 0 : scene.post.exposure_ev},
                 .exposure_offset = scene.post.auto_exposure ? scene.post.exposure_ev : 0,
                 .tone_map = scene.post.tone_map,
                 .glare = scene.post.glare},
    };
    memcpy(values.water.body_albedo, scene.water.body_albedo, sizeof values.water.body_albedo);
    return values;
}

void scene_values_free(scene_values *values)
{
    free(values->description);
    free(values->camera.path.items);
    free(values->water.waves.items);
    free(values->water.sea.items);
    free(values->water.spectrum.file);
    values->description = values->water.spectrum.file = NULL;
    values->camera.path = values->water.waves = values->water.sea = (scene_list){0};
}

bool scene_numbers_write(FILE *stream, const scene_field *field, const void *value)
{
    switch (field->type) {
    case FIELD_COUNT: fprintf(stream, "%u", *(const uint32_t *)value); return true;
    case FIELD_NUMBER: fputs(scene_double_text(*(const double *)value).text, stream); return true;
    case FIELD_SHARE: fputs(scene_float_text(*(const float *)value).text, stream); return true;
    case FIELD_VECTOR:
    case FIELD_COLOR:
        for (int i = 0; i < 3; i++) {
            const scene_number_text number =
                field->type == FIELD_VECTOR ? scene_double_text(((const double *)value)[i]) : scene_float_text(((const float *)value)[i]);
            fprintf(stream, "%s%s", i == 0 ? "[" : ", ", number.text);
        }
        fputc(']', stream);
        return true;
    default: return false;
    }
}

bool scene_field_in_range(const scene_field *field, double value)
{
    bool above = field->flags & FIELD_OPEN_MIN ? value > field->min : value >= field->min;
    bool below = field->flags & FIELD_OPEN_MAX ? value < field->max : value <= field->max;
    return above && below;
}

void scene_field_range(const scene_field *field, bool with_unit, char *out, size_t size)
{
    scene_number_text low = scene_double_text(field->min), high = scene_double_text(field->max);
    const char *min = low.text, *max = high.text;
    const char *space = with_unit && field->unit != NULL ? " " : "";
    const char *unit = with_unit && field->unit != NULL ? field->unit : "";
    if (field->min == field->max)
        snprintf(out, size, "%s", min);
    else if (field->flags & (FIELD_OPEN_MIN | FIELD_OPEN_MAX))
        snprintf(out, size, "%s %s and %s %s%s%s", field->flags & FIELD_OPEN_MIN ? "above" : "at least", min,
                 field->flags & FIELD_OPEN_MAX ? "below" : "at most", max, space, unit);
    else
        snprintf(out, size, "%s to %s%s%s", min, max, space, unit);
}

void scene_field_allowed(const scene_field *field, char *out, size_t size)
{
    char range[96];
    scene_field_range(field, true, range, sizeof range);
    size_t used;
    switch (field->type) {
    case FIELD_COUNT: snprintf(out, size, field->min == field->max ? "%s" : "a whole number, %s", range); break;
    case FIELD_NUMBER:
    case FIELD_SHARE: snprintf(out, size, "a number, %s", range); break;
    case FIELD_VECTOR:
        snprintf(out, size, "a list of 3 numbers [x, y, z], each %s%s", range,
                 field->flags & FIELD_ABOVE_WATER ? ", y above 0" : "");
        break;
    case FIELD_COLOR: snprintf(out, size, "a list of 3 numbers [r, g, b], each %s", range); break;
    case FIELD_EXPOSURE: snprintf(out, size, "auto or a number, %s", range); break;
    case FIELD_TEXT: snprintf(out, size, "text"); break;
    case FIELD_CHOICE:
        used = (size_t)snprintf(out, size, "one of");
        for (size_t i = 0; field->choices[i] != NULL && used < size; i++)
            used += (size_t)snprintf(out + used, size - used, "%s %s", i > 0 ? "," : "", field->choices[i]);
        break;
    case FIELD_MAPPING: snprintf(out, size, "a mapping {key: value, ...}"); break;
    case FIELD_LIST: snprintf(out, size, "a list of at most %zu mappings", field->max_items); break;
    }
}
