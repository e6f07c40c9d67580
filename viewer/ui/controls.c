/* SPDX-License-Identifier: MIT
 * Controls by name, over the tables of the scene format and of the settings. */
#define _POSIX_C_SOURCE 200809L
#include "viewer/ui/controls.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/common/numbers.h"
#include "params/options.h"
#include "sea/sea.h"

static const control_hint hints[] = {
    {"image.width", "width", 64, 3840, true, "%.0f px", NULL},
    {"image.height", "height", 36, 2160, true, "%.0f px", NULL},
    {"camera.position", "position", -50, 50, false, "%.2f", NULL},
    {"camera.target", "target", -50, 50, false, "%.2f", NULL},
    {"camera.up", "up", -1, 1, false, "%.2f", NULL},
    {"camera.fov_y_deg", "field of view", 5, 120, false, "%.1f°", NULL},
    {"camera.path[].time", "time", 0, 60, false, "%.2f s", NULL},
    {"camera.path[].position", "position", -50, 50, false, "%.2f", NULL},
    {"camera.path[].target", "target", -50, 50, false, "%.2f", NULL},
    {"camera.path[].up", "up", -1, 1, false, "%.2f", NULL},
    {"camera.path[].fov_y_deg", "field of view", 5, 120, false, "%.1f°", NULL},
    {"time.start", "start", 0, 60, false, "%.2f s", NULL},
    {"time.fps", "frames a second", 1, 120, false, "%.3g", NULL},
    {"time.frames", "frames", 1, 600, true, NULL, NULL},
    {"time.shutter", "shutter", 0, 2, false, "%.2f frames", NULL},
    {"light.body", "body", 0, 0, false, NULL, NULL},
    {"light.elevation_deg", "elevation", -10, 90, false, "%.2f°", NULL},
    {"light.azimuth_deg", "azimuth", -180, 180, false, "%.1f°", NULL},
    {"light.angular_radius_deg", "radius", 0.05, 20, true, "%.4f°", NULL},
    {"light.radiance", "radiance", 0, 1e7, false, NULL, NULL},
    {"sky.model", "sky", 0, 0, false, NULL, NULL},
    {"sky.turbidity", "turbidity", 1, 10, false, "%.2f", NULL},
    {"sky.zenith", "zenith", 0, 100, false, NULL, NULL},
    {"sky.horizon", "horizon", 0, 100, false, NULL, NULL},
    {"sky.night", "night", 0, 1e-3, false, NULL, NULL},
    {"sky.stars", "stars", 0, 0, false, NULL, NULL},
    {"sky.aerial", "aerial", 0, 0, false, NULL, NULL},
    {"water.waves[].amplitude", "amplitude", 1e-4, 2, true, "%.4f m", NULL},
    {"water.waves[].a", "a", -20, 20, false, "%.3f", NULL},
    {"water.waves[].b", "b", -20, 20, false, "%.3f", NULL},
    {"water.waves[].c", "c", -20, 20, false, "%.3f", NULL},
    {"water.waves[].phase", "phase", 0, 6.2831853, false, "%.2f rad", NULL},
    {"water.waves[].wavelength", "length", 0.02, 200, true, "%.3f m", NULL},
    {"water.waves[].direction_deg", "direction", -180, 180, false, "%.0f°", NULL},
    {"water.waves[].speed", "speed", -20, 20, false, "%.2f m/s", NULL},
    {"water.wind.speed", "wind", 0.5, 30, false, "%.1f m/s", NULL},
    {"water.wind.direction_deg", "comes from", -180, 180, false, "%.0f°", NULL},
    {"water.wind.fetch", "fetch", 0, 1e6, true, "%.0f m", "fully developed"},
    {"water.wind.depth", "depth", 0, 1000, true, "%.1f m", "deep"},
    {"water.wind.count", "waves", 1, 400, false, NULL, NULL},
    {"water.wind.seed", "seed", 0, 100, false, NULL, NULL},
    {"water.spectrum.model", "spectrum", 0, 0, false, NULL, NULL},
    {"water.spectrum.wind", "wind", 0.5, 30, false, "%.1f m/s", NULL},
    {"water.spectrum.wind_height", "measured at", 0, 50, false, "%.1f m", "as published"},
    {"water.spectrum.fetch", "fetch", 1000, 1e6, true, "%.0f m", NULL},
    {"water.spectrum.depth", "depth", 0, 1000, true, "%.1f m", "deep"},
    {"water.spectrum.gamma", "peakedness", 1, 20, false, "%.2f", NULL},
    {"water.spectrum.direction_deg", "comes from", -180, 180, false, "%.0f°", NULL},
    {"water.spectrum.directions", "directions", 0, 0, false, NULL, NULL},
    {"water.spectrum.spread", "spread", 0, 100, false, "%.1f", NULL},
    {"water.spectrum.slope", "slopes", 0, 0, false, NULL, NULL},
    {"water.spectrum.shortest", "shortest", 0, 2, false, "%.3f m", "usual"},
    {"water.spectrum.count", "waves", 1, 400, false, NULL, NULL},
    {"water.spectrum.seed", "seed", 0, 100, false, NULL, NULL},
    {"water.swell[].height", "height", 0.05, 5, true, "%.2f m", NULL},
    {"water.swell[].period", "period", 3, 20, false, "%.1f s", NULL},
    {"water.swell[].direction_deg", "comes from", -180, 180, false, "%.0f°", NULL},
    {"water.swell[].spread", "spread", 0, 200, false, "%.0f", NULL},
    {"water.swell[].count", "waves", 1, 64, false, NULL, NULL},
    {"water.swell[].seed", "seed", 0, 100, false, NULL, NULL},
    {"water.amplitude", "height, all", 0, 4, false, "%.2f x", NULL},
    {"objects[].position", "position", -20, 20, false, "%.2f", NULL},
    {"objects[].rotation_deg", "turned", -180, 180, false, "%.1f°", NULL},
    {"objects[].scale", "scale", 0.1, 10, false, "%.3f", NULL},
    {"objects[].size", "size", 0.1, 50, false, "%.2f", NULL},
    {"objects[].material.base_color", "colour", 0, 1, false, NULL, NULL},
    {"objects[].material.roughness", "roughness", 0.02, 1, false, "%.2f", NULL},
    {"objects[].material.metallic", "metallic", 0, 1, false, "%.2f", NULL},
    {"objects[].material.pattern", "pattern", 0, 0, false, NULL, NULL},
    {"objects[].material.pattern_color", "pattern's colour", 0, 1, false, NULL, NULL},
    {"objects[].material.pattern_size", "pattern's size", 0.01, 2, true, "%.3f", NULL},
    {"objects[].material.pattern_joint", "joints", 0, 0.5, false, "%.3f", NULL},
    {"water.choppiness", "choppiness", 0, 1, false, "%.2f", NULL},
    {"water.foam.amount", "foam", 0, 4, false, "%.2f", NULL},
    {"water.foam.share", "foam's share", 0, 0.5, false, "%.3f", NULL},
    {"water.foam.persistence", "foam lasts", 0, 10, false, "%.1f s", NULL},
    {"water.level", "level", -10, 10, false, "%.2f m", NULL},
    {"water.ior", "refraction", 1, 2, false, "%.3f", NULL},
    {"water.absorption", "absorption", 0, 2, false, "%.3f /m", NULL},
    {"water.scattering", "scattering", 0, 2, false, "%.3f /m", NULL},
    {"water.body_albedo", "body albedo", 0, 1, false, NULL, NULL},
    {"post.exposure", "exposure", -24, 24, false, "%.2f EV", NULL},
    {"post.exposure_offset", "exposure", -8, 8, false, "%+.2f EV", NULL},
    {"post.tone_map", "tone map", 0, 0, false, NULL, NULL},
    {"post.night_tint", "night tint", 0, 0, false, NULL, NULL},
    {"post.glare", "glare", 0, 0.5, false, "%.3f", NULL},
    {"a.method", "A", 0, 0, false, NULL, NULL},
    {"b.method", "B", 0, 0, false, NULL, NULL},
    {"a.spatial", "samples N x N", 1, 32, false, NULL, NULL},
    {"a.time_samples", "time samples", 1, 64, true, NULL, NULL},
    {"a.seed", "seed", 0, 100, false, NULL, NULL},
    {"a.ndf_mean", "NDF mean", 0, 0, false, NULL, NULL},
    {"a.elongation", "elongation to", 0, 100, false, NULL, NULL},
    {"a.path_segments", "path segments", 0, 16, false, NULL, NULL},
    {"a.samples", "samples", 0, 64, false, NULL, NULL},
    {"a.budget_ms", "budget", 0, 1000, false, "%.0f ms", NULL},
    {"a.slots", "samples in all", 0, 1e7, false, NULL, NULL},
    {"a.target_rmse", "predicted RMSE", 0, 0.1, false, "%.4f", NULL},
    {"a.target_displayed", "displayed RMSE", 0, 0.1, false, "%.4f", NULL},
    {"a.tess_error", "triangles off by", 0, 4, false, "%.2f px", NULL},
    {"a.refraction_samples", "rays N x N", 0, 8, false, NULL, NULL},
    {"view.compare", "compare", 0, 0, false, NULL, NULL},
    {"view.wipe", "divider", 0, 1, false, "%.3f", NULL},
    {"view.difference_scale", "A - B times", 0.5, 64, true, "%.2f", NULL},
    {"view.layer", "layer", 0, 0, false, NULL, NULL},
    {"view.near_depth", "near", 0.1, 1000, true, "%.1f m", NULL},
    {"view.far_depth", "far", 1, 100000, true, "%.0f m", NULL},
    {"view.coverage_end", "coverage to", 1e-3, 1, true, "%.3f", NULL},
    {"view.lean_end", "lean to", 1e-2, 1, true, "%.3f", NULL},
    {"view.resolution", "resolution", 0, 0, false, NULL, NULL},
    {"view.frame", "frame", 0, 0, false, NULL, NULL},
    {"view.zoom", "magnify", 1, 32, true, "%.2f x", NULL},
    {"view.center_x", "middle x", 0, 1, false, "%.3f", NULL},
    {"view.center_y", "middle y", 0, 1, false, "%.3f", NULL},
    {"clock.time", "time", 0, 60, false, "%.3f s", NULL},
    {"clock.play", "play", 0, 0, false, NULL, NULL},
    {"clock.speed", "speed", 0.02, 4, true, "%.2f x", NULL},
    {"clock.loop", "loop", 0, 0, false, NULL, NULL},
    {"waves.count", "waves used", 0, MGT_MAX_WAVES, false, NULL, NULL},
    {"move.mode", "drag", 0, 0, false, NULL, NULL},
    {"move.path", "follow the path", 0, 0, false, NULL, NULL},
    {"move.speed", "speed", 0.1, 100, true, "%.1f m/s", NULL},
    {"move.clearance", "clearance", 0.05, 10, true, "%.2f m", NULL},
    {"panel.shown", "controls", 0, 0, false, NULL, NULL},
    {"panel.timings", "timings", 0, 0, false, NULL, NULL},
    {"panel.judge", "judge", 0, 0, false, NULL, NULL},
    {"panel.inspector", "inspector", 0, 0, false, NULL, NULL},
    {"panel.keys", "keys", 0, 0, false, NULL, NULL},
    {"panel.legend", "legend", 0, 0, false, NULL, NULL},
    {"panel.log", "log", 0, 0, false, NULL, NULL},
    {"panel.scale", "size", 0.75, 2, false, "%.2f x", NULL},
    {"inspect.x", "x", 0, 1279, false, NULL, NULL},
    {"inspect.y", "y", 0, 719, false, NULL, NULL},
};

