/* SPDX-License-Identifier: MIT */
/* Mangata inside an engine: a striped ball floats on the water, a pole stands in it. The engine draws the ball, then the library draws the
 * water into the same framebuffer, then the engine draws the pole, so both must agree on depth.
 *   cc host_gl.c $(pkg-config --cflags --libs mangata) -lEGL -lGL -lglfw -lspng -lm -o host_gl
 *   ./host_gl                                    a window; Escape closes it
 *   ./host_gl --headless last.png --frames 30    without one (-DHOST_GL_NO_WINDOW builds without GLFW)
 *   --depth standard|reversed|infinite-reversed  --size WxH
 */
#include "headless_gl.h"
#include <mangata/gl.h>
#include <math.h>
#include <spng.h>
#include <stdlib.h>
#if !defined(HOST_GL_NO_WINDOW)
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#endif

enum { WAVES = 48 };
static const double pi = 3.14159265358979323846;

/* ---- the world ------------------------------------------------------------------------------------------- */

/* Deep-water waves from 12 metres to 8 centimetres, about a wind from behind the camera. */
static void make_waves(mgt_wave waves[WAVES])
{
    for (int i = 0; i < WAVES; i++) {
        const double k = 2 * pi / (12 * pow(0.08 / 12, i / (WAVES - 1.0))), heading = sin(2.4 * i);
        waves[i] = (mgt_wave){0.022 / k, k * sin(heading), -k * cos(heading), -sqrt(9.81 * k), fmod(1.7 * i * i, 2 * pi)};
    }
}

/* A low sun over those waves. The library reads neither image nor camera of the scene here: views bring their own. */
static mgt_scene make_scene(const mgt_wave waves[WAVES], double time)
{
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    scene.time = time;
    scene.shutter = 1 / 60.0;
    scene.light.elevation_deg = 14;
    scene.light.azimuth_deg = 12;
    scene.water.waves = waves;
    scene.water.wave_count = WAVES;
    return scene;
}

/* The engine's objects are surfaces of revolution about a vertical axis; a body without height is a ball. */
typedef struct body {
    double centre[3], radius, height;
    float color[3];
} body;

/* The ball floats: it rises and falls with the waves, the long ones at least. */
static body make_ball(const mgt_wave waves[WAVES], double time)
{
    body ball = {.centre = {-0.4, 0.25, 0}, .radius = 1.1, .color = {0.85f, 0.25f, 0.05f}};
    for (int i = 0; i < WAVES / 4; i++)
        ball.centre[1] += waves[i].amplitude * sin(waves[i].kx * ball.centre[0] + waves[i].kz * ball.centre[2] + waves[i].omega * time + waves[i].phase);
    return ball;
}

static body make_pole(void) { return (body){.centre = {2.4, 1, -5}, .radius = 0.14, .height = 5, .color = {0.75f, 0.05f, 0.08f}}; }

/* ---- matrices, column-major ------------------------------------------------------------------------------ */

/* Looks from `eye` along a compass heading (0 is −z) and so far down: a rotation and a translation. */
static void make_view(const double eye[3], double heading, double down, double view[16])
{
    const double right[3] = {cos(heading), 0, sin(heading)};
    const double back[3] = {-sin(heading) * cos(down), sin(down), cos(heading) * cos(down)};
    const double up[3] = {back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2], back[0] * right[1] - back[1] * right[0]};
    const double *const rows[3] = {right, up, back};
    memset(view, 0, 16 * sizeof *view);
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) {
            view[4 * column + row] = rows[row][column];
            view[12 + row] -= rows[row][column] * eye[column];
        }
    view[15] = 1;
}

typedef enum depth_convention { DEPTH_STANDARD, DEPTH_REVERSED, DEPTH_INFINITE_REVERSED } depth_convention;
static const char *const depth_names[] = {"standard", "reversed", "infinite-reversed"};
static const double near_plane = 0.1, far_plane = 20000;

/* A frustum whose sides meet the plane one metre ahead at left, right, bottom and top. */
static void make_projection(depth_convention depth, double left, double right, double bottom, double top, double projection[16])
{
    memset(projection, 0, 16 * sizeof *projection);
    projection[0] = 2 / (right - left);
    projection[5] = 2 / (top - bottom);
    projection[8] = (right + left) / (right - left);
    projection[9] = (top + bottom) / (top - bottom);
    projection[11] = -1;
    const double range = far_plane - near_plane;
    projection[10] = depth == DEPTH_STANDARD ? -(far_plane + near_plane) / range : depth == DEPTH_REVERSED ? near_plane / range : 0;
    projection[14] = depth == DEPTH_STANDARD ? -2 * far_plane * near_plane / range : depth == DEPTH_REVERSED ? far_plane * near_plane / range : near_plane;
}

