/* SPDX-License-Identifier: MIT */
/* Words of the command line and of metadata. */
#include "cli/common/names.h"

#include <string.h>

const char isa_words[] = "auto, scalar, sse2, avx2, avx512, neon";

static const char *const backend_names[] = {[MGT_BACKEND_CPU] = "cpu", [MGT_BACKEND_GL] = "gl", [MGT_BACKEND_AUTO] = "auto", [MGT_BACKEND_NULL] = "null"};
static const char *const isa_names[] = {[MGT_ISA_AUTO] = "auto", [MGT_ISA_SCALAR] = "scalar", [MGT_ISA_SSE2] = "sse2",
                                        [MGT_ISA_AVX2] = "avx2", [MGT_ISA_AVX512] = "avx512", [MGT_ISA_NEON] = "neon"};
static const char *const layer_names[] = {[MGT_LAYER_COLOR] = "color",
                                          [MGT_LAYER_COVERAGE] = "coverage",
                                          [MGT_LAYER_MASK] = "mask",
                                          [MGT_LAYER_DEPTH] = "depth",
                                          [MGT_LAYER_NORMAL] = "normal",
                                          [MGT_LAYER_SAMPLES] = "samples",
                                          [MGT_LAYER_IMPORTANCE] = "importance",
                                          [MGT_LAYER_DETAIL] = "detail",
                                          [MGT_LAYER_REFRACTION] = "refraction",
                                          [MGT_LAYER_REFRACTION_ERROR] = "refraction_error"};

static int find(const char *name, const char *const *names, int count)
{
    for (int i = 0; i < count; i++)
        if (strcmp(name, names[i]) == 0)
            return i;
    return -1;
}

bool backend_from_name(const char *name, mgt_backend *backend)
{
    const int i = find(name, backend_names, MGT_BACKEND_NULL + 1);
    if (i >= 0)
        *backend = (mgt_backend)i;
    return i >= 0;
}

const char *backend_name(mgt_backend backend) { return backend_names[backend]; }

bool isa_from_name(const char *name, mgt_isa *isa)
{
    const int i = find(name, isa_names, MGT_ISA_NEON + 1);
    if (i >= 0)
        *isa = (mgt_isa)i;
    return i >= 0;
}

const char *isa_name(mgt_isa isa) { return isa_names[isa]; }

bool layer_from_name(const char *name, mgt_layer *layer)
{
    const int i = find(name, layer_names, LAYER_COUNT);
    if (i >= 0)
        *layer = (mgt_layer)i;
    return i >= 0;
}

const char *layer_name(mgt_layer layer) { return layer_names[layer]; }

uint32_t layer_channels(mgt_layer layer) { return layer == MGT_LAYER_COLOR || layer == MGT_LAYER_NORMAL || layer == MGT_LAYER_REFRACTION ? 3 : 1; }
