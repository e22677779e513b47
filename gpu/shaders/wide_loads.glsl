// For drivers that compute on the CPU: those load lane by lane, so that few and wide loads are what counts. Doubles are
// but bits here, two floats each.
vec4 four_floats(dvec2 bits) {
  return vec4(uintBitsToFloat(unpackDouble2x32(bits.x)), uintBitsToFloat(unpackDouble2x32(bits.y)));
}
