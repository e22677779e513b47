#include "apps/memory_need.hpp"

#include "foundation/parallel.hpp"
#include "kernels/symmetric_tiles.hpp"

#include <fmt/format.h>

#include <array>
#include <numeric>
#include <unistd.h>

namespace radiosity {
namespace {

/// Whether a corner of patch j lies in front of the plane of patch i; `slack` is a length.
bool reaches_front(const PatchMesh& mesh, Index i, Index j, double slack) {
  const Patch& other = mesh.patches[static_cast<std::size_t>(j)];
  for (int k = 0; k < other.corner_count; ++k)
    if (mesh.normal.col(i).dot(mesh.corner(j, k) - mesh.centroid.col(i)) > slack) return true;
  return false;
}

double tiled_entries(Index n) {
  const Index tile_rows = (n + SymmetricTiles<double>::tile_size - 1) / SymmetricTiles<double>::tile_size;
  return 0.5 * static_cast<double>(tile_rows) * static_cast<double>(tile_rows + 1) *
         static_cast<double>(SymmetricTiles<double>::tile_entries);
}

}  // namespace

double machine_memory() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

double form_factor_bytes(Index patch_count, FormFactorMethod method) {
  const auto n = static_cast<double>(patch_count);
  return method == FormFactorMethod::gather ? 8 * n * n : 8 * tiled_entries(patch_count);
}

std::uint64_t facing_pairs(const PatchMesh& mesh) {
  const Index n = mesh.patch_count();
  const double slack =
      1e-9 * (mesh.centroid.rowwise().maxCoeff() - mesh.centroid.rowwise().minCoeff()).norm();
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(n), 0);
  parallel_for(
      static_cast<std::size_t>(n),
      [&](std::size_t row) {
        const auto i = static_cast<Index>(row);
        for (Index j = i + 1; j < n; ++j)
          if (reaches_front(mesh, i, j, slack) && reaches_front(mesh, j, i, slack)) ++counts[row];
      },
      16);
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

std::vector<MemoryNeed> memory_needs(const PatchMesh& mesh) {
  const double tiled = tiled_entries(mesh.patch_count());
  const double entries = 2 * static_cast<double>(facing_pairs(mesh));
  const double rows = 8 * static_cast<double>(mesh.patch_count() + 1);
  return {{"dense:f64", 8 * tiled},
          {"dense:f32", 4 * tiled},
          {"dense:f16", 2 * tiled},
          {"csr:f64", 12 * entries + rows},
          {"csr:f32", 8 * entries + rows}};
}

std::string byte_text(double bytes) {
  constexpr std::array units = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  std::size_t unit = 0;
  while (bytes >= 1000 && unit + 1 < units.size()) {
    bytes /= 1000;
    ++unit;
  }
  return unit == 0 ? fmt::format("{:.0f} bytes", bytes) : fmt::format("{:.3g} {}", bytes, units[unit]);
}

}  // namespace radiosity
