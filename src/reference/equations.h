/* SPDX-License-Identifier: MIT
 *
 * Independent implementation of the model's equations, in double precision and in their simplest form. Tests compare the kernels with it. Where a closed form
 * could share a mistake with a kernel, the value here comes from a quadrature or from finite differences.
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

/* Mean and variance of sin(ψ + g·u) and of cos(ψ + g·u) over the unit square u ∈ [−½, ½]², by Gauss–Legendre panels. This is a sine wave of phase ψ seen
 * through a pixel whose footprint is a parallelogram; g is the phase gradient in radians per pixel. */
typedef struct filtered_sine {
    double mean_sine, variance_sine;
    double mean_cosine, variance_cosine;
} filtered_sine;

filtered_sine box_filter_sine(double phase, const double gradient[2]);

/* ---- camera ---- */

/* The ray through a continuous pixel position at `time`; pixel (0, 0) covers [0, 1)². With camera_moves the camera goes linearly from camera_open, when the
 * shutter opens, to camera, when it closes. */
void camera_ray(const mgt_scene *scene, double pixel_x, double pixel_y, double time, double origin[3], double direction[3]);

/* The point at which the ray of camera_ray() at scene->time meets the plane y = height. Returns false if it does not meet it. */
bool pixel_on_plane(const mgt_scene *scene, double pixel_x, double pixel_y, double height, double xz[2]);

/* The footprint P = ∂(x, z)/∂(pixel x, pixel y) of pixel_on_plane(), by central differences. */
bool pixel_footprint(const mgt_scene *scene, double pixel_x, double pixel_y, double height, double footprint[2][2]);

typedef struct water_hit {
    bool hit;
    double distance; /* metres along the ray; +inf: there is no hit; 0: the camera is under the surface */
    double position[3];
    water_point water;
} water_hit;

/* First hit of the displaced surface. The search takes steps so short that no crest fits into one even if all waves align, then bisects. It is slow. */
water_hit first_hit_brute_force(const mgt_scene *scene, double pixel_x, double pixel_y, double time);

/* ---- mirror and light ---- */

/* Axes of the light plane r·L = 1: first = normalize((0,1,0) × L), second = L × first, which points up.
 * For a vertical L first is (−1, 0, 0), the limit for a light that comes from azimuth 0. */
void light_plane_axes(const double light[3], double first[3], double second[3]);

/* Direction from the surface to the point that a mirror of this slope shows to the eye. `to_eye` is the unit direction from the surface to the eye. */
void mirror_direction(const double to_eye[3], const double slope[2], double mirrored[3]);

/* Central projection of the mirrored direction onto the light plane, in the axes of light_plane_axes(). False: the direction points away from the light. */
bool mirror_map(const double to_eye[3], const double light[3], const double slope[2], double point[2]);

/* The Jacobian ∂(point)/∂(slope) of mirror_map(), by central differences. */
bool mirror_map_jacobian(const double to_eye[3], const double light[3], const double slope[2], double jacobian[2][2]);

/* The slope that mirrors the light's centre into the eye: −(h.x, h.z)/h.y with h = normalize(to_eye + light). */
void mirror_slope(const double to_eye[3], const double light[3], double slope[2]);

/* Unpolarised reflectance of a dielectric of relative index n, for the cosine of the angle of incidence in the outer medium. */
double fresnel_dielectric(double cosine, double index_of_refraction);

/* E[max(w, 0)] of a normally distributed w, by quadrature. It is the normalisation of Smith's distribution of visible slopes. */
double mean_visible_weight(double mean, double deviation);

/* ---- light disk on its plane ---- */

/* P(|X| < radius) for X ~ N(mean, covariance). The covariance must be positive definite. */
double disk_probability(const double mean[2], const double covariance[3], double radius);

/* Mean of disk_probability() over the means on the straight path from p0 to p1, with an error of at most 1e-8. */
double disk_path_quadrature(const double p0[2], const double p1[2], const double covariance[3], double radius);

/* Podee et al. 2021, §3.3. The arc is the path of the rotation from r0 to r1 in their common plane, where r = (p, 1) in the axes of the light plane. Returns
 * the angle of the part of the arc within the disk, divided by the whole angle. If p0 = p1: 1 if the point is in the disk, else 0. */
double light_arc_ratio(const double p0[2], const double p1[2], double radius);

/* The fraction of the straight path from p0 to p1 that lies within the disk, by length on the light plane. */
double light_chord_ratio(const double p0[2], const double p1[2], double radius);

#endif
