#pragma once

#include "form_factors/form_factors.hpp"
#include "operators/linear_operator.hpp"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

// What every operator must do, as functions that need no test framework: each returns an empty text where the
// operator passes and otherwise says what went wrong. An operator of one's own is checked the same way:
//
//   EXPECT_EQ(check_products(*mine, reference), "");

namespace radiosity {

/// What an operator is measured against.
struct OperatorReference {
  /// T of each channel, n x n, to more digits than the operator has.
  std::vector<Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>> matrix;
  /// Unit roundoff of the operator's storage.
  double unit_roundoff = 0x1p-53;
  /// An absolute error allowed to each entry of T besides (entries that underflow), n x n; empty: none.
  Eigen::MatrixXd entry_error;

  Index size() const { return matrix.front().rows(); }
  Index channels() const { return static_cast<Index>(matrix.size()); }
};

/// O1: |Y - T X| <= 2 n u |T| |X|, component by component, for fields of both signs.
std::string check_products(const LinearOperator& transport, const OperatorReference& reference);

/// The largest |Y - T X| of that check in units of its bound.
double product_error_ratio(const LinearOperator& transport, const OperatorReference& reference);

/// O1: the same for T' and <T x, y> = <x, T' y> to 4 n u ||x|| || |T| || ||y||; passes if there is no
/// transpose.
std::string check_transposed(const LinearOperator& transport, const OperatorReference& reference);

/// O2: Y = alpha T X + beta Y with beta = 0 not reading Y and alpha = 0 not reading X, for 0, 1, 3 and 17
/// fields.
std::string check_scaling(const LinearOperator& transport);

/// O2: X and Y that share memory, wrong heights and incomplete sets of channels are refused.
std::string check_refusals(const LinearOperator& transport);

/// O3: the same bits for 1, 2 and 8 threads and for repeated runs.
std::string check_repeatability(const LinearOperator& transport);

/// G8: rows without entries give exactly 0, so does X = 0; what lies around X is not read and around Y not
/// written.
std::string check_exact_zeros(const LinearOperator& transport, const OperatorReference& reference);

/// O4: ||(A - T) X|| <= operator_error ||T|| ||X|| in the area norm for 20 random fields and five hard ones
/// (constant, single patch, alternating signs, one patch in ten, dominant eigenvector), and rho(A) <=
/// spectral_radius_bound, where the certificate gives them. `root_area` = A^{1/2}.
std::string check_certificate(const LinearOperator& transport, const OperatorReference& reference,
                              const Eigen::VectorXd& root_area);

/// What that check measures in units of what the certificate allows; empty where it says nothing.
struct CertificateRatio {
  std::optional<double> spectral_radius;
  std::optional<double> operator_error;
};
CertificateRatio certificate_ratio(const LinearOperator& transport, const OperatorReference& reference,
                                   const Eigen::VectorXd& root_area);

/// T = R F of form factors in every channel, with u of double: what operators that keep every entry are
/// measured against.
OperatorReference exact_entries(const FormFactors& form_factors);

/// The operator's own entries, to the rounding of its products: what lossy operators are measured against but
/// for their certificates. n products. The entries of R U V' are allowed the rounding of |R| |U| |V'|, which
/// may be larger than they are.
OperatorReference own_entries(const LinearOperator& transport);

/// All of the above but the certificate, one line a failure.
std::string check_operator(const LinearOperator& transport, const OperatorReference& reference);

}  // namespace radiosity
