#include "experiments/low_rank_radiosity/frame_times.hpp"

#include "experiments/low_rank_radiosity/precomputed_woodbury.hpp"
#include "experiments/taking_turns.hpp"
#include "foundation/parallel.hpp"
#include "foundation/random.hpp"
#include "kernels/segment_sums.hpp"

#include <utility>

namespace radiosity {
namespace {

/// Each runs so often without a break that its fastest run finds in the caches what they can hold.
constexpr int turns_together = 4;

Eigen::MatrixXd random_emission(Index rows, Index columns) {
  Eigen::MatrixXd E(rows, columns);
  for (Index c = 0; c < columns; ++c) {
    RandomStream random(1, static_cast<std::uint64_t>(c));
    for (double& number : E.col(c)) number = random.uniform();
  }
  return E;
}

/// The products of one frame with c columns, full and sparse.
class FrameContest {
 public:
  FrameContest(const TallMatrix<float>& Y, const Segments& V, const TallMatrix<float>* full,
               ReadStream* stream, Index columns)
      : Y_(Y),
        V_(V),
        full_(full),
        E_(random_emission(Y.rows(), columns)),
        B_(Y.rows(), columns),
        X_(Y.columns(), columns) {
    add("sparse sums", 0, [this] { sparse_sums(); });
    add("sparse frame", Y.entry_bytes() + V.offset_bytes(), [this] {
      sparse_sums();
      subtract_product(Y_, X_, E_, B_);
    });
    if (full != nullptr) {
      add("full sums", full->entry_bytes(), [this] { multiply_transposed(*full_, E_, X_); });
      add("full frame", Y.entry_bytes() + full->entry_bytes(), [this] {
        multiply_transposed(*full_, E_, X_);
        subtract_product(Y_, X_, E_, B_);
      });
    }
    if (stream != nullptr) {
      add("read", stream->quarter_bytes(), [stream] { stream->read_quarter(); });
      competitors_.back().turns = ReadStream::quarters;
    }
  }
  FrameContest(const FrameContest&) = delete;
  FrameContest& operator=(const FrameContest&) = delete;

  FrameTimes run(double seconds) {
    take_turns(competitors_, seconds);
    FrameTimes times;
    times.threads = ThreadLimit::current();
    times.columns = E_.cols();
    times.sparse_sums = *timing("sparse sums");
    times.sparse_frame = *timing("sparse frame");
    times.full_sums = timing("full sums");
    times.full_frame = timing("full frame");
    if (const Competitor* read = find("read")) {
      const double bandwidth = read->gigabytes_per_second();
      times.sparse_bandwidth = find("sparse frame")->gigabytes_per_second() / bandwidth;
      if (full_ != nullptr) times.full_bandwidth = find("full frame")->gigabytes_per_second() / bandwidth;
    }
    return times;
  }

 private:
  void add(std::string name, std::size_t bytes, std::function<void()> work) {
    competitors_.push_back({std::move(name), E_.cols(), bytes, std::move(work), turns_together});
  }

  void sparse_sums() { segment_sums(V_, E_, X_, RowOrder::sorted); }

  const Competitor* find(const std::string& name) const {
    for (const Competitor& competitor : competitors_)
      if (competitor.name == name) return &competitor;
    return nullptr;
  }

  std::optional<Timing> timing(const std::string& name) const {
    const Competitor* competitor = find(name);
    if (competitor == nullptr) return std::nullopt;
    return Timing{competitor->seconds_min(), competitor->seconds_median()};
  }

  const TallMatrix<float>& Y_;
  const Segments& V_;
  const TallMatrix<float>* full_;
  Eigen::MatrixXd E_;
  Eigen::MatrixXd B_;
  Eigen::MatrixXd X_;
  std::vector<Competitor> competitors_;
};

}  // namespace

std::vector<FrameTimes> time_frames(const TallMatrix<float>& Y, const Segments& V,
                                    const TallMatrix<float>* full, ReadStream* stream, double seconds) {
  std::vector<FrameTimes> times;
  times.reserve(4);
  for (const Index columns : {1, 3}) {
    FrameContest contest(Y, V, full, stream, columns);
    for (const int threads : {1, 0}) {
      const ThreadLimit limit(threads);
      times.push_back(contest.run(seconds / 2));
    }
  }
  return times;
}

}  // namespace radiosity
