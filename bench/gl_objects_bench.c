/* SPDX-License-Identifier: MIT
 *
 * OpenGL: ways to refract in a pool of about 16,000 and 128,000 triangles, with a camera that moves from frame to frame, beside no refraction, as a
 * table in Markdown. What one table compares takes turns; each frame is compared with that of `off` next to it. And the tree that hybrid traces
 * rays through.
 *
 * usage: gl_objects_bench [--quick] [--gl-device N]      exit 77 where there is no OpenGL
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "frame/mesh.h"
#include "gl/gl_bvh.h"
#include "gl_frame.h"
#include "scene/scene_file.h"
#include "timing.h"

enum { WAYS = 4, METHODS = 2, COUNTS = 2, RUNS = 15, SOFTWARE_RUNS = 5, TREE_RUNS = 3 };

static const struct {
    const char *name;
    mgt_refraction refraction;
} ways[WAYS] = {
    {"off", MGT_REFRACTION_OFF},
    {"two-phase", MGT_REFRACTION_TWO_PHASE},
    {"hybrid", MGT_REFRACTION_HYBRID},
    {"screen-space", MGT_REFRACTION_SCREEN_SPACE},
};
static const struct {
    const char *name;
    mgt_method method;
} methods[METHODS] = {{"none", MGT_METHOD_NONE}, {"mangata", MGT_METHOD_MANGATA}};
static const int basins[COUNTS] = {5600, 117600}; /* triangles of the basin: the other things have 10,414 */
static const double least_software = 0.7, least_hardware = 0.95;

typedef struct bench {
    bool quick;
    int runs;
    gl_frame frame;
} bench;

static scene_file *load(const bench *b, int basin)
{
    char size[32], rows[32], triangles[48];
    snprintf(size, sizeof size, "image.width=%d", b->quick ? 64 : 1280);
    snprintf(rows, sizeof rows, "image.height=%d", b->quick ? 36 : 720);
    snprintf(triangles, sizeof triangles, "objects[0].triangles=%d", b->quick ? 1000 : basin);
    const char *const overrides[] = {
        size,
        rows,
        triangles,
        "time.shutter=0",
        "camera={fov_y_deg: 45, path: [{time: 0, position: [0.7, 4, 7.2], target: [0.2, 0, 0.4]}, "
        "{time: 100, position: [0.9, 4, 7], target: [0.4, 0, 0.4]}]}",
    };
    scene_error error;
    scene_file *file = scene_file_load(MGT_SOURCE_DIR "/scenes/pool.yaml", overrides, sizeof overrides / sizeof *overrides, &error);
    if (!file)
        fprintf(stderr, "gl_objects_bench: %s\n", error.text);
    return file;
}

/* Seconds of a frame, and of all of the processor's cores for it. */
typedef struct frame_time {
    double seconds, processor;
} frame_time;

static bool time_way(const bench *b, scene_file *file, uint32_t number, mgt_method method, mgt_refraction refraction, frame_time *out)
{
    mgt_scene scene;
    if (!scene_file_frame(file, number, &scene))
        return false;
    scene.quality.method = method;
    scene.quality.refraction = refraction;
    const clock_t begin = clock();
    out->seconds = gl_frame_seconds(&b->frame, &scene, NULL, NULL);
    out->processor = (double)(clock() - begin) / CLOCKS_PER_SEC;
    return out->seconds > 0 && out->processor > 0;
}

/* Seconds, and those of `off` over them: of frames, and of the processor. */
typedef struct way_times {
    timing seconds, rate, processor_rate;
} way_times;

