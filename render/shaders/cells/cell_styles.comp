#version 450 core
// Gives every cell its style; without colors it sets all color coordinates to 0.
#include "work.glsl"
#include "slots.glsl"

layout(std430, binding = 1) readonly buffer Styles { uint styles[]; }; // two per word

void main() {
    uint slot = my_work();
    if (slot >= work.y)
        return;
    uint style = surface_of(slot);
    if (colored)
        style = styles[slot >> 1] >> (16u * (slot & 1u)) & 0xffffu;
    points[3u * slot + 1u] = points[3u * slot + 1u] & 0xffffu | style << 16;
}
