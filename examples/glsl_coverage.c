/* SPDX-License-Identifier: MIT */
/* Mangata's kernels in a shader of one's own, without the library: this program fills the structs that the kernels read (docs/glsl.md),
 * draws one triangle with glsl_coverage.frag and writes the coverage of the pixels as PFM. It can write its scene for the command too:
 *   folder=$(pkg-config --variable=glsldir mangata)
 *   cc glsl_coverage.c -I "$folder" -lEGL -lGL -lm -o glsl_coverage && ./glsl_coverage "$folder" glsl_coverage.frag coverage.pfm scene.json
 *   mangata render scene.json --layer coverage -o same.pfm && mangata diff coverage.pfm same.pfm
 */
#include "headless_gl.h"
#include "mangata_types.h"
#include <math.h>
#include <stdlib.h>

enum { WIDTH = 320, HEIGHT = 180, WAVES = 32 };
static const double pi = 3.14159265358979323846;

/* ---- the scene ------------------------------------------------------------------------------------------ */

/* y += amplitude · sin(a·x + b·z + c·t + phase) */
typedef struct wave {
    double amplitude, a, b, c, phase;
} wave;

typedef struct scene {
    double position[3], target[3], fov_y; /* metres, radians */
    double time, shutter;                 /* seconds; the light is gathered over [time − shutter, time] */
    double elevation, azimuth, radius;    /* of the light, radians */
    wave waves[WAVES];
} scene;

/* Longest first: deep-water waves from 20 metres to 10 centimetres, about a wind from the south. */
static scene scene_make(void)
{
    scene s = {.position = {120, 5, -40},
               .target = {120.5, 4.1, -44},
               .fov_y = 50 * pi / 180,
               .time = 7,
               .shutter = 0.2,
               .elevation = 14 * pi / 180,
               .azimuth = 5 * pi / 180,
               .radius = 1.5 * pi / 180};
    for (int i = 0; i < WAVES; i++) {
        const double k = 2 * pi / (20 * pow(0.1 / 20, i / (WAVES - 1.0))), heading = 1.1 * sin(2.4 * i);
        s.waves[i] = (wave){0.03 / k, k * sin(heading), -k * cos(heading), -sqrt(9.81 * k), fmod(1.7 * i * i, 2 * pi)};
    }
    return s;
}

static bool scene_write(const scene *s, const char *path)
{
    FILE *file = fopen(path, "w");
    if (!file)
        return false;
    fprintf(file, "{\"mangata\": 1, \"image\": {\"width\": %d, \"height\": %d},\n", WIDTH, HEIGHT);
    fprintf(file, " \"camera\": {\"position\": [%.17g, %.17g, %.17g], \"target\": [%.17g, %.17g, %.17g], \"fov_y_deg\": %.17g},\n", s->position[0],
            s->position[1], s->position[2], s->target[0], s->target[1], s->target[2], s->fov_y * 180 / pi);
    fprintf(file, " \"time\": {\"start\": %.17g, \"fps\": 1, \"frames\": 1, \"shutter\": %.17g},\n", s->time, s->shutter);
    fprintf(file, " \"light\": {\"elevation_deg\": %.17g, \"azimuth_deg\": %.17g, \"angular_radius_deg\": %.17g},\n", s->elevation * 180 / pi,
            s->azimuth * 180 / pi, s->radius * 180 / pi);
    fprintf(file, " \"water\": {\"waves\": [");
    for (int i = 0; i < WAVES; i++) {
        const wave *w = &s->waves[i];
        fprintf(file, "%s\n  {\"amplitude\": %.17g, \"a\": %.17g, \"b\": %.17g, \"c\": %.17g, \"phase\": %.17g}", i ? "," : "", w->amplitude, w->a, w->b, w->c,
                w->phase);
    }
    fprintf(file, "\n ]}}\n");
    return (ferror(file) | fclose(file)) == 0;
}

/* ---- the numbers that the kernels read ------------------------------------------------------------------- */

typedef struct vector {
    double x, y, z;
} vector;

