/* SPDX-License-Identifier: MIT
 *
 * The scene format as one table: keys, types, ranges, units, meanings.
 */
#include "scene/scene_fields.h"

#include "params/foam.h"
#include "params/scene_rows.h"
#include "scene/scene_wave.h"
#include "sea/sea.h"

#include <stdio.h>
#include <string.h>

/* The ranges are the library's own where it has them, so that a file which loads also renders. */
#define VERSION 1, 1
#define NO_RANGE 0, 0

static const char *const spectrum_kinds[] = {"none", "pierson-moskowitz", "jonswap", "tma", "elfouhaily", "buoy", NULL};
static const char *const spectrum_spreadings[] = {"mitsuyasu", "hasselmann", "donelan-banner", "fixed", NULL};
static const char *const spectrum_slopes[] = {"spectrum", "cox-munk", NULL};
static const char *const clarities[] = {"pure", "clear", "coastal", "murky", NULL};
const char *const scene_shape_names[] = {"mesh", "plane", "box", "sphere", "steps", "pool", "floor", NULL};

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

/* Absorption of pure water by Pope and Fry 1997, scattering by Morel 1974, at 610, 550 and 465 nm. What is dissolved and floats in natural waters
 * adds what Petzold measured at 514 nm (1972: Bahamas, California's coast, San Diego harbour; in Mobley 1994), its absorption falling with the
 * wavelength as exp(-0.014/nm), its scattering as 1/wavelength. */
static void decide_clarity(void *parent)
{
    static const float absorption[][3] = {{0.264f, 0.0565f, 0.0101f}, {0.284f, 0.102f, 0.161f}, {0.301f, 0.142f, 0.29f}, {0.35f, 0.255f, 0.661f}};
    static const float scattering[][3] = {{0.0012f, 0.0019f, 0.0039f}, {0.0312f, 0.0346f, 0.0409f}, {0.185f, 0.205f, 0.242f}, {1.54f, 1.7f, 2.02f}};
    scene_water *water = parent;
    memcpy(water->absorption, absorption[water->clarity], sizeof water->absorption);
    memcpy(water->scattering, scattering[water->clarity], sizeof water->scattering);
    water->clarity = CLARITY_PURE;
}

static void prepare_pose(const void *parent, void *item)
{
    (void)parent;
    *(scene_pose *)item = (scene_pose){.scale = {1, 1, 1}};
}

static void prepare_object(const void *parent, void *item)
{
    scene_object *object = item;
    *object = (scene_object){.size = {1, 1, 1}, .count = 4, .rim_height = 0.1, .highest = 1, .material = {.look = scene_material_defaults()}};
    prepare_pose(parent, &object->pose);
}

static const field_row keyframe_fields[] = {{"time", FIELD_NUMBER, offsetof(scene_keyframe, time), FIELD_REQUIRED, FIELD_ANYWHERE, "s",
                                             .doc = "scene time, on the clock of time.start; each later than the one before"},
                                            CAMERA_ROWS(scene_keyframe, camera, FIELD_REQUIRED),
                                            {0}};

static const field_row camera_fields[] =
    {CAMERA_ROWS(scene_camera, still, 0),
     {"path", FIELD_LIST, offsetof(scene_camera, path), 0, NO_RANGE, NULL,
      .doc = "keyframes of a moving camera, in place of position and target; up and fov_y_deg are then the keyframes' defaults", .fields = keyframe_fields,
      .item_size = sizeof(scene_keyframe), .max_items = 10000, .prepare = prepare_keyframe},
     {0}};

static const field_row time_fields[] = {{"start", FIELD_NUMBER, offsetof(scene_clock, start), 0, -1e8, 1e8, "s", .doc = "scene time of frame 0"},
                                        {"fps", FIELD_NUMBER, offsetof(scene_clock, fps), 0, 0.01, 1000, "frames/s",
                                         .doc = "frames a second; frame f shows start + f/fps"},
                                        {"frames", FIELD_COUNT, offsetof(scene_clock, frames), FIELD_NO_PIXELS, 1, 1000000, NULL, .doc = "length of the film"},
                                        {"shutter", FIELD_NUMBER, offsetof(scene_clock, shutter), 0, 0, 1000, "frames",
                                         .doc = "how long light is gathered before a frame's time, as a fraction of 1/fps; 0: an instant"},
                                        {0}};

