/* SPDX-License-Identifier: MIT
 *
 * The sea of a scene's `water.spectrum`.
 */
#include "scene/scene_sea.h"
#include "params/foam.h"
#include "params/waves.h"
#include "scene/spectrum_table_read.h"
#include "sea/sea.h"
#include "sea/spectrum_swell.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool refuse(scene_sea_fault *fault, const char *key, const char *text)
{
    fault->setting.key = key;
    snprintf(fault->setting.text, sizeof fault->setting.text, "%s", text);
    return false;
}

char *scene_file_beside(const char *scene_path, const char *file)
{
    const char *slash = strrchr(scene_path, '/');
    const size_t folder = file[0] != '/' && slash != NULL ? (size_t)(slash - scene_path) + 1 : 0, length = strlen(file);
    char *path = malloc(folder + length + 1);
    if (path == NULL)
        return NULL;
    memcpy(path, scene_path, folder);
    memcpy(path + folder, file, length + 1);
    return path;
}

static bool load_table(spectrum_table *table, const scene_spectrum *settings, const char *scene_path, scene_sea_fault *fault)
{
    if (settings->file == NULL || settings->file[0] == '\0')
        return refuse(fault, "file", "is missing: the model buoy is a measured table; allowed: the path of one, from the scene's folder");
    char *path = scene_file_beside(scene_path, settings->file);
    if (path == NULL)
        return scene_error_memory(&fault->error);
    const bool good = spectrum_table_load(table, path, &fault->error);
    free(path);
    return good;
}

bool scene_sea_open(scene_sea *sea, const scene_spectrum *settings, const char *scene_path, scene_sea_fault *fault)
{
    const spectrum_settings *s = &settings->settings;
    *fault = (scene_sea_fault){0};
    *sea = (scene_sea){0};
    if (s->kind == SPECTRUM_BUOY && !load_table(&sea->table, settings, scene_path, fault))
        return false;
    const bool good = sea_spectrum_make(&sea->spectrum, s, &sea->table, &fault->setting);
    sea->slopes = cox_munk_slopes(wind_at_height(sea->spectrum.wind_10, 10, 12.5));
    if (!good && fault->setting.key == NULL)
        scene_error_memory(&fault->error);
    if (good)
        fault->setting = (spectrum_fault){0};
    else
        scene_sea_close(sea);
    return good;
}

void scene_sea_close(scene_sea *sea) { spectrum_table_free(&sea->table); }

/* The spectrum that `water.wind` stands for. */
static scene_spectrum wind_spectrum(const scene_wind *wind)
{
    return (scene_spectrum){.settings = sea_of_wind(wind->speed, wind->direction_deg, wind->fetch, wind->depth), .count = wind->count, .seed = wind->seed};
}

/* What the waves beside the single ones are drawn from; its kind is none where there are no others. */
static scene_spectrum drawn_from(const scene_water *water) { return water->wind.speed > 0 ? wind_spectrum(&water->wind) : water->spectrum; }

double scene_water_wind(const scene_water *water)
{
    const scene_spectrum drawn = drawn_from(water);
    return drawn.settings.kind == SPECTRUM_NONE || drawn.settings.kind == SPECTRUM_BUOY ? 0 : spectrum_wind_10(&drawn.settings);
}

double scene_water_foam(const scene_water *water)
{
    const double share = water->foam.share > 0 ? water->foam.share : water->foam.amount * foam_share_of_wind(scene_water_wind(water));
    return share < MOST_FOAM ? share : MOST_FOAM;
}

/* The waves of the spectrum, if there is one, into `waves`. */
static bool draw_waves(const scene_spectrum *settings, const char *scene_path, mgt_wave *waves, scene_sea_fault *fault)
{
    scene_sea sea;
    if (settings->settings.kind == SPECTRUM_NONE)
        return true;
    if (!scene_sea_open(&sea, settings, scene_path, fault))
        return false;
    const bool good = spectrum_sample(&sea.spectrum, settings->seed, settings->count, waves);
    scene_sea_close(&sea);
    return good || scene_error_memory(&fault->error);
}

size_t scene_swell_count(const scene_water *water)
{
    const scene_swell *swells = water->swell.items;
    size_t count = 0;
    for (size_t i = 0; i < water->swell.count; i++)
        count += swells[i].count;
    return count;
}

