#version 450 core
// A corner of a triangle that stands beside the cells (index::TriangleMesh).

#include "frame.glsl"
#include "pixels.glsl"

layout(location = 0) uniform mat4 index_from_mesh;
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 physical_normal; // of any length; 0: none
out vec3 at_in_eye;
out vec3 at_in_index;
out vec3 normal; // eye space

void main() {
    vec4 at = index_from_mesh * vec4(place, 1.0);
    at_in_index = at.xyz;
    at_in_eye = (EYE(eye_from_index) * at).xyz;
    normal = mat3(EYE(eye_from_physical)) * physical_normal;
    vec4 p = to_pixels(at);
    gl_Position = vec4(p.xy * EYE(clip_per_pixel).xy, p.zw);
}
