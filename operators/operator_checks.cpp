#include "operators/operator_checks.hpp"

#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "foundation/random.hpp"
#include "operators/global_operator.hpp"
#include "operators/low_rank_operator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace radiosity {
namespace {

using Exact = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Field random_field(Index rows, Index columns, std::uint64_t seed) {
  RandomStream random(seed);
  Field field(rows, columns);
  for (Index j = 0; j < columns; ++j)
    for (Index i = 0; i < rows; ++i) field(i, j) = random.uniform(-1, 1);
  return field;
}

/// The bits are the same; NaN equals itself.
bool same_bits(const Field& a, const Field& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         std::equal(a.data(), a.data() + a.size(), b.data(), [](double x, double y) {
           return x == y ? std::signbit(x) == std::signbit(y) : std::isnan(x) && std::isnan(y);
         });
}

/// The worst entry of Y against M X, M = T of the column's channel or its transpose.
struct WorstEntry {
  double ratio =
      0;  ///< of the error to (2 n u |M| + entry_error) |X|; infinite where 0 is allowed and not met
  std::string text;
};

WorstEntry compare(const OperatorReference& reference, bool transposed, const Field& X, const Field& Y) {
  const auto n = static_cast<long double>(reference.size());
  WorstEntry worst;
  for (Index j = 0; j < X.cols(); ++j) {
    const Exact& T = reference.matrix[static_cast<std::size_t>(j % reference.channels())];
    for (Index i = 0; i < T.rows(); ++i) {
      long double exact = 0;
      long double bound = 0;
      for (Index k = 0; k < T.cols(); ++k) {
        const long double entry = transposed ? T(k, i) : T(i, k);
        const long double x = X(k, j);
        exact += entry * x;
        bound += 2 * n * reference.unit_roundoff * std::fabs(entry * x);
        if (reference.entry_error.size() > 0)
          bound += (transposed ? reference.entry_error(k, i) : reference.entry_error(i, k)) * std::fabs(x);
      }
      const long double error = std::fabs(Y(i, j) - exact);
      if (error == 0) continue;
      double ratio = static_cast<double>(error / bound);
      if (!(ratio >= 0)) ratio = std::numeric_limits<double>::infinity();  // NaN
      if (ratio <= worst.ratio) continue;
      worst.ratio = ratio;
      worst.text = fmt::format("{}: ({}, {}) is {}, should be {} within {}", transposed ? "T' X" : "T X", i,
                               j, Y(i, j), static_cast<double>(exact), static_cast<double>(bound));
    }
  }
  return worst;
}

WorstEntry worst_product(const LinearOperator& transport, const OperatorReference& reference) {
  WorstEntry worst;
  for (const Index fields : {1, 2}) {
    const Field X = random_field(transport.size(), fields * transport.channels(), 51);
    Field Y(X.rows(), X.cols());
    transport.apply(X, Y);
    const WorstEntry found = compare(reference, false, X, Y);
    if (found.ratio > worst.ratio) worst = found;
  }
  return worst;
}

/// An upper bound of the spectral norm of |T|.
double absolute_norm(const Exact& T) {
  if (T.size() == 0) return 0;
  const auto magnitudes = T.cwiseAbs();
  return static_cast<double>(
      std::sqrt(magnitudes.rowwise().sum().maxCoeff() * magnitudes.colwise().sum().maxCoeff()));
}

bool refused(const LinearOperator& transport, const ConstFieldRef& X, FieldRef Y) {
  try {
    transport.apply(X, Y);
  } catch (const UsageError&) {
    return true;
  }
  return false;
}

/// Trial fields for one channel of an operator and its true T.
class ChannelTrials {
 public:
  ChannelTrials(const LinearOperator& transport, const Exact& truth, Index channel,
                const Eigen::VectorXd& root_area)
      : transport_(transport), truth_(truth), channel_(channel), root_area_(root_area) {}

  /// Collatz and Wielandt: (A x)_i / x_i over the support of x >= 0 is nowhere above rho(A), for A >= 0.
  double smallest_spectral_radius() const {
    Eigen::VectorXd x = Eigen::VectorXd::Ones(truth_.rows());
    double radius = 0;
    for (int iteration = 0; iteration < 30 && x.norm() > 0; ++iteration) {
      const Eigen::VectorXd y = product(x / x.norm());
      if (y.size() > 0 && y.minCoeff() < 0) return radius;
      double smallest = std::numeric_limits<double>::infinity();
      for (Index i = 0; i < y.size(); ++i)
        if (x[i] > 0) smallest = std::min(smallest, y[i] * x.norm() / x[i]);
      radius = std::max(radius, smallest);
      x = y;
    }
    return radius;
  }

