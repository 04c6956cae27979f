#version 450 core
// A picture of few pixels made as large as the view. Its rim is kept: where the enlarged mask of
// what is covered is below a half, nothing is drawn, and elsewhere the color is the mean of covered
// pixels alone, so that nothing grows and no background shines through. Layers that light shines
// through are laid over the picture as they are, with a soft rim.

layout(binding = 0) uniform sampler2D picture; // opacity 1 where it is covered, all 0 elsewhere
layout(binding = 1) uniform sampler2D depths;
layout(location = 0) uniform vec4 few_from_many; // scale and offset
layout(location = 1) uniform bool layers;
out vec4 color;

void main() {
    vec2 at = gl_FragCoord.xy * few_from_many.xy + few_from_many.zw;
    vec4 mean = texture(picture, at);
    if (mean.a < (layers ? 1.0 / 255.0 : 0.5))
        discard;
    color = layers ? mean : vec4(mean.rgb / mean.a, 1.0); // pre-multiplied
    gl_FragDepth = min(texture(depths, at).r, 0.99999); // the nearest pixel may not be covered
}
