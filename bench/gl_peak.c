/* SPDX-License-Identifier: MIT
 * The most fused multiply-adds that a GPU does in registers. */
#include "gl_peak.h"

#include <stdio.h>

#include "gl/gl_api.h"
#include "gl/gl_egl.h"

enum { CHAINS = 8, ROUNDS = 512, GROUP = 256, GROUPS_MOST = 1 << 16, RUNS = 8 };

static const char source[] = "#version 450 core\n"
                             "layout(local_size_x = 256) in;\n"
                             "layout(std430, binding = 0) buffer Values { vec4 seed; vec4 sum; };\n"
                             "void main()\n"
                             "{\n"
                             "    float a = seed.x, b = seed.y, id = float(gl_GlobalInvocationID.x);\n"
                             "    float c0 = id, c1 = id + 1.0, c2 = id + 2.0, c3 = id + 3.0, c4 = id + 4.0, c5 = id + 5.0, c6 = id + 6.0, c7 = id + 7.0;\n"
                             "    for (int i = 0; i < 512; i++) {\n"
                             "        c0 = fma(c0, a, b); c1 = fma(c1, a, b); c2 = fma(c2, a, b); c3 = fma(c3, a, b);\n"
                             "        c4 = fma(c4, a, b); c5 = fma(c5, a, b); c6 = fma(c6, a, b); c7 = fma(c7, a, b);\n"
                             "    }\n"
                             "    float all = c0 + c1 + c2 + c3 + c4 + c5 + c6 + c7;\n"
                             "    if (all == 1.2345) sum.x = all;\n"
                             "}\n";

static double run(const gl_api *gl, GLuint groups, GLuint query[2])
{
    GLuint64 begin = 0, end = 0;
    gl->QueryCounter(query[0], GL_TIMESTAMP);
    gl->DispatchCompute(groups, 1, 1);
    gl->QueryCounter(query[1], GL_TIMESTAMP);
    gl->GetQueryObjectui64v(query[0], GL_QUERY_RESULT, &begin);
    gl->GetQueryObjectui64v(query[1], GL_QUERY_RESULT, &end);
    return 1e-9 * (double)(end - begin);
}

static double measure(const gl_api *gl, bool quick)
{
    const char *text = source;
    const float values[8] = {0.999f, 1e-3f};
    GLuint buffer, query[2];
    GLint linked = 0;
    const GLuint shader = gl->CreateShader(GL_COMPUTE_SHADER), program = gl->CreateProgram();
    gl->ShaderSource(shader, 1, &text, NULL);
    gl->CompileShader(shader);
    gl->AttachShader(program, shader);
    gl->LinkProgram(program);
    gl->GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked)
        return 0;
    gl->CreateBuffers(1, &buffer);
    gl->NamedBufferStorage(buffer, sizeof values, values, 0);
    gl->CreateQueries(GL_TIMESTAMP, 2, query);
    gl->UseProgram(program);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    /* As many groups as take some milliseconds. */
    GLuint groups = 16;
    while (run(gl, groups, query) < (quick ? 1e-4 : 5e-3) && groups < GROUPS_MOST)
        groups *= 2;
    double best = 0;
    for (int i = 0; i < (quick ? 1 : RUNS); i++) {
        const double seconds = run(gl, groups, query), rate = 2.0 * CHAINS * ROUNDS * GROUP * (double)groups / seconds;
        best = seconds > 0 && rate > best ? rate : best;
    }
    gl->DeleteQueries(2, query);
    gl->DeleteBuffers(1, &buffer);
    gl->DeleteProgram(program);
    gl->DeleteShader(shader);
    return best;
}

double gl_fma_peak(bool quick)
{
    char error[REPORTER_TEXT] = "";
    const reporter r = {.error = error};
    gl_egl *egl = NULL;
    gl_egl_scope scope;
    gl_api gl;
    double peak = 0;
    if (gl_egl_create(&egl, 0, &r) != MGT_OK)
        return 0;
    if (gl_egl_enter(egl, &scope, &r) == MGT_OK) {
        if (!gl_api_load(&gl, gl_egl_get_proc))
            peak = measure(&gl, quick);
        gl_egl_leave(egl, &scope);
    }
    gl_egl_destroy(egl);
    return peak;
}