static vector cross(vector a, vector b) { return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

static vector unit(vector v)
{
    const double length = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return (vector){v.x / length, v.y / length, v.z / length};
}

/* The light, and where waves cease to be resolved. What only colour needs stays 0. */
static FrameData frame_data(const scene *s)
{
    const vector light = {sin(s->azimuth) * cos(s->elevation), sin(s->elevation), -cos(s->azimuth) * cos(s->elevation)};
    const vector e = unit(cross((vector){0, 1, 0}, light)), f = cross(light, e);
    return (FrameData){
        .light_count = 1,
        .lights[0].light_x = (float)light.x,
        .lights[0].light_y = (float)light.y,
        .lights[0].light_z = (float)light.z,
        .lights[0].disk_radius = (float)tan(s->radius),
        .lights[0].light_visible = s->elevation >= 0 ? 1 : 0,
        .lights[0].axis_e_x = (float)e.x,
        .lights[0].axis_e_y = (float)e.y,
        .lights[0].axis_e_z = (float)e.z,
        .lights[0].axis_f_x = (float)f.x,
        .lights[0].axis_f_y = (float)f.y,
        .lights[0].axis_f_z = (float)f.z,
        .ramp_scale = 1 / (1.2f * 1.2f), /* nothing is resolved beyond 1.2 cycles a pixel */
        .slope_floor = 1e-9f,
        .grazing_fall = 2.5f, /* grazing water and its two hits, as the library has them: docs/grazing.md */
        .hit_rows_fall = 2,
        .hit_rows = 2,
    };
}

/* The camera as rays, rows counted from the bottom as gl_FragCoord counts them; and what the waves can do at most. The whole image is
 * one tile, each of whose pixels finds its own hit and share of every wave. The library's tiles are 32 × 16 and so do less work. */
static TileData tile_data(const scene *s)
{
    const vector forward = unit((vector){s->target[0] - s->position[0], s->target[1] - s->position[1], s->target[2] - s->position[2]});
    const vector right = unit(cross(forward, (vector){0, 1, 0})), up = cross(right, forward);
    const double pixel = 2 * tan(s->fov_y / 2) / HEIGHT, x = 0.5 - 0.5 * WIDTH, y = 0.5 - 0.5 * HEIGHT;
    double height = 0, slope = 0, bend = 0, slope_variance = 0, shortest = 0;
    for (int i = 0; i < WAVES; i++) {
        const wave *w = &s->waves[i];
        const double k = hypot(w->a, w->b);
        height += w->amplitude;
        slope += w->amplitude * k;
        bend += w->amplitude * k * k;
        slope_variance += w->amplitude * w->amplitude * k * k / 2;
        shortest = fmax(shortest, k);
    }
    return (TileData){
        .ray_x = (float)(forward.x + pixel * (x * right.x + y * up.x)),
        .ray_y = (float)(forward.y + pixel * (x * right.y + y * up.y)),
        .ray_z = (float)(forward.z + pixel * (x * right.z + y * up.z)),
        .camera_height = (float)s->position[1],
        .right_x = (float)(pixel * right.x),
        .right_y = (float)(pixel * right.y),
        .right_z = (float)(pixel * right.z),
        .down_x = (float)(pixel * up.x),
        .down_y = (float)(pixel * up.y),
        .down_z = (float)(pixel * up.z), /* one row on: up */
        .mixed_count = WAVES,
        .search_bound = (float)height,
        .search_slope = (float)slope,
        .search_bend = (float)bend,
        .search_tolerance = (float)(0.1 * 2 * pi / shortest),
        .far_distance = 1e5f,
        .light_reach = 1,
        .horizon_steepness = (float)(pixel * hypot(right.y, up.y)),
        .horizon_inverse = (float)(1 / (pixel * hypot(right.y, up.y))),
        .slope_variance = (float)slope_variance,
    };
}

/* A wave at the middle of the shutter, its phase in turns at the point of the mean surface under the camera, reduced in double. */
static WaveData wave_data(const scene *s, const wave *w)
{
    const double half = w->c * s->shutter / 2, A = w->amplitude, squared = w->a * w->a + w->b * w->b, octave = 0.5 * log2(squared);
    const double turns = (w->a * s->position[0] + w->b * s->position[2] + w->c * (s->time - s->shutter / 2) + w->phase) / (2 * pi);
    return (WaveData){
        .turns_x = (float)(w->a / (2 * pi)),
        .turns_z = (float)(w->b / (2 * pi)),
        .phase = (float)(turns - rint(turns)),
        .amplitude = (float)A,
        .even_x = (float)(A * w->a * cos(half)),
        .even_z = (float)(A * w->b * cos(half)),
        .odd_x = (float)(A * w->a * sin(half)),
        .odd_z = (float)(A * w->b * sin(half)),
        .bend_xx = (float)(-A * w->a * w->a),
        .bend_xz = (float)(-A * w->a * w->b),
        .bend_zz = (float)(-A * w->b * w->b),
        .even_height = (float)(A * cos(half)),
        .odd_height = (float)(A * sin(half)),
        .octave_mass = (float)(A * A * squared / 2 * octave),
        .octave_sq_mass = (float)(A * A * squared / 2 * octave * octave),
        .variance_xx = (float)(A * A * w->a * w->a / 2),
        .variance_xz = (float)(A * A * w->a * w->b / 2),
        .variance_zz = (float)(A * A * w->b * w->b / 2),
    };
}

/* ---- OpenGL ---------------------------------------------------------------------------------------------- */

/* Appends a file to `text`, and in place of its #include "NAME" lines the files of that name in `folder`. */
static void append_file(const char *path, const char *folder, char *text, size_t capacity)
{
    FILE *file = fopen(path, "r");
    if (!file) {
        fprintf(stderr, "%s: cannot be read\n", path);
        exit(66);
    }
    char line[1024], name[256], included[2048];
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "#include \"%255[^\"]\"", name) == 1) {
            snprintf(included, sizeof included, "%s/%s", folder, name);
            append_file(included, folder, text, capacity);
        } else {
            strncat(text, line, capacity - 1 - strlen(text));
        }
    }
    fclose(file);
}

