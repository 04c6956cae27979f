#version 450 core
// Computes every cell's plane, as index::CellPlane defines it: the normal from the mean of its
// vertices' central differences, the offset from its own values.
#ifndef BLOCKS
#define BLOCKS samplerBuffer
#endif
#include "volume_blocks.glsl"
#include "work.glsl"
#include "slots.glsl"

// Packs a coordinate of the octahedron, -1 to 1, into twelve bits.
uint coordinate(float c) { return uint(int(c * 2047.0 + 2048.5)); }
// Packs an offset of at most CellPlane::kFarthest into the highest byte.
uint byte_of(float offset) {
    float steps = clamp(offset / 0.87, -1.0, 1.0) * 127.0;
    return uint(int(steps + (steps < 0.0 ? -0.5 : 0.5))) << 24;
}

// Distance from the cell's middle at which the value, which rises along the vector of differences
// `d` per cell, reaches the isovalue [voxels].
float rise_along(vec3 d, uint slot) {
    uint surface = surface_of(slot);
    float level = levels[surface >> 2][surface & 3u];
    vec4 low = vec4(row_11.yz, row_21.yz), high = vec4(row_12.yz, row_22.yz); // x fastest
    vec4 lacking = (level - low) + (level - high);
    vec4 across = (low.yyww - low.xxzz) + (high.yyww - high.xxzz);
    vec4 up = (low.zwzw - low.xyxy) + (high.zwzw - high.xyxy);
    vec3 own = vec3(across.x + across.z, up.x + up.y, dot(high - low, vec4(1)));
    float along = dot(own, d);
    float rise = dot(lacking, vec4(1)) * sqrt(dot(d, d)) / (2.0 * along);
    return along * abs(along) > 1e-6 * dot(d, d) * dot(own, own) ? rise : 0.0;
}

void main() {
    uint slot = my_work();
    if (slot >= work.y)
        return;
    ivec3 cell = cell_of(slot);
    read_around(cell);
    Slopes along_x = slopes_along(0, cell), along_y = slopes_along(1, cell), along_z = slopes_along(2, cell);
    // Take differences before sums: values may be large and close to each other.
    vec2 x = in_row(along_x, row_11) + in_row(along_x, row_21) + in_row(along_x, row_12) + in_row(along_x, row_22);
    vec2 y = (at_low(along_y, row_01, row_11.yz, row_21.yz) + at_low(along_y, row_02, row_12.yz, row_22.yz)) +
             (at_high(along_y, row_11.yz, row_21.yz, row_31) + at_high(along_y, row_12.yz, row_22.yz, row_32));
    vec2 z = (at_low(along_z, row_10, row_11.yz, row_12.yz) + at_low(along_z, row_20, row_21.yz, row_22.yz)) +
             (at_high(along_z, row_11.yz, row_12.yz, row_13) + at_high(along_z, row_21.yz, row_22.yz, row_23));
    vec3 d = vec3(x.x + x.y, y.x + y.y, z.x + z.y);
    float most = max(max(abs(d.x), abs(d.y)), abs(d.z));
    uint word = 0u;
    if (is_finite(d) && most > 0.0) {
        d /= most; // so that squares neither overflow nor vanish
        vec3 n = vec3(dot(from_difference_x.xyz, d), dot(from_difference_y.xyz, d),
                      dot(from_difference_z.xyz, d));
        vec2 at = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
        vec2 folded = (1.0 - abs(at.yx)) * vec2(at.x < 0.0 ? -1.0 : 1.0, at.y < 0.0 ? -1.0 : 1.0);
        at = n.z < 0.0 ? folded : at;
        word = coordinate(at.x) | coordinate(at.y) << 12 | byte_of(-rise_along(cell_size(cell) * d, slot));
    }
    points[3u * slot + 2u] = word;
}
