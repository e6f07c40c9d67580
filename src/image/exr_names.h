/* SPDX-License-Identifier: MIT */
/* Names of layers and metadata in an EXR, for writer and reader. Private to src/image. */
#ifndef MANGATA_IMAGE_EXR_NAMES_H
#define MANGATA_IMAGE_EXR_NAMES_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { EXR_LAYER_NAME_MAX = 64, EXR_CHANNEL_NAME_SIZE = EXR_LAYER_NAME_MAX + 4, EXR_ATTRIBUTE_NAME_SIZE = 96 };

static inline bool exr_layer_name_is_valid(const char *name)
{
    size_t length = name ? strlen(name) : 0;
    return length >= 1 && length <= EXR_LAYER_NAME_MAX && strspn(name, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_") == length;
}

/* Colour is the layer without a name, as viewers expect. Channels of other layers are "layer.component". */
static inline void exr_channel_name(char out[EXR_CHANNEL_NAME_SIZE], const char *layer, uint32_t channels, uint32_t component)
{
    const char *components = channels == 1 ? "Y" : strcmp(layer, "normal") == 0 ? "XYZ" : "RGB";
    if (channels == 1 && strcmp(layer, "depth") == 0)
        components = "Z";
    if (strcmp(layer, "color") == 0)
        snprintf(out, EXR_CHANNEL_NAME_SIZE, "%c", components[component]);
    else
        snprintf(out, EXR_CHANNEL_NAME_SIZE, "%s.%c", layer, components[component]);
}

/* The prefix distinguishes keys from the format's own attributes, such as "version" and "channels". */
static inline void exr_attribute_name(char out[EXR_ATTRIBUTE_NAME_SIZE], const char *key) { snprintf(out, EXR_ATTRIBUTE_NAME_SIZE, "mangata.%s", key); }

#endif
