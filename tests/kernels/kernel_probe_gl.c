/* SPDX-License-Identifier: MIT */
/* Functions of the kernels on arrays of floats, in a compute shader. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gl/gl_api.h"
#include "gl/gl_egl.h"
#include "kernel_probe.h"

/* Floats a function's arrays may hold, and where they stand in the buffer. */
enum { ROOM = 1 << 16, HEAD = 4 };

static const char shader_main[] = "layout(local_size_x = 64) in;\n"
                                  "layout(std430, binding = 0) buffer Values { int function, count, room, padding; float value[]; };\n"
                                  "void main()\n"
                                  "{\n"
                                  "    int i = int(gl_GlobalInvocationID.x);\n"
                                  "    if (i >= count)\n"
                                  "        return;\n"
                                  "    ProbeInput x;\n"
                                  "    for (int k = 0; k < 8; k++)\n"
                                  "        x.value[k] = value[k * room + i];\n"
                                  "    vec3 y = probe(0, function, x);\n"
                                  "    value[8 * room + i] = y.x;\n"
                                  "    value[9 * room + i] = y.y;\n"
                                  "    value[10 * room + i] = y.z;\n"
                                  "}\n";

static struct {
    gl_egl *egl;
    gl_api gl;
    GLuint program, buffer;
    float *values; /* mapped as long as the process lives */
} probe;

static void fail(const char *what, const char *detail)
{
    fprintf(stderr, "kernel_probe_gl: %s: %s\n", what, detail);
    exit(1);
}

/* The kernels with all includes, by the command that also makes the installed ones. */
static char *kernel_text(void)
{
    static const char command[] = MGT_SOURCE_DIR "/scripts/kernel_glsl '450 core' " MGT_SOURCE_DIR "/src/kernels/common/prelude_glsl.k " MGT_SOURCE_DIR
                                                 "/src/kernels/common/disk_path.k " MGT_SOURCE_DIR "/tests/kernels/kernel_probe.k";
    const size_t room = 1 << 20;
    char *text = calloc(room, 1);
    FILE *pipe = text ? popen(command, "r") : NULL;
    if (!pipe)
        fail("scripts/kernel_glsl", "cannot be run");
    const size_t read = fread(text, 1, room - 1, pipe);
    if (pclose(pipe) != 0 || read == 0 || read == room - 1)
        fail("scripts/kernel_glsl", "failed");
    return text;
}

static GLuint build_program(const gl_api *gl)
{
    char names[2048] = "", log[2048] = "";
    size_t length = 0;
#define PROBE_CONSTANT(name) length += (size_t)snprintf(names + length, sizeof names - length, "const int " #name " = %d;\n", name);
    PROBE_FUNCTIONS(PROBE_CONSTANT)
#undef PROBE_CONSTANT
    char *text = kernel_text();
    char *body = strchr(text, '\n'); /* #version stays first */
    *body++ = 0;
    const char *parts[] = {text, "\n", names, body, shader_main};
    const GLuint shader = gl->CreateShader(GL_COMPUTE_SHADER), program = gl->CreateProgram();
    GLint done = 0;
    gl->ShaderSource(shader, 5, parts, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &done);
    gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
    if (!done)
        fail("compiling", log);
    gl->AttachShader(program, shader);
    gl->LinkProgram(program);
    gl->GetProgramiv(program, GL_LINK_STATUS, &done);
    gl->GetProgramInfoLog(program, sizeof log, NULL, log);
    if (!done)
        fail("linking", log);
    gl->DeleteShader(shader);
    free(text);
    return program;
}

static void run(enum probe_function function, const float *const *in, float *const *out, size_t count)
{
    const gl_api *gl = &probe.gl;
    if (count > ROOM)
        fail("run", "too many cases");
    const int head[HEAD] = {(int)function, (int)count, ROOM, 0};
    memcpy(probe.values, head, sizeof head);
    for (size_t k = 0; k < PROBE_INPUTS; k++) {
        float *to = probe.values + HEAD + k * ROOM;
        if (in[k])
            memcpy(to, in[k], count * sizeof *to);
        else
            memset(to, 0, count * sizeof *to);
    }
    gl->UseProgram(probe.program);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, probe.buffer);
    gl->DispatchCompute((GLuint)((count + 63) / 64), 1, 1);
    gl->MemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
    const GLsync fence = gl->FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (gl->ClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, 60000000000u) == GL_WAIT_FAILED || gl->GetError() != GL_NO_ERROR)
        fail("run", "an OpenGL error");
    gl->DeleteSync(fence);
    for (size_t k = 0; k < PROBE_OUTPUTS; k++)
        if (out[k])
            memcpy(out[k], probe.values + HEAD + (PROBE_INPUTS + k) * ROOM, count * sizeof **out);
}

static long count_evaluations(void) { return 0; }

static bool start(void)
{
    char error[REPORTER_TEXT] = "";
    const reporter r = {.error = error};
    gl_egl_scope scope;
    if (gl_egl_create(&probe.egl, 0, &r) != MGT_OK || gl_egl_enter(probe.egl, &scope, &r) != MGT_OK) {
        fprintf(stderr, "kernel_probe_gl: the kernels are not tested as shaders: %s\n", error);
        return false;
    }
    const char *unknown = gl_api_load(&probe.gl, gl_egl_get_proc);
    if (unknown)
        fail("no OpenGL function", unknown);
    const GLbitfield access = GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    const GLsizeiptr size = (HEAD + (PROBE_INPUTS + PROBE_OUTPUTS) * (GLsizeiptr)ROOM) * (GLsizeiptr)sizeof(float);
    probe.program = build_program(&probe.gl);
    probe.gl.CreateBuffers(1, &probe.buffer);
    probe.gl.NamedBufferStorage(probe.buffer, size, NULL, access);
    probe.values = probe.gl.MapNamedBufferRange(probe.buffer, 0, size, access);
    if (!probe.values)
        fail("mapping", "no memory");
    return true;
}

/* The context lives as long as the process: the tests' probes share it. */
int kernel_probe_gl(struct kernel_probe *out)
{
    static enum { UNTRIED, THERE, MISSING } state;
    if (state == UNTRIED)
        state = start() ? THERE : MISSING;
    *out = (struct kernel_probe){"OpenGL", 1, 0, 0, run, count_evaluations};
    return state == THERE;
}
