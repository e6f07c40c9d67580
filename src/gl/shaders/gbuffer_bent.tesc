/* SPDX-License-Identifier: MIT
 *
 * Splits the edges that refraction bends. Each level depends on its edge alone, so that both triangles of an edge split it at the same points. The error of n
 * parts is 1/n² of that of one part.
 */
#include "gbuffer.glsl"

layout(vertices = 3) out;

layout(location = 0) in vec3 corner[];
layout(location = 1) in vec3 corner_image[];
layout(location = 2) flat in int corner_triangle[];
layout(location = 0) out vec3 patch_corner[];
layout(location = 1) patch out int patch_triangle;

#ifdef SOFTWARE_GL
const float MOST_PARTS = 32.0f; /* llvmpipe loses triangles that have 64 × 64 parts */
#else
const float MOST_PARTS = 64.0f;
#endif

/* Number of parts into which the edge from corner i to corner j is split. */
float parts_of_edge(int i, int j)
{
    vec3 a = corner[i], b = corner[j], image_a = corner_image[i], image_b = corner_image[j];
    float squared = edge_length_squared(0, image_a, image_b);
    if (!edge_counts(0, a, b, squared))
        return 1.0f;
    float error = edge_error_squared(0, a, b, image_a, image_b, far_image(0, scale(add(a, b), 0.5f)), squared, INFINITE);
    float parts = ceil(sqrt(sqrt(error / picture_data.error_squared)));
    /* An edge that meets the surface gets parts of about two pixels. Seen from below, its image there runs along the edge of Snell's window. With MAP_PATH,
     * paths of the same length begin there. */
    if ((refract_data.side < 0.0f || refract_data.map == MAP_PATH) && (a.y < 0.0f) != (b.y < 0.0f))
        parts = max(parts, ceil(0.5f * sqrt(squared)));
    return clamp(parts, 1.0f, MOST_PARTS);
}

void main()
{
    patch_corner[gl_InvocationID] = corner[gl_InvocationID];
    patch_triangle = corner_triangle[0];
    /* Written one by one: Mesa's llvmpipe draws nothing where the index of a level varies. */
    float parts = parts_of_edge((gl_InvocationID + 1) % 3, (gl_InvocationID + 2) % 3);
    if (gl_InvocationID == 0)
        gl_TessLevelOuter[0] = parts;
    if (gl_InvocationID == 1)
        gl_TessLevelOuter[1] = parts;
    if (gl_InvocationID == 2)
        gl_TessLevelOuter[2] = parts;
    barrier();
    if (gl_InvocationID == 0)
        gl_TessLevelInner[0] = max(gl_TessLevelOuter[0], max(gl_TessLevelOuter[1], gl_TessLevelOuter[2]));
}