/* ---- finding ------------------------------------------------------------------------------------------------ */

/* The hint of a control's name; NULL: there is none. Options of side B have those of side A. */
static const control_hint *hint_of(const char *name)
{
    char plain[64];
    size_t used = 0;
    for (const char *p = name; *p && used + 1 < sizeof plain; p++)
        if (*p < '0' || *p > '9' || p == name || p[-1] != '[')
            plain[used++] = *p;
        else
            while (p[1] >= '0' && p[1] <= '9')
                p++;
    plain[used] = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < sizeof hints / sizeof hints[0]; i++)
            if (strcmp(hints[i].name, plain) == 0)
                return &hints[i];
        if (strncmp(plain, "b.", 2) == 0) /* side B has the hints of side A */
            plain[0] = 'a';
    }
    return NULL;
}

/* Whether a key of an object is a control. Those are its place, its size and its material. */
static bool is_of_object(const char *key)
{
    static const char *const keys[] = {"position", "rotation_deg", "scale", "size"};
    bool found = strncmp(key, "material.", 9) == 0;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        found |= strcmp(key, keys[i]) == 0;
    return found;
}

/* Whether a value has no control. The range of samples belongs to the renderer. A named clarity of the water is held as numbers. The scene's quality is that of
 * each side. */
static bool is_left_out(const char *name)
{
    const char *key = strncmp(name, "objects[", 8) == 0 ? strchr(name, '.') : NULL;
    return strcmp(name, "water.clarity") == 0 || (key && !is_of_object(key + 1)) || strncmp(name, "quality", 7) == 0 || strncmp(name + 1, ".sample_", 8) == 0;
}

