#pragma once

#include "factorizations/matrix_products.hpp"

#include <cstdint>
#include <vector>

namespace radiosity {

/// S' A for a random S of m x s with s = `rows` normal columns, or A itself where s >= m: s x n. Whatever is
/// estimated from it of lengths in A has a relative standard error of about sqrt(1 / (2 s)).
Eigen::MatrixXd row_sketch(const MatrixProducts& A, Eigen::Index rows, std::uint64_t seed);

/// The first `count` columns that QR with column pivoting picks, judged by a sketch of count + max(10, count
/// / 4) rows (Duersch and Gu 2017, "Randomized QR with column pivoting", without their updates): products
/// with A' instead of the n x n factorization. Fewer where A has a rank below `count` (1e-10). Deterministic
/// for a seed.
std::vector<Eigen::Index> leading_columns(const MatrixProducts& A, Eigen::Index count, std::uint64_t seed);

}  // namespace radiosity
