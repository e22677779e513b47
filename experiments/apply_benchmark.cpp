#include "experiments/apply_benchmark.hpp"

#include "experiments/machine.hpp"
#include "experiments/read_stream.hpp"
#include "experiments/synthetic_form_factors.hpp"
#include "experiments/taking_turns.hpp"
#include "factorizations/blas_threads.hpp"
#include "foundation/error.hpp"
#include "foundation/memory.hpp"
#include "foundation/parallel.hpp"

#include <cblas.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <memory>
#include <ostream>

namespace radiosity {
namespace {

class Contest {
 public:
  Contest(const OperatorRegistry& registry, const ApplyBenchmarkOptions& options)
      : n_(options.size),
        form_factors_(synthetic_form_factors(n_)),
        single_(n_, n_),
        double_(n_, n_),
        stream_(options.stream_bytes) {
    single_.setConstant(1e-3F);
    double_.setConstant(1e-3);
    competitors_.push_back(
        {"read", 0, stream_.quarter_bytes(), [this] { stream_.read_quarter(); }, ReadStream::quarters});
    for (const Index columns : options.columns) add_libraries(columns);
    for (const std::string& spec : specs(registry, options)) {
      operators_.push_back(registry.make(spec, form_factors_));
      for (const Index columns : options.columns) add_operator(*operators_.back(), spec, columns);
    }
  }

  ApplyBenchmark run(double seconds) {
    ApplyBenchmark result;
    result.size = n_;
    result.threads = ThreadLimit::current();
    result.load_before = load_average();
    const BlasThreads blas_threads(result.threads);
    result.repetitions = take_turns(competitors_, seconds);
    result.load_after = load_average();
    if (!operators_.empty()) result.device = operators_.front()->device_use();
    fill_rows(result);
    return result;
  }

 private:
  static std::vector<std::string> specs(const OperatorRegistry& registry,
                                        const ApplyBenchmarkOptions& options) {
    if (!options.operators.empty()) return options.operators;
    std::vector<std::string> all;
    for (const OperatorEntry& entry : registry.entries()) {
      if (entry.cubic) continue;
      all.push_back(entry.defaults);
      all.insert(all.end(), entry.variants.begin(), entry.variants.end());
    }
    return all;
  }

  void add_libraries(Index columns) {
    const auto entries = static_cast<std::size_t>(n_ * n_);
    const auto n = static_cast<int>(n_);
    auto x32 = std::make_shared<Eigen::MatrixXf>(Eigen::MatrixXf::Ones(n_, columns));
    auto y32 = std::make_shared<Eigen::MatrixXf>(n_, columns);
    if (columns == 1) {
      auto x64 = std::make_shared<Eigen::VectorXd>(Eigen::VectorXd::Ones(n_));
      auto y64 = std::make_shared<Eigen::VectorXd>(n_);
      competitors_.push_back({"OpenBLAS sgemv", 1, entries * sizeof(float), [=, this] {
                                cblas_sgemv(CblasColMajor, CblasTrans, n, n, 1, single_.data(), n,
                                            x32->data(), 1, 0, y32->data(), 1);
                              }});
      competitors_.push_back({"OpenBLAS dgemv", 1, entries * sizeof(double), [=, this] {
                                cblas_dgemv(CblasColMajor, CblasTrans, n, n, 1, double_.data(), n,
                                            x64->data(), 1, 0, y64->data(), 1);
                              }});
      competitors_.push_back({"Eigen float", 1, entries * sizeof(float),
                              [=, this] { y32->col(0).noalias() = single_.transpose() * x32->col(0); }});
    } else {
      const auto c = static_cast<int>(columns);
      competitors_.push_back({"OpenBLAS sgemm", columns, entries * sizeof(float), [=, this] {
                                cblas_sgemm(CblasColMajor, CblasTrans, CblasNoTrans, n, c, n, 1,
                                            single_.data(), n, x32->data(), n, 0, y32->data(), n);
                              }});
      competitors_.push_back({"Eigen float", columns, entries * sizeof(float),
                              [=, this] { y32->noalias() = single_.transpose() * *x32; }});
    }
  }