/* Whether a name is that of the size of a mesh, which has no effect. `value` is the value of that name. */
static bool is_of_mesh(const char *name, const void *value)
{
    const char *key = strncmp(name, "objects[", 8) == 0 ? strchr(name, '.') : NULL;
    return key && strcmp(key, ".size") == 0 && ((const scene_object *)(const void *)((const char *)value - offsetof(scene_object, size)))->shape == SHAPE_MESH;
}

/* Whether a field can be a control: it is a number or a choice, and more than one value is allowed. */
static bool is_control(const field_row *field)
{
    return field->type != FIELD_MAPPING && field->type != FIELD_LIST && field->type != FIELD_TEXT && field->min <= field->max &&
           !(field->type == FIELD_COUNT && field->min == field->max);
}

typedef struct control_sink {
    control *items; /* NULL: controls are only counted */
    size_t count;
    bool of_scene;
} control_sink;

static void add(control_sink *sink, const char *name, const field_row *field, void *value, mgt_wave *wave)
{
    if (sink->items) {
        control *c = &sink->items[sink->count];
        *c = (control){.field = field, .value = value, .wave = wave, .of_scene = sink->of_scene};
        snprintf(c->name, sizeof c->name, "%s", name);
        c->hint = hint_of(c->name);
    }
    sink->count++;
}

