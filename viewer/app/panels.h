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

/* The figures of both sides, left and right of the divider, from `top` down. */
void judging_draw(const viewer *v, float divider, float top, float unit);

/* One control as its kind asks for. True when it was changed. */
bool panel_control(viewer *v, const char *name);

#endif
