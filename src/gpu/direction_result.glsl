// Writes a direction and its cone as gpu/results.glsl writes visibility (IO_DIRECTIONS).
void write_direction(ivec2 p, vec4 v) {
#ifdef TO_SCRATCH
  direction_result[p.y * view.visible_width + p.x] = v;
#else
  imageStore(direction_result, p, v);
#endif
}
