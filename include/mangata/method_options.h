/* SPDX-License-Identifier: MIT
 *
 * Options of single methods that kernels read as they stand: one line each, from which follow the member of mgt_quality (a double), the member of the
 * kernels' FrameData (a float), and the row that command lines, scene files, hashes and the viewer read. A template, for C and GLSL: define
 * MGT_METHOD_OPTION(name, method, least, most, preset, meaning) before including it. New lines go to the end. Meanings hold neither commas nor
 * quotes.
 */
#ifndef MGT_METHOD_OPTION
#define MGT_METHOD_OPTION(name, method, least, most, preset, meaning)
#endif

/* clang-format off */
MGT_METHOD_OPTION(roughness_floor, MGT_METHOD_GGX_MOMENTS, 0, 1, 0, least GGX alpha along any direction)
MGT_METHOD_OPTION(light_cells, MGT_METHOD_REFERENCE, 0, 4096, 0, cells of the water a pixel and time sample in which mirrored lights are looked for on their own; 0: by the rays alone)
/* clang-format on */

#undef MGT_METHOD_OPTION
