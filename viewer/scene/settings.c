/* SPDX-License-Identifier: MIT
 * The tables of the viewer's own settings. */
#include "viewer/scene/settings.h"

#include <string.h>

#include "params/methods.h"
#include "params/options.h"

const char *const layer_choices[] = {"color", "coverage", "mask", "depth", "normal", NULL};
static const char *const switch_choices[] = {"off", "on", NULL};
static const char *const compare_choices[] = {"off", "wipe", "difference", NULL};
static const char *const resolution_choices[] = {"auto", "full", "half", "third", "quarter", NULL};
static const char *const frame_choices[] = {"fill", "scene", NULL};
static const char *const move_choices[] = {"orbit", "fly", NULL};

#define NO_RANGE 0, 0
#define SWITCH(type, member, text) FIELD_CHOICE, offsetof(type, member), 0, NO_RANGE, NULL, .doc = text, .choices = switch_choices

static const field_row view_fields[] =
    {{"compare", FIELD_CHOICE, offsetof(view_settings, compare), 0, NO_RANGE, NULL, .doc = "side A alone, A and B left and right of a divider, or A - B",
      .choices = compare_choices},
     {"wipe", FIELD_NUMBER, offsetof(view_settings, wipe), 0, 0, 1, NULL, .doc = "place of the divider, as a fraction of the width"},
     {"difference_scale", FIELD_NUMBER, offsetof(view_settings, difference_scale), 0, 0.01, 10000, NULL, .doc = "A - B is shown times this"},
     {"layer", FIELD_CHOICE, offsetof(view_settings, layer), 0, NO_RANGE, NULL, .doc = "what is shown; all but colour in false colours",
      .choices = layer_choices},
     {"near_depth", FIELD_NUMBER, offsetof(view_settings, near_depth), 0, 0.001, 1e6, "m", .doc = "where the colours of depth begin"},
     {"far_depth", FIELD_NUMBER, offsetof(view_settings, far_depth), 0, 0.001, 1e6, "m", .doc = "where the colours of depth end"},
     {"coverage_end", FIELD_NUMBER, offsetof(view_settings, coverage_end), 0, 1e-6, 1, NULL, .doc = "coverage where the colours end"},
     {"lean_end", FIELD_NUMBER, offsetof(view_settings, lean_end), 0, 1e-4, 1, NULL, .doc = "horizontal part of a normal where the colours end"},
     {"resolution", FIELD_CHOICE, offsetof(view_settings, resolution), 0, NO_RANGE, NULL,
      .doc = "pixels that are rendered; auto: fewer while something moves, so that 30 frames a second are held", .choices = resolution_choices},
     {"frame", FIELD_CHOICE, offsetof(view_settings, frame), 0, NO_RANGE, NULL, .doc = "the picture fills the window, or has the scene's own size",
      .choices = frame_choices},
     {"zoom", FIELD_NUMBER, offsetof(view_settings, zoom), 0, 1, 64, NULL, .doc = "magnifies the finished pixels"},
     {"center_x", FIELD_NUMBER, offsetof(view_settings, center_x), 0, 0, 1, NULL, .doc = "middle of what is magnified, as a fraction of the width"},
     {"center_y", FIELD_NUMBER, offsetof(view_settings, center_y), 0, 0, 1, NULL, .doc = "the same, of the height"},
     {0}};

static const field_row clock_fields[] = {{"time", FIELD_NUMBER, offsetof(clock_settings, time), 0, -1e8, 1e8, "s",
                                          .doc = "the scene's time when the shutter closes"},
                                         {"play", SWITCH(clock_settings, play, "time runs")},
                                         {"speed", FIELD_NUMBER, offsetof(clock_settings, speed), 0, -100, 100, NULL,
                                          .doc = "scene seconds a second; below 1 slow motion, below 0 backwards"},
                                         {"loop", SWITCH(clock_settings, loop, "time goes round over the scene's frames")},
                                         {0}};

static const field_row wave_fields[] = {{"count", FIELD_COUNT, offsetof(wave_settings, count), 0, 0, MGT_MAX_WAVES, NULL,
                                         .doc = "how many of the scene's waves are used, from the first"},
                                        {0}};

