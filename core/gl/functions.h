// The OpenGL functions of one context. Pointers differ between providers (calling one provider's pointer on
// another's context crashes), so every context owns a table and nothing calls a global gl function.
#pragma once

#include <GL/glcorearb.h>

#include <functional>

namespace unshot::gl {

// One entry a function: the name in the PFNGL...PROC type, and the member, which is the name without its gl
// prefix. All are OpenGL 3.3 core (timer queries included). clang-format off: one line a function would fill
// three screens.
// clang-format off
#define UNSHOT_GL_ERRORS_STATE(X) \
  X(GETERROR, GetError) X(GETSTRING, GetString) X(GETSTRINGI, GetStringi) X(GETINTEGERV, GetIntegerv) \
  X(GETINTEGER64V, GetInteger64v) X(GETFLOATV, GetFloatv) X(GETBOOLEANV, GetBooleanv) \
  X(ISENABLED, IsEnabled) X(ENABLE, Enable) X(DISABLE, Disable) X(PIXELSTOREI, PixelStorei) \
  X(FLUSH, Flush) X(FINISH, Finish)

#define UNSHOT_GL_FIXED_FUNCTION_STATE(X) \
  X(VIEWPORT, Viewport) X(SCISSOR, Scissor) X(CLEARCOLOR, ClearColor) X(CLEARDEPTH, ClearDepth) \
  X(CLEAR, Clear) X(CLEARBUFFERIV, ClearBufferiv) X(CLEARBUFFERUIV, ClearBufferuiv) \
  X(CLEARBUFFERFV, ClearBufferfv) X(CLEARBUFFERFI, ClearBufferfi) X(COLORMASK, ColorMask) \
  X(DEPTHMASK, DepthMask) X(DEPTHFUNC, DepthFunc) X(DEPTHRANGE, DepthRange) X(CULLFACE, CullFace) \
  X(FRONTFACE, FrontFace) X(POLYGONMODE, PolygonMode) X(POLYGONOFFSET, PolygonOffset) \
  X(LINEWIDTH, LineWidth) X(POINTSIZE, PointSize) X(BLENDFUNC, BlendFunc) \
  X(BLENDFUNCSEPARATE, BlendFuncSeparate) X(BLENDEQUATION, BlendEquation) \
  X(BLENDEQUATIONSEPARATE, BlendEquationSeparate) X(STENCILFUNC, StencilFunc) X(STENCILMASK, StencilMask) \
  X(STENCILOP, StencilOp)

#define UNSHOT_GL_BUFFERS(X) \
  X(GENBUFFERS, GenBuffers) X(DELETEBUFFERS, DeleteBuffers) X(BINDBUFFER, BindBuffer) \
  X(BINDBUFFERBASE, BindBufferBase) X(BINDBUFFERRANGE, BindBufferRange) X(BUFFERDATA, BufferData) \
  X(BUFFERSUBDATA, BufferSubData) X(GETBUFFERSUBDATA, GetBufferSubData) \
  X(COPYBUFFERSUBDATA, CopyBufferSubData) X(MAPBUFFERRANGE, MapBufferRange) X(UNMAPBUFFER, UnmapBuffer)

#define UNSHOT_GL_VERTEX_ARRAYS(X) \
  X(GENVERTEXARRAYS, GenVertexArrays) X(DELETEVERTEXARRAYS, DeleteVertexArrays) \
  X(BINDVERTEXARRAY, BindVertexArray) X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray) \
  X(DISABLEVERTEXATTRIBARRAY, DisableVertexAttribArray) X(VERTEXATTRIBPOINTER, VertexAttribPointer) \
  X(VERTEXATTRIBIPOINTER, VertexAttribIPointer) X(VERTEXATTRIBDIVISOR, VertexAttribDivisor) \
  X(VERTEXATTRIB3F, VertexAttrib3f) X(VERTEXATTRIB4F, VertexAttrib4f)

