/* SPDX-License-Identifier: MIT
 *
 * Options of single methods, one line each. A line makes a member of mgt_quality (a double), a member of the kernels' FrameData (a float), and the row that
 * command lines, scene files, hashes and the viewer read. A template, for C and GLSL: define MGT_METHOD_OPTION(name, method, least, most, preset, meaning)
 * before including it. New lines go to the end. Meanings hold neither commas nor quotes.
 */
#ifndef MGT_METHOD_OPTION
#define MGT_METHOD_OPTION(name, method, least, most, preset, meaning)
#endif

/* clang-format off */
MGT_METHOD_OPTION(roughness_floor, MGT_METHOD_GGX_MOMENTS, 0, 1, 0, least GGX alpha along any direction)
MGT_METHOD_OPTION(light_cells, MGT_METHOD_REFERENCE, 0, 4096, 0, largest number of water cells per pixel and time sample over which mirrored lights are integrated; 0: rays alone find the lights)
/* clang-format on */

#undef MGT_METHOD_OPTION
