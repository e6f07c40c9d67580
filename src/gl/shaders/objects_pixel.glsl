/* SPDX-License-Identifier: MIT
 *
 * Pixels of a band that see objects: the water in them, and the lists by which one pass hands pixels on to the next ones. An entry of a list is the number of a
 * pixel in the band: tile · TILE_PIXELS + row · TILE_WIDTH + column.
 */
#include "objects_data.glsl"
#include "kernels/refraction/spread.k"
#include "kernels/refraction/edges.k"

struct PixelWater {
    float share; /* fraction of the pixel that is water; 0: the other members are not set */
    WaterHit hit;
    WaterVariation variation;
};

#ifdef LISTS_GROW
#define LIST_ACCESS
#else
#define LIST_ACCESS readonly
#endif
/* WATER_FLOATS for each pixel: PixelWater; 1 if it is in LIST_THROUGH, 2 if it is in LIST_EDGES as well; and if it is in LIST_TRACED the light that is known and
 * the rays of both branches. */
layout(std430, binding = 4) LIST_ACCESS buffer WaterBlock { float water_data[]; };

/* The lists. LIST_FRONT: pixels that an object in front of the water fills. LIST_EDGES: pixels that see edges of objects. LIST_THROUGH: pixels that see through
 * the surface. LIST_TRACED: those of LIST_THROUGH whose rays are traced. LIST_DEEP: for a camera under water, pixels that do not see the surface everywhere. */

struct ListHead {
    uint groups_x, groups_y, groups_z, count;
};
layout(std430, binding = 5) LIST_ACCESS buffer ListBlock {
    ListHead list_head[LISTS];
    uint list_entry[];
};

int band_pixels() { return pass_data.columns * pass_data.rows * TILE_PIXELS; }

bool is_through(int pixel) { return water_data[WATER_FLOATS * pixel + WATER_THROUGH] > 0.0f; }

/* Whether a pixel that looks through the surface sees an edge of an object in front, or a waterline, as well. */
bool is_at_front(int pixel) { return water_data[WATER_FLOATS * pixel + WATER_THROUGH] > 1.0f; }

PixelWater known_water(int pixel)
{
    int i = WATER_FLOATS * pixel;
    PixelWater w;
    w.share = water_data[i];
    w.hit.view = vec3(water_data[i + 1], water_data[i + 2], water_data[i + 3]);
    w.hit.along = water_data[i + 4];
    w.hit.normal = vec3(water_data[i + 5], water_data[i + 6], water_data[i + 7]);
    w.variation.bend_xx = water_data[i + 8];
    w.variation.bend_xz = water_data[i + 9];
    w.variation.bend_zz = water_data[i + 10];
    w.variation.path = vec2(water_data[i + 11], water_data[i + 12]);
    w.variation.path_along = water_data[i + 13];
    w.variation.variance_xx = water_data[i + 14];
    w.variation.variance_xz = water_data[i + 15];
    w.variation.variance_zz = water_data[i + 16];
    ivec2 at = ivec2(pixel % TILE_WIDTH, pixel / TILE_WIDTH % TILE_HEIGHT);
    int tile = pixel / (TILE_PIXELS);
    ivec2 image = (ivec2(tile % pass_data.columns, tile / pass_data.columns) + ivec2(pass_data.tile_x, pass_data.tile_y)) * ivec2(TILE_WIDTH, TILE_HEIGHT) + at;
    w.hit.column = float(image.x);
    w.hit.row = float(image.y);
    return w;
}

#ifdef LISTS_GROW
void append(int list, int pixel)
{
    uint i = atomicAdd(list_head[list].count, 1u);
    if (i % uint(LIST_GROUP) == 0u)
        atomicAdd(list_head[list].groups_x, 1u);
    list_entry[list * band_pixels() + int(i)] = uint(pixel);
}
#endif

ivec2 image_of(PixelWater w) { return ivec2(int(w.hit.column), int(w.hit.row)); }

ivec2 texel_of_image(ivec2 image) { return image - ivec2(pass_data.area_x, pass_data.area_y); }

/* The pixel of this invocation in a list; −1: the list has none for it. */
int listed_pixel(int list)
{
    uint i = gl_GlobalInvocationID.x;
    return i < list_head[list].count ? int(list_entry[list * band_pixels() + int(i)]) : -1;
}

vec3 camera_ray(ivec2 image, vec2 place) { return turned(0, layer_ray(0, float(image.x) + place.x, float(image.y) + place.y)); }

vec3 camera_position() { return vec3(narrow_data.foot_x, narrow_data.distance * narrow_data.side, narrow_data.foot_z); }

