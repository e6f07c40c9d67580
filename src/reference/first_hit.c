/* SPDX-License-Identifier: MIT
 *
 * The first hit of a ray with the water by brute force.
 */
#include <math.h>

#include "reference/equations.h"
#include "reference/sines.h"

typedef struct water_ray {
    const mgt_water *water;
    double origin[3], direction[3];
    double time;
} water_ray;

static water_point water_below(const water_ray *ray, double distance)
{
    return water_surface(ray->water, ray->origin[0] + distance * ray->direction[0], ray->origin[2] + distance * ray->direction[2], ray->time);
}

static double height_above_water(const water_ray *ray, double distance)
{
    return ray->origin[1] + distance * ray->direction[1] - water_below(ray, distance).height;
}

static water_hit hit_at(const water_ray *ray, double distance)
{
    water_hit result = {.hit = true, .distance = distance, .water = water_below(ray, distance)};
    for (int i = 0; i < 3; i++)
        result.position[i] = ray->origin[i] + distance * ray->direction[i];
    return result;
}

static water_hit bisect(const water_ray *ray, double above, double below)
{
    for (int i = 0; i < 200 && below - above > 1e-12 * below; i++) {
        const double middle = 0.5 * (above + below);
        if (height_above_water(ray, middle) > 0)
            above = middle;
        else
            below = middle;
    }
    return hit_at(ray, below);
}

water_hit first_hit_brute_force(const mgt_scene *scene, double pixel_x, double pixel_y, double time)
{
    const water_hit none = {.hit = false, .distance = HUGE_VAL};
    water_ray ray = {.water = &scene->water, .time = time};
    camera_ray(scene, pixel_x, pixel_y, time, ray.origin, ray.direction);

    double crest, steepest;
    water_worst_case(&scene->water, ray.direction, &crest, &steepest);
    const double fall = steepest - ray.direction[1]; /* the fastest loss of height over the water */
    double distance = 0;
    if (ray.origin[1] > crest) {
        if (!(ray.direction[1] < 0))
            return none;
        distance = (ray.origin[1] - crest) / -ray.direction[1];
        if (!(distance < 1e9))
            return none;
    }
    double above = 0;
    for (int i = 0; i < 10000000; i++) {
        const double height = height_above_water(&ray, distance);
        if (height <= 0)
            return distance > 0 ? bisect(&ray, above, distance) : hit_at(&ray, 0);
        if (fall <= 0 || (ray.direction[1] >= 0 && ray.origin[1] + distance * ray.direction[1] > crest))
            return none;
        above = distance;
        distance += fmax(height / fall, 1e-7 * (1 + distance));
    }
    return none;
}
