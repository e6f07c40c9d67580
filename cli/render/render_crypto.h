/* SPDX-License-Identifier: MIT */
/* Mattes of the objects, water and sky in an EXR: layers crypto_object00 to 02. */
#ifndef MANGATA_CLI_RENDER_RENDER_CRYPTO_H
#define MANGATA_CLI_RENDER_RENDER_CRYPTO_H

#include "cli/common/context_options.h"
#include "image/picture.h"
#include "scene/scene_file.h"

enum { CRYPTO_SIDE_DEFAULT = 4, CRYPTO_CHANNELS = 12 };

typedef struct render_crypto render_crypto;

/* For pictures of `width` × `height` pixels of the scene by `side` × `side` rays a pixel. Borrows the scene. An exit code; on failure, which is printed,
 * *crypto is NULL. */
int render_crypto_create(render_crypto **crypto, const scene_file *file, const context_options *context, uint32_t side, uint32_t width, uint32_t height);

/* A hash of the names, which change no pixel of other layers and are not in the scene's canonical text. */
uint32_t render_crypto_names(const render_crypto *crypto);

void render_crypto_free(render_crypto *crypto); /* NULL is allowed */

/* Draws a frame's. FILE_CANCELLED after a signal. */
file_status render_crypto_draw(render_crypto *crypto, const mgt_scene *scene, file_error *error);

/* The layers and attributes, which live as long as `crypto` and show the frame last drawn. */
void render_crypto_layers(const render_crypto *crypto, picture_layer layers[CRYPTO_CHANNELS], exr_desc *desc);

#endif
