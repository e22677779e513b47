#pragma once

#include "form_factors/patch_geometry.hpp"
#include "form_factors/shaft.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace radiosity {

/// A set of blockers, one bit each.
class BlockerSet {
 public:
  static constexpr std::size_t capacity = 256;

  void add(std::size_t b) { words_[b / 64] |= std::uint64_t{1} << (b % 64); }

  bool has(std::size_t b) const { return (words_[b / 64] >> (b % 64)) & 1U; }

  bool empty() const {
    std::uint64_t any = 0;
    for (const std::uint64_t word : words_) any |= word;
    return any == 0;
  }

  BlockerSet& operator&=(const BlockerSet& other) {
    for (std::size_t w = 0; w < words_.size(); ++w) words_[w] &= other.words_[w];
    return *this;
  }
  BlockerSet& operator|=(const BlockerSet& other) {
    for (std::size_t w = 0; w < words_.size(); ++w) words_[w] |= other.words_[w];
    return *this;
  }
  /// Takes out the members that both other sets have.
  BlockerSet& remove_common(const BlockerSet& a, const BlockerSet& b) {
    for (std::size_t w = 0; w < words_.size(); ++w) words_[w] &= ~(a.words_[w] & b.words_[w]);
    return *this;
  }

  /// Calls visit(b) for each member in rising order until it returns false.
  template <typename Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t w = 0; w < words_.size(); ++w)
      for (std::uint64_t bits = words_[w]; bits != 0; bits &= bits - 1)
        if (!visit(64 * w + static_cast<std::size_t>(__builtin_ctzll(bits)))) return;
  }

 private:
  std::array<std::uint64_t, capacity / 64> words_{};
};

/// Where blockers stand as seen from one end of a shaft, and the end as seen from them.
struct BlockerSides {
  BlockerSet ahead;  ///< not wholly behind the end's plane
  BlockerSet above;  ///< blockers whose plane has the end wholly on its front (or touching)
  BlockerSet below;  ///< ... on its back

  /// Blockers that may come between two ends as far as planes tell: ahead of both, and not with both on one
  /// side.
  friend BlockerSet between(const BlockerSides& first, const BlockerSides& second) {
    BlockerSet set = first.ahead;
    set &= second.ahead;
    set.remove_common(first.above, second.above);
    set.remove_common(first.below, second.below);
    return set;
  }
};

/// The sides of every patch and of every cluster, so that most blockers of a pair are ruled out with a few
/// bit operations.
class BlockerSideTable {
 public:
  /// Empty if there are more than BlockerSet::capacity blockers.
  BlockerSideTable(const PatchGeometry& geometry, const std::vector<Blocker>& blockers);

  bool empty() const { return patches_.empty(); }
  const BlockerSides& patch(int i) const { return patches_[static_cast<std::size_t>(i)]; }
  const BlockerSides& cluster(const PatchCluster& cluster) const {
    return clusters_[static_cast<std::size_t>(cluster.number)];
  }

 private:
  std::vector<BlockerSides> patches_, clusters_;
};

}  // namespace radiosity