/* Adds the controls of a mapping and of all mappings and lists within it. `path` is the mapping's name. */
static void walk(control_sink *sink, const char *path, const field_row *mapping, void *values)
{
    for (const field_row *field = mapping->fields; field->key; field++) {
        char name[64];
        void *value = (char *)values + field->offset;
        snprintf(name, sizeof name, "%.40s%s%s", path, path[0] ? "." : "", field->key);
        if (is_left_out(name) || is_of_mesh(name, value))
            continue;
        if (field->type == FIELD_MAPPING)
            walk(sink, name, field, value);
        else if (is_control(field))
            add(sink, name, field, value, NULL);
        if (field->type != FIELD_LIST)
            continue;
        const scene_list *list = value;
        for (size_t i = 0; i < list->count; i++) {
            char item[64], shape[96];
            void *at = (char *)list->items + i * field->item_size;
            snprintf(item, sizeof item, "%.40s[%zu]", name, i);
            walk(sink, item, field, at);
            for (const field_row *f = wave_shape_fields; f->key && strcmp(name, "water.waves") == 0; f++) {
                snprintf(shape, sizeof shape, "%s.%s", item, f->key);
                add(sink, shape, f, NULL, at);
            }
        }
    }
}

control *control_list(const control_board *board, size_t *count)
{
    control_sink sink = {0};
    for (int pass = 0; pass < 2; pass++) {
        if (pass == 1 && !(sink.items = calloc(sink.count + 1, sizeof *sink.items)))
            return NULL;
        sink.count = 0;
        sink.of_scene = true;
        walk(&sink, "", scene_root_field(), &board->document->values);
        sink.of_scene = false;
        walk(&sink, "", settings_root_field(), board->settings);
    }
    *count = sink.count;
    return sink.items;
}

