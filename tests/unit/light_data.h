/* SPDX-License-Identifier: MIT */
#ifndef MANGATA_TESTS_LIGHT_DATA_H
#define MANGATA_TESTS_LIGHT_DATA_H

#include "frame/kernel_data.h"

/* The light as kernels read it, in a direction and with the axes of its plane, all unit. Its radius is 0. */
static inline LightData light_data(const double light[3], const double e[3], const double f[3])
{
    return (LightData){.light_x = (float)light[0],
                       .light_y = (float)light[1],
                       .light_z = (float)light[2],
                       .axis_e_x = (float)e[0],
                       .axis_e_y = (float)e[1],
                       .axis_e_z = (float)e[2],
                       .axis_f_x = (float)f[0],
                       .axis_f_y = (float)f[1],
                       .axis_f_z = (float)f[2]};
}

#endif
