#include "foundation/parallel.hpp"
#include "kernels/exact_rows.hpp"
#include "product_reference.hpp"

namespace radiosity {
namespace {

std::vector<ExactRows::Row> sparse_rows(Index rows, Index columns, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<ExactRows::Row> all(static_cast<std::size_t>(rows));
  for (ExactRows::Row& row : all)
    for (Index j = static_cast<Index>(random.below(30)); j < columns;
         j += 1 + static_cast<Index>(random.below(60))) {
      row.column.push_back(static_cast<std::int32_t>(j));
      row.value.push_back(static_cast<float>(random.uniform(0, 1)));
    }
  return all;
}

TEST(ExactRows, MultiplyAsTheirFullMatrix) {
  // 70000 columns need 32 bits each.
  for (const auto& [m, n] : {std::pair<Index, Index>{0, 0}, {1, 1}, {200, 300}, {3, 70000}}) {
    const ExactRows M(n, sparse_rows(m, n, 81));
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> full(m, n);
    full.setZero();
    for (Index i = 0; i < m; ++i) M.add_row(i, full.row(i).data());
    const Eigen::VectorXd x = random_matrix(n, 1, 82), z = random_matrix(m, 1, 83);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(m), w = Eigen::VectorXd::Zero(n);
    M.add_product(2, x, y);
    M.add_transposed_product(2, z, w);
    EXPECT_TRUE(within_product_bound(full, 2 * x, y, 0x1p-50));
    EXPECT_TRUE(within_product_bound(full.transpose(), 2 * z, w, 0x1p-50));
    Eigen::VectorXd added = y;
    M.add_product(-2, x, added);
    EXPECT_EQ(added, Eigen::VectorXd::Zero(m));
    EXPECT_EQ(M.value_bytes() / 4 * (n > 65536 ? 4u : 2u) + 8u * static_cast<std::size_t>(m + 1),
              M.index_bytes());
  }
}

TEST(ExactRows, DoNotDependOnThreads) {
  const ExactRows M(900, sparse_rows(700, 900, 84));
  const Eigen::VectorXd x = random_matrix(900, 1, 85), z = random_matrix(700, 1, 86);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(700), w = Eigen::VectorXd::Zero(900);
  M.add_product(1, x, y);
  M.add_transposed_product(1, z, w);
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    Eigen::VectorXd again = Eigen::VectorXd::Zero(700), transposed = Eigen::VectorXd::Zero(900);
    M.add_product(1, x, again);
    M.add_transposed_product(1, z, transposed);
    EXPECT_EQ(y, again);
    EXPECT_EQ(w, transposed);
  }
}

}  // namespace
}  // namespace radiosity