static bool time_ways(const bench *b, scene_file *file, mgt_method method, way_times out[WAYS])
{
    static double seconds[WAYS][RUNS], rates[WAYS][RUNS], processor_rates[WAYS][RUNS];
    for (int run = -1; run < b->runs; run++) { /* the first time builds programs */
        frame_time t[WAYS];
        for (int w = 0; w < WAYS; w++) {
            if (!time_way(b, file, run + 1, method, ways[w].refraction, &t[w]))
                return false;
            if (run < 0)
                continue;
            seconds[w][run] = t[w].seconds;
            rates[w][run] = t[0].seconds / t[w].seconds;
            processor_rates[w][run] = t[0].processor / t[w].processor;
        }
    }
    const size_t runs = (size_t)b->runs;
    for (int w = 0; w < WAYS; w++)
        out[w] = (way_times){timing_of(seconds[w], runs), timing_of(rates[w], runs), timing_of(processor_rates[w], runs)};
    return true;
}

static size_t count_triangles(scene_file *file)
{
    mgt_scene scene;
    size_t count = 0;
    for (size_t i = 0; scene_file_frame(file, 0, &scene) && i < scene.object_count; i++)
        count += scene.objects[i].mesh->triangle_count;
    return count;
}

static bool bench_pool(const bench *b, int basin, int method)
{
    scene_file *file = load(b, basin);
    way_times t[WAYS];
    const bool done = file && time_ways(b, file, methods[method].method, t);
    const double least = b->frame.software ? least_software : least_hardware;
    for (int w = 0; w < WAYS && done; w++) {
        const bool fastest = t[1].seconds.median <= t[2].seconds.median && t[1].seconds.median <= t[3].seconds.median;
        char processor[16] = "";
        if (b->frame.software)
            snprintf(processor, sizeof processor, "%.3f", t[w].processor_rate.median);
        printf("| %zu | %s | %s | %.2f | %.2f – %.2f | %.3f | %s |", count_triangles(file), methods[method].name, ways[w].name, 1e3 * t[w].seconds.median,
               1e3 * t[w].seconds.least, 1e3 * t[w].seconds.most, t[w].rate.median, processor);
        if (w == 1 && !b->quick)
            printf(" ≥ %.2f: %s; the fastest that refracts: %s |\n", least, verdict(t[w].rate.median >= least), verdict(fastest));
        else
            printf(" |\n");
        fflush(stdout);
    }
    scene_file_free(file);
    return done;
}

static bool bench_all(const bench *b)
{
    const bool software = b->frame.software;
    printf("## Refraction\n\nScene `pool`, %s, a moving camera, both ways to draw the water's reflections. ", b->quick ? "64 × 36" : "1280 × 720");
    printf("%s, median of %d in turn; the frame rate is over that of `off`%s.\n\n",
           software ? "Wall time of a frame, with reading back" : "GPU time of all passes", b->runs,
           software ? ", also by the time of all cores, which other programs disturb less" : "");
    printf("| triangles | method | refraction | ms a frame | least – most | frame rate | by cores | goal |\n"
           "|---:|---|---|---:|---:|---:|---:|---|\n");
    for (int m = 0; m < METHODS; m++)
        for (int i = 0; i < (b->quick ? 1 : COUNTS); i++)
            if (!bench_pool(b, basins[i], m))
                return false;
    printf("\n");
    return true;
}

/* ---- the tree ---- */

/* A bumpy floor of `side`² cells on 12 × 12 m; false without memory. */
static bool make_floor(world *w, uint32_t side)
{
    const size_t corners = (size_t)(side + 1) * (side + 1);
    *w = (world){.vertex_count = corners, .triangle_count = (size_t)2 * side * side};
    w->positions = malloc(3 * corners * sizeof *w->positions);
    w->indices = malloc(3 * w->triangle_count * sizeof *w->indices);
    if (!w->positions || !w->indices)
        return false;
    for (size_t i = 0; i < corners; i++) {
        const float x = 12.0f * (float)(i % (side + 1)) / (float)side, z = 12.0f * (float)(i / (side + 1)) / (float)side;
        const float place[3] = {x - 6, 0.3f * sinf(3 * x) * cosf(2 * z) - 2, z - 6};
        memcpy(w->positions + 3 * i, place, sizeof place);
    }
    for (uint32_t i = 0; i < side * side; i++) {
        const uint32_t a = i / side * (side + 1) + i % side, cell[6] = {a, a + side + 1, a + 1, a + 1, a + side + 1, a + side + 2};
        memcpy(w->indices + 6 * (size_t)i, cell, sizeof cell);
    }
    return true;
}

