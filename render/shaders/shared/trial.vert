#version 450 core
// Fills the viewport, or two at once, to test whether the driver can.
void main() {
#ifdef TWO_EYES
    gl_ViewportIndex = gl_InstanceID;
#endif
    gl_Position = vec4(4.0 * float(gl_VertexID & 1) - 1.0, 4.0 * float(gl_VertexID >> 1) - 1.0, 0.0, 1.0);
}
