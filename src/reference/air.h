/* SPDX-License-Identifier: MIT
 *
 * Light along a straight path through the round atmosphere in double precision, by plain integrals without tables.
 */
#ifndef MANGATA_REFERENCE_AIR_H
#define MANGATA_REFERENCE_AIR_H

/* A straight path through the atmosphere; lengths are in kilometres. */
typedef struct reference_way {
    double turbidity;
    double height; /* height of its beginning above the sea */
    double sine;   /* sine of its elevation at its beginning */
    double length;
} reference_way;

/* Transmittance of the path at this wavelength. */
double reference_air_leaves(const reference_way *way, double nanometres);

/* Light scattered along the path per kilometre, `height` km over the sea and `distance` km along the path, whose elevation there has this sine. */
typedef double reference_source(const void *user, double height, double sine, double distance);

/* ∫ transmittance · source along the path. */
double reference_air_light(const reference_way *way, double nanometres, reference_source *source, const void *user);

#endif