/* Median seconds. */
static double build_tree(const world *w, uint32_t threads, int runs, gl_bvh *out)
{
    double seconds[TREE_RUNS];
    thread_pool *pool = thread_pool_create(threads);
    mgt_status status = pool ? MGT_OK : MGT_ERROR_THREAD;
    for (int i = 0; i < runs && status == MGT_OK; i++) {
        gl_bvh_free(out);
        const double begin = seconds_now();
        status = gl_bvh_build(out, w, pool);
        seconds[i] = seconds_now() - begin;
    }
    thread_pool_destroy(pool);
    return status == MGT_OK ? timing_of(seconds, (size_t)runs).median : -1;
}

static bool bench_trees(bool quick)
{
    static const uint32_t sides[] = {90, 253, 1582};
    bool done = true;
    printf("## The tree of boxes\n\nOf a bumpy floor, built by the CPU when objects have changed.\n\n"
           "| triangles | MiB | bytes a triangle | s, 1 thread | s, 2 threads |\n|---:|---:|---:|---:|---:|\n");
    for (int i = 0; i < (quick ? 1 : 3) && done; i++) {
        world w;
        gl_bvh tree = {0};
        done = make_floor(&w, sides[i]);
        const double one = done ? build_tree(&w, 1, quick ? 1 : TREE_RUNS, &tree) : -1;
        const double two = done ? build_tree(&w, 2, quick ? 1 : TREE_RUNS, &tree) : -1;
        done = one > 0 && two > 0;
        const double bytes = (double)(tree.texel_count * sizeof *tree.texels);
        if (done)
            printf("| %zu | %.1f | %.1f | %.3f | %.3f |\n", w.triangle_count, bytes / 1048576, bytes / (double)w.triangle_count, one, two);
        fflush(stdout);
        gl_bvh_free(&tree);
        free(w.positions);
        free(w.indices);
    }
    printf("\n");
    return done;
}

static int start(bench *b, uint32_t device)
{
    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = MGT_BACKEND_GL;
    desc.gl_device = device;
    if (mgt_context_create(&b->frame.gl, &desc) != MGT_OK) {
        fprintf(stderr, "gl_objects_bench: %s\n", mgt_last_error(NULL));
        return 77;
    }
    mgt_context_info info = {.struct_size = sizeof info};
    mgt_context_get_info(b->frame.gl, &info);
    b->frame.software = info.software;
    b->runs = b->quick ? 1 : info.software ? SOFTWARE_RUNS : RUNS;
    b->frame.pixels = calloc((size_t)1280 * 720, 12);
    return b->frame.pixels ? 0 : 1;
}

int main(int argc, char **argv)
{
    bench b = {0};
    uint32_t device = 0;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--quick") == 0) {
            b.quick = true;
        } else if (strcmp(argv[i], "--gl-device") == 0 && i + 1 < argc) {
            device = (uint32_t)strtoul(argv[++i], NULL, 10);
        } else {
            fprintf(stderr, "usage: gl_objects_bench [--quick] [--gl-device N]\n");
            return 64;
        }
    }
    FILE *bunny = fopen(MGT_SOURCE_DIR "/data/bunny.ply", "r");
    if (!bunny) {
        fprintf(stderr, "gl_objects_bench: data/bunny.ply is missing: run scripts/fetch_models\n");
        return 77;
    }
    fclose(bunny);
    int code = start(&b, device);
    if (code == 0)
        code = bench_all(&b) && bench_trees(b.quick) ? 0 : 1;
    mgt_context_destroy(b.frame.gl);
    free(b.frame.pixels);
    return code;
}