  void add_operator(const LinearOperator& transport, const std::string& spec, Index columns) {
    auto X = std::make_shared<Field>(Field::Ones(n_, columns));
    auto Y = std::make_shared<Field>(n_, columns);
    competitors_.push_back(
        {spec, columns, transport.bytes().total(), [&transport, X, Y] { transport.apply(*X, *Y); }});
  }

  void fill_rows(ApplyBenchmark& result) const {
    double sgemv = 0;
    for (const Competitor& competitor : competitors_) {
      const double fastest = competitor.seconds_min();
      if (competitor.name == "read") {
        result.read_bandwidth_gb_s = competitor.gigabytes_per_second();
        continue;
      }
      if (competitor.name == "OpenBLAS sgemv") sgemv = fastest;
      result.rows.push_back({competitor.name, competitor.columns, competitor.bytes, fastest,
                             competitor.seconds_median(),
                             competitor.gigabytes_per_second() / result.read_bandwidth_gb_s,
                             sgemv * static_cast<double>(competitor.columns) / fastest});
    }
  }

  Index n_;
  FormFactors form_factors_;
  Eigen::MatrixXf single_;
  Eigen::MatrixXd double_;
  ReadStream stream_;
  std::vector<std::unique_ptr<LinearOperator>> operators_;
  std::vector<Competitor> competitors_;
};

void check_options(const ApplyBenchmarkOptions& options) {
  if (options.size < 1 || options.size > 1 << 20)
    fail<UsageError>("a benchmark of {} patches: choose 1 to {}", options.size, 1 << 20);
  if (!(options.seconds > 0))
    fail<UsageError>("a benchmark of {} s: give it a positive time", options.seconds);
  for (const Index columns : options.columns)
    if (columns < 1) fail<UsageError>("a benchmark with {} columns: choose at least 1", columns);
  // Double and float for the libraries (12 bytes an entry), the kernel and its copies (8), csr (12).
  const double needed = 32.0 * static_cast<double>(options.size) * static_cast<double>(options.size) +
                        static_cast<double>(options.stream_bytes);
  const double free = available_memory();
  if (needed > free)
    fail("a benchmark of {} patches needs {:.1f} GB and {:.1f} GB are free: choose fewer patches",
         options.size, 1e-9 * needed, 1e-9 * free);
}

}  // namespace

std::vector<ApplyBenchmark> benchmark_apply(const OperatorRegistry& registry,
                                            const ApplyBenchmarkOptions& options) {
  check_options(options);
  ApplyBenchmarkOptions wanted = options;
  // Ratios are to sgemv, which is timed with one column.
  if (std::find(wanted.columns.begin(), wanted.columns.end(), 1) == wanted.columns.end())
    wanted.columns.insert(wanted.columns.begin(), 1);
  std::sort(wanted.columns.begin(), wanted.columns.end());
  Contest contest(registry, wanted);
  std::vector<ApplyBenchmark> results;
  for (const int threads : options.threads) {
    const ThreadLimit limit(threads);
    results.push_back(contest.run(options.seconds));
  }
  return results;
}

void print_apply_benchmark(const std::vector<ApplyBenchmark>& results, std::ostream& out) {
  for (const ApplyBenchmark& result : results) {
    fmt::print(out,
               "n = {}, {} thread{}, {} repetitions, load {:.1f} to {:.1f}, read bandwidth {:.1f} GB/s\n",
               result.size, result.threads, result.threads == 1 ? "" : "s", result.repetitions,
               result.load_before, result.load_after, result.read_bandwidth_gb_s);
    if (result.device)
      fmt::print(out, "device {}: {}{}\n", result.device->name, result.device->renderer,
                 result.device->software ? " (a software renderer: it computes on the CPU)" : "");
    fmt::print(out, "  {:<18} {:>7} {:>9} {:>9} {:>9} {:>14} {:>14}\n", "product", "columns", "MB", "min ms",
               "median ms", "of bandwidth", "x sgemv/column");
    for (const ApplyBenchmarkRow& row : result.rows)
      fmt::print(out, "  {:<16} {:>7} {:>9.1f} {:>9.2f} {:>9.2f} {:>14.2f} {:>14.2f}\n", row.name,
                 row.columns, 1e-6 * static_cast<double>(row.bytes), 1e3 * row.seconds_min,
                 1e3 * row.seconds_median, row.bandwidth_fraction, row.sgemv_ratio);
  }
}

}  // namespace radiosity