/* Finds a setting by its name, such as "view.zoom"; NULL: there is none. */
static const field_row *find_setting(settings *s, const char *path, void **value)
{
    const field_row *field = settings_root_field();
    char *at = (char *)s;
    while (*path) {
        const size_t length = strcspn(path, ".");
        const field_row *child = field->fields;
        while (child && child->key && (strlen(child->key) != length || memcmp(child->key, path, length) != 0))
            child++;
        if (!child || !child->key)
            return NULL;
        field = child;
        at += field->offset;
        path += length + (path[length] == '.');
    }
    *value = at;
    return field;
}

/* Finds a value of a wave's shape by its name; NULL: it is none of those. */
static const field_row *find_shape(const control_board *board, const char *name, mgt_wave **wave)
{
    const scene_list *waves = &board->document->values.water.waves;
    size_t index;
    int used = 0;
    if (sscanf(name, "water.waves[%zu].%n", &index, &used) != 1 || used == 0 || index >= waves->count)
        return NULL;
    for (const field_row *field = wave_shape_fields; field->key; field++)
        if (strcmp(field->key, name + used) == 0) {
            *wave = (mgt_wave *)waves->items + index;
            return field;
        }
    return NULL;
}

bool control_find(const control_board *board, const char *name, control *out)
{
    const void *value = NULL;
    *out = (control){.of_scene = true};
    snprintf(out->name, sizeof out->name, "%s", name);
    out->hint = hint_of(name);
    out->field = scene_values_find(&board->document->values, name, &value);
    memcpy(&out->value, &value, sizeof value); /* scene_values_find() returns a const pointer, but the document may be changed */
    if (!out->field)
        out->field = find_shape(board, name, &out->wave);
    if (!out->field) {
        out->field = find_setting(board->settings, name, &out->value);
        out->of_scene = false;
    }
    return out->field && is_control(out->field) && !is_left_out(name) && !is_of_mesh(name, out->value);
}

/* ---- values --------------------------------------------------------------------------------------------------- */

int control_width(const control *c) { return c->field->type == FIELD_VECTOR || c->field->type == FIELD_SCALE || c->field->type == FIELD_COLOR ? 3 : 1; }

void control_read(const control *c, double numbers[3])
{
    numbers[0] = numbers[1] = numbers[2] = 0;
    if (c->wave) {
        const wave_shape shape = wave_shape_of(c->wave);
        numbers[0] = *(const double *)(const void *)((const char *)&shape + c->field->offset);
        return;
    }
    switch (c->field->type) {
    case FIELD_COUNT:
        numbers[0] = *(const uint32_t *)c->value;
        break;
    case FIELD_NUMBER:
        numbers[0] = *(const double *)c->value;
        break;
    case FIELD_FLOAT:
        numbers[0] = (double)*(const float *)c->value;
        break;
    case FIELD_VECTOR:
    case FIELD_SCALE:
        memcpy(numbers, c->value, 3 * sizeof *numbers);
        break;
    case FIELD_COLOR:
        for (int i = 0; i < 3; i++)
            numbers[i] = (double)((const float *)c->value)[i];
        break;
    case FIELD_LARGE:
        numbers[0] = (double)*(const uint64_t *)c->value;
        break;
    case FIELD_CHOICE:
    case FIELD_SWITCH:
        numbers[0] = field_place(c->field, c->value);
        break;
    case FIELD_EXPOSURE:
        numbers[0] = ((const scene_exposure *)c->value)->stops;
        break;
    case FIELD_TEXT:
    case FIELD_MAPPING:
    case FIELD_LIST:
        break;
    }
}

/* The number, clamped to what the field allows. */
static double allowed(const field_row *field, double number)
{
    const double margin = 1e-3;
    if (field->flags & FIELD_OR_ZERO && number < field->min)
        return number < field->min / 2 ? 0 : field->min;
    const double low = field->flags & FIELD_OPEN_MIN ? field->min + margin : field->min;
    const double high = field->flags & FIELD_OPEN_MAX ? field->max - margin : field->max;
    return number >= low ? number <= high ? number : high : low;
}

/* Sets back the options that this one excludes. */
static void leave_one_alternative(const control_board *board, const control *c)
{
    for (int side = 0; side < SIDE_COUNT && c->field->alternative; side++)
        if ((char *)&board->settings->sides[side] + c->field->offset == (char *)c->value)
            quality_drop_alternatives(c->field, &board->settings->sides[side]);
}

