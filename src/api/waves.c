/* SPDX-License-Identifier: MIT
 * The functions of mangata/waves.h: seas of wind and swell as the waves of a scene. */
#include "mangata/waves.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/structs.h"
#include "api/validate.h"
#include "params/foam.h"
#include "params/scene_rows.h"
#include "params/waves.h"
#include "sea/sea.h"
#include "sea/sea_rows.h"
#include "sea/spectrum_sample.h"
#include "sea/spectrum_swell.h"

_Static_assert((int)MGT_SPECTRUM_PIERSON_MOSKOWITZ == (int)SPECTRUM_PIERSON_MOSKOWITZ && (int)MGT_SPECTRUM_ELFOUHAILY == (int)SPECTRUM_ELFOUHAILY &&
                   (int)MGT_SPREADING_FIXED == (int)DIRECTIONS_FIXED,
               "the public enums are those of spectra");

static spectrum_settings settings_of(const mgt_sea *sea)
{
    if (sea->spectrum == MGT_SPECTRUM_AUTO) {
        spectrum_settings s =
            sea_of_wind(wind_at_height(sea->wind, sea->wind_height > 0 ? sea->wind_height : 10, 10), sea->direction_deg, sea->fetch, sea->depth);
        s.slope = sea->cox_munk ? SLOPE_COX_MUNK : SLOPE_SPECTRUM;
        s.shortest = sea->shortest;
        return s;
    }
    return (spectrum_settings){.kind = (spectrum_kind)sea->spectrum,
                               .wind = sea->wind,
                               .wind_height = sea->wind_height,
                               .fetch = sea->fetch,
                               .depth = sea->depth,
                               .gamma = sea->gamma,
                               .direction_deg = sea->direction_deg,
                               .directions = (spectrum_directions)sea->spreading,
                               .spread = sea->spread,
                               .slope = sea->cox_munk ? SLOPE_COX_MUNK : SLOPE_SPECTRUM,
                               .shortest = sea->shortest};
}

static size_t wave_count(const mgt_sea *sea)
{
    size_t count = sea->wind > 0 ? sea->count : 0;
    for (uint32_t i = 0; i < sea->swell_count; i++)
        count += sea->swells[i].count;
    return count;
}

/* Copies the caller's sea into this version's struct and checks it. */
static mgt_status take_sea(const reporter *r, const mgt_sea *theirs, mgt_sea *own)
{
    mgt_status status = struct_take(r, &sea_kind, own, theirs, 1);
    if (status == MGT_OK)
        status = validate_rows(r, "sea.", sea_rows, own);
    if (status == MGT_OK && own->swell_count > 0 && !own->swells)
        status = report_error(r, MGT_ERROR_ARGUMENT, "waves.sea", "sea.swells is NULL although sea.swell_count is %u", own->swell_count);
    for (uint32_t i = 0; status == MGT_OK && i < own->swell_count; i++) {
        char path[40];
        snprintf(path, sizeof path, "sea.swells[%u].", i);
        status = validate_rows(r, path, swell_rows, &own->swells[i]);
    }
    if (status == MGT_OK && wave_count(own) > MGT_MAX_WAVES)
        status = report_error(r, MGT_ERROR_SCENE, "waves.sea", "the sea has %zu waves; at most %d are allowed", wave_count(own), MGT_MAX_WAVES);
    if (status == MGT_OK && own->wind > 0 && own->fetch == 0 && spectrum_takes_gamma((spectrum_kind)own->spectrum))
        status = report_error(r, MGT_ERROR_SCENE, "waves.sea", "sea.fetch is 0; spectrum %s needs one, 100 to 1e7 m", mgt_spectrum_name(own->spectrum));
    return status;
}

