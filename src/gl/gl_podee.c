/* SPDX-License-Identifier: MIT
 * Tables of methods podee-* with circular kernels, on the GPU. */
#include "frame/podee_tables.h"
#include "base/thread_pool.h"
#include "gl/gl_renderer.h"

/* The slices of the sweep lie side by side in one texture, SLICES_ACROSS in a row. */
enum { SLICES_ACROSS = PODEE_SLICES_ACROSS, SLICES_DOWN = PODEE_SLICES / SLICES_ACROSS };

static mgt_status build_tables(uint32_t threads, podee_tables *tables, const reporter *r)
{
    thread_pool *pool = thread_pool_create(threads ? threads : thread_pool_usable_cpus());
    if (!pool)
        return report_error(r, MGT_ERROR_THREAD, "render.thread", "no threads to make the tables that quality.kernels needs");
    const bool built = podee_tables_build(tables, thread_pool_each, pool);
    thread_pool_destroy(pool);
    return built ? MGT_OK : report_error(r, MGT_ERROR_MEMORY, "render.memory", "out of memory for the 64 MiB of tables that quality.kernels needs");
}

static mgt_status upload(gl_renderer *g, const podee_tables *tables, const reporter *r)
{
    const gl_api *gl = &g->gl;
    gl_podee *p = &g->podee;
    mgt_status status = gl_image_reserve(gl, &p->sweep, GL_R32F, SLICES_ACROSS * PODEE_COLUMNS, SLICES_DOWN * PODEE_ROWS, r);
    if (status == MGT_OK)
        status = gl_image_reserve(gl, &p->share, GL_R32F, PODEE_COLUMNS, PODEE_SLICES, r);
    if (status != MGT_OK)
        return status;
    for (int s = 0; s < PODEE_SLICES; s++)
        gl->TextureSubImage2D(p->sweep.name, 0, s % SLICES_ACROSS * PODEE_COLUMNS, s / SLICES_ACROSS * PODEE_ROWS, PODEE_COLUMNS, PODEE_ROWS, GL_RED, GL_FLOAT,
                              tables->sweep + (size_t)s * PODEE_ROWS * PODEE_COLUMNS);
    gl->TextureSubImage2D(p->share.name, 0, 0, 0, PODEE_COLUMNS, PODEE_SLICES, GL_RED, GL_FLOAT, tables->share);
    return gl_check(gl, "tables", r);
}

mgt_status gl_podee_prepare(gl_renderer *g, const mgt_scene *scene, const reporter *r)
{
    if (scene->quality.kernels == MGT_MIXTURE_RIEMANN || g->podee.filled)
        return MGT_OK;
    podee_tables tables = {NULL, NULL};
    mgt_status status = build_tables(g->threads, &tables, r);
    if (status == MGT_OK)
        status = upload(g, &tables, r);
    podee_tables_free(&tables);
    g->podee.filled = status == MGT_OK;
    return status;
}

void gl_podee_bind(const gl_renderer *g)
{
    gl_bind_texture(g, UNIT_SWEEP, g->podee.sweep.name);
    gl_bind_texture(g, UNIT_FRACTION, g->podee.share.name);
}

void gl_podee_free(gl_renderer *g)
{
    gl_image_free(&g->gl, &g->podee.sweep);
    gl_image_free(&g->gl, &g->podee.share);
    g->podee.filled = false;
}
