// Writes visibility to the frame's image or, in the form of the shader that has TO_SCRATCH defined,
// to scratch memory for a pass that goes on with it (IO_VISIBILITY of gpu/io.h).
void write_visibility(ivec2 p, float v) {
#ifdef TO_SCRATCH
  visibility_result[p.y * view.visible_width + p.x] = v;
#else
  imageStore(visibility_result, p, vec4(v));
#endif
}
