/* SPDX-License-Identifier: MIT
 * Renders in a thread of its own with a CPU context of its own. Of the frames that are asked for it renders the latest one. Pictures of methods with many samples
 * are refined sample by sample until something changes. */
#ifndef MANGATA_VIEWER_PICTURE_RENDER_WORKER_H
#define MANGATA_VIEWER_PICTURE_RENDER_WORKER_H

#include "viewer/picture/display.h"

/* What to render: a whole frame for the sides that are wanted. */
typedef struct render_order {
    uint64_t serial; /* grows from order to order */
    mgt_scene scene; /* its waves are copied when it is posted; its quality is not read */
    mgt_quality quality[SIDE_COUNT];
    bool wanted[SIDE_COUNT];
    mgt_layer layer;
    struct scene_models *models; /* what scene.objects belong to; shared when it is posted. NULL: there are none */
    bool interruptible;          /* true: a newer order may stop this one before it is done */
} render_order;

/* A finished picture of one side. */
typedef struct picture {
    uint64_t serial; /* of its order */
    mgt_layer layer;
    uint32_t width, height;
    void *pixels;                    /* as display_upload() takes them; owned */
    size_t capacity;                 /* bytes of `pixels` */
    double seconds;                  /* duration of the last rendering call */
    uint64_t samples, samples_total; /* samples taken so far, and wanted; 1 and 1 for methods without samples */
} picture;

void picture_free(picture *p);

typedef struct render_worker render_worker;

/* `refines` true: the worker renders the sides whose methods have many samples; false: the other sides. It calls `wake` on its thread when there is a picture or
 * an error to take. Returns NULL on failure, with the reason in `error`. */
render_worker *render_worker_create(const mgt_context_desc *desc, bool refines, void (*wake)(void), char *error, size_t error_size);
void render_worker_destroy(render_worker *w);

void render_worker_post(render_worker *w, const render_order *order);

/* Takes the newest picture of a side; the worker gets the memory of *p in exchange. Returns false if there is no new picture since the last call. */
bool render_worker_take(render_worker *w, int side, picture *p);

/* Takes the text of a failure since the last call. */
bool render_worker_take_error(render_worker *w, char *text, size_t size);

/* Whether no order is posted or under way, and no picture or error waits to be taken. */
bool render_worker_is_idle(render_worker *w);

/* What the context runs on. */
mgt_context_info render_worker_info(const render_worker *w);

#endif
