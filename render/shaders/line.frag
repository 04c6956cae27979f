#version 450 core
// A line with soft edges: opacity falls to zero over its outermost pixel.

layout(std140, binding = 0) uniform Frame {
    mat4 clip_from_model;
    vec4 size;
};

noperspective in float across;
flat in vec4 color;
out vec4 result;

void main() {
    float alpha = color.a * clamp(size.z - abs(across), 0.0, 1.0);
    if (alpha < size.w)
        discard;
    result = vec4(color.rgb * alpha, alpha);
}
