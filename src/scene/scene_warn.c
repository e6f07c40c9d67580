/* SPDX-License-Identifier: MIT
 *
 * Warnings about values of a scene that are legal but probably a mistake.
 */
#include <math.h>

#include "params/scene_rows.h"
#include "params/waves.h"
#include "scene/scene_path.h"
#include "scene/scene_read.h"
#include "scene/scene_sea.h"

/* Stokes' limit: waves of a greater amplitude times wave number break. */
static const double STEEPEST = 0.4432;

/* Frames that are looked at; of longer clips some. */
enum { MOST_FRAMES = 1000 };

static double steepness(const mgt_wave *wave) { return wave_crest(wave) * wave_course_of(wave, 0).number; }

static bool warn_of_wave(const scene_tree *tree, const scene_water *water, scene_error *warning)
{
    const scene_list waves = scene_water_all(water);
    const mgt_wave *all = waves.items;
    const tree_node *mapping = tree_get(tree->root, "water"), *list = tree_get(mapping, "waves");
    const tree_node *drawn = tree_get(mapping, water->wind.speed > 0 ? "wind" : "spectrum"), *swell = tree_get(mapping, "swell");
    const size_t swell_from = waves.count - scene_swell_count(water);
    for (size_t i = 0; i < waves.count; i++)
        if (steepness(&all[i]) > STEEPEST) {
            const tree_node *own = i < water->waves.count ? tree_at(list, i)
                                   : i >= swell_from      ? swell
                                                          : NULL,
                            *node = own != NULL     ? own
                                    : drawn != NULL ? drawn
                                                    : mapping;
            return tree_error(tree, node->source, node->place, warning,
                              "wave %zu is %.3g steep, amplitude times wave number; water breaks above %.3g, so that no method shows what a sea would", i,
                              steepness(&all[i]), STEEPEST);
        }
    return true;
}

static bool warn_of_foam(const scene_tree *tree, const scene_water *water, scene_error *warning)
{
    const tree_node *foam = tree_get(tree_get(tree->root, "water"), "foam"), *amount = tree_get(foam, "amount");
    const tree_node *node = amount != NULL ? amount : foam;
    if (amount != NULL && water->foam.amount > 0 && !(scene_water_wind(water) > 0))
        return tree_error(tree, node->source, node->place, warning,
                          "water.foam.amount follows the wind, and these waves have none: no foam is drawn; water.foam.share says how much there is");
    if (foam != NULL && scene_water_foam(water) > 0 && !(water->choppiness > 0))
        return tree_error(tree, node->source, node->place, warning, "foam is on water that is pressed together: without water.choppiness none is drawn");
    return true;
}

static bool warn_of_sky(const scene_tree *tree, const scene_sky *sky, scene_error *warning)
{
    if (sky->look.model == MGT_SKY_ATMOSPHERE)
        return true;
    const tree_node *mapping = tree_get(tree->root, "sky"), *aerial = tree_get(mapping, "aerial"), *stars = tree_get(mapping, "stars");
    if (aerial != NULL && sky->aerial == WHEN_ON)
        return tree_error(tree, aerial->source, aerial->place, warning,
                          "sky.aerial shows the air of the model atmosphere: with another sky.model there is none");
    if (stars != NULL && sky->stars == WHEN_ON)
        return tree_error(tree, stars->source, stars->place, warning, "sky.stars shows stars in the model atmosphere: with another sky.model there are none");
    return true;
}

/* Radius of a light's disk below which its glitter under a black sky is displayed nearly black, and the one of the papers' experiments, degrees. */
static const double SMALL_DISK = 1, SHOWN_DISK = 2;

/* Under a black sky the automatic exposure follows from the light's radiance, and glitter is as bright as the disk is large. */
static bool warn_of_exposure(const scene_tree *tree, const scene_values *values, scene_error *warning)
{
    const double radius_deg = light_shining_radius_deg(&values->light);
    const tree_node *model = tree_get(tree_get(tree->root, "sky"), "model");
    if (values->sky.look.model != MGT_SKY_BLACK || !values->post.exposure.automatic || values->post.exposure_offset != 0 || radius_deg == 0 ||
        radius_deg >= SMALL_DISK || model == NULL)
        return true;
    return tree_error(tree, model->source, model->place, warning,
                      "under a black sky the exposure follows from the light alone: glitter of a disk of %.3g degrees is displayed nearly black; "
                      "post.exposure_offset: %.2g shows it as bright as that of a disk of %g degrees",
                      radius_deg, 2 * log2(SHOWN_DISK / radius_deg), SHOWN_DISK);
}

static const tree_node *camera_node(const scene_tree *tree)
{
    const tree_node *mapping = tree_get(tree->root, "camera"), *path = tree_get(mapping, "path"), *position = tree_get(mapping, "position");
    return path != NULL ? path : position != NULL ? position : mapping != NULL ? mapping : tree->root;
}

/* Methods look through the surface from the side of the mean surface that the camera is on; at its height they see it from above. */
static bool warn_of_camera(const scene_tree *tree, const scene_values *values, scene_error *warning)
{
    const scene_list waves = scene_water_all(&values->water);
    const uint32_t step = values->time.frames / MOST_FRAMES + 1;
    for (uint32_t frame = 0; frame < values->time.frames; frame += step) {
        const double time = values->time.start + frame / values->time.fps;
        const mgt_camera camera = scene_camera_at(&values->camera, time);
        const double above = camera.position[1] - values->water.level;
        const double water = waves_height(waves.items, waves.count, camera.position[0], camera.position[2], time);
        const bool dry = above >= 0;
        if (dry ? above < water : above > water) {
            const tree_node *node = camera_node(tree);
            return tree_error(tree, node->source, node->place, warning,
                              "in frame %u a wave stands %.3g m %s the mean surface at the camera, which is at %.3g m: it is drawn as if it were %s", frame,
                              fabs(water), water > 0 ? "over" : "under", above, dry ? "dry" : "under water");
        }
    }
    return true;
}

bool scene_warn(const scene_tree *tree, const scene_values *values, scene_error *warning)
{
    return warn_of_wave(tree, &values->water, warning) && warn_of_foam(tree, &values->water, warning) && warn_of_sky(tree, &values->sky, warning) &&
           warn_of_exposure(tree, values, warning) && warn_of_camera(tree, values, warning);
}