#define UNSHOT_GL_TEXTURES_SAMPLERS(X) \
  X(GENTEXTURES, GenTextures) X(DELETETEXTURES, DeleteTextures) X(BINDTEXTURE, BindTexture) \
  X(ACTIVETEXTURE, ActiveTexture) X(TEXIMAGE2D, TexImage2D) X(TEXIMAGE3D, TexImage3D) \
  X(TEXSUBIMAGE2D, TexSubImage2D) X(TEXSUBIMAGE3D, TexSubImage3D) \
  X(TEXIMAGE2DMULTISAMPLE, TexImage2DMultisample) X(TEXPARAMETERI, TexParameteri) \
  X(TEXPARAMETERF, TexParameterf) X(TEXPARAMETERFV, TexParameterfv) X(TEXBUFFER, TexBuffer) \
  X(GETTEXIMAGE, GetTexImage) X(GENERATEMIPMAP, GenerateMipmap) X(GENSAMPLERS, GenSamplers) \
  X(DELETESAMPLERS, DeleteSamplers) X(BINDSAMPLER, BindSampler) X(SAMPLERPARAMETERI, SamplerParameteri)

#define UNSHOT_GL_FRAMEBUFFERS(X) \
  X(GENFRAMEBUFFERS, GenFramebuffers) X(DELETEFRAMEBUFFERS, DeleteFramebuffers) \
  X(BINDFRAMEBUFFER, BindFramebuffer) X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus) \
  X(FRAMEBUFFERTEXTURE, FramebufferTexture) X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D) \
  X(FRAMEBUFFERTEXTURELAYER, FramebufferTextureLayer) X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer) \
  X(GENRENDERBUFFERS, GenRenderbuffers) X(DELETERENDERBUFFERS, DeleteRenderbuffers) \
  X(BINDRENDERBUFFER, BindRenderbuffer) X(RENDERBUFFERSTORAGE, RenderbufferStorage) \
  X(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample) X(DRAWBUFFER, DrawBuffer) \
  X(DRAWBUFFERS, DrawBuffers) X(READBUFFER, ReadBuffer) X(READPIXELS, ReadPixels) \
  X(BLITFRAMEBUFFER, BlitFramebuffer)

#define UNSHOT_GL_PROGRAMS(X) \
  X(CREATESHADER, CreateShader) X(DELETESHADER, DeleteShader) X(SHADERSOURCE, ShaderSource) \
  X(COMPILESHADER, CompileShader) X(GETSHADERIV, GetShaderiv) X(GETSHADERINFOLOG, GetShaderInfoLog) \
  X(CREATEPROGRAM, CreateProgram) X(DELETEPROGRAM, DeleteProgram) X(ATTACHSHADER, AttachShader) \
  X(DETACHSHADER, DetachShader) X(LINKPROGRAM, LinkProgram) X(GETPROGRAMIV, GetProgramiv) \
  X(GETPROGRAMINFOLOG, GetProgramInfoLog) X(USEPROGRAM, UseProgram) \
  X(BINDATTRIBLOCATION, BindAttribLocation) X(BINDFRAGDATALOCATION, BindFragDataLocation) \
  X(GETATTRIBLOCATION, GetAttribLocation) X(GETUNIFORMLOCATION, GetUniformLocation) \
  X(GETUNIFORMBLOCKINDEX, GetUniformBlockIndex) X(UNIFORMBLOCKBINDING, UniformBlockBinding) \
  X(UNIFORM1I, Uniform1i) X(UNIFORM2I, Uniform2i) X(UNIFORM3I, Uniform3i) X(UNIFORM4I, Uniform4i) \
  X(UNIFORM1UI, Uniform1ui) X(UNIFORM2UI, Uniform2ui) X(UNIFORM3UI, Uniform3ui) X(UNIFORM4UI, Uniform4ui) \
  X(UNIFORM1F, Uniform1f) X(UNIFORM2F, Uniform2f) X(UNIFORM3F, Uniform3f) X(UNIFORM4F, Uniform4f) \
  X(UNIFORM1IV, Uniform1iv) X(UNIFORM1UIV, Uniform1uiv) X(UNIFORM1FV, Uniform1fv) \
  X(UNIFORM2FV, Uniform2fv) X(UNIFORM3FV, Uniform3fv) X(UNIFORM4FV, Uniform4fv) \
  X(UNIFORMMATRIX3FV, UniformMatrix3fv) X(UNIFORMMATRIX4FV, UniformMatrix4fv)

