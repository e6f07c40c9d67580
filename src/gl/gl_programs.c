/* SPDX-License-Identifier: MIT
 * The programs of the passes. They are built when they are first needed, or all of them again from replaced texts. */
#include "gl/gl_programs.h"

#include <stdio.h>
#include <string.h>

enum { STAGES = 4 };

static const GLenum stage_kinds[STAGES] = {GL_VERTEX_SHADER, GL_FRAGMENT_SHADER, GL_TESS_CONTROL_SHADER, GL_TESS_EVALUATION_SHADER};

/* The texts of a program: a compute shader, or stages in the order of stage_kinds, of which those of tessellation may be missing. `kernel` is what #include
 * "method.k" stands for, `result` is what method_result is defined as; both may be NULL. */
typedef struct program_text {
    const char *name, *compute, *stages[STAGES];
    const method_row *method; /* the method that the program shades by, or NULL */
    const char *kernel, *result;
} program_text;

static const program_text program_texts[PROGRAM_METHODS] = {
    [PROGRAM_SAMPLERS] = {"samplers", "samplers.comp", {NULL}},
    [PROGRAM_TILES] = {"tiles", "tiles.comp", {NULL}},
    [PROGRAM_NODES] = {"nodes", "nodes.comp", {NULL}},
    [PROGRAM_SURFACE] = {"surface", "surface.comp", {NULL}},
    [PROGRAM_NORMAL] = {"normal", "normal.comp", {NULL}},
    [PROGRAM_LEAN_FILL] = {"lean", "lean_fill.comp", {NULL}},
    [PROGRAM_LEAN_SHRINK] = {"lean", "lean_shrink.comp", {NULL}},
    [PROGRAM_LUMA] = {"blend", "luma.comp", {NULL}},
    [PROGRAM_FXAA] = {"blend", "fxaa.comp", {NULL}},
    [PROGRAM_TAA] = {"blend", "taa.comp", {NULL}},
    [PROGRAM_GLARE_DOWN] = {"glare", "glare_down.comp", {NULL}},
    [PROGRAM_GLARE_UP] = {"glare", "glare_up.comp", {NULL}},
    [PROGRAM_DISPLAY] = {"display", "display.comp", {NULL}},
    [PROGRAM_COPY] = {"copy", "copy.comp", {NULL}},
    [PROGRAM_VIEW] = {"view", NULL, {"view.vert", "view.frag"}},
    [PROGRAM_OBJECTS] = {"refraction", "objects.comp", {NULL}},
    [PROGRAM_OBJECTS_FRONT] = {"refraction", "objects_front.comp", {NULL}},
    [PROGRAM_OBJECTS_THROUGH] = {"refraction", "objects_through.comp", {NULL}},
    [PROGRAM_OBJECTS_TRACED] = {"refraction", "objects_traced.comp", {NULL}},
    [PROGRAM_OBJECTS_PLACES] = {"refraction", "objects_places.comp", {NULL}},
    [PROGRAM_OBJECTS_MIRRORED] = {"refraction", "objects_mirrored.comp", {NULL}},
    [PROGRAM_OBJECTS_DEEP] = {"refraction", "objects_deep.comp", {NULL}},
    [PROGRAM_OBJECTS_BLEND] = {"refraction", "objects_blend.comp", {NULL}},
    [PROGRAM_OBJECTS_COMPOSE] = {"refraction", "objects_compose.comp", {NULL}},
    [PROGRAM_SLOTS_WEIGH] = {"slots", "slots_weigh.comp", {NULL}},
    [PROGRAM_SLOTS_SCAN] = {"slots", "slots_scan.comp", {NULL}},
    [PROGRAM_SLOTS_LIST] = {"slots", "slots_list.comp", {NULL}},
    [PROGRAM_SLOTS_CHUNKS] = {"slots", "slots_chunks.comp", {NULL}},
    [PROGRAM_SLOTS_TRACE] = {"slots", "slots_trace.comp", {NULL}},
    [PROGRAM_SLOTS_SUM] = {"slots", "slots_sum.comp", {NULL}},
    [PROGRAM_SLOTS_BLEND] = {"slots", "slots_blend.comp", {NULL}},
    [PROGRAM_CELLS_PLANT] = {"adaptive", "cells_plant.comp", {NULL}},
    [PROGRAM_CELLS_PLAN] = {"adaptive", "cells_plan.comp", {NULL}},
    [PROGRAM_CELLS_CHOOSE] = {"adaptive", "cells_choose.comp", {NULL}},
    [PROGRAM_CELLS_ALLOCATE] = {"adaptive", "cells_allocate.comp", {NULL}},
    [PROGRAM_CELLS_LIST] = {"adaptive", "cells_list.comp", {NULL}},
    [PROGRAM_CELLS_SORT] = {"adaptive", "cells_sort.comp", {NULL}},
    [PROGRAM_CELLS_SHADE] = {"adaptive", "cells_shade.comp", {NULL}},
    [PROGRAM_CELLS_POINTS] = {"adaptive", "cells_points.comp", {NULL}},
    [PROGRAM_CELLS_GROW] = {"adaptive", "cells_grow.comp", {NULL}},
    [PROGRAM_CELLS_CENSUS] = {"adaptive", "cells_census.comp", {NULL}},
    [PROGRAM_GBUFFER] = {"gbuffer", NULL, {"gbuffer.vert", "gbuffer.frag"}},
    [PROGRAM_GBUFFER_BENT] = {"gbuffer", NULL, {"gbuffer_bent.vert", "gbuffer.frag", "gbuffer_bent.tesc", "gbuffer_bent.tese"}},
};

