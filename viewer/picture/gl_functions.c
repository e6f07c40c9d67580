/* SPDX-License-Identifier: MIT
 * Finds the OpenGL functions by name. */
#include "viewer/picture/gl_functions.h"

#include <stddef.h>
#include <string.h>

typedef struct gl_name {
    const char *name;
    size_t offset;
} gl_name;

static const gl_name required[] = {
    {"glActiveTexture", offsetof(gl_functions, ActiveTexture)},
    {"glAttachShader", offsetof(gl_functions, AttachShader)},
    {"glBindFramebuffer", offsetof(gl_functions, BindFramebuffer)},
    {"glBindTexture", offsetof(gl_functions, BindTexture)},
    {"glBindVertexArray", offsetof(gl_functions, BindVertexArray)},
    {"glClear", offsetof(gl_functions, Clear)},
    {"glClearColor", offsetof(gl_functions, ClearColor)},
    {"glCompileShader", offsetof(gl_functions, CompileShader)},
    {"glCreateProgram", offsetof(gl_functions, CreateProgram)},
    {"glCreateShader", offsetof(gl_functions, CreateShader)},
    {"glDeleteProgram", offsetof(gl_functions, DeleteProgram)},
    {"glDeleteShader", offsetof(gl_functions, DeleteShader)},
    {"glDeleteTextures", offsetof(gl_functions, DeleteTextures)},
    {"glDeleteVertexArrays", offsetof(gl_functions, DeleteVertexArrays)},
    {"glDisable", offsetof(gl_functions, Disable)},
    {"glDrawArrays", offsetof(gl_functions, DrawArrays)},
    {"glGenTextures", offsetof(gl_functions, GenTextures)},
    {"glGenVertexArrays", offsetof(gl_functions, GenVertexArrays)},
    {"glGetError", offsetof(gl_functions, GetError)},
    {"glGetIntegerv", offsetof(gl_functions, GetIntegerv)},
    {"glGetProgramiv", offsetof(gl_functions, GetProgramiv)},
    {"glGetProgramInfoLog", offsetof(gl_functions, GetProgramInfoLog)},
    {"glGetShaderiv", offsetof(gl_functions, GetShaderiv)},
    {"glGetShaderInfoLog", offsetof(gl_functions, GetShaderInfoLog)},
    {"glGetString", offsetof(gl_functions, GetString)},
    {"glGetTexImage", offsetof(gl_functions, GetTexImage)},
    {"glGetUniformLocation", offsetof(gl_functions, GetUniformLocation)},
    {"glLinkProgram", offsetof(gl_functions, LinkProgram)},
    {"glPixelStorei", offsetof(gl_functions, PixelStorei)},
    {"glReadPixels", offsetof(gl_functions, ReadPixels)},
    {"glShaderSource", offsetof(gl_functions, ShaderSource)},
    {"glTexImage2D", offsetof(gl_functions, TexImage2D)},
    {"glTexParameteri", offsetof(gl_functions, TexParameteri)},
    {"glTexSubImage2D", offsetof(gl_functions, TexSubImage2D)},
    {"glUniform1f", offsetof(gl_functions, Uniform1f)},
    {"glUniform1i", offsetof(gl_functions, Uniform1i)},
    {"glUniform2f", offsetof(gl_functions, Uniform2f)},
    {"glUniform4f", offsetof(gl_functions, Uniform4f)},
    {"glUseProgram", offsetof(gl_functions, UseProgram)},
    {"glViewport", offsetof(gl_functions, Viewport)},
};

static mgt_gl_function store(gl_functions *gl, size_t offset, mgt_gl_function function)
{
    memcpy((char *)gl + offset, &function, sizeof function);
    return function;
}

bool gl_functions_load(gl_functions *gl, mgt_gl_get_proc get_proc, const char **missing)
{
    *gl = (gl_functions){0};
    for (size_t i = 0; i < sizeof required / sizeof required[0]; i++)
        if (!store(gl, required[i].offset, get_proc(required[i].name))) {
            *missing = required[i].name;
            return false;
        }
    store(gl, offsetof(gl_functions, TexStorage2D), get_proc("glTexStorage2D"));
    return true;
}
