#include "operators/bounces_operator.hpp"

#include "foundation/memory.hpp"
#include "kernels/products.hpp"
#include "operators/bounce_sums.hpp"
#include "operators/colour_operator.hpp"
#include "operators/distinct_reflectances.hpp"
#include "operators/storage_choice.hpp"
#include "operators/stored_matrix.hpp"

#include <fmt/format.h>

#include <type_traits>
#include <vector>

namespace radiosity {
namespace {

template <typename Scalar>
class BouncesOperator final : public ColourOperator, public HasStoredColours {
 public:
  BouncesOperator(const FormFactors& form_factors, const BounceCount& bounces)
      : ColourOperator(form_factors, true), bounces_(bounces), reflectances_(reflectance()) {
    require_available_memory(
        fmt::format("bounces:k={} of {} patches", bounce_text(bounces), size()),
        bounce_sum_bytes(size(), bounces) + stored_bytes(),
        "take fewer patches, or dense with a solver, which has all bounces in its products");
    const Eigen::MatrixXd F = form_factors.matrix();
    const Eigen::MatrixXd colours = sender_colours(reflectance());
    for (Index distinct = 0; distinct < reflectances_.count(); ++distinct) {
      const Index channel = reflectances_.representative(distinct);
      sums_.emplace_back(bounce_sum(F, reflectance().col(channel), colours.col(channel), bounces));
    }
  }

  ByteCount bytes() const override {
    std::size_t entries = 0;
    for (const auto& sum : sums_) entries += sum.entry_bytes();
    return {{{"entries", entries}, {"diagonals", diagonal_bytes(size(), channels())}}};
  }
  std::string describe() const override {
    return fmt::format("bounces:k={},storage={}", bounce_text(bounces_), storage_name<Scalar>());
  }
  std::vector<StoredMatrix> stored_colours() const override {
    std::vector<StoredMatrix> matrices;
    for (const auto& sum : sums_) matrices.emplace_back(&sum);
    return matrices;
  }
  double product_roundoff() const override { return std::is_same_v<Scalar, double> ? 0x1p-53 : 0x1p-24; }

 protected:
  void multiply_colours(const ConstFieldRef& X, FieldRef Y) const override {
    Y = reflectances_.multiply_each(X, size(), [&](Index distinct, const Field& fields, FieldRef images) {
      multiply(sums_[static_cast<std::size_t>(distinct)], fields, images, instructions_);
    });
  }
  void multiply_colours_transposed(const ConstFieldRef& X, FieldRef Y) const override {
    Y = reflectances_.multiply_each(X, size(), [&](Index distinct, const Field& fields, FieldRef images) {
      multiply_transposed(sums_[static_cast<std::size_t>(distinct)], fields, images, instructions_);
    });
  }

 private:
  double stored_bytes() const {
    return static_cast<double>(sizeof(Scalar)) * static_cast<double>(reflectances_.count()) *
           static_cast<double>(size()) * static_cast<double>(size());
  }

  InstructionSet instructions_ = best_instruction_set();
  BounceCount bounces_;
  DistinctReflectances reflectances_;
  std::vector<RowMajorMatrix<Scalar>> sums_;  ///< S_k - I, one a distinct reflectance
};

}  // namespace

std::unique_ptr<LinearOperator> make_bounces_operator(Spec& spec, const FormFactors& form_factors) {
  const BounceCount bounces = take_bounces(spec, "k", 3);
  const std::string storage = spec.choice("storage", "f32", {"f64", "f32", "f16"});
  spec.finish();
  if (storage == "f64") return std::make_unique<BouncesOperator<double>>(form_factors, bounces);
  if (storage == "f16") return std::make_unique<BouncesOperator<Half>>(form_factors, bounces);
  return std::make_unique<BouncesOperator<float>>(form_factors, bounces);
}

}  // namespace radiosity