enum { LOG_SIZE = 4096 };

/* ---- programs of methods ---- */

/* The shader of a slot. The first METHOD_SLOTS slots are those of methods, the others those of their variants with tables. NULL: the slot is empty. */
static const method_shader *shader_at(int slot)
{
    const size_t method = (size_t)slot % METHOD_SLOTS;
    if (method >= method_count)
        return NULL;
    const method_row *row = method_of((mgt_method)method);
    return slot < METHOD_SLOTS ? row->shader : row->with_tables;
}

gl_program gl_method_program(mgt_method method, bool tables)
{
    const int first = tables ? METHOD_SLOTS : 0;
    int slot = first;
    while (shader_at(slot) != shader_at(first + (int)method))
        slot++;
    return (gl_program)(PROGRAM_METHODS + slot);
}

/* The texts of a program, all NULL if there is no such program. */
static program_text text_of(gl_program which)
{
    if (which < PROGRAM_METHODS)
        return program_texts[which];
    const int slot = (int)which - PROGRAM_METHODS;
    const mgt_method method = (mgt_method)(slot % METHOD_SLOTS);
    const method_shader *shader = shader_at(slot);
    if (!shader || gl_method_program(method, slot >= METHOD_SLOTS) != which)
        return (program_text){0};
    const method_row *row = method_of(method);
    return (program_text){.name = row->properties.name, .compute = shader->pass, .method = row, .kernel = shader->kernel, .result = shader->result};
}

/* The #define lines that precede the texts of a program. */
typedef struct define_text {
    char text[256];
} define_text;

static const char *const water_defines[WATER_MANY_WAVES] =
    {[WATER_SINES] = "", [WATER_CHOPPY] = "#define CHOPPY_WATER\n", [WATER_FOAM] = "#define CHOPPY_WATER\n#define FOAMY_WATER\n"};

static define_text defines_of(const gl_programs *p, const program_text *t)
{
    define_text d;
    int used = snprintf(d.text, sizeof d.text, "%s%s%s", p->defines ? p->defines : "", water_defines[p->water % WATER_MANY_WAVES],
                        p->water < WATER_MANY_WAVES ? "" : "#define MANY_WAVES\n");
    if (t->result)
        used += snprintf(d.text + used, sizeof d.text - (size_t)used, "#define method_result %s\n", t->result);
    if (t->method && t->method->tables & METHOD_LEAN_MAP)
        snprintf(d.text + used, sizeof d.text - (size_t)used, "#define LEAN_MAP\n");
    return d;
}

/* ---- building ---- */

/* Reports a failure by the first error of a compiler's or linker's log. */
static mgt_status explain(const gl_source *source, const char *program, const char *log, const reporter *r)
{
    char text[REPORTER_TEXT];
    gl_source_explain(source, log, text, sizeof text);
    report(r, MGT_LOG_DEBUG, "gl.shader", "%s: %s", program, log);
    return report_error(r, MGT_ERROR_UNAVAILABLE, "gl.shader", "%s", text);
}

/* The assembled stages of a program. */
typedef struct program_source {
    program_text text;
    gl_source stages[STAGES];
    GLenum kinds[STAGES];
    int count;
} program_source;

static mgt_status assemble(const gl_programs *p, const gl_replacements *replaced, gl_program which, program_source *out, const reporter *r)
{
    *out = (program_source){.text = text_of(which)};
    const program_text *t = &out->text;
    const define_text defines = defines_of(p, t);
    const char *const *files = t->compute ? &t->compute : t->stages;
    const int most = t->compute ? 1 : STAGES;
    while (out->count < most && files[out->count]) {
        out->kinds[out->count] = t->compute ? GL_COMPUTE_SHADER : stage_kinds[out->count];
        gl_source *s = &out->stages[out->count++];
        if (gl_source_assemble(s, replaced, files[out->count - 1], t->kernel, defines.text))
            continue;
        return s->out_of_memory ? report_error(r, MGT_ERROR_MEMORY, "gl.shader", "out of memory for the text of %s", files[out->count - 1])
                                : report_error(r, MGT_ERROR_UNAVAILABLE, "gl.shader", "%s: it includes a file that does not exist", s->missing);
    }
    return MGT_OK;
}