/* Draws the waves of a sea. `waves` is memory of the library, so that a failure leaves the caller's unchanged. */
static mgt_status draw(const reporter *r, const mgt_sea *sea, mgt_wave *waves)
{
    wave_spectrum spectrum;
    spectrum_fault fault = {0};
    bool good = true;
    if (sea->wind > 0) {
        const spectrum_settings settings = settings_of(sea);
        good = sea_spectrum_make(&spectrum, &settings, NULL, &fault);
        if (!good && fault.key)
            return report_error(r, MGT_ERROR_SCENE, "waves.sea", "sea.%s %s", fault.key, fault.text);
        good = good && spectrum_sample(&spectrum, sea->seed, sea->count, waves);
        waves += sea->count;
    }
    for (uint32_t i = 0; good && i < sea->swell_count; i++) {
        const mgt_swell *swell = &sea->swells[i];
        good = swell_spectrum_make(&spectrum, swell->height, swell->period, swell->direction_deg, swell->spread) &&
               spectrum_sample(&spectrum, swell_seed(swell->seed, i), swell->count, waves);
        waves += swell->count;
    }
    return good ? MGT_OK : report_error(r, MGT_ERROR_MEMORY, "waves.memory", "out of memory for the waves of a sea");
}

/* Checks the drawn waves, because legal settings may give waves that a scene must not have. */
static mgt_status check_drawn(const reporter *r, const mgt_wave *waves, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!wave_is_legal(&waves[i])) {
            char name[40];
            snprintf(name, sizeof name, "sea: its wave %zu: ", i);
            return validate_rows(r, name, wave_rows, &waves[i]);
        }
    return MGT_OK;
}

static mgt_status fill_waves(const reporter *r, const mgt_sea *sea, mgt_wave *waves, size_t capacity)
{
    const size_t count = wave_count(sea);
    if (count > 0 && !waves)
        return report_error(r, MGT_ERROR_ARGUMENT, "waves.room", "the list of waves is NULL");
    if (count > capacity)
        return report_error(r, MGT_ERROR_ARGUMENT, "waves.room", "the sea has %zu waves, and there is room for %zu", count, capacity);
    mgt_wave *own = malloc((count ? count : 1) * sizeof *own);
    if (!own)
        return report_error(r, MGT_ERROR_MEMORY, "waves.memory", "out of memory for the waves of a sea");
    mgt_status status = draw(r, sea, own);
    if (status == MGT_OK)
        status = check_drawn(r, own, count);
    if (status == MGT_OK && count > 0)
        memcpy(waves, own, count * sizeof *own);
    free(own);
    return status;
}

size_t mgt_sea_wave_count(const mgt_sea *sea)
{
    const reporter r = creation_reporter();
    mgt_sea own;
    return take_sea(&r, sea, &own) == MGT_OK ? wave_count(&own) : 0;
}

mgt_status mgt_sea_waves(const mgt_sea *sea, mgt_wave *waves, size_t capacity)
{
    const reporter r = creation_reporter();
    mgt_sea own;
    const mgt_status status = take_sea(&r, sea, &own);
    return status == MGT_OK ? fill_waves(&r, &own, waves, capacity) : status;
}

mgt_status mgt_sea_scene(const mgt_sea *sea, mgt_wave *waves, size_t capacity, mgt_scene *scene)
{
    const reporter r = creation_reporter();
    mgt_sea own;
    mgt_scene checked; /* only to check the caller's struct_size */
    mgt_status status = take_sea(&r, sea, &own);
    if (status == MGT_OK)
        status = struct_take(&r, &scene_kind, &checked, scene, 1);
    if (status == MGT_OK)
        status = fill_waves(&r, &own, waves, capacity);
    if (status != MGT_OK)
        return status;
    scene->water.waves = waves;
    scene->water.wave_count = wave_count(&own);
    scene->water.choppiness = own.choppiness;
    const spectrum_settings settings = settings_of(&own);
    const double foam = own.wind > 0 ? (double)own.foam * foam_share_of_wind(spectrum_wind_10(&settings)) : 0;
    scene->foam = (float)(foam < MOST_FOAM ? foam : MOST_FOAM);
    scene->aerial = own.wind > 0;
    if (own.wind > 0 && light_is_moon(&scene->light))
        scene->stars = scene->night_tint = 1;
    return MGT_OK;
}

void mgt_swell_init(mgt_swell *swell)
{
    if (swell)
        *swell = (mgt_swell){.height = 1, .period = SWELL_USUAL_PERIOD, .spread = SWELL_USUAL_SPREAD, .count = SWELL_COUNT, .seed = 1};
}