static const field_row spectrum_fields[] =
    {{"model", FIELD_CHOICE, offsetof(scene_spectrum, settings.kind), FIELD_REQUIRED, NO_RANGE, NULL,
      .doc = "which sea; none: no further waves; buoy: the table in file", .choices = spectrum_kinds},
     {"wind", FIELD_NUMBER, offsetof(scene_spectrum, settings.wind), 0, SEA_WIND, "m/s", .doc = "speed of the wind"},
     {"wind_height", FIELD_NUMBER, offsetof(scene_spectrum, settings.wind_height), FIELD_OR_ZERO, SEA_WIND_HEIGHT, "m",
      .doc = "where the wind was measured; 0: 19.5 m for pierson-moskowitz, else 10 m, as in their papers"},
     {"fetch", FIELD_NUMBER, offsetof(scene_spectrum, settings.fetch), 0, SEA_FETCH, "m",
      .doc = "stretch of open water that the wind has crossed (jonswap, tma, elfouhaily)"},
     {"depth", FIELD_NUMBER, offsetof(scene_spectrum, settings.depth), 0, SEA_DEPTH, "m", .doc = "of the water; 0: deep"},
     {"gamma", FIELD_NUMBER, offsetof(scene_spectrum, settings.gamma), 0, SEA_GAMMA, NULL, .doc = "peak enhancement factor (jonswap, tma)"},
     {"direction_deg", FIELD_NUMBER, offsetof(scene_spectrum, settings.direction_deg), 0, SEA_DIRECTION, "degrees",
      .doc = "where the wind comes from: 0 is -z (\"north\"), 90 is +x (\"east\")"},
     {"directions", FIELD_CHOICE, offsetof(scene_spectrum, settings.directions), 0, NO_RANGE, NULL,
      .doc = "how waves spread around the wind (pierson-moskowitz, jonswap, tma); fixed: cos^2s of half the angle with s = spread",
      .choices = spectrum_spreadings},
     {"spread", FIELD_NUMBER, offsetof(scene_spectrum, settings.spread), 0, SEA_SPREAD, NULL, .doc = "s of directions: fixed; 0: from everywhere"},
     {"slope", FIELD_CHOICE, offsetof(scene_spectrum, settings.slope), 0, NO_RANGE, NULL,
      .doc = "cox-munk: the short waves are scaled to the mean-square slope of a clean sea in this wind", .choices = spectrum_slopes},
     {"shortest", FIELD_NUMBER, offsetof(scene_spectrum, settings.shortest), FIELD_OR_ZERO, SEA_SHORTEST, "m",
      .doc = "length of the shortest wave; 0: 0.05 m, or a table's end"},
     {"count", FIELD_COUNT, offsetof(scene_spectrum, count), 0, 1, MGT_MAX_WAVES, NULL, .doc = "number of waves, with those of waves at most 2048"},
     {"seed", FIELD_COUNT, offsetof(scene_spectrum, seed), 0, 0, 4294967295, NULL, .doc = "another seed: another sea of the same kind"},
     {"file", FIELD_TEXT, offsetof(scene_spectrum, file), 0, NO_RANGE, NULL,
      .doc = "table of a buoy, or a file of NDBC's or Datawell's, from the scene's folder (see waves.md)"},
     {0}};

static const field_row wind_fields[] = {{"speed", FIELD_NUMBER, offsetof(scene_wind, speed), FIELD_OR_ZERO, SEA_WIND, "m/s",
                                         .doc = "of the wind at 10 m, which makes the whole sea; wind: 12 says the speed alone; 0: no such sea"},
                                        {"direction_deg", FIELD_NUMBER, offsetof(scene_wind, direction_deg), 0, SEA_DIRECTION, "degrees",
                                         .doc = "where the wind comes from: 0 is -z (\"north\"), 90 is +x (\"east\")"},
                                        {"fetch", FIELD_NUMBER, offsetof(scene_wind, fetch), FIELD_OR_ZERO, SEA_FETCH, "m",
                                         .doc = "stretch of open water that the wind has crossed; 0: as long as the sea needs to be fully developed"},
                                        {"depth", FIELD_NUMBER, offsetof(scene_wind, depth), 0, SEA_DEPTH, "m", .doc = "of the water; 0: deep"},
                                        {"count", FIELD_COUNT, offsetof(scene_wind, count), 0, 1, MGT_MAX_WAVES, NULL, .doc = "number of waves"},
                                        {"seed", FIELD_COUNT, offsetof(scene_wind, seed), 0, 0, 4294967295, NULL,
                                         .doc = "another seed: another sea of the same kind"},
                                        {0}};

static void prepare_swell(const void *parent, void *item)
{
    (void)parent;
    *(scene_swell *)item = scene_swell_defaults();
}

