/* SPDX-License-Identifier: MIT */
/* The figures of Liu et al.: the views, the methods that render them, and the order of the plates. */
#include "cli/figures/figures_refraction.h"

#include <stdlib.h>
#include <string.h>

const figure_method_text refraction_methods[REFRACTION_METHODS] = {
    [SHOWN_TWO_PHASE] = {"mangata+two-phase", "two-phase"},
    [SHOWN_HYBRID] = {"mangata+hybrid", "hybrid"},
    [SHOWN_LIU] = {"mangata+liu", "Liu et al., as printed"},
    [SHOWN_BROAD] = {"mangata+broad", "broad phase alone"},
    [SHOWN_NARROW] = {"mangata+narrow", "narrow phase alone"},
    [SHOWN_SCREEN_SPACE] = {"mangata+screen-space", "screen space"},
    [SHOWN_DISTANCE_FIELD] = {"mangata+distance-field", "distance field"},
    [SHOWN_OFF] = {"mangata+off", "no refraction"},
    [SHOWN_RAY] = {"mangata+truth:refraction-samples=1", "truth, one ray"},
    [SHOWN_WHOLE] = {"mangata+two-phase:tess-error=100", "two-phase, whole triangles"},
    [SHOWN_WHOLE_BROAD] = {"mangata+broad:tess-error=100", "broad phase alone, whole triangles"},
    [TIMED_TRUTH] = {"none+truth:refraction-samples=1", "truth, one ray"},
    [TIMED_TWO_PHASE] = {"none+two-phase", "two-phase"},
    [TIMED_HYBRID] = {"none+hybrid", "hybrid"},
    [TIMED_LIU] = {"none+liu", "Liu et al., as printed"},
    [TIMED_SCREEN_SPACE] = {"none+screen-space", "screen space"},
    [TIMED_DISTANCE_FIELD] = {"none+distance-field", "distance field"},
    [TIMED_OFF] = {"none+off", "no refraction"},
};

/* ---- views ---- */

/* Sets of figures and of methods. */
#define FIGURE(id) (1u << FIGURE_LIU_##id)
#define METHOD(id) (1u << SHOWN_##id)

enum {
    OURS = METHOD(TWO_PHASE) | METHOD(RAY),
    BASELINES = OURS | METHOD(SCREEN_SPACE) | METHOD(OFF),
    WHOLE = OURS | METHOD(BROAD) | METHOD(WHOLE) | METHOD(WHOLE_BROAD),
    ALL_SHOWN = METHOD(WHOLE) - 1,
    ALL_TIMED = ((1u << REFRACTION_METHODS) - 1) & ~((1u << TIMED_TRUTH) - 1)
};

typedef struct view_text {
    const char *name, *scene;
    uint32_t figures, methods;
    const char *overrides[3];
} view_text;

#define STEEP "camera={position: [0.8, 7, 2.6], target: [0.6, 0, -0.66], fov_y_deg: 45}"
#define UPWARDS "camera={position: [0.6, -1.7, 2], target: [0, 1.5, -2], fov_y_deg: 75}"
#define CLOSE "camera={position: [0.8, 4, 7.2], target: [0.25, -1.3, 1], fov_y_deg: 16}"
#define ASIDE "camera={position: [-4.6, 3.4, 4.4], target: [0.2, -0.4, 0.2], fov_y_deg: 45}"
#define GRAZING "camera={position: [1, 1.7, 8.4], target: [0, 0, 0.5], fov_y_deg: 45}"
#define MOVING                                                                                                                               \
    "camera={path: [{time: 0, position: [0.7, 4, 7.2], target: [0.2, 0, 0.4]}, {time: 100, position: [0.9, 4, 7], target: [0.4, 0, 0.4]}], " \
    "fov_y_deg: 45}"

