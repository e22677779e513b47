// Four rows of SUMS columns, of which LANES of the INVOCATIONS of a work group have summed up a part each, side by side.
// The file that reads this has write_sum.
void write_sum(uint column, uint row, float sum);

#if LANES > 1
shared vec4 lane_sums[SUMS][INVOCATIONS];
#endif

void write_four_rows(vec4 sum[SUMS], bool present, uint first_row) {
#if LANES > 1
  uint place = gl_LocalInvocationID.x;
  uint lane = place % LANES;
  for (uint c = 0; c < SUMS; ++c) lane_sums[c][place] = sum[c];
  for (uint width = LANES / 2; width > 0; width /= 2) {
    barrier();
    if (lane < width)
      for (uint c = 0; c < SUMS; ++c) lane_sums[c][place] += lane_sums[c][place + width];
  }
  barrier();
  if (present && lane < 4 * SUMS)
    write_sum(lane / 4, first_row + lane % 4, lane_sums[lane / 4][place - lane][lane % 4]);
#else
  if (present)
    for (uint c = 0; c < SUMS; ++c)
      for (uint r = 0; r < 4; ++r) write_sum(c, first_row + r, sum[c][r]);
#endif
}