static const field_row swell_fields[] =
    {{"height", FIELD_NUMBER, offsetof(scene_swell, height), FIELD_REQUIRED, SWELL_HEIGHT, "m", .doc = "significant height"},
     {"period", FIELD_NUMBER, offsetof(scene_swell, period), 0, SWELL_PERIOD, "s", .doc = "of its highest waves"},
     {"direction_deg", FIELD_NUMBER, offsetof(scene_swell, direction_deg), 0, SEA_DIRECTION, "degrees",
      .doc = "where it comes from: 0 is -z (\"north\"), 90 is +x (\"east\")"},
     {"spread", FIELD_NUMBER, offsetof(scene_swell, spread), 0, SEA_SPREAD, NULL,
      .doc = "s of cos^2s of half the angle to its direction: 25 from near, 75 from far away"},
     {"count", FIELD_COUNT, offsetof(scene_swell, count), 0, 1, MGT_MAX_WAVES, NULL, .doc = "number of waves, with all others at most 2048"},
     {"seed", FIELD_COUNT, offsetof(scene_swell, seed), 0, 0, 4294967295, NULL, .doc = "another seed: another swell of the same kind"},
     {0}};

static void decide_wind(void *parent)
{
    scene_water *water = parent;
    if (water->wind.speed > 0) {
        water->choppiness = SEA_CHOPPINESS;
        water->foam.amount = 1;
    }
}

static const field_row foam_fields[] = {{"amount", FIELD_NUMBER, offsetof(scene_foam, amount), FIELD_NO_PIXELS, SEA_FOAM, NULL,
                                         .doc = "whitecaps over what the wind makes at sea, 3.84e-6 U^3.41 of the water; 0: none; 1 with water.wind"},
                                        {"share", FIELD_NUMBER, offsetof(scene_foam, share), 0, 0, MOST_FOAM, NULL,
                                         .doc = "of the water that whitecaps cover, for waves of no wind: in place of amount; 0: what amount says"},
                                        {"persistence", FIELD_NUMBER, offsetof(scene_foam, persistence), 0, 0, 60, "s",
                                         .doc = "how long foam lasts; 0: only where waves break right now"},
                                        {0}};

static const field_row water_fields[] =
    {{"waves", FIELD_LIST, offsetof(scene_water, waves), 0, NO_RANGE, NULL,
      .doc = "each adds amplitude·sin(a·x + b·z + c·t + phase) to the height; none: a flat mirror", .fields = wave_rows, .item_size = sizeof(mgt_wave),
      .max_items = MGT_MAX_WAVES, .prepare = prepare_wave, .other = &measured_wave_form},
     {"spectrum", FIELD_MAPPING, offsetof(scene_water, spectrum), FIELD_NO_PIXELS, NO_RANGE, NULL,
      .doc = "waves drawn from a wind's or a buoy's spectrum, beside those of waves", .fields = spectrum_fields},
     {"wind", FIELD_MAPPING, offsetof(scene_water, wind), FIELD_NO_PIXELS | FIELD_SHORT, NO_RANGE, NULL,
      .doc = "a whole sea from the wind alone, in place of waves and spectrum: a speed, or a mapping", .fields = wind_fields, .decide = decide_wind},
     {"swell", FIELD_LIST, offsetof(scene_water, swell), FIELD_NO_PIXELS, NO_RANGE, NULL, .doc = "waves from far away, beside all others",
      .fields = swell_fields, .item_size = sizeof(scene_swell), .max_items = SEA_SWELLS, .prepare = prepare_swell},
     {"amplitude", FIELD_NUMBER, offsetof(scene_water, height), FIELD_NO_PIXELS, 0, 1000, NULL,
      .doc = "factor on the heights of all waves, those of spectrum, wind and swell too; 0: a flat mirror"},
     WATER_BODY_ROWS(scene_water),
     {"foam", FIELD_MAPPING, offsetof(scene_water, foam), 0, NO_RANGE, NULL, .doc = "whitecaps, where choppy water is pressed together", .fields = foam_fields},
     {"clarity", FIELD_CHOICE, offsetof(scene_water, clarity), FIELD_NO_PIXELS, NO_RANGE, NULL,
      .doc = "sets the defaults of absorption and scattering: a clean pool, clear ocean, a coast, a harbour", .choices = clarities, .decide = decide_clarity},
     WATER_COLOR_ROWS(scene_water),
     {0}};

