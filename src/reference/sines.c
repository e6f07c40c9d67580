/* SPDX-License-Identifier: MIT
 *
 * Sine waves in double precision.
 */
#include "reference/sines.h"

#include <math.h>

#include "reference/equations.h"

static const long double pi = 3.14159265358979323846264338327950288L;

water_point water_surface(const mgt_water *water, double x, double z, double time)
{
    water_point point = {0};
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *wave = &water->waves[i];
        const double phase = wave->kx * x + wave->kz * z + wave->omega * time + wave->phase;
        const double sine = wave->amplitude * sin(phase), cosine = wave->amplitude * cos(phase);
        point.height += sine;
        point.slope[0] += wave->kx * cosine;
        point.slope[1] += wave->kz * cosine;
        point.hessian[0] -= wave->kx * wave->kx * sine;
        point.hessian[1] -= wave->kx * wave->kz * sine;
        point.hessian[2] -= wave->kz * wave->kz * sine;
    }
    return point;
}

void water_worst_case(const mgt_water *water, const double direction[3], double *height, double *slope)
{
    *height = *slope = 0;
    for (size_t i = 0; i < water->wave_count; i++) {
        const mgt_wave *wave = &water->waves[i];
        *height += fabs(wave->amplitude);
        *slope += fabs(wave->amplitude * (wave->kx * direction[0] + wave->kz * direction[2]));
    }
}

/* long double, because a camera may stand at phases of 10⁷ radians. */
static double reduced_half_turns(const mgt_wave *wave, const mgt_scene *scene)
{
    const long double phase = (long double)wave->kx * scene->camera.position[0] + (long double)wave->kz * scene->camera.position[2] +
                              (long double)wave->omega * scene->time + (long double)wave->phase;
    return (double)remainderl(phase / pi, 2.0L);
}

double reference_waves_of(const mgt_scene *scene, double deviations, reference_wave *out)
{
    double sum = 0, square = 0;
    for (size_t i = 0; i < scene->water.wave_count; i++) {
        const mgt_wave *from = &scene->water.waves[i];
        out[i] = (reference_wave){.amplitude = from->amplitude,
                                  .a = from->kx,
                                  .b = from->kz,
                                  .amplitude_a = from->amplitude * from->kx,
                                  .amplitude_b = from->amplitude * from->kz,
                                  .half_turns_a = (double)(from->kx / pi),
                                  .half_turns_b = (double)(from->kz / pi),
                                  .half_turns_c = (double)(from->omega / pi),
                                  .phase = reduced_half_turns(from, scene)};
        sum += fabs(from->amplitude);
        square += from->amplitude * from->amplitude;
    }
    return fmin(sum, deviations * sqrt(0.5 * square));
}

void reference_waves_mirror(reference_wave *waves, size_t count)
{
    for (size_t i = 0; i < count; i++)
        waves[i].phase += 1; /* half a turn: amplitudes stay positive, as the bounds want them */
}