static const field_row move_fields[] = {{"mode", FIELD_CHOICE, offsetof(move_settings, mode), 0, NO_RANGE, NULL,
                                         .doc = "dragging turns the camera about its target, or its view", .choices = move_choices},
                                        {"path", SWITCH(move_settings, path, "the camera follows the keyframes")},
                                        {"speed", FIELD_NUMBER, offsetof(move_settings, speed), 0, 0.01, 1e5, "m/s", .doc = "of the keys W A S D Q E"},
                                        {"clearance", FIELD_NUMBER, offsetof(move_settings, clearance), 0, 0.01, 1000, "m",
                                         .doc = "the camera is kept this far above the water under it"},
                                        {0}};

static const field_row panel_fields[] = {{"shown", SWITCH(panel_settings, shown, "the panel of controls")},
                                         {"timings", SWITCH(panel_settings, timings, "times of frames and passes")},
                                         {"judge", SWITCH(panel_settings, judge, "A and B against brute force while nothing moves")},
                                         {"inspector", SWITCH(panel_settings, inspector, "what is known of one pixel")},
                                         {"keys", SWITCH(panel_settings, keys, "the list of keys")},
                                         {"legend", SWITCH(panel_settings, legend, "what false colours stand for")},
                                         {"log", SWITCH(panel_settings, log, "messages")},
                                         {"scale", FIELD_NUMBER, offsetof(panel_settings, scale), 0, 0.5, 4, NULL, .doc = "size of text and controls"},
                                         {0}};

static const field_row inspect_fields[] = {{"x", FIELD_COUNT, offsetof(inspect_settings, x), 0, 0, MGT_MAX_IMAGE_SIDE - 1, "pixels",
                                            .doc = "column of the inspected pixel"},
                                           {"y", FIELD_COUNT, offsetof(inspect_settings, y), 0, 0, MGT_MAX_IMAGE_SIDE - 1, "pixels",
                                            .doc = "row of the inspected pixel"},
                                           {0}};

static const field_row fields[] =
    {{"a", FIELD_MAPPING, offsetof(settings, sides[SIDE_A]), 0, NO_RANGE, NULL, .doc = "side A", .fields = quality_fields},
     {"b", FIELD_MAPPING, offsetof(settings, sides[SIDE_B]), 0, NO_RANGE, NULL, .doc = "side B", .fields = quality_fields},
     {"view", FIELD_MAPPING, offsetof(settings, view), 0, NO_RANGE, NULL, .doc = "the picture", .fields = view_fields},
     {"clock", FIELD_MAPPING, offsetof(settings, clock), 0, NO_RANGE, NULL, .doc = "the time shown", .fields = clock_fields},
     {"waves", FIELD_MAPPING, offsetof(settings, waves), 0, NO_RANGE, NULL, .doc = "all waves at once", .fields = wave_fields},
     {"move", FIELD_MAPPING, offsetof(settings, move), 0, NO_RANGE, NULL, .doc = "how the camera is moved", .fields = move_fields},
     {"panel", FIELD_MAPPING, offsetof(settings, panel), 0, NO_RANGE, NULL, .doc = "what stands beside the picture", .fields = panel_fields},
     {"inspect", FIELD_MAPPING, offsetof(settings, inspect), 0, NO_RANGE, NULL, .doc = "the pixel looked into", .fields = inspect_fields},
     {0}};

static const field_row root_field = {"", FIELD_MAPPING, 0, 0, NO_RANGE, NULL, .doc = "settings of the viewer", .fields = fields};

const field_row *settings_root_field(void) { return &root_field; }

bool field_is_switch(const field_row *field) { return field->choices && strcmp(field_word(field, 0), "off") == 0 && strcmp(field_word(field, 1), "on") == 0; }

settings settings_defaults(void)
{
    mgt_quality a = quality_defaults(), b = a;
    method_from_name("reference", &b);
    return (settings){
        .sides = {a, b},
        .view = {.wipe = 0.5,
                 .difference_scale = 4,
                 .near_depth = 1,
                 .far_depth = 10000,
                 .coverage_end = 0.25,
                 .lean_end = 0.25,
                 .zoom = 1,
                 .center_x = 0.5,
                 .center_y = 0.5},
        .clock = {.speed = 1, .loop = 1},
        .waves = {.count = MGT_MAX_WAVES},
        .move = {.path = 1, .speed = 4, .clearance = 0.3},
        .panel = {.shown = 1, .judge = 1, .legend = 1, .scale = 1},
    };
}
