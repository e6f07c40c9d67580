/* SPDX-License-Identifier: MIT
 * Methods that work on whole pictures: METHOD_PASS on the CPU. */
#include <stdlib.h>

#include "cpu/adaptive_podee.h"
#include "cpu/baseline_lanes.h"
#include "cpu/cpu_state.h"

typedef struct picture_user {
    cpu_state *state;
    const reporter *r;
    picture_sums sums; /* for method adaptive, scheme podee */
} picture_user;

static mgt_status make_picture(void *user, const mgt_scene *scene, const mgt_target *targets, size_t count, const frame_pass *pass)
{
    const picture_user *u = user;
    return cpu_render_picture(u->state, u->r, scene, targets, count, pass, (picture_sums){0});
}

static mgt_status show_picture(void *user, const mgt_scene *scene, const float *radiance, const mgt_target *target)
{
    const picture_user *u = user;
    return cpu_display(u->state, u->r, scene, radiance, target);
}

typedef struct luma_job {
    const lane_kernels *kernels;
    const FrameData *frame;
    const float *radiance;
    float *luma;
    size_t width;
} luma_job;

static void luma_row(void *argument, size_t y)
{
    const luma_job *job = argument;
    job->kernels->baselines->luma(job->frame, job->radiance + 3 * y * job->width, job->luma + y * job->width, job->width);
}

static mgt_status luma_of_picture(void *user, const mgt_scene *scene, const float *radiance, float *luma)
{
    const picture_user *u = user;
    const mgt_status status = cpu_prepare_sky(u->state, u->r, scene);
    if (status != MGT_OK)
        return status;
    frame *const f = &u->state->frame;
    frame_make(scene, u->state->sky, true, f);
    luma_job job = {u->state->kernels, &f->data, radiance, luma, scene->image.width};
    thread_pool_each(u->state->pool, scene->image.height, luma_row, &job);
    return MGT_OK;
}

static void run_rows(void *user, size_t count, void (*body)(void *, size_t), void *argument)
{
    const picture_user *u = user;
    thread_pool_each(u->state->pool, count, body, argument);
}

static bool report_adaptive(void *argument, double fraction)
{
    const cpu_state *s = argument;
    return !s->progress || s->progress(s->progress_user, fraction);
}

/* Renders the picture that scheme podee begins with, by method podee-uniform. */
static mgt_status approximate_picture(const picture_user *u, const mgt_scene *scene, const picture_planes *out)
{
    mgt_scene plain = *scene;
    plain.quality = plain_quality(&scene->quality, MGT_METHOD_PODEE_UNIFORM);
    const size_t size = sizeof(mgt_target);
    const mgt_target layers[] = {{size, MGT_LAYER_COLOR, MGT_FORMAT_RGB32F, out->color, 0},
                                 {size, MGT_LAYER_COVERAGE, MGT_FORMAT_R32F, out->coverage, 0},
                                 {size, MGT_LAYER_MASK, MGT_FORMAT_R32F, out->water, 0}};
    const frame_pass pass = {camera_rays_of(&scene->camera, scene->image.width, scene->image.height), 0, 0.3, true};
    return cpu_render_picture(u->state, u->r, &plain, layers, 3, &pass, (picture_sums){0});
}

/* Finds the objects in all tiles before method adaptive begins. */
typedef struct objects_job {
    tile_job tiles;
    tile_scratch **scratch;
    uint32_t columns;
    tile_opened *seen;
} objects_job;

static void see_tile(void *argument, size_t tile, uint32_t worker)
{
    const objects_job *job = argument;
    tile_scratch *s = job->scratch[worker];
    tile_see_objects(&job->tiles, (uint32_t)(tile % job->columns), (uint32_t)(tile / job->columns), s);
    refraction_keep(&s->objects, &job->seen[tile]);
}

