#version 450 core
// A line with soft edges: coverage falls to zero over the outermost half pixel on each side.

layout(std140, binding = 0) uniform Frame {
    mat4 clip_from_model;
    vec4 size;
};

in float across_w;
flat in vec4 color;
out vec4 result;

void main() {
    float coverage = clamp(2.0 * (size.z - abs(across_w * gl_FragCoord.w)), 0.0, 1.0);
    if (coverage < size.w)
        discard;
    float alpha = color.a * coverage;
    result = vec4(color.rgb * alpha, alpha);
}
