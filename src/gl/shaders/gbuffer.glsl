/* SPDX-License-Identifier: MIT
 *
 * The drawing of a layer of objects. The framebuffer's depth is the least depth divided by the depth of the point. Its lowest row is the picture's top row.
 */
#include "kernels/common/prelude_glsl.k"
#include "kernels/refraction/refract_types.k"
#include "pass_data.k"

layout(std140, binding = 0) uniform RefractBlock { RefractData refract_data; };
layout(std140, binding = 1) uniform PictureBlock { PictureData picture_data; };
layout(std140, binding = 3) uniform GbufferBlock { GbufferData gbuffer_data; };
#define REFRACT(cx) refract_data
#define PICTURE(cx) picture_data

#include "kernels/refraction/refract_patch.k"


/* Clip coordinates of an image: column and row, both times the depth, and the depth. */
vec4 clip_of(vec3 image)
{
    /* The borders lie half a pixel outside of the outermost pixels' centres. */
    float x = (2.0f * image.x - (picture_data.left + picture_data.right) * image.z) / (picture_data.right - picture_data.left - 1.0f);
    float y = (2.0f * image.y - (picture_data.top + picture_data.bottom) * image.z) / (picture_data.bottom - picture_data.top - 1.0f);
    return vec4(x, y, picture_data.least_depth, image.z);
}

/* Clip distance: not below 0 on the layer's side of the surface and up to `crest` metres beyond it. */
float clip_distance_of(vec3 p) { return p.y * gbuffer_data.side + gbuffer_data.crest; }
