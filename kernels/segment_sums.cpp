#include "kernels/segment_sums.hpp"

#include "foundation/parallel.hpp"
#include "kernels/product_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace radiosity {
namespace {

/// Sums that run side by side: as many as hide the latency of an addition, and as fit into the registers of
/// the smallest instruction set, which already reads faster than memory delivers.
constexpr Index sum_lanes = 16;
/// Numbers that are added up without compensation.
constexpr Index sum_run = 256;
/// How far ahead memory is asked for numbers: processors do not look beyond the page of 512 that they read.
constexpr Index fetched_ahead = 256;
/// Sorted positions that one thread adds up without a break, so that no long segment keeps it alone.
constexpr Index positions_of_a_chunk = 8192;

/// A sum that remembers what its additions rounded away (Neumaier 1974).
class CompensatedSum {
 public:
  void add(double term) {
    const double next = sum_ + term;
    lost_ += std::fabs(sum_) >= std::fabs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
  }
  void add(const CompensatedSum& other) {
    add(other.sum_);
    lost_ += other.lost_;
  }
  /// Infinite sums have lost nothing that makes sense.
  double value() const { return std::isfinite(sum_) ? sum_ + lost_ : sum_; }

 private:
  double sum_ = 0;
  double lost_ = 0;
};

/// The terms of one column of X: what V' X adds up for sorted position s.
template <bool weighted, bool ordered>
struct Terms {
  const double* x;
  const double* weight;
  const std::int32_t* order;

  double operator()(Index s) const {
    const double value = ordered ? x[order[s]] : x[s];
    return weighted ? weight[s] * value : value;
  }

  /// Sums that are never indexed by what the compiler does not know, or they would leave the registers.
  template <Index lanes>
  double sum_by_lanes(Index begin, Index end) const {
    double sums[lanes] = {};
    for (Index s = begin; s < end; s += lanes) {
      if constexpr (lanes == sum_lanes && !ordered)
        for (Index k = 0; k < lanes; k += 8) __builtin_prefetch(x + s + k + fetched_ahead);
      for (Index k = 0; k < lanes; ++k) sums[k] += (*this)(s + k);
    }
    for (Index half = lanes / 2; half > 0; half /= 2)
      for (Index k = 0; k < half; ++k) sums[k] += sums[k + half];
    return sums[0];
  }

  double sum_of_run(Index begin, Index end) const {
    const Index wide = begin + (end - begin) / sum_lanes * sum_lanes;
    const Index narrow = wide + (end - wide) / 4 * 4;
    double sum = wide > begin ? sum_by_lanes<sum_lanes>(begin, wide) : 0;
    if (narrow > wide) sum += sum_by_lanes<4>(wide, narrow);
    for (Index s = narrow; s < end; ++s) sum += (*this)(s);
    return sum;
  }

  CompensatedSum sum(Index begin, Index end) const {
    CompensatedSum total;
    for (Index s = begin; s < end; s += sum_run) total.add(sum_of_run(s, std::min(s + sum_run, end)));
    return total;
  }
};

/// Calls body(Terms) for a column of X.
template <typename Body>
void with_terms(const Segments& V, RowOrder rows, const double* x, const Body& body) {
  const double* weight = V.weights().data();
  const std::int32_t* order = V.order().data();
  const bool ordered = rows == RowOrder::scene && !V.order().empty();
  if (V.weights().empty())
    ordered ? body(Terms<false, true>{x, weight, order}) : body(Terms<false, false>{x, weight, order});
  else
    ordered ? body(Terms<true, true>{x, weight, order}) : body(Terms<true, false>{x, weight, order});
}

/// The chunk's share of segments that it does not hold whole, one column: of the one that began before it and
/// of the one that goes on behind it.
struct LooseEnds {
  CompensatedSum head;
  CompensatedSum tail;
};

/// Sorted positions by chunks, cut at fixed places; at least one chunk.
class Chunks {
 public:
  explicit Chunks(const Segments& V) : V_(V) {}

  Index count() const {
    return std::max<Index>((V_.rows() + positions_of_a_chunk - 1) / positions_of_a_chunk, 1);
  }
  Index begin(Index chunk) const { return chunk * positions_of_a_chunk; }
  Index end(Index chunk) const { return std::min(begin(chunk + 1), V_.rows()); }
  /// The segments that begin in the chunk are first_segment(chunk) ... first_segment(chunk + 1) - 1. Those
  /// that begin where the last chunk ends are empty, and the last chunk's.
  Index first_segment(Index chunk) const {
    if (chunk == count()) return V_.count();
    const auto offsets = V_.offsets().begin();
    return std::lower_bound(offsets, offsets + V_.count(), begin(chunk)) - offsets;
  }

