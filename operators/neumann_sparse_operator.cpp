#include "operators/neumann_sparse_operator.hpp"

#include "foundation/error.hpp"
#include "kernels/sparse_powers.hpp"
#include "operators/distinct_reflectances.hpp"
#include "operators/reflectance.hpp"
#include "operators/stored_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

/// The entries of F that are not zero.
CsrMatrix<double> compress_form_factors(const FormFactors& form_factors) {
  if (!form_factors.symmetric()) return compress<double>(*form_factors.unsymmetric);
  const Eigen::VectorXd root_area = form_factors.mesh->area.cwiseSqrt();
  CsrMatrix<double> matrix = compress<double>(*form_factors.kernel);
  for (Index i = 0; i < matrix.rows(); ++i)
    for (auto k = static_cast<std::size_t>(matrix.row_begin[static_cast<std::size_t>(i)]);
         k < static_cast<std::size_t>(matrix.row_begin[static_cast<std::size_t>(i) + 1]); ++k)
      matrix.value[k] *= root_area[matrix.column[k]] / root_area[i];
  return matrix;
}

CsrMatrix<double> scale_rows(CsrMatrix<double> matrix, const Eigen::VectorXd& factors) {
  for (Index i = 0; i < matrix.rows(); ++i)
    for (auto k = static_cast<std::size_t>(matrix.row_begin[static_cast<std::size_t>(i)]);
         k < static_cast<std::size_t>(matrix.row_begin[static_cast<std::size_t>(i) + 1]); ++k)
      matrix.value[k] *= factors[i];
  return matrix;
}

class NeumannSparseOperator final : public LinearOperator, public HasStoredSeries {
 public:
  NeumannSparseOperator(const FormFactors& form_factors, const SparsePowersOptions& options)
      : reflectance_(form_factors.mesh->reflectance),
        options_(options),
        reflectances_(form_factors.mesh->reflectance) {
    check_reflectance(reflectance_, form_factors.patch_count());
    const CsrMatrix<double> F = compress_form_factors(form_factors);
    const Eigen::VectorXd root_area = form_factors.mesh->area.cwiseSqrt();
    for (Index distinct = 0; distinct < reflectances_.count(); ++distinct) {
      const SparsePowers powers = sum_sparse_powers(
          scale_rows(F, reflectance_.col(reflectances_.representative(distinct))), root_area, options);
      indirect_.push_back({RowGroups<float>(powers.sum), powers.powers, powers.remainder});
    }
  }

  Index size() const override { return reflectance_.rows(); }
  Index channels() const override { return reflectance_.cols(); }
  bool global() const override { return true; }

  std::vector<const RowGroups<float>*> stored_series() const override {
    std::vector<const RowGroups<float>*> series;
    for (const Series& powers : indirect_) series.push_back(&powers.sum);
    return series;
  }
  const Eigen::MatrixXd& reflectance() const override { return reflectance_; }

  ByteCount bytes() const override {
    std::size_t entries = 0;
    std::size_t indices = 0;
    for (const Series& series : indirect_) {
      entries += series.sum.value_bytes();
      indices += series.sum.index_bytes();
    }
    return {{{"entries", entries}, {"indices", indices}}};
  }

  std::string describe() const override {
    return fmt::format("neumann-sparse:threshold={},bounces={}", options_.threshold, options_.most_powers);
  }

  std::string remark() const override {
    int powers = 0;
    double kept = 0;
    double remainder = 0;
    for (const Series& series : indirect_) {
      powers = std::max(powers, series.powers);
      kept += static_cast<double>(series.sum.entries());
      remainder = std::max(remainder, series.remainder);
    }
    const double all = static_cast<double>(reflectances_.count()) * static_cast<double>(size()) *
                       static_cast<double>(size());
    std::string text =
        fmt::format("{} powers of T, {:.3g} % of the entries kept", powers, all > 0 ? 100 * kept / all : 0);
    if (remainder > 0x1p-24)
      text += fmt::format(", and further powers would add about {:.2g} of a row's norm", remainder);
    return text;
  }

 protected:
  void apply_impl(double alpha, const ConstFieldRef& X, double beta, FieldRef Y) const override {
    const Field reflected =
        reflectances_.multiply_each(X, size(), [&](Index distinct, const Field& fields, FieldRef images) {
          multiply(indirect_[static_cast<std::size_t>(distinct)].sum, fields, images);
        });
    add_answer(alpha, X, reflected, beta, Y);
  }

 private:
  /// SparsePowers, as it is multiplied with.
  struct Series {
    RowGroups<float> sum;
    int powers;
    double remainder;
  };

  Eigen::MatrixXd reflectance_;
  SparsePowersOptions options_;
  DistinctReflectances reflectances_;
  std::vector<Series> indirect_;  ///< G - I, one a distinct reflectance
};

}  // namespace

std::unique_ptr<LinearOperator> make_neumann_sparse_operator(Spec& spec, const FormFactors& form_factors) {
  SparsePowersOptions options;
  options.threshold = spec.number("threshold", 1e-5, 0, 1);
  options.most_powers = static_cast<int>(spec.integer("bounces", options.most_powers, 1, 1 << 20));
  spec.finish();
  return std::make_unique<NeumannSparseOperator>(form_factors, options);
}

}  // namespace radiosity
