#version 450 core
// A character or its halo, drawn from its coverage in the atlas; or a plain area.

layout(binding = 1) uniform sampler2D glyphs; // coverage of letters, of halos

layout(std140, binding = 0) uniform Frame {
    mat4 clip_from_model;
    vec4 size;
};

in vec2 place;
flat in vec4 color;
flat in int kind;
out vec4 result;

void main() {
    float coverage = kind < 0 ? 1.0 : texture(glyphs, place)[kind];
    if (coverage < size.w || (kind == 1 && size.w > 0.0)) // a halo hides nothing
        discard;
    float alpha = color.a * coverage;
    result = vec4(color.rgb * alpha, alpha);
}
