#version 450 core
// Writes the changed pages of a new set of volume blocks into the page table.

#include "work.glsl"

layout(std430, binding = 0) writeonly buffer Pages { uint pages[]; };
layout(std430, binding = 1) readonly buffer Message { uvec2 message[]; }; // block id, slot

void main() {
    uint i = my_work();
    if (i < work.y)
        pages[message[i].x] = message[i].y;
}
