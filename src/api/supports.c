/* SPDX-License-Identifier: MIT
 * Which scenes methods and backends can render. */
#include "api/supports.h"

#include "api/structs.h"
#include "frame/backend.h"
#include "frame/podee_rules.h"
#include "frame/targets.h"
#include "params/methods.h"
#include "trace/trace.h"

enum { MOST_PLACES = 4 }; /* largest quality.refraction_samples on OpenGL */

static const double most_slots = 2147483647; /* largest number of sample slots of a picture on OpenGL */

/* What OpenGL does not support of method adaptive, as gl_lacks() words it; NULL: nothing. */
static const char *gl_lacks_scheme(const mgt_scene *scene)
{
    const mgt_quality *q = &scene->quality;
    const double pixels = (double)scene->image.width * scene->image.height, slots = q->sample_slots ? (double)q->sample_slots : podee_samples_of(q) * pixels;
    if (q->budget_ms > 0)
        return "a budget of milliseconds is kept";
    if (q->adaptive == MGT_ADAPTIVE_PODEE && (q->sample_first || q->sample_count))
        return "a range of samples is taken";
    return q->adaptive == MGT_ADAPTIVE_PODEE && slots > most_slots ? "more than 2^31 samples of a picture are taken" : NULL;
}

bool method_draws(const mgt_scene *scene)
{
    const bool surface_alone = !(method_of(scene->quality.method)->properties.layers & 1u << MGT_LAYER_REFRACTION);
    return !surface_alone || (scene->object_count == 0 && scene->camera.position[1] >= 0);
}

const char *gl_lacks(const mgt_scene *scene)
{
    const mgt_refraction refraction = scene->quality.refraction;
    if (!(method_of(scene->quality.method)->properties.backends & 1u << MGT_BACKEND_GL))
        return "the method runs";
    if (scene->quality.method == MGT_METHOD_ADAPTIVE && gl_lacks_scheme(scene))
        return gl_lacks_scheme(scene);
    if (scene->object_count == 0)
        return NULL;
    if (refraction == MGT_REFRACTION_DISTANCE_FIELD || refraction == MGT_REFRACTION_PATH_TRACED)
        return "refraction distance-field and path-traced run";
    if (refraction == MGT_REFRACTION_LIU && scene->camera.position[1] < 0)
        return "refraction liu from under water runs";
    return scene->quality.refraction_samples > MOST_PLACES ? "more than 4 x 4 samples of refraction a pixel run" : NULL;
}

const char *gl_lacks_layer(const mgt_scene *scene, mgt_layer layer)
{
    /* For a moving camera OpenGL keeps the mean of refraction over the shutter, but these layers are of one instant. */
    const bool refraction = scene->object_count > 0 && !scene->camera_moves && method_of(scene->quality.method)->way != METHOD_PASS;
    if (layer <= MGT_LAYER_DETAIL || layer == MGT_LAYER_FOAM || (refraction && (layer == MGT_LAYER_REFRACTION || layer == MGT_LAYER_REFRACTION_ERROR)))
        return gl_lacks(scene);
    return "a layer that was asked for runs";
}

bool mgt_supports(mgt_backend backend, const mgt_scene *scene, mgt_layer layer)
{
    const reporter r = creation_reporter();
    mgt_scene own;
    if (scene_take(&r, &own, scene) != MGT_OK || mgt_layer_channels(layer) == 0)
        return false;
    scene_to_sea_level(&own);
    if (!method_draws(&own))
        return false;
    const bool traces = own.object_count > 0 && (own.quality.refraction == MGT_REFRACTION_HYBRID || own.quality.refraction == MGT_REFRACTION_PATH_TRACED);
    const bool gl = gl_backend.render && !gl_lacks_layer(&own, layer), cpu = !traces || trace_available();
    switch (backend) {
    case MGT_BACKEND_CPU:
        return cpu;
    case MGT_BACKEND_GL:
        return gl;
    case MGT_BACKEND_AUTO:
        return gl || cpu;
    case MGT_BACKEND_NULL:
        return true;
    }
    return false;
}
