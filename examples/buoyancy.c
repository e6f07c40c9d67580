/* SPDX-License-Identifier: MIT */
/* A rowing boat that floats on the waves that are rendered: a rigid body moved by mgt_water_query(), frame by frame.
 *   cc buoyancy.c $(pkg-config --cflags --libs mangata) -lm -o buoyancy
 *   ./buoyancy boat_####.ppm        # frame numbers in place of #; docs/buoyancy.md makes a film of them
 *   --size WxH  --frames N  --fps F  --mesh scenes/models/hull.ply
 */
#include "floating_body.h"
#include <errno.h>
#include <mangata/mangata.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WAVES = 96, COLUMNS_ACROSS = 6, COLUMNS_ALONG = 14 };
static const double pi = 3.14159265358979323846;
static const double wind = 5;               /* m/s */
static const double start = 20;             /* seconds: the time of frame 0 */
static const double settling = 10;          /* seconds before frame 0 in which the boat finds its motion */
static const double rim = 0.36;             /* metres: the lowest gunwale of the boat over its waterline */
static const double box[3] = {1.7, 0.6, 5}; /* metres: what has the boat's inertia */

typedef struct film_options {
    const char *mesh, *output;
    unsigned width, height;
    int frames;
    double fps;
} film_options;

/* ---- the sea ---------------------------------------------------------------------------------------------- */

/* The next of a sequence of numbers in [0, 1): a linear congruential generator. */
static double draw(uint32_t *state)
{
    *state = 1664525 * *state + 1013904223;
    return (*state >> 8) / 16777216.0;
}

/* A fully developed sea (Pierson and Moskowitz 1964): bands from 60 m to 0.25 m of wavelength, each one wave of the band's variance, about a wind from
 * behind the camera. Returns the significant wave height. */
static double make_waves(mgt_wave waves[WAVES])
{
    const double g = 9.81, peak = 0.74 * pow(g / wind, 4), variance = 0.0081 * g * g / (4 * peak);
    const double lowest = sqrt(2 * pi * g / 60), ratio = sqrt(60 / 0.25);
    uint32_t state = 7;
    double below = exp(-peak / pow(lowest, 4));
    for (int i = 0; i < WAVES; i++) {
        const double omega = lowest * pow(ratio, (i + 0.5) / WAVES), end = lowest * pow(ratio, (i + 1.0) / WAVES), k = omega * omega / g;
        const double upto = exp(-peak / pow(end, 4)), heading = pi + 0.5 + 1.1 * (draw(&state) + draw(&state) - 1);
        waves[i] = (mgt_wave){sqrt(2 * variance * (upto - below)), k * sin(heading), -k * cos(heading), -omega, 2 * pi * draw(&state)};
        below = upto;
    }
    return 4 * sqrt(variance);
}

static double water_height(const mgt_water *water, double time, double x, double z)
{
    double height = 0;
    mgt_water_answers answers;
    mgt_water_answers_init(&answers, sizeof answers);
    answers.height = &height;
    return mgt_water_query(water, time, (const double[]){x, z}, 1, &answers) == MGT_OK ? height : NAN;
}

/* ---- the boat --------------------------------------------------------------------------------------------- */

typedef struct triangles {
    float *positions;
    uint32_t *indices;
    uint32_t vertices, count;
} triangles;

static void free_triangles(triangles *mesh)
{
    free(mesh->positions);
    free(mesh->indices);
    *mesh = (triangles){0};
}

/* Reads the numbers of vertices and faces, up to the header's end. Only what scripts/make_models writes is understood: little-endian x y z and triangles. */
static bool read_header(FILE *file, triangles *mesh)
{
    char line[256];
    while (fgets(line, sizeof line, file)) {
        if (strcmp(line, "end_header\n") == 0)
            return mesh->vertices > 0 && mesh->vertices < 1000000 && mesh->count > 0 && mesh->count < 1000000;
        if (strncmp(line, "element vertex ", 15) == 0)
            mesh->vertices = (uint32_t)strtoul(line + 15, NULL, 10);
        if (strncmp(line, "element face ", 13) == 0)
            mesh->count = (uint32_t)strtoul(line + 13, NULL, 10);
    }
    return false;
}

static bool read_face(FILE *file, const triangles *mesh, uint32_t face[3])
{
    return fgetc(file) == 3 && fread(face, sizeof *face, 3, file) == 3 && face[0] < mesh->vertices && face[1] < mesh->vertices && face[2] < mesh->vertices;
}

