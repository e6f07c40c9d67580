/* SPDX-License-Identifier: MIT
 *
 * Rows of an mgt_scene.
 */
#include "params/scene_rows.h"

#include "params/foam.h"
#include "params/names.h"

#define NO_RANGE 0, 0

static const char *const switch_words[] = {"off", "on", NULL};

const mgt_light light_defaults[] =
    {[MGT_SOURCE_SUN] = {.body = MGT_SOURCE_SUN, .elevation_deg = 30, .angular_radius_deg = 0.2665, .radiance = {1.98e6f, 1.88e6f, 1.80e6f}},
     [MGT_SOURCE_MOON] = {.body = MGT_SOURCE_MOON, .elevation_deg = 30, .angular_radius_deg = 0.2590, .radiance = {3.75f, 3.45f, 3.0f}}};

bool light_is_moon(const mgt_light *light) { return light->body == MGT_SOURCE_MOON; }

double light_shining_radius_deg(const mgt_light *light)
{
    const bool shines = light->radiance[0] > 0 || light->radiance[1] > 0 || light->radiance[2] > 0;
    return shines ? light->angular_radius_deg : 0;
}

static void decide_body(void *parent)
{
    mgt_light *light = parent;
    *light = light_defaults[light->body];
}

/* Sets the radius and radiance of another body. It stays in its place. */
static void change_body(void *parent)
{
    mgt_light *light = parent;
    const mgt_light old = *light;
    decide_body(light);
    light->elevation_deg = old.elevation_deg;
    light->azimuth_deg = old.azimuth_deg;
}

const field_row image_rows[] = {{"width", FIELD_COUNT, offsetof(mgt_image, width), 0, 1, MGT_MAX_IMAGE_SIDE, "pixels", .doc = "width of the whole image"},
                                {"height", FIELD_COUNT, offsetof(mgt_image, height), 0, 1, MGT_MAX_IMAGE_SIDE, "pixels", .doc = "height of the whole image"},
                                {0}};

const field_row light_rows[] = {{"body", FIELD_CHOICE, offsetof(mgt_light, body), 0, NO_RANGE, NULL,
                                 .doc = "kind of light: sets the defaults of angular_radius_deg and radiance, and the limb darkening", .choices = body_names,
                                 .alias = "source", .decide = decide_body, .change = change_body},
                                {"elevation_deg", FIELD_NUMBER, offsetof(mgt_light, elevation_deg), 0, -90, 90, "degrees",
                                 .doc = "height over the horizon; below 0 no direct light meets the water"},
                                {"azimuth_deg", FIELD_NUMBER, offsetof(mgt_light, azimuth_deg), 0, -1e6, 1e6, "degrees",
                                 .doc = "0 is -z (\"north\"), 90 is +x (\"east\")"},
                                {"angular_radius_deg", FIELD_NUMBER, offsetof(mgt_light, angular_radius_deg), 0, 1e-4, 20, "degrees",
                                 .doc = "radius of the disk in the sky"},
                                {"radiance", FIELD_COLOR, offsetof(mgt_light, radiance), 0, 0, 1e12, "kcd/m²",
                                 .doc = "linear sRGB; with the atmosphere sky as seen outside the atmosphere"},
                                {0}};

typedef struct sky_place {
    mgt_sky sky;
} sky_place;

const field_row sky_rows[] = {SKY_LOOK_ROWS(sky_place, sky), {0}};

typedef struct camera_place {
    mgt_camera camera;
} camera_place;

const field_row camera_rows[] = {CAMERA_ROWS(camera_place, camera, 0), {0}};

static const field_row water_rows[] = {WATER_BODY_ROWS(mgt_water), WATER_COLOR_ROWS(mgt_water), {0}};

#define PART(member, rows, text)                                                                            \
    {                                                                                                       \
#member, FIELD_MAPPING, offsetof(mgt_scene, member), 0, NO_RANGE, NULL, .doc = text, .fields = rows \
    }

const field_row scene_rows[] = {PART(camera, camera_rows, "when the shutter closes"),
                                {"camera_moves", FIELD_SWITCH, offsetof(mgt_scene, camera_moves), .doc = "whether camera_open counts", .choices = switch_words},
                                {"time", FIELD_NUMBER, offsetof(mgt_scene, time), 0, FIELD_ANYWHERE, "s", .doc = "when the shutter closes"},
                                {"shutter", FIELD_NUMBER, offsetof(mgt_scene, shutter), 0, 0, 1e6, "s", .doc = "how long the shutter is open"},
                                {"frame_interval", FIELD_NUMBER, offsetof(mgt_scene, frame_interval), 0, 0, 1e6, "s", .doc = "since the frame before"},
                                PART(light, light_rows, "the sun or the moon"),
                                PART(sky, sky_rows, "what the water mirrors"),
                                {"aerial", FIELD_SWITCH, offsetof(mgt_scene, aerial), .doc = "whether the air before the water is seen",
                                 .choices = switch_words},
                                {"stars", FIELD_SWITCH, offsetof(mgt_scene, stars), .doc = "whether stars are seen in the sky", .choices = switch_words},
                                {"night_tint", FIELD_SWITCH, offsetof(mgt_scene, night_tint), .doc = "whether colours are shown as by night",
                                 .choices = switch_words},
                                PART(water, water_rows, "the surface and what is under it"),
                                {"foam", FIELD_FLOAT, offsetof(mgt_scene, foam), 0, 0, MOST_FOAM, NULL, .doc = "share of the water that whitecaps cover"},
                                {"foam_persistence", FIELD_FLOAT, offsetof(mgt_scene, foam_persistence), 0, 0, 60, "s", .doc = "how long foam lasts"},
                                PART(post, post_fields, "from radiance to displayed colour"),
                                PART(quality, quality_fields, "how it is rendered"),
                                {0}};
