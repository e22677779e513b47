// Every product kernel with every instruction set that this machine has, at a size that fits a cache and at
// one that does not:
//   radiosity_product_benchmarks --benchmark_filter=f16
// `radiosity bench apply` compares whole operators with the machine's bandwidth and with OpenBLAS; this is
// for work on one kernel.
#include "kernels/products.hpp"

#include "kernels/stored_number.hpp"

#include <benchmark/benchmark.h>

#include <string>

namespace radiosity {
namespace {

template <typename Stored>
SymmetricTiles<Stored> filled_tiles(Index n) {
  SymmetricTiles<Stored> tiles(n, [](Index, Index) { return true; });
  for (Index tile = 0; tile < tiles.tile_count(); ++tile)
    for (Index k = 0; k < SymmetricTiles<Stored>::tile_entries; ++k)
      tiles.tile_data(tile)[k] = round_to<Stored>(1.0 / static_cast<double>(n + k));
  return tiles;
}

template <typename Stored>
void symmetric_product(benchmark::State& state, Index n, Index columns, InstructionSet instructions) {
  const SymmetricTiles<Stored> K = filled_tiles<Stored>(n);
  const Eigen::MatrixXd X = Eigen::MatrixXd::Ones(n, columns);
  Eigen::MatrixXd Y(n, columns);
  for (auto _ : state) {
    multiply(K, X, Y, instructions);
    benchmark::DoNotOptimize(Y.data());
  }
  const auto bytes =
      sizeof(Stored) * static_cast<std::size_t>(K.tile_count() * SymmetricTiles<Stored>::tile_entries);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
}

template <typename Stored>
void add(const std::string& storage) {
  for (const InstructionSet instructions : available_instruction_sets())
    for (const Index n : {512, 8192})
      for (const Index columns : {1, 3, 8})
        benchmark::RegisterBenchmark(("symmetric/" + storage + "/" + std::string(name(instructions)) +
                                      "/n:" + std::to_string(n) + "/columns:" + std::to_string(columns))
                                         .c_str(),
                                     symmetric_product<Stored>, n, columns, instructions)
            ->UseRealTime()
            ->Unit(benchmark::kMicrosecond);
}

}  // namespace
}  // namespace radiosity

int main(int argc, char** argv) {
  radiosity::add<double>("f64");
  radiosity::add<float>("f32");
  radiosity::add<radiosity::Half>("f16");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
