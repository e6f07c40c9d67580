/* SPDX-License-Identifier: MIT */
/* Which lane widths were built and can run here, and OpenGL. */
#include "kernel_probe.h"

int kernel_lane_probes(struct kernel_probe *probes)
{
    int count = 0;
    probes[count++] = kernel_probe_1();
    probes[count++] = kernel_probe_4();
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        probes[count++] = kernel_probe_8();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
        probes[count++] = kernel_probe_16();
#endif
    return count;
}

int kernel_probes(struct kernel_probe *probes)
{
    int count = kernel_lane_probes(probes);
#if defined(MGT_TEST_GL)
    count += kernel_probe_gl(&probes[count]);
#endif
    return count;
}