static GLuint build_stage(GLenum stage, const char *text)
{
    const GLuint program = glCreateShaderProgramv(stage, 1, &text);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) {
        char log[4096];
        glGetProgramInfoLog(program, sizeof log, NULL, log);
        fprintf(stderr, "%s\n", log);
        exit(1);
    }
    return program;
}

/* A triangle that covers the viewport, and the shader. */
static GLuint build_pipeline(const char *folder, const char *shader)
{
    static char text[1 << 18];
    append_file(shader, folder, text, sizeof text);
    const char *triangle = "#version 450 core\nout gl_PerVertex { vec4 gl_Position; };\n"
                           "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }\n";
    GLuint pipeline;
    glCreateProgramPipelines(1, &pipeline);
    glUseProgramStages(pipeline, GL_VERTEX_SHADER_BIT, build_stage(GL_VERTEX_SHADER, triangle));
    glUseProgramStages(pipeline, GL_FRAGMENT_SHADER_BIT, build_stage(GL_FRAGMENT_SHADER, text));
    return pipeline;
}

/* A uniform block of `size` bytes, of which `data` fills the first `used`. */
static void fill_block(GLuint binding, const void *data, size_t used, size_t size)
{
    GLuint buffer;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, (GLsizeiptr)size, NULL, GL_DYNAMIC_STORAGE_BIT);
    glNamedBufferSubData(buffer, 0, (GLsizeiptr)used, data);
    glBindBufferBase(GL_UNIFORM_BUFFER, binding, buffer);
}

int main(int argc, char **argv)
{
    if (argc != 4 && argc != 5) {
        fprintf(stderr, "usage: glsl_coverage GLSL_FOLDER SHADER OUT.pfm [SCENE.json]\n");
        return 64;
    }
    const scene s = scene_make();
    if (argc == 5 && !scene_write(&s, argv[4])) {
        fprintf(stderr, "%s: cannot be written\n", argv[4]);
        return 73;
    }
    if (!headless_gl_start())
        return 69;

    const FrameData frame = frame_data(&s);
    const TileData tile = tile_data(&s);
    WaveData waves[WAVES];
    for (int i = 0; i < WAVES; i++)
        waves[i] = wave_data(&s, &s.waves[i]);
    fill_block(0, &frame, sizeof frame, sizeof frame);
    fill_block(1, &tile, sizeof tile, sizeof tile);
    fill_block(2, waves, sizeof waves, 128 * sizeof waves[0]);

    GLuint array, picture, framebuffer;
    glCreateTextures(GL_TEXTURE_2D, 1, &picture);
    glTextureStorage2D(picture, 1, GL_R32F, WIDTH, HEIGHT);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, picture, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glCreateVertexArrays(1, &array);
    glBindVertexArray(array);
    glBindProgramPipeline(build_pipeline(argv[1], argv[2]));
    glViewport(0, 0, WIDTH, HEIGHT);
    glDrawArrays(GL_TRIANGLES, 0, 3);

    static float coverage[WIDTH * HEIGHT]; /* bottom row first, as both OpenGL and PFM have it */
    glReadPixels(0, 0, WIDTH, HEIGHT, GL_RED, GL_FLOAT, coverage);
    const GLenum error = glGetError();
    FILE *file = error == GL_NO_ERROR ? fopen(argv[3], "wb") : NULL;
    if (file)
        fprintf(file, "Pf\n%d %d\n-1\n", WIDTH, HEIGHT);
    if (!file || fwrite(coverage, sizeof coverage, 1, file) != 1 || fclose(file)) {
        fprintf(stderr, "%s: cannot be written (OpenGL error 0x%x)\n", argv[3], error);
        return 73;
    }
    return 0;
}
