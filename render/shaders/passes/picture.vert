#version 450 core
// A rectangle in the room, as a strip of two triangles.

uniform mat4 clip_from_room;
uniform vec3 corners[4]; // lower left, upper left, upper right, lower right
out vec2 place;          // in the picture, 0 to 1

void main() {
    const int order[4] = int[4](0, 3, 1, 2);
    const vec2 places[4] = vec2[4](vec2(0, 0), vec2(0, 1), vec2(1, 1), vec2(1, 0));
    int corner = order[gl_VertexID];
    place = places[corner];
    gl_Position = clip_from_room * vec4(corners[corner], 1.0);
}
