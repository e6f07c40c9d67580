/* SPDX-License-Identifier: MIT
 *
 * Every equation of the model once more, in double precision and in its simplest form: the oracle that tests hold the kernels
 * to. Where a closed form could share a mistake with a kernel, the value here comes from a quadrature or finite differences.
 *
 * Two-dimensional quantities: slopes are (∂y/∂x, ∂y/∂z); covariances are {xx, xz, zz}; matrices are m[row][column].
 */
#ifndef MANGATA_REFERENCE_EQUATIONS_H
#define MANGATA_REFERENCE_EQUATIONS_H

#include <stdbool.h>

#include "mangata/mangata.h"

/* ---- water ---- */

typedef struct water_point {
    double height;
    double slope[2];
    double hessian[3]; /* ∂²y/∂x², ∂²y/∂x∂z, ∂²y/∂z² */
} water_point;

/* y = Σ A sin(a x + b z + c t + φ) and its derivatives. */
water_point water_surface(const mgt_water *water, double x, double z, double time);

/* Mean and variance of sin and of cos of ψ + g·u over the unit square u ∈ [−½, ½]², by Gauss–Legendre panels: a sine wave seen
 * through a pixel whose footprint is a parallelogram, g its phase gradient in radians per pixel. */
typedef struct filtered_sine {
    double mean_sine, variance_sine;
    double mean_cosine, variance_cosine;
} filtered_sine;

filtered_sine box_filter_sine(double phase, const double gradient[2]);

/* ---- camera ---- */

/* The ray through a continuous pixel position (pixel (0,0) covers [0,1)²) at a time; with camera_moves the camera runs
 * linearly from camera_open at time − shutter to camera at time. */
void camera_ray(const mgt_scene *scene, double pixel_x, double pixel_y, double time, double origin[3], double direction[3]);

/* Where that ray at scene->time meets the plane y = height; false if it does not. */
bool pixel_on_plane(const mgt_scene *scene, double pixel_x, double pixel_y, double height, double xz[2]);

/* P = ∂(x, z)/∂(pixel x, pixel y) there, by central differences. */
bool pixel_footprint(const mgt_scene *scene, double pixel_x, double pixel_y, double height, double footprint[2][2]);

typedef struct water_hit {
    bool hit;
    double distance; /* metres along the ray; +inf without a hit, 0 when the camera is under the surface */
    double position[3];
    water_point water;
} water_hit;

/* First hit of the displaced surface: steps that no crest can fit into even if all waves align, then bisection. Slow. */
water_hit first_hit_brute_force(const mgt_scene *scene, double pixel_x, double pixel_y, double time);

/* ---- mirror and light ---- */

/* Axes of the light plane r·L = 1: first = normalize((0,1,0) × L), second = L × first, which points up.
 * For a vertical L first is (−1, 0, 0), the limit for a light that comes from azimuth 0. */
void light_plane_axes(const double light[3], double first[3], double second[3]);

/* Direction of the ray that reaches the eye along `to_eye` (unit, from the surface) after a mirror of this slope. */
void mirror_direction(const double to_eye[3], const double slope[2], double mirrored[3]);

/* Its central projection onto the light plane, in the axes above. False when it points away from the light. */
bool mirror_map(const double to_eye[3], const double light[3], const double slope[2], double point[2]);

/* ∂(point)/∂(slope) by central differences. */
bool mirror_map_jacobian(const double to_eye[3], const double light[3], const double slope[2], double jacobian[2][2]);

/* The slope that mirrors the light's centre into the eye: −(h.x, h.z)/h.y of h = normalize(to_eye + light). */
void mirror_slope(const double to_eye[3], const double light[3], double slope[2]);

/* Unpolarised reflectance of a dielectric of relative index n, for the cosine of the angle of incidence in the outer medium. */
double fresnel_dielectric(double cosine, double index_of_refraction);

/* E[max(w, 0)] of a normal w, by quadrature: the normalisation of Smith's visible slopes. */
double mean_visible_weight(double mean, double deviation);

/* ---- light disk on its plane ---- */

/* P(|X| < radius) of X ~ N(mean, covariance). The covariance must be positive definite. */
double disk_probability(const double mean[2], const double covariance[3], double radius);

/* Mean of that over the straight path of means from p0 to p1, to 1e-8. */
double disk_path_quadrature(const double p0[2], const double p1[2], const double covariance[3], double radius);

/* Podee et al. 2021, §3.3: the arc is what the rotation from r0 to r1 sweeps, in their common plane, with r = (p, 1) in light-plane
 * axes; the part of its angle within the disk over the whole angle. With p0 = p1: whether the point is inside. */
double light_arc_ratio(const double p0[2], const double p1[2], double radius);

/* The same by lengths on the light plane. */
double light_chord_ratio(const double p0[2], const double p1[2], double radius);

#endif