/* False where the file is no such mesh; the caller frees what was read in any case. */
static bool read_triangles(const char *path, triangles *mesh)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        fprintf(stderr, "buoyancy: %s: %s; --mesh PLY names the boat, hull.ply of Mangata's scenes/models\n", path, strerror(errno));
        return false;
    }
    bool good = read_header(file, mesh);
    if (good) {
        mesh->positions = malloc(3 * sizeof(float) * mesh->vertices);
        mesh->indices = malloc(3 * sizeof(uint32_t) * mesh->count);
        good = mesh->positions && mesh->indices && fread(mesh->positions, 3 * sizeof(float), mesh->vertices, file) == mesh->vertices;
    }
    for (uint32_t i = 0; good && i < mesh->count; i++)
        good = read_face(file, mesh, mesh->indices + 3 * i);
    fclose(file);
    if (!good)
        fprintf(stderr, "buoyancy: %s is no mesh of the boat: no binary PLY of triangles with x, y, z alone\n", path);
    return good;
}

/* Height at which an upright line through (x, z) meets a triangle; INFINITY: it does not. */
static double meet_triangle(const float *a, const float *b, const float *c, double x, double z)
{
    const double area = (b[0] - a[0]) * (double)(c[2] - a[2]) - (c[0] - a[0]) * (double)(b[2] - a[2]);
    const double u = ((x - a[0]) * (c[2] - a[2]) - (c[0] - a[0]) * (z - a[2])) / area, v = ((b[0] - a[0]) * (z - a[2]) - (x - a[0]) * (b[2] - a[2])) / area;
    return area != 0 && u >= 0 && v >= 0 && u + v <= 1 ? a[1] + u * (b[1] - a[1]) + v * (c[1] - a[1]) : INFINITY;
}

static double lowest_of_mesh(const triangles *mesh, double x, double z)
{
    double lowest = INFINITY;
    for (uint32_t i = 0; i < mesh->count; i++) {
        const uint32_t *face = mesh->indices + 3 * i;
        lowest = fmin(lowest, meet_triangle(mesh->positions + 3 * face[0], mesh->positions + 3 * face[1], mesh->positions + 3 * face[2], x, z));
    }
    return lowest;
}

/* Columns from the planking up to the rim, wherever the mesh lies below it. */
static floating_body make_boat(const triangles *mesh)
{
    floating_body boat = {.damping = 800, .least_wavelength = box[0], .heading = -0.75};
    const double width = box[0] / COLUMNS_ACROSS, length = box[2] / COLUMNS_ALONG;
    for (int i = 0; i < COLUMNS_ACROSS * COLUMNS_ALONG; i++) {
        const double x = (i % COLUMNS_ACROSS + 0.5) * width - box[0] / 2, z = (i / COLUMNS_ACROSS + 0.5) * length - box[2] / 2;
        const double bottom = lowest_of_mesh(mesh, x, z);
        if (bottom < rim)
            boat.columns[boat.count++] = (body_column){x, z, bottom, rim, width * length};
    }
    if (boat.count > 0)
        body_float_as_drawn(&boat, 0.1, box);
    return boat;
}

static mgt_status make_mesh(const triangles *read, mgt_mesh **mesh)
{
    mgt_mesh_desc desc;
    mgt_mesh_desc_init(&desc, sizeof desc);
    desc.positions = read->positions;
    desc.vertex_count = read->vertices;
    desc.indices = read->indices;
    desc.triangle_count = read->count;
    desc.dry = 1;
    return mgt_mesh_create(mesh, &desc);
}

/* ---- the film --------------------------------------------------------------------------------------------- */

/* Writes `number` over the run of # in the pattern; without one all frames would have the same name. */
static bool frame_name(char *name, size_t size, const char *pattern, int number)
{
    const char *const first = strchr(pattern, '#');
    if (!first)
        return false;
    const int digits = (int)strspn(first, "#"), length = snprintf(name, size, "%.*s%0*d%s", (int)(first - pattern), pattern, digits, number, first + digits);
    return length > 0 && (size_t)length < size;
}

static bool write_ppm(const char *path, const unsigned char *rgba, unsigned width, unsigned height)
{
    FILE *file = fopen(path, "wb");
    bool written = file && fprintf(file, "P6\n%u %u\n255\n", width, height) > 0;
    for (size_t i = 0; written && i < (size_t)width * height; i++)
        written = fwrite(rgba + 4 * i, 1, 3, file) == 3;
    written = file && fclose(file) == 0 && written;
    if (!written)
        fprintf(stderr, "buoyancy: %s cannot be written\n", path);
    return written;
}

static mgt_scene make_scene(const film_options *film, const mgt_wave waves[WAVES])
{
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    scene.image.width = film->width;
    scene.image.height = film->height;
    scene.camera = (mgt_camera){.position = {1.5, 2.6, 6.3}, .target = {0.1, 0.1, 0}, .up = {0, 1, 0}, .fov_y_deg = 36};
    scene.shutter = fmin(0.5 / film->fps, 1 / 48.0); /* the boat is drawn where it is when the shutter closes */
    scene.light.elevation_deg = 32;
    scene.light.azimuth_deg = 48;
    scene.post.exposure_ev = 1;
    scene.quality.refraction_samples = 3; /* smooth outlines of the boat in the water */
    scene.water.waves = waves;
    scene.water.wave_count = WAVES;
    scene.water.choppiness = 0.7f;
    return scene;
}

