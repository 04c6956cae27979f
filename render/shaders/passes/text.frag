#version 450 core
// A character, drawn from its coverage in the atlas.

layout(binding = 1) uniform sampler2D glyphs;

layout(std140, binding = 0) uniform Frame {
    mat4 clip_from_model;
    vec4 size;
};

in vec2 place;
flat in vec4 color;
out vec4 result;

void main() {
    float coverage = texture(glyphs, place, -0.5).r;
    if (coverage < size.w)
        discard;
    float alpha = color.a * coverage;
    result = vec4(color.rgb * alpha, alpha);
}
