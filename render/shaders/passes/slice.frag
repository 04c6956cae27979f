#version 450 core
// The color of the value at a place of a slice, trilinear in its cell; and lines where the value is
// that of a surface. A cell with a missing value is a hole.

#include "cell_place.glsl"
#include "color_map.glsl"

layout(binding = 0) uniform usamplerBuffer columns; // of each, where its run begins, and at which vertex
layout(binding = 1) uniform samplerBuffer shares;   // of values in the array's range; MISSING or more: none
const float MISSING = 1.5e38;
layout(binding = 7) uniform sampler1D map;
layout(location = 8) uniform vec3 cells;            // along the axes of the grid
layout(location = 9) uniform int axis;              // of the columns
layout(location = 10) uniform vec4 on_map;          // place = x * share + y; z: ratio; w: it has bands
layout(location = 11) uniform float half_width;     // of the lines, pixels
layout(location = 12) uniform int line_count;
layout(location = 13) uniform vec4 lines[MOST_SURFACES]; // linear light, w: their share
in vec3 even;
out vec4 result;

#ifdef UNEVEN
// The cell at an even coordinate along an axis: the last whose first vertex lies at or below it.
int cell_along(int axis, float at) {
    int low = 0, high = int(cells[axis]);
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (texelFetch(axis_table, 4 * middle)[axis] <= at)
            low = middle;
        else
            high = middle;
    }
    return low;
}
ivec3 cell_at(vec3 at) { return ivec3(cell_along(0, at.x), cell_along(1, at.y), cell_along(2, at.z)); }
#else
ivec3 cell_at(vec3 at) { return ivec3(clamp(floor(at), vec3(0.0), cells - 1.0)); }
#endif

void main() {
    ivec3 cell = cell_at(even);
    vec3 local = clamp((even - vertex_place(cell)) / cell_size(cell), 0.0, 1.0);
    int axis1 = axis == 2 ? 0 : axis + 1, axis2 = axis == 0 ? 2 : axis - 1;
    int across = int(cells[axis1]) + 1;
    int first = cell[axis2] * across + cell[axis1];
    float values[8];
    float most = 0.0;
    for (int i = 0; i < 4; ++i) {
        uvec2 column = texelFetch(columns, first + (i & 1) + (i >> 1) * across).xy;
        int at = int(column.x) + cell[axis] - int(column.y);
        values[2 * i] = texelFetch(shares, at).x;
        values[2 * i + 1] = texelFetch(shares, at + 1).x;
        most = max(most, max(values[2 * i], values[2 * i + 1]));
    }
    float along = local[axis], along1 = local[axis1], along2 = local[axis2];
    float share = mix(mix(mix(values[0], values[1], along), mix(values[2], values[3], along), along1),
                      mix(mix(values[4], values[5], along), mix(values[6], values[7], along), along1),
                      along2);
    vec2 slopes = vec2(dFdx(share), dFdy(share)); // before any invocation ends
    if (most >= MISSING)
        discard;
    vec3 color = color_on(map, on_map.x * share + on_map.y, on_map.z, on_map.w != 0.0);
    float slope = length(slopes); // per pixel
    for (int i = 0; i < line_count; ++i) {
        float distant = abs(share - lines[i].w);
        if (!(slope > 0.0) || slope > 1e3 || distant > slope * (half_width + 2.0))
            continue; // flat, or beside a hole
        float pixels = distant / slope;
        color = mix(color, vec3(0.0), 0.6 * clamp(half_width + 1.5 - pixels, 0.0, 1.0));
        color = mix(color, lines[i].rgb, clamp(half_width + 0.5 - pixels, 0.0, 1.0));
    }
    result = vec4(color, 1.0);
}