  /// ||T|| in the area norm, from below, by power iteration on M' M with M = A^{1/2} T A^{-1/2}.
  double norm() const {
    const Eigen::MatrixXd M =
        root_area_.asDiagonal() * truth_.cast<double>() * root_area_.cwiseInverse().asDiagonal();
    Eigen::VectorXd x = Eigen::VectorXd::Ones(M.cols()).normalized();
    double norm = 0;
    for (int iteration = 0; iteration < 100; ++iteration) {
      const Eigen::VectorXd y = M * x;
      norm = std::max(norm, y.norm());
      x = M.transpose() * y;
      if (x.norm() == 0) break;
      x.normalize();
    }
    return norm;
  }

  /// The largest ||(A - T) x|| / ||x|| of the trial fields.
  double largest_error() const {
    double error = 0;
    for (const Eigen::VectorXd& x : fields()) {
      const Eigen::VectorXd exact = (truth_ * x.cast<long double>()).cast<double>();
      error = std::max(
          error, root_area_.cwiseProduct(product(x) - exact).norm() / root_area_.cwiseProduct(x).norm());
    }
    return error;
  }

 private:
  std::vector<Eigen::VectorXd> fields() const {
    const Index n = truth_.rows();
    std::vector<Eigen::VectorXd> fields(20);
    for (std::size_t k = 0; k < fields.size(); ++k) fields[k] = random_field(n, 1, 58 + k).col(0);
    fields.push_back(Eigen::VectorXd::Ones(n));
    fields.push_back(Eigen::VectorXd::Unit(n, n / 3));
    Eigen::VectorXd alternating = Eigen::VectorXd::Ones(n);
    Eigen::VectorXd light = Eigen::VectorXd::Zero(n);
    for (Index i = 0; i < n; ++i) {
      if (i % 2 == 1) alternating[i] = -1;
      if (i % 10 == 0) light[i] = 1;
    }
    fields.push_back(alternating);
    fields.push_back(light);
    Eigen::VectorXd dominant = Eigen::VectorXd::Ones(n);
    for (int iteration = 0; iteration < 30; ++iteration) {
      const Eigen::VectorXd next = (truth_ * dominant.cast<long double>()).cast<double>();
      if (next.norm() == 0) break;
      dominant = next.normalized();
    }
    fields.push_back(dominant);
    return fields;
  }

  Eigen::VectorXd product(const Eigen::VectorXd& x) const {
    Field X = Field::Zero(x.size(), transport_.channels());
    X.col(channel_) = x;
    Field Y(X.rows(), X.cols());
    transport_.apply(X, Y);
    return Y.col(channel_);
  }

  const LinearOperator& transport_;
  const Exact& truth_;
  Index channel_;
  const Eigen::VectorXd& root_area_;
};

}  // namespace

double product_error_ratio(const LinearOperator& transport, const OperatorReference& reference) {
  return worst_product(transport, reference).ratio;
}

std::string check_products(const LinearOperator& transport, const OperatorReference& reference) {
  const WorstEntry worst = worst_product(transport, reference);
  return worst.ratio <= 1 ? std::string() : worst.text;
}

std::string check_transposed(const LinearOperator& transport, const OperatorReference& reference) {
  const auto* transposable = dynamic_cast<const TransposedApply*>(&transport);
  if (transposable == nullptr) return {};
  const Field X = random_field(transport.size(), transport.channels(), 52);
  const Field Y = random_field(transport.size(), transport.channels(), 53);
  Field TX(X.rows(), X.cols());
  Field TY(X.rows(), X.cols());
  transport.apply(X, TX);
  transposable->apply_transposed(1, Y, 0, TY);
  if (const WorstEntry worst = compare(reference, true, Y, TY); worst.ratio > 1) return worst.text;
  for (Index j = 0; j < X.cols(); ++j) {
    const double left = TX.col(j).dot(Y.col(j));
    const double right = X.col(j).dot(TY.col(j));
    const double bound = 4 * static_cast<double>(transport.size()) * reference.unit_roundoff *
                         X.col(j).norm() * absolute_norm(reference.matrix[static_cast<std::size_t>(j)]) *
                         Y.col(j).norm();
    if (!(std::fabs(left - right) <= bound))
      return fmt::format("<T x, y> = {} and <x, T' y> = {} differ by more than {}", left, right, bound);
  }
  return {};
}

