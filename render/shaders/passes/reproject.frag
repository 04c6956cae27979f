#version 450 core
// A picture that was drawn for other eyes, moved by its depth to where these eyes see it: each pixel
// looks for the place of the old picture that is seen there (Bowles, Mitchell, Sumner, Moore and
// Gross, Iterative image warping, Computer Graphics Forum 31, 2012,
// doi:10.1111/j.1467-8659.2012.03002.x), from the nearest depth on and then from the farthest one, so
// that what is in front hides what is behind. What was hidden takes the color of what lies behind.

layout(binding = 0) uniform sampler2D colors;
layout(binding = 1) uniform sampler2D depths;         // 1: nothing was drawn
layout(location = 0) uniform mat4 now_from_then; // pixel and depth now from those then, homogeneous
layout(location = 4) uniform vec4 pixels;             // least and largest pixel of the old picture
layout(location = 5) uniform vec2 range;              // depths of the nearest and farthest cell
out vec4 color;

const int kSteps = 4;
const float kSame = 0.7; // pixels: a place so near is the one

vec3 seen_now(vec2 at, float depth) {
    vec4 place = now_from_then * vec4(at, depth, 1.0);
    return place.xyz / place.w;
}

struct Found {
    vec2 at;
    float depth; // depth in the old picture
    float seen;  // depth now
    bool is;
};

Found found_from(float depth) {
    Found found;
    vec2 at = 2.0 * gl_FragCoord.xy - seen_now(gl_FragCoord.xy, depth).xy;
    for (int i = 0; i < kSteps; ++i) {
        at = clamp(at, pixels.xy, pixels.zw);
        found.at = at;
        found.depth = texelFetch(depths, ivec2(at), 0).r;
        vec3 seen = seen_now(at, min(found.depth, range.y));
        vec2 off = gl_FragCoord.xy - seen.xy;
        found.seen = seen.z;
        found.is = max(abs(off.x), abs(off.y)) <= kSame;
        if (found.is)
            break;
        at += off;
    }
    return found;
}

void main() {
    Found found = found_from(range.x);
    if (!found.is || found.depth == 1.0) {
        Found behind = found_from(range.y);
        if (behind.is || behind.depth > found.depth)
            found = behind;
    }
    if (found.depth == 1.0)
        discard;
    color = texelFetch(colors, ivec2(found.at), 0);
    gl_FragDepth = clamp(found.seen, 0.0, 0.99999);
}
