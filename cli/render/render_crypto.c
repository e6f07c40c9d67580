/* SPDX-License-Identifier: MIT */
/* Mattes: pairs of the id of a name and its coverage, from the objects that rays meet. */
#include "cli/render/render_crypto.h"

#include <stdlib.h>
#include <string.h>

#include "cli/common/interrupt.h"
#include "cpu/object_ids.h"
#include "image/cryptomatte.h"
#include "trace/trace.h"

#define LAYER "crypto_object"

struct render_crypto {
    context_options context;
    uint32_t side, width, height;
    size_t object_count;
    uint32_t *labels;   /* for each object of the scene the index of its name */
    const char **names; /* "sky", "water", then the names of objects, each once; borrowed */
    float *ids;         /* ids of the names */
    size_t name_count;
    cryptomatte_header header;
    object_shares *shares;
    float *values; /* 12 for each pixel: six pairs of id and coverage */
};

static const char *const channel_names[CRYPTO_CHANNELS] = {LAYER "00.R", LAYER "00.G", LAYER "00.B", LAYER "00.A", LAYER "01.R", LAYER "01.G",
                                                           LAYER "01.B", LAYER "01.A", LAYER "02.R", LAYER "02.G", LAYER "02.B", LAYER "02.A"};
_Static_assert((int)CRYPTO_CHANNELS == 2 * (int)OBJECT_RANKS, "a pair of channels for each rank");

/* Finds names by their hashes. */
typedef struct name_table {
    uint32_t *places; /* 1 + the name's index; 0: the slot is free */
    size_t slots;     /* a power of two, at least twice the number of names */
} name_table;

/* Index of a name, which is added if it is new. */
static uint32_t take_name(render_crypto *c, const name_table *table, const char *name)
{
    size_t slot = cryptomatte_hash(name) & (table->slots - 1);
    for (; table->places[slot]; slot = (slot + 1) & (table->slots - 1))
        if (strcmp(c->names[table->places[slot] - 1], name) == 0)
            return table->places[slot] - 1;
    c->names[c->name_count++] = name;
    table->places[slot] = (uint32_t)c->name_count;
    return table->places[slot] - 1;
}

static bool take_names(render_crypto *c, const scene_file *file)
{
    while (scene_file_object_name(file, c->object_count))
        c->object_count++;
    name_table table = {.slots = 4};
    while (table.slots < 2 * (c->object_count + 2))
        table.slots *= 2;
    table.places = calloc(table.slots, sizeof *table.places);
    c->labels = calloc(c->object_count + 1, sizeof *c->labels);
    c->names = calloc(c->object_count + 2, sizeof *c->names);
    if (!table.places || !c->labels || !c->names) {
        free(table.places);
        return false;
    }
    take_name(c, &table, "sky");
    take_name(c, &table, "water");
    for (size_t i = 0; i < c->object_count; i++)
        c->labels[i] = take_name(c, &table, scene_file_object_name(file, i));
    free(table.places);
    c->ids = calloc(c->name_count, sizeof *c->ids);
    for (size_t i = 0; c->ids && i < c->name_count; i++)
        c->ids[i] = cryptomatte_id(c->names[i]);
    return c->ids && cryptomatte_header_make(&c->header, LAYER, c->names, c->name_count);
}

int render_crypto_create(render_crypto **crypto, const scene_file *file, const context_options *context, uint32_t side, uint32_t width, uint32_t height)
{
    const size_t pixels = (size_t)width * height;
    *crypto = NULL;
    if (!trace_available())
        return console_error(EXIT_CODE_UNAVAILABLE, "--exr cryptomatte: this build traces no rays: it was made without Embree");
    render_crypto *c = *crypto = calloc(1, sizeof *c);
    if (c) {
        c->context = *context;
        c->side = side;
        c->width = width;
        c->height = height;
        c->shares = calloc(pixels, sizeof *c->shares);
        c->values = calloc(pixels, CRYPTO_CHANNELS * sizeof *c->values);
        if (c->shares && c->values && take_names(c, file))
            return EXIT_CODE_OK;
    }
    render_crypto_free(c);
    *crypto = NULL;
    return console_error(EXIT_CODE_FAILED, "out of memory for the mattes of %u x %u pixels", width, height);
}

uint32_t render_crypto_names(const render_crypto *c) { return cryptomatte_hash(c->header.manifest); }

void render_crypto_free(render_crypto *c)
{
    if (!c)
        return;
    cryptomatte_header_free(&c->header);
    free(c->labels);
    free(c->names);
    free(c->ids);
    free(c->shares);
    free(c->values);
    free(c);
}

/* Writes the pairs. A rank that nothing covers is zero, as the specification says. */
static void write_values(render_crypto *c)
{
    for (size_t i = 0; i < (size_t)c->width * c->height; i++)
        for (int rank = 0; rank < OBJECT_RANKS; rank++) {
            const float share = c->shares[i].share[rank];
            float *pair = c->values + i * CRYPTO_CHANNELS + 2 * rank;
            pair[0] = share > 0 ? c->ids[c->shares[i].label[rank]] : 0;
            pair[1] = share;
        }
}

file_status render_crypto_draw(render_crypto *c, const mgt_scene *scene, file_error *error)
{
    char text[REPORTER_TEXT] = "";
    const reporter failures = {.error = text};
    const object_ids_job job = {.scene = scene,
                                .labels = c->labels,
                                .sky = 0,
                                .water = 1,
                                .side = c->side,
                                .threads = c->context.threads,
                                .isa = c->context.isa,
                                .progress = interrupt_keep_going};
    if (c->context.backend == MGT_BACKEND_NULL)
        return FILE_OK;
    const mgt_status status = object_ids_draw(&job, &failures, c->shares);
    if (status == MGT_CANCELLED)
        return file_error_set(error, FILE_CANCELLED, "stopped by a signal");
    if (status != MGT_OK)
        return file_error_set(error, status == MGT_ERROR_UNAVAILABLE ? FILE_UNAVAILABLE : FILE_MEMORY, "%s", text[0] ? text : mgt_status_text(status));
    write_values(c);
    return FILE_OK;
}

void render_crypto_layers(const render_crypto *c, picture_layer layers[CRYPTO_CHANNELS], exr_desc *desc)
{
    for (int i = 0; i < CRYPTO_CHANNELS; i++)
        layers[i] = (picture_layer){.name = LAYER,
                                    .channel = channel_names[i],
                                    .part = LAYER,
                                    .exact = true,
                                    .channels = 1,
                                    .pixels = c->values + i,
                                    .pixel_floats = CRYPTO_CHANNELS};
    desc->attributes = c->header.entries;
    desc->attribute_count = CRYPTOMATTE_ENTRIES;
}