/* The rows of a scene_pose inside a struct: an object and its instances share them. */
#define PLACE(type, member)                                                                                                                              \
    {"position", FIELD_VECTOR, offsetof(type, member), 0, -1e6, 1e6, "m", .doc = "where the origin of the mesh or shape goes"},                          \
        {"rotation_deg",                                                                                                                                 \
         FIELD_VECTOR,                                                                                                                                   \
         offsetof(type, member) + offsetof(scene_pose, rotation_deg),                                                                                    \
         0,                                                                                                                                              \
         -1e6,                                                                                                                                           \
         1e6,                                                                                                                                            \
         "degrees",                                                                                                                                      \
         .doc = "angles about x, y and z, right-handed: turned about z first, then x, then y"},                                                          \
    {                                                                                                                                                    \
        "scale", FIELD_SCALE, offsetof(type, member) + offsetof(scene_pose, scale), 0, 1e-6, 1e6, NULL, .doc = "factor on the size, before it is turned" \
    }

static const field_row instance_fields[] = {PLACE(
                                                struct { scene_pose pose; }, pose),
                                            {0}};

#define LOOK(member) offsetof(scene_material, look.member)

static const field_row material_fields[] =
    {{"base_color", FIELD_COLOR, LOOK(base_color), 0, 0, 1, NULL, .doc = "linear sRGB, times the texture"},
     {"roughness", FIELD_FLOAT, LOOK(roughness), 0, 0.02, 1, NULL, .doc = "of the gloss (GGX, alpha is its square)"},
     {"metallic", FIELD_FLOAT, LOOK(metallic), 0, 0, 1, NULL, .doc = "1: a metal; 0: mirrors 4% at normal incidence and is diffuse below"},
     {"texture", FIELD_TEXT, offsetof(scene_material, texture), FIELD_NO_PIXELS, NO_RANGE, NULL,
      .doc = "PNG or JPEG picture, from the scene's folder; on shapes it repeats each metre"},
     {"pattern", FIELD_CHOICE, LOOK(pattern), 0, NO_RANGE, NULL,
      .doc = "puts pattern_color on the joints between tiles, every other field or every other stripe", .choices = pattern_names},
     {"pattern_color", FIELD_COLOR, LOOK(pattern_color), 0, 0, 1, NULL, .doc = "linear sRGB"},
     {"pattern_size", FIELD_FLOAT, LOOK(pattern_size), 0, 1e-4, 1e6, NULL,
      .doc = "side of a tile, field or stripe in texture coordinates, which are metres on shapes"},
     {"pattern_joint", FIELD_FLOAT, LOOK(pattern_joint), 0, 0, 0.999, NULL, .doc = "width of a joint as a fraction of a tile"},
     {0}};

static const char *const dry_words[] = {"false", "true", NULL};

static const field_row object_fields[] =
    {{"name", FIELD_TEXT, offsetof(scene_object, name), FIELD_NO_PIXELS, NO_RANGE, NULL, .doc = "free text, after which mattes are called"},
     {"mesh", FIELD_TEXT, offsetof(scene_object, mesh), FIELD_NO_PIXELS, NO_RANGE, NULL,
      .doc = "file of triangles (.gltf, .glb, .obj, .ply), from the scene's folder; this or shape"},
     {"shape", FIELD_CHOICE, offsetof(scene_object, shape), 0, NO_RANGE, NULL, .doc = "a built-in shape; mesh: the file in mesh", .choices = scene_shape_names},
     {"size", FIELD_VECTOR, offsetof(scene_object, size), 0, 1e-3, 1e5, "m", .doc = "of a shape along x, y and z, before scale"},
     {"triangles", FIELD_COUNT, offsetof(scene_object, triangles), 0, 0, SCENE_SHAPE_TRIANGLES, NULL,
      .doc = "at most so many of a shape, as even as it goes; 0: as few as its form needs"},
     {"count", FIELD_COUNT, offsetof(scene_object, count), 0, 1, 100, NULL, .doc = "number of steps (steps)"},
     {"rim_width", FIELD_NUMBER, offsetof(scene_object, rim_width), 0, 0, 1e4, "m", .doc = "width of the level rim around a pool; 0: none (pool)"},
     {"rim_height", FIELD_NUMBER, offsetof(scene_object, rim_height), 0, 0, 1000, "m", .doc = "of the walls over the pool's origin (pool)"},
     {"heights", FIELD_TEXT, offsetof(scene_object, heights), FIELD_NO_PIXELS, NO_RANGE, NULL,
      .doc = "grey PNG or PFM of the heights, from the scene's folder, its top row at -z (floor)"},
     {"lowest", FIELD_NUMBER, offsetof(scene_object, lowest), 0, -1e5, 1e5, "m", .doc = "height of 0 or black (floor)"},
     {"highest", FIELD_NUMBER, offsetof(scene_object, highest), 0, -1e5, 1e5, "m", .doc = "height of 1 or white (floor)"},
     {"dry", FIELD_SWITCH, offsetof(scene_object, dry), 0, NO_RANGE, NULL, .doc = "true: a hull, no water within it; see docs/refraction.md",
      .choices = dry_words},
     PLACE(scene_object, pose),
     {"instances", FIELD_LIST, offsetof(scene_object, instances), 0, NO_RANGE, NULL, .doc = "further places of the same mesh or shape",
      .fields = instance_fields, .item_size = sizeof(scene_pose), .max_items = MGT_MAX_OBJECTS, .prepare = prepare_pose},
     {"material", FIELD_MAPPING, offsetof(scene_object, material), FIELD_GIVEN, NO_RANGE, NULL,
      .doc = "what it is made of; replaces the materials of a mesh's file", .fields = material_fields},
     {0}};

