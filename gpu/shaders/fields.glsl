// One invocation for each number of some fields, whose columns lie one after the other, each padded with zeros to
// `stride`, a multiple of 64: a work group is in one column.
layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Diagonals { float diagonals[]; };  // left, right, weight: channels x stride

uniform uint stride;
uniform uint columns;
uniform uint channels;

uint field_column() {
  return group_index() / (stride / 64);
}

uint field_place() {
  return group_index() * 64 + gl_LocalInvocationID.x;
}

// Of diagonal `which` in this row, for the channel of this column.
float diagonal(uint which) {
  uint channel = field_column() % channels;
  return diagonals[(which * channels + channel) * stride + field_place() % stride];
}

#if SUMS > 0 && !SHARED
// For drivers that compute on the CPU, where shared memory and barriers cost more than all the rest.
layout(std430, binding = 7) writeonly buffer Sums { float number_sums[]; };  // SUMS of each number of the fields

void add_up(float values[SUMS]) {
  for (uint s = 0; s < SUMS; ++s) number_sums[field_place() * SUMS + s] = values[s];
}
#elif SUMS > 0
layout(std430, binding = 7) writeonly buffer Sums { float group_sums[]; };  // SUMS of each work group
shared float lane_sums[SUMS][64];

void add_up(float values[SUMS]) {
  uint lane = gl_LocalInvocationID.x;
  for (uint s = 0; s < SUMS; ++s) lane_sums[s][lane] = values[s];
  for (uint width = 32; width > 0; width /= 2) {
    barrier();
    if (lane < width)
      for (uint s = 0; s < SUMS; ++s) lane_sums[s][lane] += lane_sums[s][lane + width];
  }
  barrier();
  if (lane < SUMS) group_sums[group_index() * SUMS + lane] = lane_sums[lane][0];
}
#endif