std::string check_scaling(const LinearOperator& transport) {
  for (const Index fields : {0, 1, 3, 17}) {
    const Index columns = fields * transport.channels();
    const Field X = random_field(transport.size(), columns, 54);
    const Field before = random_field(transport.size(), columns, 55);
    const Field unread = Field::Constant(transport.size(), columns, nan);

    Field product = unread;
    transport.apply(1, X, 0, product);
    if (product.array().isNaN().any()) return "beta = 0 reads Y";

    Field Y = before;
    transport.apply(0, unread, 0.5, Y);
    if (!same_bits(Y, 0.5 * before)) return "alpha = 0 does not leave beta Y";
    Y = unread;
    transport.apply(0, unread, 0, Y);
    if ((Y.array() != 0).any()) return "alpha = beta = 0 does not leave 0";

    Y = before;
    transport.apply(2, X, -0.5, Y);
    const Eigen::ArrayXXd allowed = 0x1p-50 * (2 * product.cwiseAbs() + before.cwiseAbs()).array();
    if (!((Y - (2 * product - 0.5 * before)).array().abs() <= allowed).all())
      return fmt::format("2 T X - Y / 2 is wrong for {} columns", columns);
  }
  return {};
}

std::string check_refusals(const LinearOperator& transport) {
  const Index n = transport.size();
  const Index c = transport.channels();
  Field tall(n + 1, c);
  if (!refused(transport, Field::Zero(n + 1, c), tall)) return "fields of n + 1 rows are not refused";
  Field twice(n, 2 * c);
  if (!refused(transport, Field::Zero(n, c), twice)) return "X and Y of different widths are not refused";
  Field incomplete(n, c + 1);
  if (c > 1 && !refused(transport, Field::Zero(n, c + 1), incomplete))
    return "an incomplete set of channels is not refused";
  if (n == 0) return {};
  Field shared = Field::Zero(n, 2 * c);
  if (!refused(transport, shared, shared)) return "Y = X is not refused";
  Field wide = Field::Zero(n, 2 * c + 1);
  if (!refused(transport, wide.leftCols(2 * c), wide.rightCols(2 * c)))
    return "Y that overlaps X is not refused";
  Field apart = Field::Zero(n, 2 * c);
  if (refused(transport, apart.leftCols(c), apart.rightCols(c)))
    return "separate columns of one matrix are refused";
  return {};
}

std::string check_repeatability(const LinearOperator& transport) {
  const Field X = random_field(transport.size(), 3 * transport.channels(), 56);
  Field first(X.rows(), X.cols());
  transport.apply(X, first);
  for (const int threads : {1, 2, 8, 8}) {
    const ThreadLimit limit(threads);
    Field again(X.rows(), X.cols());
    transport.apply(X, again);
    if (!same_bits(first, again)) return fmt::format("the result differs with {} threads", threads);
  }
  return {};
}

std::string check_exact_zeros(const LinearOperator& transport, const OperatorReference& reference) {
  const Index n = transport.size();
  const Index c = transport.channels();
  const Field X = random_field(n, c, 57);
  Field plain(n, c);
  transport.apply(X, plain);
  for (Index j = 0; j < c; ++j)
    for (Index i = 0; i < n; ++i)
      if ((reference.matrix[static_cast<std::size_t>(j)].row(i).array() == 0).all() && plain(i, j) != 0)
        return fmt::format("row {} of T is zero, but ({}, {}) of T X is {}", i, i, j, plain(i, j));

  Field nothing = Field::Constant(n, c, nan);
  transport.apply(Field::Zero(n, c), nothing);
  if ((nothing.array() != 0).any()) return "T 0 is not 0";

  // Two fields, because one column has no next column to leak into.
  Field around_x = Field::Constant(n + 70, 2 * c + 2, nan);
  around_x.block(3, 1, n, 2 * c) = X.replicate(1, 2);
  Field around_y = Field::Constant(n + 70, 2 * c + 2, 0.25);
  transport.apply(around_x.block(3, 1, n, 2 * c), around_y.block(3, 1, n, 2 * c));
  if (!same_bits(around_y.block(3, 1, n, c), plain) || !same_bits(around_y.block(3, 1 + c, n, c), plain))
    return "what lies around X leaks into the result";
  around_y.block(3, 1, n, 2 * c).setConstant(0.25);
  if ((around_y.array() != 0.25).any()) return "something around Y is written";
  return {};
}

OperatorReference exact_entries(const FormFactors& form_factors) {
  OperatorReference reference;
  const PatchMesh& mesh = *form_factors.mesh;
  const Index n = form_factors.patch_count();
  for (Index channel = 0; channel < mesh.channels(); ++channel) {
    Exact& T = reference.matrix.emplace_back(n, n);
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        const long double factor = form_factors.symmetric()
                                       ? (*form_factors.kernel)(i, j) *
                                             std::sqrt(static_cast<long double>(mesh.area[j]) / mesh.area[i])
                                       : (*form_factors.unsymmetric)(i, j);
        T(i, j) = mesh.reflectance(i, channel) * factor;
      }
  }
  return reference;
}

