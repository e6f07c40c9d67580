/* SPDX-License-Identifier: MIT
 * An OpenGL context of our own without a window, through libEGL opened at run time.
 *
 * libEGL stays open and displays stay initialised until the process ends. EGL gives the same display to everyone who asks for it, so terminating it would also
 * end the host's use of it. Drivers may crash when they are unloaded. */
#include "gl/gl_egl.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

/* The functions of EGL that are used. Core functions come from dlsym(). Those of extensions come from eglGetProcAddress() and may be NULL. */
typedef struct egl_api {
    __typeof__(&eglGetProcAddress) GetProcAddress;
    __typeof__(&eglBindAPI) BindAPI;
    __typeof__(&eglChooseConfig) ChooseConfig;
    __typeof__(&eglCreateContext) CreateContext;
    __typeof__(&eglDestroyContext) DestroyContext;
    __typeof__(&eglGetCurrentContext) GetCurrentContext;
    __typeof__(&eglGetCurrentDisplay) GetCurrentDisplay;
    __typeof__(&eglGetCurrentSurface) GetCurrentSurface;
    __typeof__(&eglGetError) GetError;
    __typeof__(&eglInitialize) Initialize;
    __typeof__(&eglMakeCurrent) MakeCurrent;
    __typeof__(&eglQueryAPI) QueryAPI;
    __typeof__(&eglQueryString) QueryString;
    PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplay;
    PFNEGLQUERYDEVICESEXTPROC QueryDevices;
} egl_api;

struct gl_egl {
    egl_api api;
    EGLDisplay display;
    EGLContext context;
};

static bool has_extension(const char *list, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = list; at && (at = strstr(at, name)); at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == 0))
            return true;
    return false;
}

static void *open_library(void) { return dlopen("libEGL.so.1", RTLD_NOW | RTLD_GLOBAL | RTLD_NODELETE); }

static mgt_status load(egl_api *api, const reporter *r)
{
    void *library = open_library();
    if (!library)
        return report_error(r, MGT_ERROR_UNAVAILABLE, "context.backend", "OpenGL without a window needs EGL, but libEGL.so.1 cannot be opened: %s", dlerror());
#define LOAD(name)                                                         \
    if (!(api->name = (__typeof__(api->name))dlsym(library, "egl" #name))) \
        return report_error(r, MGT_ERROR_UNAVAILABLE, "context.backend", "libEGL.so.1 has no egl" #name ": OpenGL without a window needs EGL 1.4");
    LOAD(GetProcAddress)
    LOAD(BindAPI)
    LOAD(ChooseConfig)
    LOAD(CreateContext)
    LOAD(DestroyContext)
    LOAD(GetCurrentContext)
    LOAD(GetCurrentDisplay)
    LOAD(GetCurrentSurface)
    LOAD(GetError)
    LOAD(Initialize)
    LOAD(MakeCurrent)
    LOAD(QueryAPI)
    LOAD(QueryString)
#undef LOAD
    api->GetPlatformDisplay = (PFNEGLGETPLATFORMDISPLAYEXTPROC)api->GetProcAddress("eglGetPlatformDisplayEXT");
    api->QueryDevices = (PFNEGLQUERYDEVICESEXTPROC)api->GetProcAddress("eglQueryDevicesEXT");
    return MGT_OK;
}

mgt_gl_function gl_egl_get_proc(const char *name)
{
    void *library = open_library();
    const __typeof__(&eglGetProcAddress) get = library ? (__typeof__(&eglGetProcAddress))dlsym(library, "eglGetProcAddress") : NULL;
    return get ? get(name) : NULL;
}

/* ---- displays ---- */

enum { MAX_DEVICES = 64 };

static mgt_status open_device(gl_egl *egl, uint32_t device, const reporter *r)
{
    EGLDeviceEXT devices[MAX_DEVICES];
    EGLint count = 0;
    if (!egl->api.QueryDevices(MAX_DEVICES, devices, &count) || count <= 0)
        return report_error(r, MGT_ERROR_UNAVAILABLE, "context.backend", "EGL knows no OpenGL device on this machine");
    if (device >= (uint32_t)count)
        return report_error(r, MGT_ERROR_UNAVAILABLE, "context.device", "there is no OpenGL device %u: this machine has %d, counted from 0", device,
                            (int)count);
    egl->display = egl->api.GetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[device], NULL);
    if (egl->display == EGL_NO_DISPLAY || !egl->api.Initialize(egl->display, NULL, NULL))
        return report_error(r, MGT_ERROR_UNAVAILABLE, "context.gl", "OpenGL device %u of %d cannot be opened (EGL error 0x%x)", device, (int)count,
                            (unsigned)egl->api.GetError());
    return MGT_OK;
}

static mgt_status open_surfaceless(gl_egl *egl, uint32_t device, const reporter *r)
{
    if (device > 0)
        return report_error(r, MGT_ERROR_UNAVAILABLE, "context.device", "there is no OpenGL device %u: this EGL cannot list devices and has one", device);
    egl->display = egl->api.GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, (void *)EGL_DEFAULT_DISPLAY, NULL);
    if (egl->display == EGL_NO_DISPLAY || !egl->api.Initialize(egl->display, NULL, NULL))
        return report_error(r, MGT_ERROR_UNAVAILABLE, "context.backend", "EGL has no display without a window system (error 0x%x)",
                            (unsigned)egl->api.GetError());
    return MGT_OK;
}

/* Opens and initialises the display of device number `device`. An EGL that cannot list devices has device 0 alone. */
static mgt_status open_display(gl_egl *egl, uint32_t device, const reporter *r)
{
    const char *extensions = egl->api.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const bool devices = egl->api.GetPlatformDisplay && egl->api.QueryDevices && has_extension(extensions, "EGL_EXT_platform_device") &&
                         (has_extension(extensions, "EGL_EXT_device_enumeration") || has_extension(extensions, "EGL_EXT_device_base"));
    if (devices)
        return open_device(egl, device, r);
    if (egl->api.GetPlatformDisplay && has_extension(extensions, "EGL_MESA_platform_surfaceless"))
        return open_surfaceless(egl, device, r);
    return report_error(r, MGT_ERROR_UNAVAILABLE, "context.backend",
                        "this EGL opens no display without a window: it has neither EGL_EXT_platform_device nor EGL_MESA_platform_surfaceless");
}

/* ---- contexts ---- */

/* Creates a context of OpenGL 4.5 core. `robust`: one that reports resets of the GPU. EGL_NO_CONTEXT: EGL cannot create it. */
static EGLContext create_context(const gl_egl *egl, bool robust)
{
    const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,
        4,
        EGL_CONTEXT_MINOR_VERSION,
        5,
        EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
        robust ? EGL_CONTEXT_OPENGL_ROBUST_ACCESS : EGL_NONE,
        EGL_TRUE,
        EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
        EGL_LOSE_CONTEXT_ON_RESET,
        EGL_NONE,
    };
    EGLConfig config = NULL; /* this is EGL_NO_CONFIG_KHR */
    const char *extensions = egl->api.QueryString(egl->display, EGL_EXTENSIONS);
    if (!has_extension(extensions, "EGL_KHR_no_config_context")) {
        const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_NONE};
        EGLint count = 0;
        if (!egl->api.ChooseConfig(egl->display, wanted, &config, 1, &count) || count == 0)
            return EGL_NO_CONTEXT;
    }
    return egl->api.CreateContext(egl->display, config, EGL_NO_CONTEXT, attributes);
}