static void write_choice(const control *c, int choice)
{
    const int count = field_word_count(c->field);
    field_choose(c->field, choice < 0 ? 0 : choice < count ? choice : count - 1, c->value);
    if (c->field->change)
        c->field->change((char *)c->value - c->field->offset);
}

/* Makes the changes that follow from a change of the water or of an object. `had_wind`: a wind made the sea before the change. */
static void follow_change(const control_board *board, const control *c, bool had_wind)
{
    document *d = board->document;
    scene_water *water = &d->values.water;
    size_t index;
    int used = 0;
    if (water->wind.speed > 0 && !had_wind) { /* these are the values that a file with a wind has */
        water->choppiness = SEA_CHOPPINESS;
        water->foam = (scene_foam){.amount = 1, .persistence = water->foam.persistence};
    }
    if (c->value == &water->foam.share && water->foam.share > 0)
        water->foam.amount = 0;
    if (c->value == &water->foam.amount && water->foam.amount > 0)
        water->foam.share = 0;
    if (sscanf(c->name, "objects[%zu].material.%n", &index, &used) == 1 && used > 0) {
        scene_object *object = (scene_object *)d->values.objects.items + index;
        object->material.given = object->shape == SHAPE_MESH; /* a shape always has a material of its own */
    }
    const bool objects = strncmp(c->name, "objects[", 8) == 0;
    if (objects || strncmp(c->name, "water.", 6) == 0)
        document_changed(d, objects);
}

static void write_value(const control_board *board, const control *c, const double numbers[3])
{
    const field_row *field = c->field;
    leave_one_alternative(board, c);
    if (c->wave) {
        wave_shape shape = wave_shape_of(c->wave);
        *(double *)(void *)((char *)&shape + field->offset) = allowed(field, numbers[0]);
        wave_set_shape(c->wave, &shape);
        return;
    }
    switch (field->type) {
    case FIELD_COUNT:
        *(uint32_t *)c->value = (uint32_t)allowed(field, round(numbers[0]));
        break;
    case FIELD_NUMBER:
        *(double *)c->value = allowed(field, numbers[0]);
        break;
    case FIELD_FLOAT:
        *(float *)c->value = (float)allowed(field, numbers[0]);
        break;
    case FIELD_VECTOR:
    case FIELD_SCALE:
        for (int i = 0; i < 3; i++)
            ((double *)c->value)[i] = allowed(field, numbers[i]);
        break;
    case FIELD_COLOR:
        for (int i = 0; i < 3; i++)
            ((float *)c->value)[i] = (float)allowed(field, numbers[i]);
        break;
    case FIELD_LARGE:
        *(uint64_t *)c->value = (uint64_t)allowed(field, round(numbers[0]));
        break;
    case FIELD_CHOICE:
    case FIELD_SWITCH:
        write_choice(c, (int)numbers[0]);
        break;
    case FIELD_EXPOSURE:
        *(scene_exposure *)c->value = (scene_exposure){.stops = allowed(field, numbers[0])};
        break;
    case FIELD_TEXT:
    case FIELD_MAPPING:
    case FIELD_LIST:
        break;
    }
}

void control_write(const control_board *board, const control *c, const double numbers[3])
{
    const bool had_wind = board->document->values.water.wind.speed > 0;
    write_value(board, c, numbers);
    if (c->of_scene)
        follow_change(board, c, had_wind);
}

bool control_set_number(const control_board *board, const char *name, double number)
{
    control c;
    const double numbers[3] = {number, number, number};
    if (!control_find(board, name, &c))
        return false;
    control_write(board, &c, numbers);
    return true;
}

/* ---- text ------------------------------------------------------------------------------------------------------ */

control_text control_print(const control *c)
{
    control_text out = {""};
    double n[3];
    control_read(c, n);
    if (c->field->choices)
        snprintf(out.text, sizeof out.text, "%s", field_word(c->field, (int)n[0]));
    else if (c->field->type == FIELD_EXPOSURE && ((const scene_exposure *)c->value)->automatic)
        snprintf(out.text, sizeof out.text, "auto");
    else if (control_width(c) == 3)
        snprintf(out.text, sizeof out.text, "[%s, %s, %s]", double_text(n[0]).text, double_text(n[1]).text, double_text(n[2]).text);
    else
        snprintf(out.text, sizeof out.text, "%s", c->field->type == FIELD_FLOAT ? float_text((float)n[0]).text : double_text(n[0]).text);
    return out;
}

