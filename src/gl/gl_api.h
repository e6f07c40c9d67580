/* SPDX-License-Identifier: MIT
 * The OpenGL functions that the backend calls, as a table filled at run time: the library links neither libGL nor libEGL. */
#ifndef MANGATA_GL_GL_API_H
#define MANGATA_GL_GL_API_H

#include <GL/glcorearb.h>

#include "mangata/mangata.h"

/* Each function of OpenGL 4.5 core by the name in capitals of its pointer type, and without "gl". */
#define GL_FUNCTIONS(X)                                                                   \
    X(ACTIVETEXTURE, ActiveTexture)                                                       \
    X(ATTACHSHADER, AttachShader)                                                         \
    X(BINDBUFFER, BindBuffer)                                                             \
    X(BINDBUFFERBASE, BindBufferBase)                                                     \
    X(BINDBUFFERRANGE, BindBufferRange)                                                   \
    X(BINDFRAMEBUFFER, BindFramebuffer)                                                   \
    X(BINDIMAGETEXTURE, BindImageTexture)                                                 \
    X(BINDSAMPLER, BindSampler)                                                           \
    X(BINDTEXTURE, BindTexture)                                                           \
    X(BINDTEXTUREUNIT, BindTextureUnit)                                                   \
    X(BINDVERTEXARRAY, BindVertexArray)                                                   \
    X(BLENDEQUATIONSEPARATEI, BlendEquationSeparatei)                                     \
    X(BLENDFUNCSEPARATEI, BlendFuncSeparatei)                                             \
    X(CHECKNAMEDFRAMEBUFFERSTATUS, CheckNamedFramebufferStatus)                           \
    X(CLEARBUFFERFV, ClearBufferfv)                                                       \
    X(CLEARBUFFERIV, ClearBufferiv)                                                       \
    X(CLEARNAMEDBUFFERSUBDATA, ClearNamedBufferSubData)                                   \
    X(CLEARTEXIMAGE, ClearTexImage)                                                       \
    X(CLIENTWAITSYNC, ClientWaitSync)                                                     \
    X(CLIPCONTROL, ClipControl)                                                           \
    X(COLORMASKI, ColorMaski)                                                             \
    X(COMPILESHADER, CompileShader)                                                       \
    X(COPYNAMEDBUFFERSUBDATA, CopyNamedBufferSubData)                                     \
    X(CREATEBUFFERS, CreateBuffers)                                                       \
    X(CREATEFRAMEBUFFERS, CreateFramebuffers)                                             \
    X(CREATEPROGRAM, CreateProgram)                                                       \
    X(CREATEQUERIES, CreateQueries)                                                       \
    X(CREATESAMPLERS, CreateSamplers)                                                     \
    X(CREATESHADER, CreateShader)                                                         \
    X(CREATETEXTURES, CreateTextures)                                                     \
    X(CREATEVERTEXARRAYS, CreateVertexArrays)                                             \
    X(DEBUGMESSAGECALLBACK, DebugMessageCallback)                                         \
    X(DELETEBUFFERS, DeleteBuffers)                                                       \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                             \
    X(DELETEPROGRAM, DeleteProgram)                                                       \
    X(DELETEQUERIES, DeleteQueries)                                                       \
    X(DELETESAMPLERS, DeleteSamplers)                                                     \
    X(DELETESHADER, DeleteShader)                                                         \
    X(DELETESYNC, DeleteSync)                                                             \
    X(DELETETEXTURES, DeleteTextures)                                                     \
    X(DELETEVERTEXARRAYS, DeleteVertexArrays)                                             \
    X(DEPTHFUNC, DepthFunc)                                                               \
    X(DEPTHMASK, DepthMask)                                                               \
    X(DEPTHRANGEINDEXED, DepthRangeIndexed)                                               \
    X(DISABLE, Disable)                                                                   \
    X(DISABLEI, Disablei)                                                                 \
    X(DISPATCHCOMPUTE, DispatchCompute)                                                   \
    X(DISPATCHCOMPUTEINDIRECT, DispatchComputeIndirect)                                   \
    X(DRAWARRAYS, DrawArrays)                                                             \
    X(ENABLE, Enable)                                                                     \
    X(ENABLEI, Enablei)                                                                   \
    X(FENCESYNC, FenceSync)                                                               \
    X(FLUSH, Flush)                                                                       \
    X(GETBOOLEANI_V, GetBooleani_v)                                                       \
    X(GETBOOLEANV, GetBooleanv)                                                           \
    X(GETERROR, GetError)                                                                 \
    X(GETFLOATI_V, GetFloati_v)                                                           \
    X(GETGRAPHICSRESETSTATUS, GetGraphicsResetStatus)                                     \
    X(GETINTEGER64I_V, GetInteger64i_v)                                                   \
    X(GETINTEGER64V, GetInteger64v)                                                       \
    X(GETINTEGERI_V, GetIntegeri_v)                                                       \
    X(GETINTEGERV, GetIntegerv)                                                           \
    X(GETNAMEDFRAMEBUFFERATTACHMENTPARAMETERIV, GetNamedFramebufferAttachmentParameteriv) \
    X(GETPROGRAMINFOLOG, GetProgramInfoLog)                                               \
    X(GETPROGRAMIV, GetProgramiv)                                                         \
    X(GETQUERYOBJECTUI64V, GetQueryObjectui64v)                                           \
    X(GETQUERYOBJECTUIV, GetQueryObjectuiv)                                               \
    X(GETSHADERINFOLOG, GetShaderInfoLog)                                                 \
    X(GETSHADERIV, GetShaderiv)                                                           \
    X(GETSTRING, GetString)                                                               \
    X(GETTEXTURELEVELPARAMETERIV, GetTextureLevelParameteriv)                             \
    X(GETTEXTUREPARAMETERIV, GetTextureParameteriv)                                       \
    X(GETTEXTURESUBIMAGE, GetTextureSubImage)                                             \
    X(ISENABLED, IsEnabled)                                                               \
    X(ISENABLEDI, IsEnabledi)                                                             \
    X(ISFRAMEBUFFER, IsFramebuffer)                                                       \
    X(ISPROGRAM, IsProgram)                                                               \
    X(ISTEXTURE, IsTexture)                                                               \
    X(LINKPROGRAM, LinkProgram)                                                           \
    X(MAPNAMEDBUFFERRANGE, MapNamedBufferRange)                                           \
    X(MEMORYBARRIER, MemoryBarrier)                                                       \
    X(NAMEDBUFFERSTORAGE, NamedBufferStorage)                                             \
    X(NAMEDFRAMEBUFFERDRAWBUFFER, NamedFramebufferDrawBuffer)                             \
    X(NAMEDFRAMEBUFFERTEXTURE, NamedFramebufferTexture)                                   \
    X(PATCHPARAMETERI, PatchParameteri)                                                   \
    X(PIXELSTOREI, PixelStorei)                                                           \
    X(POLYGONMODE, PolygonMode)                                                           \
    X(POPDEBUGGROUP, PopDebugGroup)                                                       \
    X(PUSHDEBUGGROUP, PushDebugGroup)                                                     \
    X(QUERYCOUNTER, QueryCounter)                                                         \
    X(SAMPLERPARAMETERI, SamplerParameteri)                                               \
    X(SHADERSOURCE, ShaderSource)                                                         \
    X(TEXTUREBUFFERRANGE, TextureBufferRange)                                             \
    X(TEXTURESTORAGE2D, TextureStorage2D)                                                 \
    X(TEXTURESUBIMAGE2D, TextureSubImage2D)                                               \
    X(UNMAPNAMEDBUFFER, UnmapNamedBuffer)                                                 \
    X(USEPROGRAM, UseProgram)                                                             \
    X(VIEWPORTINDEXEDF, ViewportIndexedf)

typedef struct gl_api {
#define GL_MEMBER(TYPE, name) PFNGL##TYPE##PROC name;
    GL_FUNCTIONS(GL_MEMBER)
#undef GL_MEMBER
} gl_api;

/* Fills the table. Returns NULL, or the name of the first function that `get_proc` does not know. */
const char *gl_api_load(gl_api *gl, mgt_gl_get_proc get_proc);

#endif
