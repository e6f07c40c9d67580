/* SPDX-License-Identifier: MIT
 * A scene from the page's settings. */
#include "page.h"

#include <math.h>
#include <string.h>

#include "mangata/waves.h"
#include "params/methods.h"
#include "params/scene_rows.h"

static double settings[SETTING_COUNT];
static double target[3];           /* the camera's, as the page writes it into commands */
static double drawn[SETTING_moon]; /* settings of the sea that `waves` are of */
static mgt_wave waves[MGT_MAX_WAVES];
static mgt_scene scene;
static sky_state *sky;

const mgt_scene *page_scene(void) { return &scene; }
const sky_state *page_sky(void) { return sky; }

EXPORT(settings) double *page_settings(void) { return settings; }
EXPORT(target) double *page_target(void) { return target; }
EXPORT(sky_table) const float *page_sky_table(void) { return sky->table; }
EXPORT(sky_columns) int page_sky_columns(void) { return SKY_COLUMNS; }
EXPORT(sky_rows) int page_sky_rows(void) { return SKY_TABLE_ROWS; }

static mgt_status draw_sea(void)
{
    mgt_sea sea;
    mgt_sea_init(&sea, sizeof sea);
    sea.wind = settings[SETTING_wind];
    sea.direction_deg = settings[SETTING_direction];
    sea.fetch = settings[SETTING_fetch] * 1000;
    sea.seed = (uint32_t)settings[SETTING_seed];
    sea.count = (uint32_t)settings[SETTING_waves];
    sea.choppiness = (float)settings[SETTING_choppiness];
    sea.foam = (float)settings[SETTING_foam];
    mgt_swell swell;
    mgt_swell_init(&swell);
    swell.height = settings[SETTING_swell];
    swell.period = settings[SETTING_swell_period];
    swell.direction_deg = settings[SETTING_swell_direction];
    sea.swells = &swell;
    sea.swell_count = swell.height > 0;
    return mgt_sea_scene(&sea, waves, MGT_MAX_WAVES, &scene);
}

static double *light_number(const char *key) { return (double *)((char *)&scene.light + field_find(light_rows, key, strlen(key))->offset); }

/* The scene's sea anew, where its settings have changed. Below 0: no such sea, and the one before stays. */
EXPORT(take_sea) int page_take_sea(void)
{
    if (!sky) {
        sky = sky_state_create();
        mgt_scene_init(&scene, sizeof scene);
    }
    if (memcmp(drawn, settings, sizeof drawn) == 0)
        return 0;
    if (draw_sea() != MGT_OK)
        return -1;
    memcpy(drawn, settings, sizeof drawn);
    return 0;
}

/* Scene and sky anew. Below 0: no such sea. */
EXPORT(update) int page_update(void)
{
    if (page_take_sea() < 0)
        return -1;
    mgt_light_init(&scene.light, settings[SETTING_moon] != 0 ? MGT_SOURCE_MOON : MGT_SOURCE_SUN);
    scene.stars = scene.night_tint = settings[SETTING_moon] != 0;
    *light_number("elevation_deg") = settings[SETTING_elevation];
    *light_number("azimuth_deg") = settings[SETTING_azimuth];
    scene.sky.turbidity = (float)settings[SETTING_turbidity];
    scene.camera.position[0] = scene.camera.position[2] = 0;
    scene.camera.position[1] = settings[SETTING_height];
    memcpy(scene.camera.target, target, sizeof target);
    scene.camera.fov_y_deg = settings[SETTING_fov];
    scene.time = settings[SETTING_time];
    scene.shutter = settings[SETTING_shutter] / 30;
    scene.frame_interval = 1.0 / 30;
    scene.post.exposure_ev = settings[SETTING_exposure];
    if (!sky_state_same_inputs(sky, &scene.sky, &scene.light))
        sky_state_build(sky, &scene.sky, &scene.light);
    sky_state_see_air(sky, &scene);
    return 0;
}

frame page_frame(mgt_method method, uint32_t columns, uint32_t rows, const double jitter[2])
{
    scene.image = (mgt_image){.width = columns, .height = rows};
    scene.quality.method = method;
    frame f;
    frame_make(&scene, sky, true, &f);
    camera_rays rays = camera_rays_of(&scene.camera, columns, rows);
    for (int i = 0; i < 3; i++)
        rays.corner[i] += jitter[0] * rays.right[i] + jitter[1] * rays.down[i];
    frame_look(&f, &rays, &rays);
    return f;
}

interval page_interval(const frame *f, mgt_method method, bool *filter)
{
    const mgt_method_waves kind = method_of(method)->properties.waves;
    *filter = kind != MGT_WAVES_POINT;
    return kind == MGT_WAVES_SHUTTER ? frame_shutter(f) : (interval){f->scene->time, 0};
}
