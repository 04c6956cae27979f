#version 450 core
// Green in the program that fills two viewports at once, else red.
out vec4 result;
void main() {
#ifdef TWO_EYES
    result = vec4(0, 1, 0, 1);
#else
    result = vec4(1, 0, 0, 1);
#endif
}
