/* SPDX-License-Identifier: MIT
 * What stands beside and over the picture. */
#ifndef MANGATA_VIEWER_APP_PANELS_H
#define MANGATA_VIEWER_APP_PANELS_H

#include "viewer/app/viewer.h"

/* Width that the panel takes from the picture, window coordinates. */
float panels_width(const viewer *v);

void panels_draw(viewer *v);
void overlays_draw(viewer *v);
void inspector_draw(viewer *v);
void film_draw(viewer *v);
void dialog_draw(viewer *v);

/* A choice of sizes: the window's (0, 0), the scene's, usual ones, any other. */
void size_draw(viewer *v, const char *label, uint32_t size[2]);

/* The figures of both sides, left and right of the divider, from `top` down. */
void judging_draw(const viewer *v, float divider, float top, float unit);

/* The page of the sea (sea_page.c). */
void sea_page_draw(viewer *v);

/* Controls by name, ended by NULL. */
void panel_controls(viewer *v, const char *const *names);

/* A count that is no control, laid out as one; `zero` as in ui_slider_count(). */
bool panel_count(viewer *v, const char *label, uint32_t *value, uint32_t min, uint32_t max, const char *zero);

/* One control as its kind asks for. True when it was changed. */
bool panel_control(viewer *v, const char *name);

#endif