/* Writes to `error` what is allowed. Returns false. */
static bool refuse(const control *c, const char *text, char *error, size_t size)
{
    char words[160];
    field_allowed(c->field, words, sizeof words);
    snprintf(error, size, "%s=%s: allowed is %s", c->name, scene_quote_text(text, strlen(text)).text, words);
    return false;
}

static bool parse_number(const field_row *field, const char *text, double *number)
{
    return number_parse_double(text, number) && field_in_range(field, *number);
}

/* Reads "[x, y, z]". */
static bool parse_three(const field_row *field, const char *text, double numbers[3])
{
    char words[3][40];
    int end = 0;
    if (sscanf(text, " [ %39[^], ] , %39[^], ] , %39[^], ] ] %n", words[0], words[1], words[2], &end) != 3 || end == 0 || text[end])
        return false;
    for (int i = 0; i < 3; i++)
        if (!parse_number(field, words[i], &numbers[i]))
            return false;
    return true;
}

static bool parse(const control *c, const char *text, double numbers[3])
{
    int choice[2]; /* room for a switch or a choice */
    if (c->field->choices) {
        const bool good = field_parse(c->field, text, choice);
        numbers[0] = good ? field_place(c->field, choice) : 0;
        return good;
    }
    return control_width(c) == 3 ? parse_three(c->field, text, numbers) : parse_number(c->field, text, &numbers[0]);
}

/* Sets a list, an item or a mapping by the rules of `--set`. */
static bool set_by_word(const control_board *board, const char *name, const char *text, char *error, size_t error_size)
{
    scene_error problem;
    const size_t size = strlen(name) + strlen(text) + 2;
    char *word = malloc(size);
    if (!word) {
        snprintf(error, error_size, "out of memory");
        return false;
    }
    snprintf(word, size, "%s=%s", name, text);
    const bool good = document_set(board->document, word, &problem);
    free(word);
    if (!good)
        snprintf(error, error_size, "%s", problem.text);
    return good;
}

bool control_set(const control_board *board, const char *name, const char *text, char *error, size_t error_size)
{
    control c;
    double numbers[3] = {0};
    if (!control_find(board, name, &c))
        return set_by_word(board, name, text, error, error_size);
    if (c.field->type == FIELD_EXPOSURE && strcmp(text, "auto") == 0) {
        *(scene_exposure *)c.value = (scene_exposure){.automatic = true};
        return true;
    }
    if (!parse(&c, text, numbers))
        return refuse(&c, text, error, error_size);
    control_write(board, &c, numbers);
    return true;
}

/* ---- chance ------------------------------------------------------------------------------------------------------ */

double random_fraction(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 33) * 0x1p-31;
}

static double random_number(const control *c, uint64_t *state)
{
    const control_hint *h = c->hint;
    const double low = h ? fmax(h->low, c->field->min) : c->field->min, high = h ? fmin(h->high, c->field->max) : c->field->max;
    const double share = random_fraction(state), first = low > 0 ? low : high * 1e-3; /* a logarithmic scale does not begin at 0 */
    double number = h && h->logarithmic ? first * pow(high / first, share) : low + (high - low) * share;
    if (c->field->type == FIELD_COUNT || c->field->type == FIELD_LARGE)
        number = round(number);
    return allowed(c->field, number);
}

control_text control_random(const control *c, uint64_t *state)
{
    control_text out = {""};
    if (c->field->choices) {
        const int count = field_word_count(c->field);
        const int now = field_place(c->field, c->value), other = (now + 1 + (int)(random_fraction(state) * (count - 1))) % count;
        snprintf(out.text, sizeof out.text, "%s", field_word(c->field, other));
        return out;
    }
    double n[3];
    for (int i = 0; i < 3; i++)
        n[i] = random_number(c, state);
    if (control_width(c) == 3)
        snprintf(out.text, sizeof out.text, "[%.9g, %.9g, %.9g]", n[0], n[1], n[2]);
    else
        snprintf(out.text, sizeof out.text, "%.9g", n[0]);
    return out;
}
