/* SPDX-License-Identifier: MIT
 *
 * Methods that work on pictures: fxaa's edges, taa's history.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "frame/whole_frame.h"

enum { WIDTH = 48, HEIGHT = 32, PIXELS = WIDTH * HEIGHT };

/* ---- fxaa ---- */

static float blended(const float *luma, uint32_t x, uint32_t y)
{
    const fxaa_shift s = fxaa_shift_of(luma, WIDTH, HEIGHT, x, y);
    assert_true(s.amount >= 0 && s.amount <= 1 && abs(s.dx) + abs(s.dy) <= 1);
    const int64_t column = (int64_t)x + s.dx, row = (int64_t)y + s.dy;
    if (column < 0 || row < 0 || column >= WIDTH || row >= HEIGHT)
        return luma[y * WIDTH + x];
    return (1 - s.amount) * luma[y * WIDTH + x] + s.amount * luma[row * WIDTH + column];
}

static void flat_areas_stay(void **state)
{
    (void)state;
    float luma[PIXELS];
    for (int kind = 0; kind < 3; kind++) {
        for (int i = 0; i < PIXELS; i++)
            luma[i] = kind == 0 ? 0.5f : kind == 1 ? 0.3f + 0.01f * (float)(i % WIDTH) : 0.9f + 0.05f * (float)(i % 2);
        for (uint32_t i = 0; i < PIXELS; i++)
            assert_true(fxaa_shift_of(luma, WIDTH, HEIGHT, i % WIDTH, i / WIDTH).amount == 0);
    }
}

/* An edge y = height + slant·x of a dark and a bright half-plane: point samples, and the areas that they should have been. */
static void slanted_edges_become_areas(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        const double slant = kind % 2 ? -0.15 : 0.1;
        float luma[PIXELS], area[PIXELS];
        for (int i = 0; i < PIXELS; i++) {
            double x = i % WIDTH, y = i / WIDTH, sum = 0;
            for (int k = 0; k < 64; k++)
                sum += y + (k / 8 + 0.5) / 8 - 0.5 > 14 + slant * (x + (k % 8 + 0.5) / 8 - 0.5 - 24);
            area[i] = (float)(sum / 64);
            luma[i] = y > 14 + slant * (x - 24);
            if (kind >= 2)
                area[i] = 1 - area[i], luma[i] = 1 - luma[i];
        }
        double before = 0, after = 0;
        for (uint32_t y = 8; y < 24; y++)
            for (uint32_t x = 14; x < 34; x++) {
                before += pow((double)(luma[y * WIDTH + x] - area[y * WIDTH + x]), 2);
                after += pow((double)(blended(luma, x, y) - area[y * WIDTH + x]), 2);
            }
        print_message("  slant %.2f: square error of samples %.3f, after fxaa %.3f\n", slant, before, after);
        assert_true(after < 0.5 * before);
    }
}

/* ---- taa ---- */

static float noise(uint32_t i)
{
    i = (i ^ 61) ^ (i >> 16);
    i *= 9;
    i ^= i >> 4;
    i *= 0x27d4eb2d;
    return (float)((i ^ (i >> 15)) >> 8) * 0x1p-24f;
}

static picture_planes planes(void)
{
    picture_planes p = picture_planes_create(WIDTH, HEIGHT, METHOD_PASS_TAA);
    assert_non_null(p.color);
    return p;
}

static void fill(picture_planes *p, int kind, uint32_t number)
{
    for (uint32_t i = 0; i < PIXELS; i++) {
        /* A slope from column to column, by more than frames differ: only the columns at the edge leave their neighbours' range. */
        const float value = kind == 0 ? 0.05f * (float)(i % WIDTH) + 0.02f * noise(number * PIXELS + i) : 0;
        for (int c = 0; c < 3; c++)
            p->color[3 * i + (uint32_t)c] = value * (float)(c + 1);
        p->coverage[i] = value / 4;
        p->water[i] = 1;
    }
}

