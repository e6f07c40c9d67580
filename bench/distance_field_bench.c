/* SPDX-License-Identifier: MIT
 * Size of the voxels of refraction distance-field, their memory and the time to build them, for scenes/pool.yaml.
 *
 *   distance_field_bench [--quick] */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cpu/distance_field.h"
#include "scene/scene_file.h"
#include "timing.h"

static void measure(const char *triangles)
{
    char error[REPORTER_TEXT] = "";
    const reporter quiet = {.error = error};
    scene_error wrong;
    mgt_scene scene;
    scene_file *file = scene_file_load(MGT_SOURCE_DIR "/scenes/pool.yaml", &triangles, 1, &wrong);
    thread_pool *pool = thread_pool_create(thread_pool_usable_cpus());
    world *w = NULL;
    distance_field *f = NULL;
    if (!file || !pool || !scene_file_frame(file, 0, &scene) || world_update(&w, &scene, pool) != MGT_OK) {
        fprintf(stderr, "distance_field_bench: no scene, or no memory\n");
        exit(1);
    }
    const double start = seconds_now();
    if (distance_field_update(&f, w, pool, &quiet) != MGT_OK) {
        fprintf(stderr, "distance_field_bench: %s\n", error);
        exit(1);
    }
    const double built = seconds_now() - start;
    printf("%10zu %10.3f %12zu %10.1f %10.2f\n", w->triangle_count, (double)f->voxel, (size_t)f->size[0] * f->size[1] * f->size[2],
           (double)distance_field_bytes(f) / 1048576, built);
    distance_field_free(f);
    world_free(w);
    thread_pool_destroy(pool);
    scene_file_free(file);
}

int main(int argc, char **argv)
{
    const bool quick = argc > 1 && strcmp(argv[1], "--quick") == 0;
    printf("%10s %10s %12s %10s %10s\n", "triangles", "voxel m", "voxels", "MiB", "build s");
    measure("objects[0].triangles=15000");
    if (!quick)
        measure("objects[0].triangles=127000");
    return 0;
}