static void multiply(const double a[16], const double b[16], float out[16])
{
    for (int i = 0; i < 16; i++) {
        double sum = 0;
        for (int k = 0; k < 4; k++)
            sum += a[4 * k + i % 4] * b[4 * (i / 4) + k];
        out[i] = (float)sum;
    }
}

/* The camera drifts about the ball; what it sees is `aspect` as wide as high. */
static mgt_gl_view make_camera(depth_convention depth, double aspect, double time)
{
    mgt_gl_view v;
    mgt_gl_view_init(&v, sizeof v);
    const double eye[3] = {0.6 * sin(0.3 * time), 2.2, 7}, top = tan(pi / 8);
    make_view(eye, 0.05 * sin(0.2 * time), 0.2, v.view);
    make_projection(depth, -aspect * top, aspect * top, -top, top, v.projection);
    v.reversed_depth = depth != DEPTH_STANDARD;
    v.draw_sky = true;
    v.color = MGT_GL_COLOR_DISPLAY; /* an engine with a tone map of its own takes MGT_GL_COLOR_RADIANCE into RGBA16F */
    return v;
}

/* ---- the engine ------------------------------------------------------------------------------------------ */

typedef struct engine {
    depth_convention depth;
    uint32_t width, height;
    GLuint framebuffer, color_texture, depth_texture, program, array;
    mgt_context *mangata;
} engine;

static const char body_vertex[] = "#version 450 core\n"
                                  "layout(location = 0) uniform mat4 clip;\n"
                                  "layout(location = 1) uniform vec4 place; /* centre, radius */\n"
                                  "layout(location = 2) uniform float height;\n"
                                  "layout(location = 0) out vec3 normal;\n"
                                  "layout(location = 1) out vec2 at;\n"
                                  "void main() {\n"
                                  "    int quad = gl_VertexID / 6, corner = gl_VertexID % 6;\n"
                                  "    ivec2 step = ivec2(corner == 1 || corner == 2 || corner == 4, corner == 2 || corner == 4 || corner == 5);\n"
                                  "    at = vec2(ivec2(quad % 96, quad / 96) + step) / vec2(96, 48);\n"
                                  "    float around = 6.2831853 * at.x, up = 3.14159265 * (at.y - 0.5);\n"
                                  "    vec3 side = vec3(cos(around), 0, sin(around));\n"
                                  "    normal = height > 0 ? side : vec3(side.x * cos(up), sin(up), side.z * cos(up));\n"
                                  "    gl_Position = clip * vec4(place.xyz + place.w * normal + vec3(0, height * (at.y - 0.5), 0), 1);\n"
                                  "}\n";
static const char body_fragment[] = "#version 450 core\n"
                                    "layout(location = 3) uniform vec3 color;\n"
                                    "layout(location = 4) uniform vec3 light;\n"
                                    "layout(location = 0) in vec3 normal;\n"
                                    "layout(location = 1) in vec2 at;\n"
                                    "layout(location = 0) out vec4 shown;\n"
                                    "void main() {\n"
                                    "    vec3 paint = fract(6 * at.y) < 0.5 ? color : vec3(0.85);\n"
                                    "    float lit = 0.35 + 0.25 * normal.y + 0.6 * max(dot(normalize(normal), light), 0);\n"
                                    "    shown = vec4(pow(min(lit * paint, vec3(1)), vec3(1 / 2.2)), 1);\n"
                                    "}\n";

static GLuint build_program(void)
{
    const char *const texts[2] = {body_vertex, body_fragment};
    const GLuint program = glCreateProgram();
    for (int i = 0; i < 2; i++) {
        const GLuint shader = glCreateShader(i == 0 ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER);
        glShaderSource(shader, 1, &texts[i], NULL);
        glCompileShader(shader);
        glAttachShader(program, shader);
        glDeleteShader(shader);
    }
    glLinkProgram(program);
    return program;
}

