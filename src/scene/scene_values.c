/* SPDX-License-Identifier: MIT
 *
 * The values of a scene: defaults, copies, and what they own.
 */
#include <stdlib.h>
#include <string.h>

#include "params/options.h"
#include "params/scene_rows.h"
#include "scene/scene_models.h"
#include "sea/sea.h"

bool scene_values_by_night(const scene_values *values, scene_when when)
{
    return when == WHEN_ON || (when == WHEN_AUTO && values->water.wind.speed > 0 && light_is_moon(&values->light));
}

scene_values scene_values_defaults(void)
{
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    scene_values values = {
        .version = 1,
        .image = scene.image,
        .camera = {.still = scene.camera},
        .time = {.start = 0, .fps = 30, .frames = 1, .shutter = 1},
        .light = scene.light,
        .sky = {.look = scene.sky},
        .water = {.spectrum = {.settings = {.wind = 8, .fetch = 5e4, .gamma = SEA_PEAKEDNESS, .directions = DIRECTIONS_HASSELMANN, .spread = 10},
                               .count = 64,
                               .seed = 1},
                  .wind = {.count = SEA_COUNT, .seed = 1},
                  .height = 1,
                  .index_of_refraction = scene.water.index_of_refraction,
                  .level = scene.water.level,
                  .choppiness = scene.water.choppiness,
                  .foam = {.share = (double)scene.foam, .persistence = (double)scene.foam_persistence}},
        .post = {.exposure = {.automatic = scene.post.auto_exposure, .stops = scene.post.auto_exposure ? 0 : scene.post.exposure_ev},
                 .exposure_offset = scene.post.auto_exposure ? scene.post.exposure_ev : 0,
                 .tone_map = scene.post.tone_map,
                 .glare = scene.post.glare},
        .quality = quality_defaults(),
    };
    memcpy(values.water.absorption, scene.water.absorption, sizeof values.water.absorption);
    memcpy(values.water.scattering, scene.water.scattering, sizeof values.water.scattering);
    memcpy(values.water.body_albedo, scene.water.body_albedo, sizeof values.water.body_albedo);
    return values;
}

scene_swell scene_swell_defaults(void) { return (scene_swell){.period = SWELL_USUAL_PERIOD, .spread = SWELL_USUAL_SPREAD, .count = SWELL_COUNT, .seed = 1}; }

mgt_material scene_material_defaults(void)
{
    return (
        mgt_material){.base_color = {0.7f, 0.7f, 0.7f}, .roughness = 0.5f, .pattern_color = {0.2f, 0.2f, 0.2f}, .pattern_size = 0.2f, .pattern_joint = 0.05f};
}

/* Frees the text and the lists that a mapping owns. */
static void free_members(const field_row *mapping, void *values)
{
    for (const field_row *field = mapping->fields; field->key != NULL; field++) {
        void *at = (char *)values + field->offset;
        if (field->type == FIELD_TEXT) {
            char **text = at;
            free(*text);
            *text = NULL;
        } else if (field->type == FIELD_MAPPING) {
            free_members(field, at);
        } else if (field->type == FIELD_LIST) {
            scene_list *list = at;
            for (size_t i = 0; i < list->count; i++)
                free_members(field, (char *)list->items + i * field->item_size);
            free(list->items);
            *list = (scene_list){0};
        }
    }
}

/* Replaces borrowed text and lists by copies. When memory runs out what is not copied is empty: false, but fit to be freed. */
static bool copy_members(const field_row *mapping, void *values)
{
    bool good = true;
    for (const field_row *field = mapping->fields; field->key != NULL; field++) {
        void *at = (char *)values + field->offset;
        if (field->type == FIELD_TEXT) {
            char **text = at;
            const char *borrowed = *text;
            *text = borrowed != NULL ? strdup(borrowed) : NULL;
            good &= borrowed == NULL || *text != NULL;
        } else if (field->type == FIELD_MAPPING) {
            good &= copy_members(field, at);
        } else if (field->type == FIELD_LIST) {
            scene_list *list = at;
            const scene_list borrowed = *list;
            *list = (scene_list){.otherwise = borrowed.otherwise};
            if (borrowed.count == 0)
                continue;
            list->items = malloc(borrowed.count * field->item_size);
            if (list->items == NULL) {
                good = false;
                continue;
            }
            memcpy(list->items, borrowed.items, borrowed.count * field->item_size);
            list->count = borrowed.count;
            for (size_t i = 0; i < list->count; i++)
                good &= copy_members(field, (char *)list->items + i * field->item_size);
        }
    }
    return good;
}

void scene_values_free(scene_values *values)
{
    free_members(scene_root_field(), values);
    free(values->water.sea.items);
    values->water.sea = (scene_list){0};
    scene_models_release(values->models);
    values->models = NULL;
}

bool scene_values_copy(scene_values *out, const scene_values *values)
{
    const scene_list sea = values->water.sea;
    *out = *values;
    out->models = scene_models_share(values->models);
    out->water.sea = (scene_list){0};
    bool good = copy_members(scene_root_field(), out);
    if (sea.count > 0) {
        out->water.sea.items = malloc(sea.count * sizeof(mgt_wave));
        good &= out->water.sea.items != NULL;
        if (out->water.sea.items != NULL) {
            memcpy(out->water.sea.items, sea.items, sea.count * sizeof(mgt_wave));
            out->water.sea.count = sea.count;
        }
    }
    if (!good)
        scene_values_free(out);
    return good;
}
