#pragma once

#include "solvers/weighted_residual.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace radiosity {

struct ErrorCertificateOptions {
  double confidence = 0.9999;  ///< of the eigenvalue bound, over the random start
  double wanted_ratio = 3;     ///< (1 - smallest) / (1 - largest) eigenvalue left by the deflation
  Index most_vectors = 64;     ///< a channel
  std::uint64_t seed = 1;
};

/// An a posteriori bound on the error of any B~ as a solution of B = E + T B with the true kernel K: from an
/// approximate operator, a solver that was stopped early, or a guess (methods.md, "Layers": certificate;
/// docs/theory.md proves what is used).
///
/// With S = R^{1/2} K R^{1/2} and w = R^{1/2} K A^{1/2} B, (I - S)(w - w~) is a residual that one product
/// gives. Its size alone bounds the error badly where light survives many bounces (eigenvalues of S near 1:
/// one a weakly coupled room). These eigenvectors are found once (deflation), the residual along them is
/// divided by 1 - eigenvalue, and only the rest by the bound for the rest. Inexact eigenvectors are allowed
/// for. The bound is relative to the given F.
class ErrorCertificate {
 public:
  /// Finds the eigenpairs, some 10 to 100 products a channel. `truth` outlives the certificate; its
  /// reflectances are those of now.
  explicit ErrorCertificate(const KernelOperator& truth, const ErrorCertificateOptions& options = {});

  /// Bounds B~ (n x c) as an answer to E (n x c, W/m^2), at the price of one product, or two where B~ differs
  /// from E on black patches. Throws UsageError for wrong shapes.
  ErrorBound bound(const Field& emission, const Field& radiosity) const;

  /// "proved" where the row sums suffice, else "deflated", which holds with confidence().
  const std::string& kind() const { return kind_; }
  double confidence() const { return confidence_; }
  /// Eigenvectors kept, over all channels.
  Index vectors() const;
  /// Products spent so far, setup included (columns / channels).
  double products() const { return static_cast<double>(columns_) / static_cast<double>(truth_.channels()); }

 private:
  struct Channel {
    Eigen::VectorXd root;     ///< R^{1/2}, n
    Eigen::VectorXd values;   ///< theta, m
    Eigen::MatrixXd vectors;  ///< V, n x m
    double eta = 0;           ///< ||S V - V diag(theta)||
    double rest = 0;          ///< mu >= largest eigenvalue of Q S Q
    double row_bound = 0;     ///< ||S||_2 <= this
  };

  Channel examine_channel(Index channel, double row_bound, const ErrorCertificateOptions& options);
  double bound_column(const Channel& channel, const Eigen::VectorXd& residual, double rounding) const;
  void count_columns(Index columns) const { columns_ += columns; }

  const KernelOperator& truth_;
  std::vector<Channel> channels_;
  std::string kind_ = "proved";
  double confidence_ = 1;
  mutable Index columns_ = 0;
};

}  // namespace radiosity
