/* SPDX-License-Identifier: MIT
 * Decides when A and B are judged against brute force, and draws the figures beside the divider. */
#include <GLFW/glfw3.h>

#include <stdio.h>

#include "params/options.h"
#include "viewer/app/panels.h"

/* Whether judging is on, two methods are compared in colour, and the picture is finished and does not move. */
static bool is_wanted(const viewer *v)
{
    const settings *s = &v->settings;
    return s->panel.judge && s->view.compare == COMPARE_WIPE && s->view.layer == MGT_LAYER_COLOR && !s->clock.play && viewer_is_settled(v, 1);
}

/* The shots of this frame and of the next one. The clock is set to the latter for a moment. */
static bool take_frames(viewer *v, shot shots[JUDGE_FRAMES])
{
    const double time = v->settings.clock.time;
    bool good = viewer_take_shot(v, &shots[0]);
    v->settings.clock.time = time + 1 / v->document.values.time.fps;
    good = good && viewer_take_shot(v, &shots[1]);
    v->settings.clock.time = time;
    return good;
}

/* Orders the judgement of what is shown. */
static void begin(viewer *v)
{
    judging *state = &v->judging;
    shot shots[JUDGE_FRAMES];
    judge_order order = {.models = v->document.values.models};
    char why[VIEWER_TEXT];
    if (!state->judge) {
        const mgt_context_desc desc = viewer_cpu_desc(v);
        state->judge = judge_create(&desc, glfwPostEmptyEvent, why, sizeof why);
        if (!state->judge) {
            v->settings.panel.judge = 0;
            viewer_report(v, true, "%s", why);
            return;
        }
    }
    if (!take_frames(v, shots))
        return;
    for (int frame = 0; frame < JUDGE_FRAMES; frame++) {
        order.frames[frame] = shots[frame].scene;
        order.frames[frame].image = v->render.last.scene.image;
    }
    for (int side = 0; side < SIDE_COUNT; side++)
        order.quality[side] = v->render.last.quality[side];
    judge_post(state->judge, &order);
    state->serial = v->render.serial;
    state->has_found = false;
}

void viewer_judge(viewer *v)
{
    judging *state = &v->judging;
    char problem[VIEWER_TEXT] = "";
    if (state->serial && (state->serial != v->render.serial || !is_wanted(v))) {
        judge_stop(state->judge);
        state->serial = 0;
        state->has_found = false;
    }
    if (!state->serial && is_wanted(v))
        begin(v);
    if (state->serial)
        state->has_found |= judge_take(state->judge, &state->found, problem, sizeof problem);
    if (problem[0])
        viewer_report(v, true, "%s", problem);
}

/* ---- beside the divider ---- */

/* Draws the figures of a side. A figure is marked if it is better than the other side's and the latter is above the noise. */
static void draw_scores(ui_rect box, const judgement *found, int side, float unit)
{
    const judge_scores *own = &found->sides[side], *other = &found->sides[SIDE_COUNT - 1 - side];
    static const char *const names[] = {"error", "FLIP", "flicker"};
    const double values[] = {own->error, own->flip, own->flicker}, others[] = {other->error, other->flip, other->flicker};
    const double noise[] = {found->noise, 0, found->step_noise};
    char text[32];
    ui_draw_box(UI_LAYER_BEHIND, box, 0x0a0d13c8, 4);
    for (int i = 0; i < 3; i++) {
        const float y = box.y + (0.3f + 1.35f * (float)i) * unit;
        snprintf(text, sizeof text, values[i] < noise[i] ? "< %.4f" : "%.4f", values[i] < noise[i] ? noise[i] : values[i]);
        ui_draw_text(UI_LAYER_BEHIND, box.x + 0.5f * unit, y, 0x8891a0ff, names[i]);
        ui_draw_text(UI_LAYER_BEHIND, box.x + box.width - 0.5f * unit - ui_text_width(text), y,
                     values[i] < others[i] && noise[i] < others[i] ? 0xedc778ff : 0xdde2eaff, text);
    }
}

void judging_draw(const viewer *v, float divider, float top, float unit)
{
    const judging *state = &v->judging;
    const float width = 9.4f * unit, height = 4.5f * unit;
    char text[96];
    if (!state->serial)
        return;
    if (state->has_found) {
        draw_scores((ui_rect){divider - unit - width, top, width, height}, &state->found, SIDE_A, unit);
        draw_scores((ui_rect){divider + unit, top, width, height}, &state->found, SIDE_B, unit);
        snprintf(text, sizeof text, "%u of %u samples, noise %.4f", state->found.samples, state->found.total, state->found.noise);
    } else {
        snprintf(text, sizeof text, "gathering references");
    }
    const float room = ui_text_width(text) + unit, y = state->has_found ? top + height + 0.3f * unit : top;
    const ui_rect box = {divider + unit, y, room, 1.7f * unit};
    ui_draw_box(UI_LAYER_BEHIND, box, 0x0a0d13c8, 4);
    ui_draw_text(UI_LAYER_BEHIND, box.x + 0.5f * unit, box.y + 0.3f * unit, 0x8891a0ff, text);
}
