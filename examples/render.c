/* SPDX-License-Identifier: MIT */
/* A whole program: a scene made of three waves, rendered into 8-bit pixels, written as a PPM picture.
 *   cc render.c $(pkg-config --cflags --libs mangata) -lm -o render && ./render sea.ppm */
#include <mangata/mangata.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A wave of `length` metres running towards `heading`; its speed is that of deep water. */
static mgt_wave wave(double length, double steepness, double heading)
{
    const double k = 2 * 3.14159265358979 / length;
    return (mgt_wave){.amplitude = steepness / k, .kx = k * sin(heading), .kz = -k * cos(heading), .omega = -sqrt(9.81 * k)};
}

int main(int argc, char **argv)
{
    const mgt_wave waves[] = {wave(9.0, 0.06, 0.3), wave(2.3, 0.05, -0.5), wave(0.4, 0.04, 0.9)};
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    scene.image.width = 640;
    scene.image.height = 360;
    scene.light.elevation_deg = 12;
    scene.time = 3;
    scene.water.waves = waves;
    scene.water.wave_count = sizeof waves / sizeof waves[0];

    mgt_target target; /* displayed colour, 8 bits, tightly packed */
    mgt_target_init(&target, sizeof target);
    const size_t pixels = (size_t)scene.image.width * scene.image.height;
    unsigned char *rgba = target.pixels = malloc(4 * pixels);
    mgt_context *context = NULL;
    mgt_status status = rgba ? mgt_context_create(&context, NULL) : MGT_ERROR_MEMORY;
    if (status == MGT_OK)
        status = mgt_render(context, &scene, &target, 1);
    if (status != MGT_OK)
        fprintf(stderr, "render: %s: %s\n", mgt_status_text(status), mgt_last_error(context));

    FILE *file = status != MGT_OK ? NULL : argc > 1 ? fopen(argv[1], "wb") : stdout;
    int written = 0;
    if (status == MGT_OK && !file)
        perror(argv[1]);
    if (file) {
        fprintf(file, "P6\n%u %u\n255\n", scene.image.width, scene.image.height);
        for (size_t i = 0; i < pixels; i++)
            fwrite(rgba + 4 * i, 1, 3, file);
        written = !ferror(file) && fclose(file) == 0;
    }
    mgt_context_destroy(context);
    free(rgba);
    return written ? 0 : 1;
}
