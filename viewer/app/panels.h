/* SPDX-License-Identifier: MIT
 * The panels beside and over the picture. All functions draw into the current frame of ui_shim.h, on the main thread. */
#ifndef MANGATA_VIEWER_APP_PANELS_H
#define MANGATA_VIEWER_APP_PANELS_H

#include "viewer/app/viewer.h"

/* Width of the panel of controls, window coordinates; 0: it is hidden. */
float panels_width(const viewer *v);

void panels_draw(viewer *v);    /* the panel of controls, and the clock */
void overlays_draw(viewer *v);  /* all that stands over the picture */
void inspector_draw(viewer *v); /* the inspector, and its mark in the picture */
void film_draw(viewer *v);      /* the part of the page Files that is for films */
void dialog_draw(viewer *v);    /* the dialog that opens a scene, if it is shown */

/* Draws a choice of picture sizes in pixels: that of the window, which is (0, 0), that of the scene, usual ones, and any other. */
void size_draw(viewer *v, const char *label, uint32_t size[2]);

/* Draws the figures of both sides left and right of the divider, from `top` down. `unit` is the height of the text. All are window coordinates. */
void judging_draw(const viewer *v, float divider, float top, float unit);

/* Draws the page Sea (sea_page.c). */
void sea_page_draw(viewer *v);

/* Draws controls by name. The list ends with NULL. */
void panel_controls(viewer *v, const char *const *names);

/* Draws a number that is no control, laid out like one. `zero` as in ui_slider_count(). Returns whether it was changed. */
bool panel_count(viewer *v, const char *label, uint32_t *value, uint32_t min, uint32_t max, const char *zero);

/* Draws one control. Returns whether it was changed. */
bool panel_control(viewer *v, const char *name);

#endif
