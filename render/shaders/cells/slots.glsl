// The cells on the GPU; needs work.glsl.

// Three words for each slot: index::CellPoint.
layout(std430, binding = 0) buffer Points { uint points[]; };

ivec3 cell_of(uint slot) {
    uint xy = points[3u * slot];
    return ivec3(xy & 0xffffu, xy >> 16, points[3u * slot + 1u] & 0xffffu);
}
uint surface_of(uint slot) { return points[3u * slot + 1u] >> 16 & 7u; }