mgt_status gl_egl_create(gl_egl **out, uint32_t device, const reporter *r)
{
    gl_egl *egl = calloc(1, sizeof *egl);
    if (!egl)
        return report_error(r, MGT_ERROR_MEMORY, "context.create", "out of memory");
    mgt_status status = load(&egl->api, r);
    if (status == MGT_OK)
        status = open_display(egl, device, r);
    if (status != MGT_OK) {
        free(egl);
        return status;
    }
    const EGLenum api = egl->api.QueryAPI();
    if (egl->api.BindAPI(EGL_OPENGL_API)) {
        egl->context = create_context(egl, true);
        if (egl->context == EGL_NO_CONTEXT)
            egl->context = create_context(egl, false);
    }
    const unsigned error = (unsigned)egl->api.GetError();
    egl->api.BindAPI(api);
    if (egl->context == EGL_NO_CONTEXT) {
        free(egl);
        return report_error(r, MGT_ERROR_UNAVAILABLE, "context.gl", "OpenGL device %u has no OpenGL 4.5 core profile (EGL error 0x%x)", device, error);
    }
    *out = egl;
    return MGT_OK;
}

void gl_egl_destroy(gl_egl *egl)
{
    if (!egl)
        return;
    egl->api.DestroyContext(egl->display, egl->context);
    free(egl);
}

mgt_status gl_egl_enter(const gl_egl *egl, gl_egl_scope *scope, const reporter *r)
{
    const egl_api *api = &egl->api;
    *scope =
        (gl_egl_scope){api->GetCurrentDisplay(), api->GetCurrentSurface(EGL_DRAW), api->GetCurrentSurface(EGL_READ), api->GetCurrentContext(), api->QueryAPI()};
    api->BindAPI(EGL_OPENGL_API);
    if (api->MakeCurrent(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, egl->context))
        return MGT_OK;
    const unsigned error = (unsigned)api->GetError();
    api->BindAPI(scope->api);
    return report_error(r, MGT_ERROR_UNAVAILABLE, "render.context", "the OpenGL context cannot be made current (EGL error 0x%x)", error);
}

void gl_egl_leave(const gl_egl *egl, const gl_egl_scope *scope)
{
    const egl_api *api = &egl->api;
    if (scope->context == EGL_NO_CONTEXT)
        api->MakeCurrent(egl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    api->BindAPI(scope->api);
    if (scope->context != EGL_NO_CONTEXT)
        api->MakeCurrent(scope->display, scope->draw, scope->read, scope->context);
}