static void engine_resize(engine *e, uint32_t width, uint32_t height)
{
    glDeleteTextures(1, &e->color_texture);
    glDeleteTextures(1, &e->depth_texture);
    glCreateTextures(GL_TEXTURE_2D, 1, &e->color_texture);
    glCreateTextures(GL_TEXTURE_2D, 1, &e->depth_texture);
    glTextureStorage2D(e->color_texture, 1, GL_RGBA8, (GLsizei)width, (GLsizei)height);
    glTextureStorage2D(e->depth_texture, 1, GL_DEPTH_COMPONENT32F, (GLsizei)width, (GLsizei)height);
    glNamedFramebufferTexture(e->framebuffer, GL_COLOR_ATTACHMENT0, e->color_texture, 0);
    glNamedFramebufferTexture(e->framebuffer, GL_DEPTH_ATTACHMENT, e->depth_texture, 0);
    e->width = width;
    e->height = height;
}

static void print_log(void *user, mgt_log_level level, const char *id, const char *text)
{
    (void)user;
    if (level >= MGT_LOG_WARNING)
        fprintf(stderr, "mangata: %s: %s\n", id, text);
}

/* With the OpenGL context current. The depth convention is set once, as engines do; the library finds it out. */
static mgt_status engine_start(engine *e, depth_convention depth, uint32_t width, uint32_t height, mgt_gl_get_proc get_proc)
{
    *e = (engine){.depth = depth};
    glCreateFramebuffers(1, &e->framebuffer);
    glCreateVertexArrays(1, &e->array);
    e->program = build_program();
    engine_resize(e, width, height);
    glClipControl(GL_LOWER_LEFT, depth == DEPTH_STANDARD ? GL_NEGATIVE_ONE_TO_ONE : GL_ZERO_TO_ONE);
    glClearDepthf(depth == DEPTH_STANDARD ? 1 : 0);
    glDepthFunc(depth == DEPTH_STANDARD ? GL_LESS : GL_GREATER);
    glEnable(GL_DEPTH_TEST);

    mgt_context_desc desc;
    mgt_context_desc_init(&desc, sizeof desc);
    desc.backend = MGT_BACKEND_GL;
    desc.gl_get_proc = get_proc;
    desc.log = print_log;
    const mgt_status status = mgt_context_create(&e->mangata, &desc);
    if (status != MGT_OK)
        fprintf(stderr, "host_gl: %s: %s\n", mgt_status_text(status), mgt_last_error(NULL));
    return status;
}

static void engine_stop(engine *e)
{
    mgt_context_destroy(e->mangata);
    glUseProgram(0);
    glDeleteProgram(e->program);
    glDeleteVertexArrays(1, &e->array);
    glDeleteFramebuffers(1, &e->framebuffer);
    glDeleteTextures(1, &e->color_texture);
    glDeleteTextures(1, &e->depth_texture);
}

static void engine_draw_body(const engine *e, const mgt_gl_view *camera, const mgt_light *light, const body *b)
{
    float clip[16];
    multiply(camera->projection, camera->view, clip);
    const double elevation = light->elevation_deg * pi / 180, azimuth = light->azimuth_deg * pi / 180;
    glBindFramebuffer(GL_FRAMEBUFFER, e->framebuffer);
    glViewport(camera->x, camera->y, (GLsizei)camera->width, (GLsizei)camera->height);
    glUseProgram(e->program);
    glBindVertexArray(e->array);
    glUniformMatrix4fv(0, 1, GL_FALSE, clip);
    glUniform4f(1, (float)b->centre[0], (float)b->centre[1], (float)b->centre[2], (float)b->radius);
    glUniform1f(2, (float)b->height);
    glUniform3fv(3, 1, b->color);
    glUniform3f(4, (float)(sin(azimuth) * cos(elevation)), (float)sin(elevation), (float)(-cos(azimuth) * cos(elevation)));
    glDrawArrays(GL_TRIANGLES, 0, 96 * 48 * 6);
}

/* One frame. The water hides what of the ball is under it, and what of the pole, which comes after it. */
static mgt_status engine_draw(const engine *e, double time)
{
    mgt_wave waves[WAVES];
    make_waves(waves);
    const mgt_scene scene = make_scene(waves, time);
    const body ball = make_ball(waves, time), pole = make_pole();
    mgt_gl_view camera = make_camera(e->depth, (double)e->width / e->height, time);
    camera.framebuffer = e->framebuffer;
    camera.width = e->width;
    camera.height = e->height;

    glBindFramebuffer(GL_FRAMEBUFFER, e->framebuffer);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    engine_draw_body(e, &camera, &scene.light, &ball);
    const mgt_status status = mgt_gl_render_views(e->mangata, &scene, &camera, 1);
    if (status != MGT_OK)
        fprintf(stderr, "host_gl: %s: %s\n", mgt_status_text(status), mgt_last_error(e->mangata));
    engine_draw_body(e, &camera, &scene.light, &pole);
    return status;
}