static void a_history_within_its_neighbours_is_a_mean(void **state)
{
    (void)state;
    picture_planes current = planes(), history = planes(), out = planes();
    double mean[PIXELS] = {0}, worst = 0;
    int clamped = 0;
    fill(&history, 0, 0);
    for (int i = 0; i < PIXELS; i++)
        mean[i] = (double)history.coverage[i] / TAA_FRAMES;
    for (int frames = 1; frames < TAA_FRAMES; frames++) {
        fill(&current, 0, (uint32_t)frames);
        const taa_step step = {.current = &current, .history = &history, .out = &out, .still = true, .frames = frames};
        for (uint32_t y = 0; y < HEIGHT; y++)
            taa_blend_row(&step, y);
        for (int i = 0; i < PIXELS; i++)
            mean[i] += (double)current.coverage[i] / TAA_FRAMES;
        const picture_planes swap = history;
        history = out, out = swap;
    }
    for (int i = 0; i < PIXELS; i++) {
        const double off = fabs((double)history.coverage[i] - mean[i]);
        clamped += off > 1e-6;
        if (off <= 1e-6)
            worst = fmax(worst, off);
    }
    print_message("  %d of %d pixels were clamped\n", clamped, PIXELS);
    assert_true(clamped <= 2 * HEIGHT && worst <= 1e-6);
    picture_planes_free(&current);
    picture_planes_free(&history);
    picture_planes_free(&out);
}

static void history_is_clamped_to_its_neighbours(void **state)
{
    (void)state;
    picture_planes current = planes(), history = planes(), out = planes();
    fill(&current, 1, 0);
    for (int i = 0; i < PIXELS; i++)
        history.coverage[i] = 1;
    current.coverage[10 * WIDTH + 10] = 0.6f;
    const taa_step step = {.current = &current, .history = &history, .out = &out, .still = true, .frames = 3};
    for (uint32_t y = 0; y < HEIGHT; y++)
        taa_blend_row(&step, y);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const bool near = abs(x - 10) <= 1 && abs(y - 10) <= 1;
            const double expected = x == 10 && y == 10 ? 0.6 : near ? 0.45 : 0; /* 3 parts of what is left of the history to 1 of now */
            assert_true(fabs((double)out.coverage[y * WIDTH + x] - expected) < 1e-6);
        }
    picture_planes_free(&current);
    picture_planes_free(&history);
    picture_planes_free(&out);
}

/* A pattern painted on the water, seen from two places: the history is found where it was. */
static void history_follows_the_camera(void **state)
{
    (void)state;
    picture_planes current = planes(), history = planes(), out = planes();
    mgt_scene defaults;
    mgt_scene_init(&defaults, sizeof defaults);
    mgt_camera camera = defaults.camera;
    camera.target[1] = 2;
    taa_step step = {.current = &current, .history = &history, .out = &out, .frames = 1000000};
    step.now = camera_rays_of(&camera, WIDTH, HEIGHT);
    camera.position[0] += 0.07, camera.position[2] -= 0.05, camera.target[0] += 0.11;
    step.before = camera_rays_of(&camera, WIDTH, HEIGHT);
    for (int which = 0; which < 2; which++) {
        picture_planes *p = which ? &history : &current;
        const camera_rays *c = which ? &step.before : &step.now;
        for (int i = 0; i < PIXELS; i++) {
            double ray[3], length = 0;
            for (int k = 0; k < 3; k++) {
                ray[k] = c->corner[k] + i % WIDTH * c->right[k] + i / WIDTH * c->down[k];
                length += ray[k] * ray[k];
            }
            const double along = ray[1] < 0 ? c->position[1] / -ray[1] : INFINITY;
            p->depth[i] = (float)(along * sqrt(length));
            const double x = c->position[0] + along * ray[0], z = c->position[2] + along * ray[2];
            p->coverage[i] = ray[1] < 0 ? (float)(0.5 + 0.2 * sin(0.9 * x) + 0.2 * cos(0.7 * z)) : 0;
        }
    }
    double moved = 0, followed = 0;
    int count = 0;
    for (uint32_t y = 0; y < HEIGHT; y++) {
        taa_blend_row(&step, y);
        for (uint32_t x = 3; y > HEIGHT / 2 && y < HEIGHT - 3 && x < WIDTH - 3; x++, count++) {
            const size_t i = y * WIDTH + x;
            moved += pow((double)(history.coverage[i] - current.coverage[i]), 2);
            followed += pow((double)(out.coverage[i] - current.coverage[i]), 2);
        }
    }
    print_message("  history off by %.4f where it stands, by %.4f where it is found\n", sqrt(moved / count), sqrt(followed / count));
    assert_true(followed < 0.01 * moved);
    picture_planes_free(&current);
    picture_planes_free(&history);
    picture_planes_free(&out);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flat_areas_stay),
        cmocka_unit_test(slanted_edges_become_areas),
        cmocka_unit_test(a_history_within_its_neighbours_is_a_mean),
        cmocka_unit_test(history_is_clamped_to_its_neighbours),
        cmocka_unit_test(history_follows_the_camera),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
