/* SPDX-License-Identifier: MIT
 *
 * Checks that concern several keys of a scene at once.
 */
#include <stdlib.h>
#include <string.h>

#include "params/methods.h"
#include "params/options.h"
#include "scene/scene_path.h"
#include "scene/scene_read.h"

static const double MIN_KEYFRAME_GAP = 1e-6;

/* The first of two nodes that is there: where a message about both of them points. */
static const tree_node *either(const tree_node *first, const tree_node *second) { return first != NULL ? first : second; }

/* The part of a value that --set has written; NULL: it stands in the file as it is. */
static const tree_node *overridden(const tree_node *node)
{
    if (node == NULL || node->source != NULL)
        return node;
    for (const tree_node *child = node->first; child != NULL; child = child->next)
        if (child->source != NULL)
            return child;
    return NULL;
}

/* Whether --set has written the whole value. */
static bool is_set(const tree_node *node) { return node->key_source != NULL || node->source != NULL; }

static bool check_image(const scene_tree *tree, const mgt_image *image, scene_error *error)
{
    double pixels = (double)image->width * image->height;
    if (pixels <= SCENE_PIXELS_MOST)
        return true;
    const tree_node *mapping = tree_get(tree->root, "image");
    const tree_node *width = tree_get(mapping, "width"), *height = tree_get(mapping, "height");
    const tree_node *node = either(either(overridden(height), overridden(width)), either(height, width));
    return tree_error(tree, node->source, node->place, error, "image is %u x %u = %.0f pixels; allowed: width x height at most %d", image->width, image->height,
                      pixels, SCENE_PIXELS_MOST);
}

static bool refuse_camera(const scene_tree *tree, const tree_node *node, camera_fault fault, const char *where, scene_error *error)
{
    static const char *const faults[] = {
        [CAMERA_LEGAL] = "",
        [CAMERA_NO_VIEW] = "the camera looks at its own position; allowed: a target apart from position",
        [CAMERA_NO_UP] = "up is zero or parallel to the view (target - position); allowed: a direction across the view",
        [CAMERA_FAR_AWAY] = "the camera is too far away; allowed: coordinates of -1e9 to 1e9 m",
    };
    return tree_error(tree, node->source, node->place, error, "%s: %s", where, faults[fault]);
}

/* The node that most likely is at fault: the last of the two points, or up. */
static const tree_node *faulty_node(const tree_node *mapping, camera_fault fault, const tree_node *fallback)
{
    const tree_node *up = tree_get(mapping, "up"), *target = tree_get(mapping, "target"), *position = tree_get(mapping, "position");
    /* A value from the command line was written last. */
    const tree_node *given = either(overridden(target), overridden(position)), *point = either(target, position);
    if (fault == CAMERA_NO_UP)
        given = either(overridden(up), given);
    return either(given, either(fault == CAMERA_NO_UP ? either(up, point) : point, either(mapping, fallback)));
}

static bool check_still_camera(const scene_tree *tree, const scene_camera *camera, scene_error *error)
{
    camera_fault fault = scene_camera_fault(&camera->still);
    if (fault == CAMERA_LEGAL)
        return true;
    const tree_node *mapping = tree_get(tree->root, "camera");
    return refuse_camera(tree, faulty_node(mapping, fault, tree->root), fault, "camera", error);
}

static bool check_keyframes(const scene_tree *tree, const scene_camera *camera, const tree_node *path, scene_error *error)
{
    static const char *const excluded[] = {"position", "target"};
    const tree_node *mapping = tree_get(tree->root, "camera");
    for (size_t i = 0; i < 2; i++) {
        const tree_node *node = tree_get(mapping, excluded[i]);
        if (node != NULL && !is_set(node) && is_set(path))
            return tree_error(tree, path->key_source != NULL ? path->key_source : path->source, path->key_place, error,
                              "camera.path stands beside camera.%s of the scene, which it replaces; allowed: one of them (--set 'camera={path: [...]}')",
                              excluded[i]);
        if (node != NULL)
            return tree_error(tree, node->key_source != NULL ? node->key_source : node->source, node->key_place, error,
                              "camera.%s stands beside camera.path, which replaces it; allowed: one of them%s", excluded[i],
                              is_set(node) ? " (--set camera.path=[])" : "");
    }
    const scene_keyframe *keyframes = camera->path.items;
    const tree_node *before = NULL; /* time of the keyframe before */
    const tree_node *item = path->first;
    for (size_t i = 0; i < camera->path.count; i++, item = item->next) {
        const tree_node *time = tree_get(item, "time"), *blamed = either(overridden(time), either(overridden(before), time));
        before = time;
        if (i > 0 && !(keyframes[i].time - keyframes[i - 1].time >= MIN_KEYFRAME_GAP))
            return tree_error(tree, blamed->source, blamed->place, error,
                              "camera.path[%zu].time is %s; allowed: later than camera.path[%zu].time, %s s, by at least 1e-6 s", i, time->text, i - 1,
                              double_text(keyframes[i - 1].time).text);
        camera_fault fault = scene_camera_fault(&keyframes[i].camera);
        if (fault != CAMERA_LEGAL)
            return refuse_camera(tree, faulty_node(item, fault, path), fault, "camera.path", error);
    }
    return true;
}