static const char *const when_words[] = {"auto", "off", "on", NULL};

static const field_row sky_fields[] =
    {SKY_LOOK_ROWS(scene_sky, look),
     {"aerial", FIELD_CHOICE, offsetof(scene_sky, aerial), 0, NO_RANGE, NULL,
      .doc = "on: the air of the atmosphere is seen before the water, more of it with turbidity; auto: on with water.wind, else off", .choices = when_words},
     {"stars", FIELD_CHOICE, offsetof(scene_sky, stars), 0, NO_RANGE, NULL,
      .doc = "on: the stars of the naked eye stand in the sky (atmosphere); auto: on with water.wind and the moon, else off", .choices = when_words},
     {0}};

static const field_row scene_post_fields[] = {{"exposure", FIELD_EXPOSURE, offsetof(scene_post, exposure), 0, EXPOSURE_RANGE,
                                               .doc = "auto: from light and sky, the same for a whole film; a number: 2^exposure per kcd/m²"},
                                              {"exposure_offset", FIELD_NUMBER, offsetof(scene_post, exposure_offset), 0, EXPOSURE_RANGE,
                                               .doc = "added to the automatic exposure"},
                                              POST_ROWS(scene_post),
                                              {"night_tint", FIELD_CHOICE, offsetof(scene_post, night_tint), 0, NO_RANGE, NULL,
                                               .doc = "on: dark scenes have the bluish grey of the night; auto: on with water.wind and the moon, else off",
                                               .choices = when_words},
                                              {0}};

static const field_row scene_fields[] =
    {{"mangata", FIELD_COUNT, offsetof(scene_values, version), FIELD_REQUIRED, VERSION, NULL, .doc = "version of the format"},
     {"description", FIELD_TEXT, offsetof(scene_values, description), FIELD_NO_PIXELS, NO_RANGE, NULL, .doc = "free text"},
     {"image", FIELD_MAPPING, offsetof(scene_values, image), 0, NO_RANGE, NULL, .doc = "the picture", .fields = image_rows},
     {"camera", FIELD_MAPPING, offsetof(scene_values, camera), 0, NO_RANGE, NULL, .doc = "the view", .fields = camera_fields},
     {"time", FIELD_MAPPING, offsetof(scene_values, time), 0, NO_RANGE, NULL, .doc = "the clock", .fields = time_fields},
     {"light", FIELD_MAPPING, offsetof(scene_values, light), 0, NO_RANGE, NULL, .doc = "the sun or the moon", .fields = light_rows},
     {"sky", FIELD_MAPPING, offsetof(scene_values, sky), 0, NO_RANGE, NULL, .doc = "what the water mirrors", .fields = sky_fields},
     {"water", FIELD_MAPPING, offsetof(scene_values, water), 0, NO_RANGE, NULL, .doc = "the surface and what is under it", .fields = water_fields},
     {"objects", FIELD_LIST, offsetof(scene_values, objects), 0, NO_RANGE, NULL, .doc = "what stands in and around the water", .fields = object_fields,
      .item_size = sizeof(scene_object), .max_items = 10000, .prepare = prepare_object},
     {"post", FIELD_MAPPING, offsetof(scene_values, post), 0, NO_RANGE, NULL, .doc = "from radiance to 8-bit pictures", .fields = scene_post_fields},
     {"quality", FIELD_MAPPING, offsetof(scene_values, quality), FIELD_NO_PIXELS, NO_RANGE, NULL, .doc = "how it is rendered; the command line overrides it",
      .fields = quality_fields},
     {0}};

static const field_row root_field = {"", FIELD_MAPPING, 0, 0, NO_RANGE, NULL, .doc = "a scene of Mangata", .fields = scene_fields};

const field_row *scene_root_field(void) { return &root_field; }
