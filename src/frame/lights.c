/* SPDX-License-Identifier: MIT
 * The lights of a frame. */
#include "frame/lights.h"

#include <math.h>

#include "base/triples.h"

void lights_place(const sky_state *sky, const mgt_light *light, bool under, FrameData *frame)
{
    const double up[3] = {0, 1, 0}, north[3] = {0, 0, -1};
    const double to[3] = {sky->direction[0], under ? -sky->direction[1] : sky->direction[1], sky->direction[2]};
    double e[3], f[3];
    cross3(fabs(to[1]) < 0.999 ? up : north, to, e);
    normalize3(e);
    cross3(to, e, f);
    frame->light_count = 1;
    frame->lights[0] = (LightData){
        .light_x = (float)to[0],
        .light_y = (float)to[1],
        .light_z = (float)to[2],
        .disk_radius = (float)sky->tan_radius,
        .light_azimuth_x = (float)sky->azimuth[0],
        .light_azimuth_z = (float)sky->azimuth[1],
        .limb = (float)sky->limb,
        .light_visible = light->elevation_deg >= 0 ? 1 : 0,
        .light_radiance_r = (float)sky->light_radiance[0],
        .light_radiance_g = (float)sky->light_radiance[1],
        .light_radiance_b = (float)sky->light_radiance[2],
        .axis_e_x = (float)e[0],
        .axis_e_y = (float)e[1],
        .axis_e_z = (float)e[2],
        .axis_f_x = (float)f[0],
        .axis_f_y = (float)f[1],
        .axis_f_z = (float)f[2],
    };
}