static bool draw_swells(const scene_water *water, mgt_wave *waves)
{
    const scene_swell *swells = water->swell.items;
    for (size_t i = 0; i < water->swell.count; waves += swells[i++].count) {
        wave_spectrum spectrum;
        if (!swell_spectrum_make(&spectrum, swells[i].height, swells[i].period, swells[i].direction_deg, swells[i].spread) ||
            !spectrum_sample(&spectrum, swell_seed(swells[i].seed, i), swells[i].count, waves))
            return false;
    }
    return true;
}

/* Too many waves: the count of the spectrum, or of the swells where there is none, is at fault. */
static bool refuse_count(scene_sea_fault *fault, const scene_water *water, size_t drawn, size_t all)
{
    char text[160];
    const size_t swells = scene_swell_count(water);
    snprintf(text, sizeof text, "is %zu, with %s %zu in all; allowed: together at most %d", drawn > 0 ? drawn : swells,
             drawn == 0 || swells == 0 ? "water.waves" : "water.waves and water.swell", all, MGT_MAX_WAVES);
    return refuse(fault, "count", text);
}

bool scene_sea_fill(scene_water *water, const char *scene_path, scene_sea_fault *fault)
{
    const scene_spectrum settings = drawn_from(water);
    const size_t before = water->waves.count, drawn = settings.settings.kind != SPECTRUM_NONE ? settings.count : 0;
    const size_t count = before + drawn + scene_swell_count(water);
    *fault = (scene_sea_fault){0};
    free(water->sea.items);
    water->sea = (scene_list){0};
    if (!scene_water_has_sea(water) || count == 0)
        return true;
    if (count > MGT_MAX_WAVES)
        return refuse_count(fault, water, drawn, count);
    mgt_wave *waves = malloc(count * sizeof *waves);
    if (waves == NULL)
        return scene_error_memory(&fault->error);
    bool good = draw_waves(&settings, scene_path, waves + before, fault);
    if (good && !draw_swells(water, waves + before + drawn))
        good = scene_error_memory(&fault->error);
    if (!good) {
        free(waves);
        return false;
    }
    if (before > 0)
        memcpy(waves, water->waves.items, before * sizeof *waves);
    waves_scale(waves, count, water->height, HUGE_VAL);
    water->sea = (scene_list){.items = waves, .count = count};
    return true;
}

/* The library's own bound, which single waves keep but the factor may break. */
static bool check_heights(const scene_tree *tree, const scene_water *water, scene_error *error)
{
    const mgt_wave *waves = water->sea.items;
    for (size_t i = 0; i < water->sea.count; i++)
        if (!(wave_crest(&waves[i]) <= 1000)) {
            const tree_node *mapping = tree_get(tree->root, "water"), *node = tree_get(mapping, "amplitude");
            node = node != NULL ? node : mapping;
            return tree_error(tree, node->source, node->place, error, "water.amplitude is %s, which makes a wave of %s m; allowed: waves of at most 1000 m",
                              double_text(water->height).text, double_text(wave_crest(&waves[i])).text);
        }
    return true;
}

void scene_wind_fault(spectrum_fault *fault)
{
    if (strcmp(fault->key, "slope") == 0) {
        fault->key = "speed";
        snprintf(fault->text, sizeof fault->text,
                 "makes waves, after this fetch, whose slopes cannot be those of a clean sea; allowed: another wind or fetch, or water.spectrum");
    } else if (strcmp(fault->key, "wind") == 0 || strcmp(fault->key, "shortest") == 0) {
        fault->key = "speed";
        snprintf(fault->text, sizeof fault->text,
                 "makes waves, after this fetch and over this depth, that are all shorter than %g m; allowed: a longer fetch, deeper water, or a stronger wind",
                 4 * SPECTRUM_SHORTEST);
    }
}

bool scene_sea_read(const scene_tree *tree, scene_water *water, scene_error *error)
{
    scene_sea_fault fault;
    if (scene_sea_fill(water, tree->file_name, &fault))
        return check_heights(tree, water, error);
    if (fault.setting.key == NULL) {
        if (error != NULL)
            *error = fault.error;
        return false;
    }
    const bool wind = water->wind.speed > 0;
    if (wind)
        scene_wind_fault(&fault.setting);
    const char *name = wind ? "wind" : water->spectrum.settings.kind != SPECTRUM_NONE ? "spectrum" : "swell";
    const tree_node *mapping = tree_get(tree_get(tree->root, "water"), name), *node = tree_get(mapping, fault.setting.key);
    node = node != NULL ? node : mapping;
    return tree_error(tree, node->source, node->place, error, "water.%s.%s %s", name, fault.setting.key, fault.setting.text);
}