  /// Calls body(chunk) for each; few chunks are not worth waking threads.
  template <typename Body>
  void for_each(const Body& body) const {
    if (count() <= 2)
      for (Index chunk = 0; chunk < count(); ++chunk) body(chunk);
    else
      parallel_for(static_cast<std::size_t>(count()),
                   [&](std::size_t chunk) { body(static_cast<Index>(chunk)); });
  }

 private:
  const Segments& V_;
};

/// V' X by chunks of sorted positions.
class ChunkedSums {
 public:
  ChunkedSums(const Segments& V, RowOrder rows, const ConstFieldRef& X, FieldRef C)
      : V_(V),
        rows_(rows),
        X_(X),
        C_(C),
        chunks_(V),
        ends_(static_cast<std::size_t>(chunks_.count() * X.cols())) {}

  void run() {
    chunks_.for_each([&](Index chunk) {
      for (Index c = 0; c < X_.cols(); ++c)
        with_terms(V_, rows_, X_.col(c).data(),
                   [&](const auto& terms) { add_column(chunk, terms, C_.col(c).data(), ends(chunk, c)); });
    });
    for (Index chunk = 0; chunk + 1 < chunks_.count(); ++chunk) join_from(chunk);
  }

 private:
  /// Writes the sums of segments that lie in the chunk and keeps the others' shares.
  template <typename ColumnTerms>
  void add_column(Index chunk, const ColumnTerms& terms, double* sums, LooseEnds& loose) const {
    const Index end = chunks_.end(chunk);
    const Index last = chunks_.first_segment(chunk + 1);
    Index p = chunks_.first_segment(chunk);
    loose.head = terms.sum(chunks_.begin(chunk), p == V_.count() ? end : std::min(begin_of(p), end));
    for (; p < last && end_of(p) <= end; ++p) sums[p] = terms.sum(begin_of(p), end_of(p)).value();
    if (p < last) loose.tail = terms.sum(begin_of(p), end);
  }

  /// Writes the sums of the segment that crosses from the chunk in which it begins into the next.
  void join_from(Index chunk) {
    const Index p = chunks_.first_segment(chunk + 1) - 1;
    if (p < chunks_.first_segment(chunk) || end_of(p) <= chunks_.end(chunk)) return;
    for (Index c = 0; c < X_.cols(); ++c) {
      CompensatedSum total = ends(chunk, c).tail;
      for (Index next = chunk + 1; next < chunks_.count() && chunks_.begin(next) < end_of(p); ++next)
        total.add(ends(next, c).head);
      C_(p, c) = total.value();
    }
  }

  Index begin_of(Index p) const { return V_.offsets()[static_cast<std::size_t>(p)]; }
  Index end_of(Index p) const { return V_.offsets()[static_cast<std::size_t>(p) + 1]; }
  LooseEnds& ends(Index chunk, Index c) { return ends_[static_cast<std::size_t>(chunk * X_.cols() + c)]; }

  const Segments& V_;
  RowOrder rows_;
  const ConstFieldRef& X_;
  FieldRef C_;
  Chunks chunks_;
  std::vector<LooseEnds> ends_;
};

}  // namespace

void segment_sums(const Segments& V, const ConstFieldRef& X, FieldRef C, RowOrder rows) {
  check_product_shapes(V.count(), V.rows(), X, C);
  ChunkedSums(V, rows, X, C).run();
}

void spread_segments(const Segments& V, const ConstFieldRef& C, FieldRef Y, RowOrder rows) {
  check_product_shapes(V.rows(), V.count(), C, Y);
  const bool ordered = rows == RowOrder::scene && !V.order().empty();
  const Chunks chunks(V);
  chunks.for_each([&](Index chunk) {
    const auto end = static_cast<std::size_t>(chunks.end(chunk));
    // The segment that holds the chunk's first position: the last to begin there or before.
    const auto first = std::upper_bound(V.offsets().begin(), V.offsets().end(), chunks.begin(chunk));
    auto p = static_cast<std::size_t>(first - V.offsets().begin()) - 1;
    for (auto s = static_cast<std::size_t>(chunks.begin(chunk)); s < end; ++p)
      for (const auto last = std::min(end, static_cast<std::size_t>(V.offsets()[p + 1])); s < last; ++s) {
        const Index row = ordered ? V.order()[s] : static_cast<Index>(s);
        const double weight = V.weights().empty() ? 1 : V.weights()[s];
        for (Index c = 0; c < C.cols(); ++c) Y(row, c) = weight * C(static_cast<Index>(p), c);
      }
  });
}

}  // namespace radiosity