namespace {

/// |R| |U| |V'|, n x n: the size of what cancels in the entries of R U V'. The largest over channels.
Eigen::MatrixXd factor_products(const LowRankFactors& factors, Index n) {
  Field U(n, factors.rank());
  factors.multiply_left(Field::Identity(factors.rank(), factors.rank()), U);
  Field V(factors.rank(), n);
  factors.multiply_right_transposed(Field::Identity(n, n), V);
  return factors.albedo().rowwise().maxCoeff().asDiagonal() * (U.cwiseAbs() * V.cwiseAbs());
}

}  // namespace

OperatorReference own_entries(const LinearOperator& transport) {
  const Index n = transport.size();
  const Index c = transport.channels();
  Field X = Field::Zero(n, n * c);
  for (Index k = 0; k < n; ++k) X.block(k, k * c, 1, c).setOnes();
  Field Y(n, n * c);
  transport.apply(X, Y);
  OperatorReference reference;
  reference.unit_roundoff = transport.product_roundoff();
  reference.entry_error = Eigen::MatrixXd::Zero(n, n);
  for (Index channel = 0; channel < c; ++channel) {
    Exact entries(n, n);
    for (Index k = 0; k < n; ++k) entries.col(k) = Y.col(k * c + channel).cast<long double>();
    // Each entry is a product itself, which multiplies a rounded 1 by a rounded number.
    reference.entry_error =
        reference.entry_error.cwiseMax(4 * reference.unit_roundoff * entries.cast<double>().cwiseAbs());
    reference.matrix.push_back(std::move(entries));
  }
  // Two products, by n and by k terms, of numbers that may cancel.
  if (const auto* factors = dynamic_cast<const LowRankFactors*>(&transport))
    reference.entry_error +=
        4 * static_cast<double>(n + factors->rank()) * reference.unit_roundoff * factor_products(*factors, n);
  if (const auto* global = dynamic_cast<const GlobalOperator*>(&transport))
    reference.entry_error +=
        4 * static_cast<double>(n + global->rank()) * reference.unit_roundoff * global->term_sizes();
  return reference;
}

CertificateRatio certificate_ratio(const LinearOperator& transport, const OperatorReference& reference,
                                   const Eigen::VectorXd& root_area) {
  CertificateRatio worst;
  const Certificate certificate = transport.certificate();
  if (transport.size() == 0) return worst;
  const auto ratio = [](double measured, double allowed) {
    if (measured == 0) return 0.0;
    const double quotient = measured / allowed;
    return quotient >= 0 ? quotient : std::numeric_limits<double>::infinity();
  };
  for (Index channel = 0; channel < transport.channels(); ++channel) {
    const ChannelTrials trials(transport, reference.matrix[static_cast<std::size_t>(channel)], channel,
                               root_area);
    if (certificate.spectral_radius_bound)
      worst.spectral_radius =
          std::max(worst.spectral_radius.value_or(0),
                   ratio(trials.smallest_spectral_radius(), *certificate.spectral_radius_bound));
    if (certificate.operator_error)
      worst.operator_error =
          std::max(worst.operator_error.value_or(0),
                   ratio(trials.largest_error(), *certificate.operator_error * trials.norm()));
  }
  return worst;
}

std::string check_certificate(const LinearOperator& transport, const OperatorReference& reference,
                              const Eigen::VectorXd& root_area) {
  const CertificateRatio ratio = certificate_ratio(transport, reference, root_area);
  if (!ratio.spectral_radius && !ratio.operator_error) return {};
  if (transport.certificate().method.empty()) return "the certificate does not say how it was obtained";
  if (ratio.spectral_radius.value_or(0) > 1 + 1e-6)
    return fmt::format("the spectral radius is {} of its bound", *ratio.spectral_radius);
  // The norm of T is one of its products, and so from below: the slack is for that.
  if (ratio.operator_error.value_or(0) > 1.02)
    return fmt::format("||(A - T) X|| is {} of what the certificate allows", *ratio.operator_error);
  return {};
}

std::string check_operator(const LinearOperator& transport, const OperatorReference& reference) {
  std::string failures;
  const auto note = [&](const char* check, const std::string& failure) {
    if (!failure.empty()) failures += fmt::format("{}: {}\n", check, failure);
  };
  note("products", check_products(transport, reference));
  note("transposed", check_transposed(transport, reference));
  note("scaling", check_scaling(transport));
  note("refusals", check_refusals(transport));
  note("repeatability", check_repeatability(transport));
  note("exact zeros", check_exact_zeros(transport, reference));
  return failures;
}

}  // namespace radiosity