ivec2 front_texel(ivec2 image) { return image + ivec2(int(narrow_data.left), int(narrow_data.top)); }

int front_triangle_at(ivec2 at) { return texelFetch(front_triangle, at, 0).r; }

float front_depth_at(ivec2 at) { return objects_data.least_depth / texelFetch(front_depth, at, 0).r; }

/* Multiple of the camera's ray at which it meets the plane of the surface in the pixel. */
float meet_water(PixelWater w, vec3 ray)
{
    return meet_surface(0, w.share > 0.0f, turned(0, w.hit.normal), turned(0, w.hit.view), w.hit.along, ray);
}

/* The dry level of that side of a triangle that a ray meets; −inf: nothing is dry. */
float dry_level(int triangle, vec3 ray)
{
    if (objects_data.dry == 0)
        return -INFINITE;
    vec2 level = texelFetch(plane_table, objects_data.dry + triangle).xy;
    return level_faced(0, level.x, level.y, dot(texelFetch(plane_table, triangle).xyz, ray));
}

/* Whether a triangle stands in front of the water. `along` is the multiple of the camera's ray at which the ray meets the triangle. */
bool is_in_front(int triangle, float along, PixelWater w, vec3 ray)
{
    float water = meet_water(w, ray);
    return stands_in_front(0, along, water, camera_position().y + water * ray.y, dry_level(triangle, ray));
}

/* ---- surfaces of triangles ---- */

vec3 SURFACE_CORNER(int cx, int triangle, int i) { return texelFetch(vertex_table, 2 * int(texelFetch(index_table, 3 * triangle + i).r)).xyz; }

#define SURFACE_NORMAL(cx, triangle) texelFetch(plane_table, triangle).xyz
#define SURFACE_NEIGHBOUR(cx, triangle, i) texelFetch(neighbour_table, 3 * (triangle) + (i)).r

/* Invocations keep no list of triangles. */
#define SURFACE_KNOWN(cx, triangle) false
#define IS_TESTED(cx, triangle) false
#define IS_IN_LAYER(cx, layer, column, row) ((column) >= 0.0f && (row) >= 0.0f && (column) < narrow_data.columns && (row) < narrow_data.rows)
#define SHOWN_TRIANGLE(cx, layer, column, row) layer_triangle(layer, ivec2(int(column), int(row)))
#define ALONG_RAY(cx, end, nearest, i) place_along_ray(end.layer, end.from, end.direction, nearest, i)

vec2 place_along_ray(int layer, vec3 from, vec3 direction, float nearest, int i)
{
    vec3 begin = turned(0, from - vec3(narrow_data.foot_x, 0.0f, narrow_data.foot_z));
    Place p = place_along(0, layer, begin, turned(0, direction), nearest, (float(i) + 0.5f) / float(SHARP_PLACES));
    LayerPlace there = layer_place(0, p.column, p.row);
    return p.inside > 0.0f ? vec2(there.x, there.y) : vec2(-1.0f);
}

#include "kernels/refraction/shown.k"

/* ---- edges of objects in front ---- */

/* The triangle that the pixel's neighbour on the side of `place` shows; −1: none. */
int triangle_beside(ivec2 at, vec2 place)
{
    vec2 side = edge_side(0, place);
    return front_triangle_at(at + ivec2(int(side.x), int(side.y)));
}

/* What the ray of a pixel through one of its places meets of the triangles that the front layer shows there and around; triangle −1: nothing. */
FrontHit hit_at_edge(ivec2 image, vec2 place, vec3 ray)
{
    ivec2 at = front_texel(image);
    FrontHit hit = FrontHit(-1, INFINITE);
    for (int i = 0; i < 9; i++) {
        int triangle = front_triangle_at(at + ivec2(i % 3 - 1, i / 3 - 1));
        if (triangle >= 0)
            hit = nearer_hit(0, hit, triangle, facet_of(0, triangle, camera_position()), camera_position(), ray);
    }
    if (shows_pixel(0, hit, front_triangle_at(at), triangle_beside(at, place)))
        hit = FrontHit(front_triangle_at(at), front_depth_at(at));
    return hit;
}

/* Whether an object in front hides the water in a place of a pixel. `water`: of the place, or of the centre. */
bool is_hidden(ivec2 image, PixelWater water, vec2 place)
{
    vec3 ray = camera_ray(image, place);
    FrontHit hit = hit_at_edge(image, place, ray);
    return hit.triangle >= 0 && is_in_front(hit.triangle, hit.along, water, ray);
}