static void print_motion(const body_motion *boat, double second, double water)
{
    const double degrees = 180 / pi;
    printf("second %.2f: heave %.3f m, pitch %.2f deg, roll %.2f deg; water %.3f m\n", second, boat->heave, boat->pitch * degrees, boat->roll * degrees, water);
}

/* Renders frame after frame and moves the boat on between them. */
static bool render_film(const film_options *film, mgt_context *context, const floating_body *boat, mgt_scene *scene, mgt_object *object, unsigned char *rgba)
{
    char name[4096];
    mgt_target target;
    mgt_target_init(&target, sizeof target);
    target.pixels = rgba;
    body_motion motion = {0};
    mgt_status status = body_run(boat, &motion, &scene->water, start - settling, settling);
    for (int i = 0, printed = -1; status == MGT_OK && i < film->frames; i++) {
        const double second = i / film->fps;
        scene->time = start + second;
        body_transform(boat, &motion, object->transform);
        status = mgt_render(context, scene, &target, 1);
        if (status == MGT_OK && (!frame_name(name, sizeof name, film->output, i) || !write_ppm(name, rgba, film->width, film->height)))
            return false;
        if (status == MGT_OK && (int)second > printed) {
            printed = (int)second;
            print_motion(&motion, second, water_height(&scene->water, scene->time, boat->place_x, boat->place_z));
        }
        if (status == MGT_OK)
            status = body_run(boat, &motion, &scene->water, scene->time, 1 / film->fps);
    }
    if (status != MGT_OK)
        fprintf(stderr, "buoyancy: %s: %s\n", mgt_status_text(status), mgt_last_error(context));
    return status == MGT_OK;
}

static bool make_film(const film_options *film)
{
    mgt_wave waves[WAVES];
    triangles read = {0};
    mgt_mesh *mesh = NULL;
    mgt_context *context = NULL;
    unsigned char *const rgba = malloc(4 * (size_t)film->width * film->height);
    bool good = rgba && read_triangles(film->mesh, &read);
    if (good && (make_mesh(&read, &mesh) != MGT_OK || mgt_context_create(&context, NULL) != MGT_OK)) {
        fprintf(stderr, "buoyancy: %s\n", mgt_last_error(NULL));
        good = false;
    }
    if (good) {
        const floating_body boat = make_boat(&read);
        printf("sea: significant height %.3f m; boat: %.0f kg, %zu columns\n", make_waves(waves), boat.mass, boat.count);
        mgt_scene scene = make_scene(film, waves);
        mgt_object object = {.mesh = mesh, .material = {.base_color = {0.35f, 0.1f, 0.03f}, .roughness = 0.5f}};
        scene.objects = &object;
        scene.object_count = 1;
        body_transform(&boat, &(body_motion){0}, object.transform);
        scene.quality.refraction = MGT_REFRACTION_HYBRID;
        if (!mgt_supports(MGT_BACKEND_CPU, &scene, MGT_LAYER_COLOR))
            scene.quality.refraction = MGT_REFRACTION_TWO_PHASE; /* built without rays */
        good = render_film(film, context, &boat, &scene, &object, rgba);
    }
    mgt_context_destroy(context);
    mgt_mesh_destroy(mesh);
    free_triangles(&read);
    free(rgba);
    return good;
}

/* False where the command line is not understood. */
static bool read_options(film_options *film, int argc, char **argv)
{
    int i = 1;
    for (; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--size") == 0 && sscanf(argv[i + 1], "%ux%u", &film->width, &film->height) == 2)
            continue;
        if (strcmp(argv[i], "--frames") == 0)
            film->frames = atoi(argv[i + 1]);
        else if (strcmp(argv[i], "--fps") == 0)
            film->fps = atof(argv[i + 1]);
        else if (strcmp(argv[i], "--mesh") == 0)
            film->mesh = argv[i + 1];
        else
            return false;
    }
    film->output = argv[i];
    return i + 1 == argc && strchr(film->output, '#') && film->frames > 0 && film->fps >= 0.1 && film->fps <= 1000 && film->width > 0 && film->width <= 16384 &&
           film->height > 0 && film->height <= 16384;
}

int main(int argc, char **argv)
{
    film_options film = {.mesh = "scenes/models/hull.ply", .width = 640, .height = 360, .frames = 96, .fps = 24};
    if (!read_options(&film, argc, argv)) {
        fprintf(stderr, "usage: buoyancy [--size WxH] [--frames N] [--fps F] [--mesh PLY] OUT_####.ppm\n");
        return 64;
    }
    return make_film(&film) ? 0 : 1;
}
