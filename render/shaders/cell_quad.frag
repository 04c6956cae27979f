#version 450 core
// A fast quad: one flat colour, corners and all.

flat in vec4 shaded;
out vec4 result;

void main() {
    result = vec4(shaded.rgb, 1.0);
}
