// overlap_columns from a function lanes_overlapping(block, lower, upper): a bit for each lane of `block` that overlaps the
// box from lower[0], lower[kStride], lower[2 kStride] to upper[...].

static std::uint32_t overlap_columns(const Block& a, const Block& b, std::uint16_t* columns) {
  // Most boxes of two neighbouring blocks lie clear of the other block as a whole.
  std::uint32_t candidates = lanes_overlapping<1>(a, b.bounds_lower, b.bounds_upper);
  if (candidates == 0) return 0;
  const std::uint32_t allowed = lanes_overlapping<1>(b, a.bounds_lower, a.bounds_upper);
  if (allowed == 0) return 0;
  std::uint32_t rows = 0;
  for (; candidates != 0; candidates &= candidates - 1) {
    const int lane = __builtin_ctz(candidates);
    const std::uint32_t hits = allowed & lanes_overlapping<kLanes>(b, &a.lower[0][lane], &a.upper[0][lane]);
    if (hits == 0) continue;
    columns[lane] = static_cast<std::uint16_t>(hits);
    rows |= 1u << lane;
  }
  return rows;
}
