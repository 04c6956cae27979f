#version 450 core
// The nearest layer of each surface that light shines through, laid over the picture in the order of
// their depths. What lies behind them, the surfaces' far sides, is taken to look as they do, in
// the opposite order.

#include "srgb.glsl"

layout(binding = 0) uniform sampler2D colors[LAYERS]; // opacity 1 where it is covered, else 0
layout(binding = LAYERS) uniform sampler2D depths[LAYERS];
layout(location = 0) uniform float opacities[LAYERS];
layout(location = LAYERS) uniform bool linear_light;
out vec4 result; // pre-multiplied

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 near_first[LAYERS];
    float depth[LAYERS];
    int count = 0;
    for (int i = 0; i < LAYERS; ++i) {
        vec4 color = texelFetch(colors[i], at, 0);
        if (color.a == 0.0)
            continue;
        float mine = texelFetch(depths[i], at, 0).r;
        int place = count++;
        for (; place > 0 && depth[place - 1] > mine; --place) {
            near_first[place] = near_first[place - 1];
            depth[place] = depth[place - 1];
        }
        near_first[place] = vec4(linear_light ? color.rgb : srgb_from_linear(color.rgb), opacities[i]);
        depth[place] = mine;
    }
    if (count == 0)
        discard;
    vec3 light = vec3(0.0);
    float through = 1.0;
    for (int i = 0; i < 2 * count; ++i) {
        vec4 layer = near_first[i < count ? i : 2 * count - 1 - i];
        light += through * layer.a * layer.rgb;
        through *= 1.0 - layer.a;
    }
    result = vec4(light, 1.0 - through);
}
