#version 450 core
// Gives every cell its normal: the mean of its vertices' central differences, as
// index::shade_cells defines it.
#ifndef BRICKS
#define BRICKS samplerBuffer
#endif
#include "volume_bricks.glsl"
#include "work.glsl"
#include "slots.glsl"

// Rounded halves away from zero, into ten bits.
uint ten_bits(float component) {
    return uint(int(component * 511.0 + (component < 0.0 ? -0.5 : 0.5))) & 0x3ffu;
}

void main() {
    uint slot = my_work();
    if (slot >= work.y)
        return;
    ivec3 cell = cell_of(slot);
    read_around(cell);
    vec2 wx = difference_weights(cell.x, vertices.x);
    vec2 wy = difference_weights(cell.y, vertices.y);
    vec2 wz = difference_weights(cell.z, vertices.z);
    // Differences first and sums of them then: values may be large and close to each other.
    vec2 x = wx * ((row_11.zw - row_11.xy) + (row_21.zw - row_21.xy) +
                   (row_12.zw - row_12.xy) + (row_22.zw - row_22.xy));
    vec2 y = wy.x * ((row_21.yz - row_01) + (row_22.yz - row_02)) +
             wy.y * ((row_31 - row_11.yz) + (row_32 - row_12.yz));
    vec2 z = wz.x * ((row_12.yz - row_10) + (row_22.yz - row_20)) +
             wz.y * ((row_13 - row_11.yz) + (row_23 - row_21.yz));
    vec3 d = vec3(x.x + x.y, y.x + y.y, z.x + z.y);
    float most = max(max(abs(d.x), abs(d.y)), abs(d.z));
    uint word = 0u;
    if (is_finite(d) && most > 0.0) {
        d /= most; // no square may overflow or vanish
        vec3 n = vec3(dot(from_difference_x.xyz, d), dot(from_difference_y.xyz, d),
                      dot(from_difference_z.xyz, d));
        n /= sqrt(dot(n, n));
        word = ten_bits(n.x) | ten_bits(n.y) << 10 | ten_bits(n.z) << 20;
    }
    points[3u * slot + 2u] = word;
}