static const view_text views[REFRACTION_VIEWS] = {
    [VIEW_BELOW] = {"diver-upwards", "diver", FIGURE(4), BASELINES | METHOD(HYBRID), {UPWARDS}},
    [VIEW_BORDER] = {"pool-border", "pool", FIGURE(7), OURS | METHOD(LIU), {STEEP, "water.amplitude=2"}},
    [VIEW_FLAT] = {"pool-flat", "pool", FIGURE(10), ALL_SHOWN, {"water.amplitude=0"}},
    [VIEW_WAVES] = {"pool-waves", "pool", FIGURE(8) | FIGURE(9) | FIGURE(11) | FIGURE(13), ALL_SHOWN, {NULL}},
    [VIEW_DENSE] = {"pool-dense", "pool", FIGURE(12), WHOLE, {CLOSE, "water.amplitude=0", "objects[0].triangles=2000"}},
    [VIEW_SPARSE] = {"pool-sparse", "pool", FIGURE(12), WHOLE, {CLOSE, "water.amplitude=0", "objects[0].triangles=30"}},
    [VIEW_CALM] = {"pool-calm", "pool", FIGURE(13), OURS, {"water.amplitude=0.5"}},
    [VIEW_ROUGH] = {"pool-rough", "pool", FIGURE(13), OURS, {"water.amplitude=2"}},
    [VIEW_ROUGHER] = {"pool-rougher", "pool", FIGURE(13), OURS, {"water.amplitude=4"}},
    [VIEW_STEEP] = {"pool-steep", "pool", FIGURE(13), OURS, {STEEP, "water.amplitude=2"}},
    [VIEW_ASIDE] = {"pool-aside", "pool", FIGURE(13), OURS, {ASIDE, "water.amplitude=2"}},
    [VIEW_GRAZING] = {"pool-grazing", "pool", FIGURE(13), OURS, {GRAZING, "water.amplitude=2"}},
    [VIEW_SHORE] = {"shore", "shore", FIGURE(14), BASELINES, {NULL}},
    [VIEW_HULL] = {"hull", "hull", FIGURE(14), BASELINES, {NULL}},
    [VIEW_DIVER] = {"diver", "diver", FIGURE(15), BASELINES, {NULL}},
    [VIEW_SPEED_16K] = {"pool-16k", "pool", FIGURE(TABLE3), ALL_TIMED, {MOVING, "objects[0].triangles=15000", "time.shutter=0"}},
    [VIEW_SPEED_128K] = {"pool-128k", "pool", FIGURE(TABLE3), ALL_TIMED, {MOVING, "objects[0].triangles=127000", "time.shutter=0"}},
};

static void add_override(refraction_figures *r, refraction_view view, const char *text)
{
    compare_view *v = &r->renders.views[r->place[view]];
    r->overrides[view][v->override_count++] = text;
}

static int add_view(refraction_figures *r, refraction_view view, const char *folder)
{
    const figures_request *request = r->figures->request;
    const view_text *text = &views[view];
    compare_request *c = &r->renders;
    const bool timed = text->methods == ALL_TIMED;
    r->place[view] = COMPARE_SCENES;
    if (!(request->wanted & text->figures) || (timed && request->time_runs == 0))
        return EXIT_CODE_OK;
    if ((size_t)snprintf(r->paths[view], sizeof r->paths[view], "%s/%s.yaml", folder, text->scene) >= sizeof r->paths[view])
        return console_error(EXIT_CODE_USAGE, "%s: the path is too long", folder);
    r->place[view] = c->scene_count;
    c->scene_paths[c->scene_count] = r->paths[view];
    c->views[c->scene_count] =
        (compare_view){.name = text->name, .overrides = r->overrides[view], .methods = text->methods, .untimed = !timed, .only_timed = timed};
    if (!request->size_given) {
        add_override(r, view, timed ? "image.width=1280" : "image.width=640");
        add_override(r, view, timed ? "image.height=720" : "image.height=360");
    }
    for (size_t i = 0; i < sizeof text->overrides / sizeof *text->overrides && text->overrides[i]; i++)
        add_override(r, view, text->overrides[i]);
    if (r->rock[0] && strcmp(text->scene, "pool") == 0)
        add_override(r, view, r->rock);
    c->scene_count++;
    return EXIT_CODE_OK;
}

/* Replaces the bunny of the pool by a rock if its model is missing. That is not an error, because the model must be downloaded. */
static void look_for_bunny(refraction_figures *r, const char *folder)
{
    char path[4300];
    const char *override = r->rock;
    scene_error error;
    snprintf(path, sizeof path, "%s/pool.yaml", folder);
    scene_file *pool = scene_file_load(path, NULL, 0, &error);
    for (unsigned object = 0; !pool && object < 16; object++) {
        snprintf(r->rock, sizeof r->rock, "objects[%u].mesh=models/rock.ply", object);
        pool = scene_file_load(path, &override, 1, &error);
        if (pool)
            console_note(&r->figures->request->out, "mangata: a rock stands for the pool's bunny, which scripts/fetch_models brings");
    }
    if (!pool)
        r->rock[0] = 0;
    scene_file_free(pool);
}