/* Between good keyframes the interpolated camera may still turn through its own axis. */
static bool check_path(const scene_tree *tree, const scene_values *values, const tree_node *path, scene_error *error)
{
    const scene_clock *clock = &values->time;
    for (uint32_t frame = 0; frame < clock->frames; frame++) {
        double close = clock->start + frame / clock->fps, open = close - clock->shutter / clock->fps;
        const double times[2] = {close, open};
        for (int i = 0; i < 2; i++) {
            mgt_camera camera = scene_camera_at(&values->camera, times[i]);
            camera_fault fault = scene_camera_fault(&camera);
            if (fault != CAMERA_LEGAL) {
                char where[128];
                snprintf(where, sizeof where, "camera.path at %s s (frame %u)", double_text(times[i]).text, frame);
                return refuse_camera(tree, path, fault, where, error);
            }
        }
    }
    return true;
}

/* The wind makes the whole sea. Where one of the two was written last, on the command line, that one is at fault. */
static bool check_wind(const scene_tree *tree, const scene_water *water, scene_error *error)
{
    const char *other = water->waves.count > 0 ? "waves" : water->spectrum.settings.kind != SPECTRUM_NONE ? "spectrum" : NULL;
    if (!(water->wind.speed > 0) || other == NULL)
        return true;
    const tree_node *mapping = tree_get(tree->root, "water"), *wind = tree_get(mapping, "wind"), *node = tree_get(mapping, other);
    if (node->key_source == NULL && node->source == NULL && (wind->key_source != NULL || wind->source != NULL))
        return tree_error(tree, wind->key_source != NULL ? wind->key_source : wind->source, wind->key_place, error,
                          "water.wind stands beside water.%s of the file, which it replaces; allowed: one of them (--set water.%s)", other,
                          water->waves.count > 0 ? "waves=[]" : "spectrum.model=none");
    return tree_error(tree, node->key_source != NULL ? node->key_source : node->source, node->key_place, error,
                      "water.%s stands beside water.wind, which replaces it; allowed: one of them", other);
}

/* Foam is as much as the wind makes, or as is said. */
static bool check_foam(const scene_tree *tree, const scene_water *water, scene_error *error)
{
    const tree_node *foam = tree_get(tree_get(tree->root, "water"), "foam"), *amount = tree_get(foam, "amount"), *share = tree_get(foam, "share");
    if (amount == NULL || !(water->foam.amount > 0) || share == NULL || !(water->foam.share > 0))
        return true;
    const tree_node *node = overridden(share) == NULL && overridden(amount) != NULL ? amount : share;
    return tree_error(tree, node->key_source != NULL ? node->key_source : node->source, node->key_place, error,
                      "water.foam.share stands beside water.foam.amount; allowed: one of them");
}

static bool check_exposure(const scene_tree *tree, const scene_values *values, scene_error *error)
{
    const tree_node *post = tree_get(tree->root, "post"), *offset = tree_get(post, "exposure_offset"), *exposure = tree_get(post, "exposure");
    if (values->post.exposure.automatic || offset == NULL || values->post.exposure_offset == 0)
        return true;
    const tree_node *node = overridden(offset) == NULL && overridden(exposure) != NULL ? exposure : offset;
    return tree_error(tree, node->key_source != NULL ? node->key_source : node->source, node->key_place, error,
                      "post.exposure_offset stands beside an exposure that is a number; allowed: only with exposure: auto%s",
                      node == exposure ? " (--set post.exposure_offset=0)" : "");
}

/* The number stands once: in the method's name or beside it. Where --set has changed the number beside the name, that one counts. */
static bool check_number(const scene_tree *tree, scene_error *error)
{
    const tree_node *quality = tree_get(tree->root, "quality"), *method = tree_get(quality, "method"), *spatial = tree_get(quality, "spatial");
    if (method == NULL || spatial == NULL || !method_name_has_number(method->text))
        return true;
    if (overridden(spatial) != NULL && overridden(method) == NULL)
        return true;
    const tree_node *blamed = overridden(spatial) == NULL && overridden(method) != NULL ? method : spatial;
    return tree_error(tree, blamed->source, blamed->place, error,
                      "quality.spatial stands beside the method %s, which says the number already; allowed: one of them, ssaaN or ssaa with spatial: N",
                      method->text);
}

static bool check_quality(const scene_tree *tree, const mgt_quality *quality, scene_error *error)
{
    char wrong[160];
    const tree_node *node = tree_get(tree->root, "quality");
    if (node == NULL || !quality_conflict(quality, wrong, sizeof wrong))
        return true;
    const tree_node *blamed = NULL;
    for (const tree_node *child = node->first; child != NULL; child = child->next) {
        const field_row *field = field_find(quality_fields, child->key, strlen(child->key));
        if (field != NULL && field->alternative && overridden(child) != NULL)
            blamed = child;
    }
    blamed = either(blamed, node);
    return tree_error(tree, blamed->source, blamed->place, error, "quality: %s", wrong);
}

bool scene_check(const scene_tree *tree, const scene_values *values, scene_error *error)
{
    const tree_node *path = tree_get(tree_get(tree->root, "camera"), "path");
    bool moves = values->camera.path.count > 0;
    return check_image(tree, &values->image, error) &&
           (moves ? check_keyframes(tree, &values->camera, path, error) && check_path(tree, values, path, error)
                  : check_still_camera(tree, &values->camera, error)) &&
           check_wind(tree, &values->water, error) && check_foam(tree, &values->water, error) && check_exposure(tree, values, error) &&
           check_number(tree, error) && check_quality(tree, &values->quality, error);
}
