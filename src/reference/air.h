/* SPDX-License-Identifier: MIT
 *
 * Light along a straight way through the round atmosphere in double precision: plain integrals, without tables.
 */
#ifndef MANGATA_REFERENCE_AIR_H
#define MANGATA_REFERENCE_AIR_H

/* A way, lengths in kilometres. */
typedef struct reference_way {
    double turbidity;
    double height; /* where it begins, over the sea */
    double sine;   /* of its elevation there */
    double length;
} reference_way;

/* Share of light of this wavelength that the way leaves. */
double reference_air_leaves(const reference_way *way, double nanometres);

/* What a place sends along the way per kilometre: `height` km over the sea, `distance` km along the way, whose elevation there has this sine. */
typedef double reference_source(const void *user, double height, double sine, double distance);

/* ∫ leaves · source along the way. */
double reference_air_light(const reference_way *way, double nanometres, reference_source *source, const void *user);

#endif
