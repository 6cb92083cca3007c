// Where results go: to the frame's images or, in the form of a shader that has TO_SCRATCH defined, to
// scratch memory at the same bindings, for a pass that goes on with them. A shader says
// VISIBILITY_BINDING and, if it gives directions, DIRECTIONS_BINDING.
#ifdef TO_SCRATCH
layout(binding = VISIBILITY_BINDING) writeonly buffer VisibilityResult { float visibility_result[]; };
void write_visibility(ivec2 p, float v) { visibility_result[p.y * view.visible_width + p.x] = v; }
#else
layout(binding = VISIBILITY_BINDING) uniform writeonly image2D visibility_result;
void write_visibility(ivec2 p, float v) { imageStore(visibility_result, p, vec4(v)); }
#endif

#ifdef DIRECTIONS_BINDING
#ifdef TO_SCRATCH
layout(binding = DIRECTIONS_BINDING) writeonly buffer DirectionResult { vec4 direction_result[]; };
void write_direction(ivec2 p, vec4 v) { direction_result[p.y * view.visible_width + p.x] = v; }
#else
layout(binding = DIRECTIONS_BINDING) uniform writeonly image2D direction_result;
void write_direction(ivec2 p, vec4 v) { imageStore(direction_result, p, v); }
#endif
#endif