static mgt_status compile(const gl_api *gl, GLuint program, const program_source *s, int stage, const reporter *r)
{
    const GLuint shader = gl->CreateShader(s->kinds[stage]);
    const GLchar *text = s->stages[stage].text;
    const GLint length = (GLint)s->stages[stage].length;
    gl->ShaderSource(shader, 1, &text, &length);
    gl->CompileShader(shader);
    GLint compiled = 0;
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    mgt_status status = MGT_OK;
    if (compiled) {
        gl->AttachShader(program, shader);
    } else {
        char log[LOG_SIZE] = "";
        gl->GetShaderInfoLog(shader, sizeof log, NULL, log);
        status = explain(&s->stages[stage], s->text.name, log, r);
    }
    gl->DeleteShader(shader); /* OpenGL keeps it while it is attached */
    return status;
}

static mgt_status link(const gl_api *gl, GLuint program, const program_source *s, const reporter *r)
{
    gl->LinkProgram(program);
    GLint linked = 0;
    gl->GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked)
        return MGT_OK;
    char log[LOG_SIZE] = "";
    gl->GetProgramInfoLog(program, sizeof log, NULL, log);
    return explain(&s->stages[0], s->text.name, log, r);
}

/* Builds a program. If `p` has one of the same text, `out` is that one. `out` is 0 after a failure, or if there is no such program. */
static mgt_status build(const gl_programs *p, const gl_replacements *replaced, gl_program which, GLuint *out, uint64_t *hash, const reporter *r)
{
    program_source s;
    mgt_status status = assemble(p, replaced, which, &s, r);
    *out = 0;
    *hash = 0;
    for (int i = 0; i < s.count; i++)
        *hash = *hash * 31 + gl_source_hash(&s.stages[i]);
    if (status == MGT_OK && p->of[p->water].names[which] && p->of[p->water].hashes[which] == *hash) {
        *out = p->of[p->water].names[which];
    } else if (status == MGT_OK && s.count > 0) {
        const GLuint program = p->gl->CreateProgram();
        for (int i = 0; i < s.count && status == MGT_OK; i++)
            status = compile(p->gl, program, &s, i, r);
        if (status == MGT_OK)
            status = link(p->gl, program, &s, r);
        if (status == MGT_OK)
            *out = program;
        else
            p->gl->DeleteProgram(program);
    }
    for (int i = 0; i < s.count; i++)
        gl_source_free(&s.stages[i]);
    return status;
}

GLuint gl_program_get(gl_programs *p, gl_program which, const reporter *r, mgt_status *status)
{
    GLuint *name = &p->of[p->water].names[which];
    if (*name == 0 && *status == MGT_OK)
        *status = build(p, &p->replaced, which, name, &p->of[p->water].hashes[which], r);
    return *name;
}

static void delete_programs(gl_programs *p, gl_water water)
{
    for (int i = 0; i < PROGRAM_COUNT; i++)
        if (p->of[water].names[i])
            p->gl->DeleteProgram(p->of[water].names[i]);
    memset(&p->of[water], 0, sizeof p->of[water]);
}

mgt_status gl_programs_replace(gl_programs *p, const mgt_gl_source *sources, size_t count, const reporter *r)
{
    gl_programs next = *p;
    if (!gl_replacements_copy(&next.replaced, sources, count))
        return report_error(r, MGT_ERROR_MEMORY, "gl.sources", "out of memory for %zu texts", count);
    mgt_status status = MGT_OK;
    int built = 0;
    GLuint *const old = p->of[p->water].names, *const new = next.of[p->water].names;
    for (; built < PROGRAM_COUNT && status == MGT_OK; built++)
        status = build(p, &next.replaced, (gl_program)built, &new[built], &next.of[p->water].hashes[built], r);
    const GLuint *const unused = status == MGT_OK ? old : new;
    for (int i = 0; i < built; i++)
        if (unused[i] && old[i] != new[i])
            p->gl->DeleteProgram(unused[i]);
    gl_replacements_free(status == MGT_OK ? &p->replaced : &next.replaced);
    if (status == MGT_OK) {
        *p = next;
        for (int water = 0; water < WATER_KINDS; water++)
            if (water != (int)p->water)
                delete_programs(p, (gl_water)water);
    }
    return status;
}

void gl_programs_free(gl_programs *p)
{
    for (int water = 0; water < WATER_KINDS; water++)
        delete_programs(p, (gl_water)water);
    gl_replacements_free(&p->replaced);
}