/* ---- a file or a window ---------------------------------------------------------------------------------- */

static bool write_png(const engine *e, const char *path)
{
    const size_t row = 3 * (size_t)e->width, size = row * e->height;
    unsigned char *const picture = malloc(2 * size); /* bottom row first, then top row first */
    FILE *const file = picture ? fopen(path, "wb") : NULL;
    spng_ctx *const png = file ? spng_ctx_new(SPNG_CTX_ENCODER) : NULL;
    bool written = false;
    if (png) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, e->framebuffer);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glReadPixels(0, 0, (GLsizei)e->width, (GLsizei)e->height, GL_RGB, GL_UNSIGNED_BYTE, picture);
        for (size_t y = 0; y < e->height; y++)
            memcpy(picture + size + y * row, picture + (e->height - 1 - y) * row, row);
        struct spng_ihdr header = {.width = e->width, .height = e->height, .bit_depth = 8, .color_type = SPNG_COLOR_TYPE_TRUECOLOR};
        written =
            !spng_set_png_file(png, file) && !spng_set_ihdr(png, &header) && !spng_encode_image(png, picture + size, size, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
    }
    spng_ctx_free(png);
    written = file && fclose(file) == 0 && written;
    free(picture);
    if (!written)
        fprintf(stderr, "host_gl: %s cannot be written\n", path);
    return written;
}

static int run_headless(const char *path, int frames, depth_convention depth, uint32_t width, uint32_t height)
{
    engine e;
    if (!headless_gl_start() || engine_start(&e, depth, width, height, eglGetProcAddress) != MGT_OK)
        return 69;
    bool good = true;
    for (int frame = 0; frame < frames && good; frame++)
        good = engine_draw(&e, frame / 30.0) == MGT_OK;
    good = good && write_png(&e, path);
    engine_stop(&e);
    return good ? 0 : 1;
}

static int run_window(depth_convention depth, uint32_t width, uint32_t height)
{
#if defined(HOST_GL_NO_WINDOW)
    (void)depth, (void)width, (void)height;
    fprintf(stderr, "host_gl: built without windows: --headless OUT.png\n");
    return 69;
#else
    if (!glfwInit())
        return fprintf(stderr, "host_gl: no display; --headless OUT.png needs none\n"), 69;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    GLFWwindow *const window = glfwCreateWindow((int)width, (int)height, "Mangata in an engine", NULL, NULL);
    glfwMakeContextCurrent(window);
    engine e;
    if (!window || engine_start(&e, depth, width, height, glfwGetProcAddress) != MGT_OK)
        return glfwTerminate(), 69;
    mgt_status status = MGT_OK;
    while (status == MGT_OK && !glfwWindowShouldClose(window) && glfwGetKey(window, GLFW_KEY_ESCAPE) != GLFW_PRESS) {
        int w, h;
        glfwGetFramebufferSize(window, &w, &h);
        if (w > 0 && h > 0 && ((uint32_t)w != e.width || (uint32_t)h != e.height))
            engine_resize(&e, (uint32_t)w, (uint32_t)h);
        status = engine_draw(&e, glfwGetTime());
        glBlitNamedFramebuffer(e.framebuffer, 0, 0, 0, (GLint)e.width, (GLint)e.height, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        glfwSwapBuffers(window);
        glfwPollEvents();
    }
    engine_stop(&e);
    glfwTerminate();
    return status == MGT_OK ? 0 : 1;
#endif
}

int main(int argc, char **argv)
{
    const char *path = NULL;
    int frames = 1, depth = DEPTH_STANDARD, i = 1;
    unsigned width = 1280, height = 720;
    for (; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--headless") == 0)
            path = argv[i + 1];
        else if (strcmp(argv[i], "--frames") == 0)
            frames = atoi(argv[i + 1]);
        else if (strcmp(argv[i], "--depth") == 0)
            for (depth = 0; depth < 3 && strcmp(argv[i + 1], depth_names[depth]) != 0; depth++)
                ;
        else if (strcmp(argv[i], "--size") != 0 || sscanf(argv[i + 1], "%ux%u", &width, &height) != 2)
            break;
    }
    if (i != argc || frames < 1 || depth > DEPTH_INFINITE_REVERSED || width < 1 || width > 16384 || height < 1 || height > 16384) {
        fprintf(stderr, "usage: host_gl [--headless OUT.png] [--frames N] [--depth standard|reversed|infinite-reversed] [--size WxH]\n");
        return 64;
    }
    return path ? run_headless(path, frames, (depth_convention)depth, width, height) : run_window((depth_convention)depth, width, height);
}