static int choose(refraction_figures *r, const char *folder)
{
    const figures_request *request = r->figures->request;
    compare_request *c = &r->renders;
    *c = (compare_request){.out = request->out,
                           .folder = request->folder,
                           .overwrite = request->overwrite,
                           .changes = request->changes,
                           .layers = {MGT_LAYER_REFRACTION, MGT_LAYER_MASK},
                           .layer_count = 2,
                           .shard = request->shard,
                           .time_runs = request->time_runs,
                           .memory = true,
                           .context = request->context,
                           .progress = request->progress};
    mgt_quality_init(&c->reference, sizeof c->reference);
    c->reference.refraction_samples = request->refraction_samples;
    const uint32_t first = frame_list_at(&request->frames, 0);
    frame_list_span(&c->frames, first, first);
    for (int m = 0; m < REFRACTION_METHODS; m++) {
        char wrong[512];
        const char *spec = refraction_methods[m].spec;
        if (!method_spec_parse(&c->methods[c->method_count++], spec, strlen(spec), wrong, sizeof wrong))
            return console_error(EXIT_CODE_FAILED, "%s", wrong);
    }
    look_for_bunny(r, folder);
    int code = EXIT_CODE_OK;
    for (int v = 0; v < REFRACTION_VIEWS && code == EXIT_CODE_OK; v++)
        code = add_view(r, (refraction_view)v, folder);
    return code;
}

const compare_scene *refraction_scene(const refraction_figures *r, refraction_view view) { return &r->compare->scenes[r->place[view]]; }

size_t refraction_picture(refraction_method method) { return (size_t)method + 1; }

/* ---- the run ---- */

static void make(refraction_figures *r)
{
    static const struct {
        figure_id id;
        void (*make)(refraction_figures *r);
    } plates[] = {{FIGURE_LIU_4, refraction_below},      {FIGURE_LIU_7, refraction_border},   {FIGURE_LIU_8, refraction_occlusion},
                  {FIGURE_LIU_9, refraction_narrow},     {FIGURE_LIU_10, refraction_flat},    {FIGURE_LIU_11, refraction_waves},
                  {FIGURE_LIU_TABLE3, refraction_speed}, {FIGURE_LIU_12, refraction_density}, {FIGURE_LIU_13, refraction_angles},
                  {FIGURE_LIU_14, refraction_outdoors},  {FIGURE_LIU_15, refraction_diver}};
    figures_steps(r->figures, sizeof plates / sizeof *plates);
    for (size_t i = 0; i < sizeof plates / sizeof *plates && figures_good(r->figures); i++) {
        if (figure_wanted(r->figures, plates[i].id))
            plates[i].make(r);
        figures_step(r->figures);
    }
    progress_clear(&r->figures->compare->progress);
}

static void put_heading(refraction_figures *r)
{
    const figures_request *request = r->figures->request;
    fprintf(r->figures->page,
            "<h1 id=\"liu\">Liu, Han and Fei 2020</h1>\n<p>H. Liu, H. Han, G. Fei: <i>Two-phase real-time rendering method for realistic water "
            "refraction</i>, Virtual Reality &amp; Intelligent Hardware 2(2), 2020. Their scenes are not published: ours are a tiled pool, a shore, a "
            "boat and a pool hall from below. <i>two-phase</i> is this library's own method; <i>Liu et al., as printed</i> is the paper's, with its "
            "mistakes of print mended (<code>docs/refraction.md</code>). Pictures hold reflections too, all alike; errors are of what comes through the "
            "surface, before Fresnel takes its share: RMSE of displayed colour (sRGB, 0 to 255, exposure −%d stops) over whole pixels of water, against "
            "rays traced through the waves as they are, one through the middle of every pixel as the methods have it. Pictures of the truth take %u × %u "
            "rays a pixel. <i>Artefacts</i> are pixels of water off by more than %d of 255 in a channel.</p>\n",
            REFRACTION_STOPS_DOWN, request->refraction_samples, request->refraction_samples, ARTEFACT);
}

int figures_refraction_open(figures_job *f, const char *folder)
{
    refraction_figures *r = calloc(1, sizeof *r);
    compare_job *compare = calloc(1, sizeof *compare);
    if (!r || !compare) {
        free(r);
        free(compare);
        return figures_no_memory();
    }
    r->figures = f;
    r->compare = compare;
    r->compare->request = &r->renders; /* compare_close() reads it if choose() fails */
    f->refraction = r;
    const int code = choose(r, folder);
    return code == EXIT_CODE_OK ? compare_open(r->compare, &r->renders, figures_outputs) : code;
}

void figures_refraction(figures_job *f)
{
    refraction_figures *r = f->refraction;
    f->code = compare_render(r->compare);
    if (r->renders.shard.count)
        goto done;
    if (figures_good(f))
        f->code = compare_time_methods(r->compare);
    if (figures_good(f))
        refraction_measure(r);
    if (figures_good(f)) {
        put_heading(r);
        make(r);
    }
    if (figures_good(f))
        refraction_write_table(r);
done:
    f->compare->rendered += r->compare->rendered;
    f->compare->kept += r->compare->kept;
}

void figures_refraction_close(figures_job *f)
{
    refraction_figures *r = f->refraction;
    if (!r)
        return;
    compare_close(r->compare);
    free(r->compare);
    free(r);
    f->refraction = NULL;
}
