/* SPDX-License-Identifier: MIT
 *
 * Mangata: reflections of the sun and the moon on water, anti-aliased in space and time.
 *
 * In short: create a context, initialise a scene and change what you like, point one or more targets at your memory, call mgt_render().
 *
 * Conventions of every function here
 *   Units       metres, seconds, degrees where the name says so and radians elsewhere; luminance in kcd/m².
 *   Axes        right-handed, y up. The mean water surface is y = water.level, 0 by default. Azimuth 0 is -z ("north"), 90 is +x ("east").
 *   Pixels      (0,0) is the top left pixel; +x of the image is cross(forward, up).
 *   Structs     a struct that begins with `struct_size` is initialised by its mgt_*_init(&x, sizeof x), which writes no more than
 *               that; one that a function only fills needs nothing but struct_size = sizeof. Later versions add members at the
 *               end. A program that was built with an earlier header keeps working: what its structs lack has its default. With
 *               a later header, members that this library does not know must stay as initialised. Elements of an array have the
 *               same size. Structs without struct_size never change.
 *   Errors      functions return an mgt_status; mgt_last_error() and the log say what was wrong. After a
 *               failure no object has changed; pixels of the targets may have been written in part.
 *   Threads     a context is used by one thread at a time; different contexts are independent. A call that renders, inspects or sums with a
 *               context whose earlier call still runs, on another thread or around a callback, returns MGT_ERROR_ARGUMENT and does nothing.
 *   Stack       a call needs at most 0.5 MiB of its thread's stack, a query of more than 512 waves 0.7; drivers of OpenGL need theirs.
 *   Determinism the pixels depend on the scene alone: not on threads, tiles, crop, instruction set (AVX2,
 *               AVX-512 and the scalar build agree to the bit) or what was rendered before.
 */
#ifndef MANGATA_MANGATA_H
#define MANGATA_MANGATA_H

#include "mangata/gl.h"
#include "mangata/objects.h"
#include "mangata/query.h"
#include "mangata/render.h"
#include "mangata/scene.h"
#include "mangata/waves.h"

#endif
