/* SPDX-License-Identifier: MIT */
/* OpenGL 4.5 without a window, through EGL: for the examples. Link with -lEGL -lGL. */
#ifndef HEADLESS_GL_H
#define HEADLESS_GL_H

#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* Mesa's platform without surfaces where EGL has it, else the first device, whose driver may be NVIDIA's. */
static inline EGLDisplay headless_display(void)
{
    const char *extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!extensions)
        return EGL_NO_DISPLAY;
    EGLDisplay display = EGL_NO_DISPLAY;
    const PFNEGLGETPLATFORMDISPLAYEXTPROC get_display = (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    if (get_display && strstr(extensions, "EGL_MESA_platform_surfaceless"))
        display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (display != EGL_NO_DISPLAY && eglInitialize(display, NULL, NULL))
        return display;
    const PFNEGLQUERYDEVICESEXTPROC query_devices = (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
    EGLDeviceEXT device;
    EGLint devices = 0;
    if (!get_display || !query_devices || !query_devices(1, &device, &devices) || devices < 1)
        return EGL_NO_DISPLAY;
    display = get_display(EGL_PLATFORM_DEVICE_EXT, device, NULL);
    return display != EGL_NO_DISPLAY && eglInitialize(display, NULL, NULL) ? display : EGL_NO_DISPLAY;
}

/* Makes an OpenGL 4.5 core context current on this thread; on failure says what is missing. It lasts as long as the program. */
static inline bool headless_gl_start(void)
{
    static const EGLint config_wants[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    static const EGLint context_wants[] = {EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    const EGLDisplay display = headless_display();
    EGLConfig config;
    EGLint configs = 0;
    const char *missing = NULL;
    if (display == EGL_NO_DISPLAY)
        missing = "EGL without a window (EGL_MESA_platform_surfaceless or EGL_EXT_platform_device)";
    else if (!eglBindAPI(EGL_OPENGL_API) || !eglChooseConfig(display, config_wants, &config, 1, &configs) || configs < 1)
        missing = "desktop OpenGL through EGL";
    const EGLContext context = missing ? EGL_NO_CONTEXT : eglCreateContext(display, config, EGL_NO_CONTEXT, context_wants);
    if (!missing && (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)))
        missing = "an OpenGL 4.5 core context";
    if (missing)
        fprintf(stderr, "this needs %s, which is not here\n", missing);
    return !missing;
}

#endif
