/* SPDX-License-Identifier: MIT
 *
 * Seas from wind and swell, as the waves of a scene. They need no context. */
#ifndef MANGATA_WAVES_H
#define MANGATA_WAVES_H

#include "mangata/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Density of the waves over frequency. docs/waves.md has the formulas. */
typedef enum mgt_spectrum {
    MGT_SPECTRUM_AUTO = 0,          /* ELFOUHAILY */
    MGT_SPECTRUM_PIERSON_MOSKOWITZ, /* a fully developed sea of the open ocean (Pierson and Moskowitz 1964) */
    MGT_SPECTRUM_JONSWAP,           /* limited by fetch (Hasselmann et al. 1973) */
    MGT_SPECTRUM_TMA,               /* JONSWAP in water of a depth (Bouws et al. 1985) */
    MGT_SPECTRUM_ELFOUHAILY         /* long and short waves alike, with directions of its own (Elfouhaily et al. 1997) */
} mgt_spectrum;

/* How waves spread around the wind. */
typedef enum mgt_spreading {
    MGT_SPREADING_MITSUYASU = 0,  /* Mitsuyasu et al. 1975 */
    MGT_SPREADING_HASSELMANN,     /* Hasselmann et al. 1980 */
    MGT_SPREADING_DONELAN_BANNER, /* Donelan et al. 1985, high frequencies after Banner 1990 */
    MGT_SPREADING_FIXED           /* cos^2s of half the angle, s = spread */
} mgt_spreading;

/* Waves that have left their wind: JONSWAP's form with gamma 7. Directions are where waves or wind come from: 0 is -z ("north"), 90 is +x ("east"). */
typedef struct mgt_swell {
    double height;        /* significant, metres, 0.001 … 50 */
    double period;        /* seconds, of the highest waves, 1 … 40 */
    double direction_deg; /* ±1e6 */
    double spread;        /* s of cos^2s of half the angle, 0 … 1000: 25 from near, 75 from far away */
    uint32_t count;       /* of waves, 1 … MGT_MAX_WAVES */
    uint32_t seed;        /* of the random phases and directions */
} mgt_swell;

/* A sea. What a scene file has as water.wind or water.spectrum, and water.swell. */
typedef struct mgt_sea {
    size_t struct_size;
    mgt_spectrum spectrum;
    mgt_spreading spreading; /* pierson-moskowitz, jonswap, tma */
    double wind;             /* m/s, 0.5 … 75; 0: none, swells alone */
    double wind_height;      /* metres over the water at which it blows, 0.5 … 200; 0: 19.5 for pierson-moskowitz, else 10 */
    double direction_deg;    /* ±1e6, as a swell's */
    double fetch;            /* metres of open water before the wind, 100 … 1e7; auto and elfouhaily, 0: a fully developed sea */
    double depth;            /* metres, up to 12000; 0: deep water */
    double gamma;            /* how far the peak stands out, 1 … 20: jonswap, tma */
    double spread;           /* of MGT_SPREADING_FIXED, 0 … 1000 */
    double shortest;         /* length of the shortest wave, metres, 1e-4 … 1000; 0: 0.05 */
    uint32_t count;          /* waves of the wind, 1 … MGT_MAX_WAVES; with those of all swells at most as many */
    uint32_t seed;           /* of the random phases and directions */
    uint32_t cox_munk;    /* 1: short waves are scaled to the mean-square slope of a clean sea in this wind (Cox and Munk 1954); 0: as the spectrum has them */
    float choppiness;     /* for mgt_sea_scene(): of the water, [0, 1] */
    float foam;           /* for mgt_sea_scene(): factor on the fraction of the water that whitecaps cover in this wind, [0, 10]. That fraction is
                             3.84e-6 U^3.41, with U the wind in m/s at 10 m */
    uint32_t swell_count; /* 0 … 16 */
    const mgt_swell *swells; /* swell_count of them, the caller's, read during the call; NULL where there are none */
} mgt_sea;

/* A deep, fully developed sea in a wind of 10 m/s from north: 160 waves, choppiness 0.7, foam 1, no swell; what `water: {wind: 10}` makes. */
MGT_API void mgt_sea_init(mgt_sea *sea, size_t size);

/* A swell one metre high, period 12 s, from north, spread 40, of 24 waves. */
MGT_API void mgt_swell_init(mgt_swell *swell);

/* Number of waves of the wind and of all swells together. 0, too, where `sea` is NULL, its struct_size is no version's or a
 * member is out of its range; mgt_last_error(NULL) then has the words. */
MGT_API size_t mgt_sea_wave_count(const mgt_sea *sea);

/* Writes mgt_sea_wave_count() waves to `waves`, which has room for `capacity`: those of the wind from the longest to the shortest, then those of each swell.
 * The same sea gives the same bytes on every machine. Any thread, several at once; nothing is kept. Takes about a millisecond.
 * MGT_ERROR_SCENE: a member is out of its range, or no such sea exists (a fetch too short, slopes that no tail has); MGT_ERROR_ARGUMENT: there is no room;
 * MGT_ERROR_MEMORY. mgt_last_error(NULL) has the words, and nothing has been written. */
MGT_API mgt_status mgt_sea_waves(const mgt_sea *sea, mgt_wave *waves, size_t capacity);

/* Writes the waves as mgt_sea_waves() does and sets the scene's waves, choppiness, foam, aerial perspective and, where its light is the moon, stars and night tint, so
 * that it renders as a scene file with water.wind does. The scene points to `waves`, which must stay in place while it is used. Errors as above; *scene is then unchanged. */
MGT_API mgt_status mgt_sea_scene(const mgt_sea *sea, mgt_wave *waves, size_t capacity, mgt_scene *scene);

MGT_API const char *mgt_spectrum_name(mgt_spectrum spectrum);
MGT_API const char *mgt_spreading_name(mgt_spreading spreading);
MGT_API bool mgt_spectrum_from_name(const char *name, mgt_spectrum *spectrum);
MGT_API bool mgt_spreading_from_name(const char *name, mgt_spreading *spreading);

#ifdef __cplusplus
}
#endif
#endif
