/* SPDX-License-Identifier: MIT */
/* Mattes of the objects, the water and the sky in an EXR file: the Cryptomatte layers crypto_object00 to 02. */
#ifndef MANGATA_CLI_RENDER_RENDER_CRYPTO_H
#define MANGATA_CLI_RENDER_RENDER_CRYPTO_H

#include "cli/common/context_options.h"
#include "image/picture.h"
#include "scene/scene_file.h"

enum { CRYPTO_SIDE_DEFAULT = 4, CRYPTO_CHANNELS = 12 };

typedef struct render_crypto render_crypto;

/* Prepares mattes for pictures of width × height pixels with side × side rays per pixel. It borrows the names in `file`. Returns an exit code. After an error,
 * which is printed, *crypto is NULL. */
int render_crypto_create(render_crypto **crypto, const scene_file *file, const context_options *context, uint32_t side, uint32_t width, uint32_t height);

/* A hash of the names of the mattes. The scene's canonical text does not contain them, because they change no pixel of other layers. */
uint32_t render_crypto_names(const render_crypto *crypto);

void render_crypto_free(render_crypto *crypto); /* NULL is allowed */

/* Draws the mattes of a frame. Returns FILE_CANCELLED after a signal. */
file_status render_crypto_draw(render_crypto *crypto, const mgt_scene *scene, file_error *error);

/* The layers and the attributes of the last frame drawn. They point into `crypto`. */
void render_crypto_layers(const render_crypto *crypto, picture_layer layers[CRYPTO_CHANNELS], exr_desc *desc);

#endif