#define UNSHOT_GL_DRAWING(X) \
  X(DRAWARRAYS, DrawArrays) X(DRAWARRAYSINSTANCED, DrawArraysInstanced) X(DRAWELEMENTS, DrawElements) \
  X(DRAWELEMENTSINSTANCED, DrawElementsInstanced) X(DRAWELEMENTSBASEVERTEX, DrawElementsBaseVertex) \
  X(DRAWRANGEELEMENTS, DrawRangeElements) X(MULTIDRAWARRAYS, MultiDrawArrays) \
  X(MULTIDRAWELEMENTS, MultiDrawElements) X(MULTIDRAWELEMENTSBASEVERTEX, MultiDrawElementsBaseVertex) \
  X(PRIMITIVERESTARTINDEX, PrimitiveRestartIndex) X(PROVOKINGVERTEX, ProvokingVertex)

#define UNSHOT_GL_QUERIES_FENCES(X) \
  X(GENQUERIES, GenQueries) X(DELETEQUERIES, DeleteQueries) X(BEGINQUERY, BeginQuery) \
  X(ENDQUERY, EndQuery) X(QUERYCOUNTER, QueryCounter) X(GETQUERYOBJECTIV, GetQueryObjectiv) \
  X(GETQUERYOBJECTUIV, GetQueryObjectuiv) X(GETQUERYOBJECTI64V, GetQueryObjecti64v) \
  X(GETQUERYOBJECTUI64V, GetQueryObjectui64v) X(FENCESYNC, FenceSync) X(CLIENTWAITSYNC, ClientWaitSync) \
  X(WAITSYNC, WaitSync) X(DELETESYNC, DeleteSync)

#define UNSHOT_GL_FUNCTIONS(X) \
  UNSHOT_GL_ERRORS_STATE(X) \
  UNSHOT_GL_FIXED_FUNCTION_STATE(X) \
  UNSHOT_GL_BUFFERS(X) \
  UNSHOT_GL_VERTEX_ARRAYS(X) \
  UNSHOT_GL_TEXTURES_SAMPLERS(X) \
  UNSHOT_GL_FRAMEBUFFERS(X) \
  UNSHOT_GL_PROGRAMS(X) \
  UNSHOT_GL_DRAWING(X) \
  UNSHOT_GL_QUERIES_FENCES(X)
// clang-format on

// Functions of later versions: null in contexts without them.
// clang-format off
#define UNSHOT_GL_OPTIONAL_FUNCTIONS(X) \
  X(CLIPCONTROL, ClipControl, 45, "GL_ARB_clip_control")
// clang-format on

/// Looks one function up by its full name ("glClear"); null where there is none.
using Loader = std::function<void*(const char*)>;

/// One function table: `fn.BindBuffer(...)`. Callable only on the thread where its context is current.
struct Functions {
#define UNSHOT_GL_MEMBER(TYPE, NAME) PFNGL##TYPE##PROC NAME = nullptr;
  UNSHOT_GL_FUNCTIONS(UNSHOT_GL_MEMBER)
#undef UNSHOT_GL_MEMBER
#define UNSHOT_GL_MEMBER(TYPE, NAME, VERSION, EXTENSION) PFNGL##TYPE##PROC NAME = nullptr;
  UNSHOT_GL_OPTIONAL_FUNCTIONS(UNSHOT_GL_MEMBER)
#undef UNSHOT_GL_MEMBER
};

/// Loads every function, those of later versions where the version or an extension of the current context
/// promises them (loaders give addresses for others too). Throws Error kEnvironment that names those of
/// OpenGL 3.3 that are missing.
Functions loadFunctions(const Loader& load);

}  // namespace unshot::gl