static mgt_status see_objects(const picture_user *u, const frame *f, objects_job *job)
{
    cpu_state *s = u->state;
    if (!cpu_shows_objects(f))
        return MGT_OK;
    const mgt_image *image = &f->scene->image;
    job->columns = (image->width + TILE_WIDTH - 1) / TILE_WIDTH;
    const size_t tiles = (size_t)job->columns * ((image->height + TILE_HEIGHT - 1) / TILE_HEIGHT);
    job->scratch = s->scratch;
    job->seen = malloc(tiles * sizeof *job->seen);
    if (!job->seen)
        return report_error(u->r, MGT_ERROR_MEMORY, "render.memory", "out of memory for the objects of %u x %u pixels", image->width, image->height);
    frame_waves_build(f, s->waves);
    const mgt_status status = refraction_prepare(&s->objects, u->r, f, s->sky, s->kernels, s->isa, s->pool);
    if (status != MGT_OK)
        return status;
    job->tiles = (tile_job){.frame = f, .waves = s->waves, .kernels = s->kernels, .sky = s->sky->table, .objects = s->objects};
    const thread_loop loop = {tiles, see_tile, job, NULL};
    thread_pool_run(s->pool, &loop);
    return MGT_OK;
}

#define MGT_LANES 1
#include "kernels/common/prelude_c.h"

#include "kernels/refraction/compose.k"

/* Composes objects in front of the water over the finished picture. */
static void put_objects_before(const objects_job *job, const picture_planes *p)
{
    for (uint32_t y = 0; y < p->height && job->seen; y++)
        for (uint32_t x = 0; x < p->width; x++) {
            const tile_opened *o = &job->seen[(size_t)(y / TILE_HEIGHT) * job->columns + x / TILE_WIDTH];
            const size_t from = (size_t)(y % TILE_HEIGHT) * TILE_WIDTH + x % TILE_WIDTH, to = (size_t)y * p->width + x;
            const float share = o->share[from];
            for (size_t k = 0; k < 3 && share > 0; k++)
                p->color[3 * to + k] = light_over(NULL, p->color[3 * to + k], o->color[k][from], share);
            p->coverage[to] = left_behind(NULL, p->coverage[to], share);
            p->water[to] = left_behind(NULL, p->water[to], share);
        }
}

static mgt_status adapt_picture(void *user, const mgt_scene *scene, const picture_planes *out)
{
    const picture_user *u = user;
    cpu_state *s = u->state;
    const bool podee = scene->quality.adaptive == MGT_ADAPTIVE_PODEE;
    mgt_status status = podee ? approximate_picture(u, scene, out) : cpu_prepare_sky(s, u->r, scene);
    if (status != MGT_OK)
        return status;
    frame_make(scene, s->sky, true, &s->frame);
    objects_job objects = {.seen = NULL};
    status = see_objects(u, &s->frame, &objects);
    if (status != MGT_OK) {
        free(objects.seen);
        return status;
    }
    const adaptive_frame a = {&s->frame, s->kernels, s->sky->table, s->pool, s->scratch, objects.seen, u->sums, report_adaptive, s};
    status = podee ? adaptive_podee_render(&a, out) : adaptive_render(&a, &s->adaptive, out);
    if (status == MGT_OK)
        put_objects_before(&objects, out);
    free(objects.seen);
    if (status == MGT_OK)
        return MGT_OK;
    return report_error(u->r, status, status == MGT_CANCELLED ? "render.cancelled" : "render.memory",
                        status == MGT_CANCELLED ? "rendering was cancelled" : "out of memory for method adaptive");
}

/* Adds samples of method adaptive. The samples of a crop depend on the whole picture, so all of it is computed. */
static mgt_status sum_adaptive(picture_user *u, const mgt_scene *scene)
{
    mgt_scene whole = *scene;
    whole.image = (mgt_image){.width = scene->image.width, .height = scene->image.height};
    picture_planes p = picture_planes_create(whole.image.width, whole.image.height, METHOD_PASS_ADAPTIVE);
    if (!p.color)
        return report_error(u->r, MGT_ERROR_MEMORY, "render.memory", "out of memory for %u x %u pixels", whole.image.width, whole.image.height);
    const mgt_status status = adapt_picture(u, &whole, &p);
    picture_planes_free(&p);
    return status;
}

mgt_status cpu_render_summed(cpu_state *s, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count, picture_sums sums)
{
    if (method_of(scene->quality.method)->way != METHOD_PASS)
        return cpu_render_picture(s, r, scene, targets, count, NULL, sums);
    picture_user user = {s, r, sums};
    const picture_maker maker = {&user, make_picture, show_picture, luma_of_picture, run_rows, adapt_picture};
    return sums.add ? sum_adaptive(&user, scene) : whole_frame_render(&maker, r, scene, targets, count);
}

mgt_status cpu_render(void *state, const reporter *r, const mgt_scene *scene, const mgt_target *targets, size_t count)
{
    return cpu_render_summed(state, r, scene, targets, count, (picture_sums){0});
}
