/* SPDX-License-Identifier: MIT
 * Method fxaa (after Lottes 2009): finds edges in the displayed picture of method `none` and reads every pixel a little across its edge.
 *
 * Luma has twelve bits (display_luma() of tone.k). By bytes a step of one, which rounding may cause, would move what is blended too far for the
 * pictures of two machines to agree; without steps ties would fall as rounding has it. */
#include <math.h>
#include <stdlib.h>

#include "frame/whole_frame.h"

/* ---- one pixel ---- */

typedef struct luma_view {
    const float *luma;
    int width, height;
} luma_view;

static float luma_at(const luma_view *v, int x, int y)
{
    x = x < 0 ? 0 : x >= v->width ? v->width - 1 : x;
    y = y < 0 ? 0 : y >= v->height ? v->height - 1 : y;
    return v->luma[(size_t)y * (size_t)v->width + (size_t)x];
}

/* The luma about a pixel, [row][column]. */
typedef struct luma_patch {
    float at[3][3];
    float range;
} luma_patch;

static luma_patch patch_of(const luma_view *v, int x, int y)
{
    luma_patch p;
    float least = INFINITY, most = 0;
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++) {
            p.at[j][i] = luma_at(v, x + i - 1, y + j - 1);
            if (i == 1 || j == 1)
                least = fminf(least, p.at[j][i]), most = fmaxf(most, p.at[j][i]);
        }
    /* Contrast below an eighth of the brightest, or too dark to see, is no edge. */
    p.range = most - least < fmaxf(1.0f / 32, most / 8) ? 0 : most - least;
    return p;
}

/* Of features smaller than a pixel: how far the pixel lies from the mean of its neighbours. */
static float subpixel_amount(const luma_patch *p)
{
    const float sides = p->at[0][1] + p->at[2][1] + p->at[1][0] + p->at[1][2];
    const float corners = p->at[0][0] + p->at[0][2] + p->at[2][0] + p->at[2][2];
    const float off = fminf(fabsf((2 * sides + corners) / 12 - p->at[1][1]) / p->range, 1);
    const float smooth = off * off * (3 - 2 * off);
    return 0.75f * smooth * smooth;
}

/* Whether the edge runs along the row: luma bends more down than across. */
static bool runs_along_row(const luma_patch *p)
{
    float across = 0, down = 0;
    for (int i = 0; i < 3; i++) {
        const float weight = i == 1 ? 2 : 1;
        down += weight * fabsf(p->at[0][i] + p->at[2][i] - 2 * p->at[1][i]);
        across += weight * fabsf(p->at[i][0] + p->at[i][2] - 2 * p->at[i][1]);
    }
    return down >= across;
}

/* Where the edge ends in one direction: how many pixels off, and whether luma rises there above the edge's own. */
typedef struct edge_end {
    float distance, luma;
} edge_end;

/* Steps as FXAA's quality presets have them: near ones fine, far ones coarse. */
static edge_end walk_edge(const luma_view *v, int x, int y, fxaa_shift side, int sign, float edge, float limit)
{
    static const int steps[] = {1, 1, 1, 1, 1, 2, 2, 2, 2, 4, 8};
    int distance = 0;
    float off = 0;
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        distance += steps[i];
        const int px = x + (side.dy != 0 ? sign * distance : 0), py = y + (side.dy != 0 ? 0 : sign * distance);
        off = 0.5f * (luma_at(v, px, py) + luma_at(v, px + side.dx, py + side.dy)) - edge;
        if (fabsf(off) >= limit)
            break;
    }
    return (edge_end){(float)distance, off};
}

fxaa_shift fxaa_shift_of(const float *luma, uint32_t width, uint32_t height, uint32_t column, uint32_t row)
{
    const luma_view v = {luma, (int)width, (int)height};
    const int x = (int)column, y = (int)row;
    const luma_patch p = patch_of(&v, x, y);
    fxaa_shift shift = {0, 0, 0};
    if (p.range == 0)
        return shift;
    const bool horizontal = runs_along_row(&p);
    const float centre = p.at[1][1], before = horizontal ? p.at[0][1] : p.at[1][0], after = horizontal ? p.at[2][1] : p.at[1][2];
    const int sign = fabsf(before - centre) >= fabsf(after - centre) ? -1 : 1;
    *(horizontal ? &shift.dy : &shift.dx) = sign;
    const float neighbour = sign < 0 ? before : after, edge = 0.5f * (centre + neighbour);
    const float limit = 0.25f * fmaxf(fabsf(neighbour - centre), 1e-6f);
    const edge_end back = walk_edge(&v, x, y, shift, -1, edge, limit), ahead = walk_edge(&v, x, y, shift, 1, edge, limit);
    const edge_end near = back.distance < ahead.distance ? back : ahead;
    /* Only where the nearer end turns to the other side of the edge does the pixel lie under the slanting line. */
    float amount = 0;
    if ((near.luma < 0) != (centre < edge))
        amount = 0.5f - near.distance / (back.distance + ahead.distance);
    shift.amount = fmaxf(amount, subpixel_amount(&p));
    return shift;
}

/* ---- a picture ---- */

typedef struct fxaa_job {
    const picture_planes *in;
    picture_planes *out;
    float *luma;
} fxaa_job;

static void blend_pixel(const fxaa_job *job, size_t to, size_t from, float amount)
{
    const picture_planes *in = job->in;
    for (int c = 0; c < 3; c++)
        job->out->color[3 * to + (size_t)c] = (1 - amount) * in->color[3 * to + (size_t)c] + amount * in->color[3 * from + (size_t)c];
    job->out->coverage[to] = (1 - amount) * in->coverage[to] + amount * in->coverage[from];
    job->out->water[to] = (1 - amount) * in->water[to] + amount * in->water[from];
}

static void fxaa_row(void *argument, size_t y)
{
    const fxaa_job *job = argument;
    const uint32_t width = job->in->width, height = job->in->height;
    for (uint32_t x = 0; x < width; x++) {
        const fxaa_shift s = fxaa_shift_of(job->luma, width, height, x, (uint32_t)y);
        const int64_t column = (int64_t)x + s.dx, row = (int64_t)y + s.dy;
        const bool inside = column >= 0 && row >= 0 && column < width && row < height;
        const size_t to = y * width + x;
        blend_pixel(job, to, inside ? (size_t)row * width + (size_t)column : to, s.amount);
    }
}

mgt_status fxaa_render(const picture_maker *m, const reporter *r, const mgt_scene *scene, picture_planes *out)
{
    const size_t pixels = (size_t)out->width * out->height;
    picture_planes in = picture_planes_create(out->width, out->height, METHOD_PASS_FXAA);
    fxaa_job job = {&in, out, malloc(pixels * sizeof(float))};
    mgt_status status = MGT_ERROR_MEMORY;
    if (!in.color || !job.luma) {
        report_error(r, status, "render.memory", "out of memory for fxaa on %u x %u pixels", out->width, out->height);
        goto done;
    }
    const size_t size = sizeof(mgt_target);
    const mgt_target layers[] = {{size, MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, in.color, 0},
                                 {size, MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, in.coverage, 0},
                                 {size, MGT_LAYER_MASK, MGT_FORMAT_R32F, in.water, 0}};
    status = m->render(m->user, scene, layers, 3, NULL);
    if (status != MGT_OK)
        goto done;
    status = m->luma(m->user, scene, in.color, job.luma); /* edges are those of the tone-mapped picture, before glare */
    if (status != MGT_OK)
        goto done;
    m->run(m->user, out->height, fxaa_row, &job);
done:
    free(job.luma);
    picture_planes_free(&in);
    return status;
}
