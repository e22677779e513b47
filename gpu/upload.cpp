#include "gpu/upload.hpp"

#include "foundation/error.hpp"
#include "foundation/random.hpp"
#include "foundation/spec.hpp"
#include "foundation/stopwatch.hpp"
#include "gpu/csr_on_device.hpp"
#include "gpu/dense_on_device.hpp"
#include "gpu/device_colour_operator.hpp"
#include "gpu/device_factors_operator.hpp"
#include "gpu/device_operator.hpp"
#include "gpu/device_series_operator.hpp"
#include "gpu/global_factors.hpp"
#include "gpu/low_rank_on_device.hpp"
#include "gpu/sampled_texture_on_device.hpp"
#include "gpu/sampling_difference.hpp"
#include "gpu/sparse_v_on_device.hpp"
#include "gpu/texture_on_device.hpp"
#include "gpu/tiles_on_device.hpp"
#include "gpu/two_sided_factors.hpp"
#include "operators/low_rank_operator.hpp"
#include "operators/sparse_v_operator.hpp"
#include "operators/stored_matrix.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace radiosity {
namespace {

[[noreturn]] void refuse(const std::string& spec) {
  fail<UsageError>("{} cannot run with --device gl; those that can are {}", spec,
                   fmt::join(uploadable_specs(), ", "));
}

std::string spec_on_device(const LinearOperator& original, const UploadChoice& choice) {
  std::string spec = original.describe();
  if (choice.strategy)
    spec = with_keys(spec, *choice.strategy == RowStrategy::group ? "strategy=group" : "strategy=invocation");
  if (choice.placement == Placement::hybrid) spec = with_keys(spec, "placement=hybrid");
  if (choice.blocks == BlockPlacement::texture) spec = with_keys(spec, "blocks=texture");
  return spec;
}

/// The BC1 texture of an operator that texture units are to decode. Throws UsageError, naming the spec, for
/// others.
const ColourTexture& texture_to_sample(const HasCompressedColours* stored, const std::string& spec) {
  const ColourTexture* texture = stored == nullptr ? nullptr : stored->compressed_colours().texture();
  if (texture == nullptr) fail<UsageError>("{}: blocks=texture is for BC1 blocks: take codec=bc1", spec);
  return *texture;
}

/// Copies one operator to a device, matrix by matrix.
class Uploader {
 public:
  Uploader(std::shared_ptr<GlDevice> device, const LinearOperator& original, const UploadChoice& choice)
      : device_(std::move(device)),
        original_(original),
        strategy_(choice.strategy.value_or(device_->preferred_strategy())),
        choice_(choice),
        spec_(spec_on_device(original, choice)) {}

  /// Throws UsageError for operators that have no form for the device.
  std::unique_ptr<LinearOperator> copy() const {
    if (choice_.placement == Placement::hybrid) return copy_in_two_places();
    if (choice_.blocks == BlockPlacement::texture) return copy_sampled();
    if (const auto* stored = dynamic_cast<const HasStoredMatrix*>(&original_))
      return with_diagonals(copy_stored(stored->stored()));
    if (const auto* stored = dynamic_cast<const HasStoredColours*>(&original_)) return copy_colours(*stored);
    if (const auto* stored = dynamic_cast<const HasCompressedColours*>(&original_))
      return copy_texture(*stored);
    if (const auto* stored = dynamic_cast<const HasCompressedKernel*>(&original_)) return copy_tiles(*stored);
    if (const auto* stored = dynamic_cast<const HasStoredSeries*>(&original_)) return copy_series(*stored);
    if (const auto* global = dynamic_cast<const GlobalOperator*>(&original_)) return copy_global(*global);
    if (auto factors = copy_factors<float>()) return factors;
    if (auto factors = copy_factors<double>()) return factors;
    refuse(original_.describe());
  }

 private:
  using Copy = std::unique_ptr<DeviceMatrix>;

  std::unique_ptr<LinearOperator> with_diagonals(Copy matrix) const {
    if (const auto* kernel = dynamic_cast<const KernelOperator*>(&original_))
      return std::make_unique<DeviceKernelOperator>(*kernel, std::move(matrix), origin());
    return std::make_unique<DeviceMatrixOperator>(dynamic_cast<const MatrixOperator&>(original_),
                                                  std::move(matrix), origin());
  }

  /// Nothing for operators that do not have factors of this kind.
  template <typename Scalar>
  std::unique_ptr<LinearOperator> copy_factors() const {
    if (const auto* factors = dynamic_cast<const LowRankOperator<Scalar>*>(&original_))
      return with_factors<DeviceFactorsOperator, LowRankOnDevice>(*factors, factors->left_factor(),
                                                                  factors->right_factor());
    if (const auto* factors = dynamic_cast<const SparseVOperator<Scalar>*>(&original_))
      return with_factors<DeviceFactorsOperator, SparseVOnDevice>(*factors, factors->left_factor(),
                                                                  factors->right_factor());
    if (const auto* factors = dynamic_cast<const LowRankKernelOperator<Scalar>*>(&original_))
      return with_factors<DeviceKernelFactorsOperator, LowRankOnDevice>(*factors, factors->factor(),
                                                                        factors->values());
    if (const auto* factors = dynamic_cast<const TwoSidedOperator<Scalar>*>(&original_))
      return with_factors<DeviceKernelFactorsOperator, LowRankOnDevice>(*factors, full_left_factor(*factors),
                                                                        full_right_factor(*factors));
    return nullptr;
  }

  std::unique_ptr<LinearOperator> copy_in_two_places() const {
    if (const auto* factors = dynamic_cast<const LowRankOperator<float>*>(&original_))
      return in_two_places(*factors, factors->left_factor(), factors->right_factor().clone());
    if (const auto* factors = dynamic_cast<const SparseVOperator<float>*>(&original_))
      return in_two_places(*factors, factors->left_factor(), factors->right_factor());
    fail<UsageError>("{}: placement=hybrid is for operators of low rank as U V' in float32", spec_);
  }

  std::unique_ptr<LinearOperator> in_two_places(const MatrixOperator& original, const TallMatrix<float>& left,
                                                HybridFactors::RightFactor right) const {
    auto factors = std::make_unique<HybridFactors>(device_, left, std::move(right), strategy_);
    return std::make_unique<HybridFactorsOperator>(original, std::move(factors), origin());
  }

  template <typename Operator, typename Factors, typename Original, typename Left, typename Right>
  std::unique_ptr<LinearOperator> with_factors(const Original& original, const Left& left,
                                               const Right& right) const {
    auto factors = std::make_unique<Factors>(device_, left, right, strategy_);
    return std::make_unique<Operator>(original, std::move(factors), origin());
  }

  std::unique_ptr<LinearOperator> copy_texture(const HasCompressedColours& stored) const {
    const CompressedColours& compressed = stored.compressed_colours();
    Copy matrix;
    if (compressed.texture() != nullptr)
      matrix =
          std::make_unique<TextureOnDevice>(device_, *compressed.texture(), compressed.exact(), strategy_);
    else
      matrix = std::make_unique<TilesOnDevice>(device_, *compressed.tiles(), strategy_);
    return with_order(std::move(matrix), compressed, origin());
  }

  /// What the texture units round is in its certificate, and allowed when it is compared.
  std::unique_ptr<LinearOperator> copy_sampled() const {
    const auto* stored = dynamic_cast<const HasCompressedColours*>(&original_);
    const ColourTexture& texture = texture_to_sample(stored, spec_);
    const CompressedColours& compressed = stored->compressed_colours();
    auto matrix = std::make_unique<SampledTextureOnDevice>(device_, texture, compressed.exact(), strategy_);
    DeviceOrigin sampled = origin();
    SamplingDifference difference =
        sampling_difference(texture, compressed.order(),
                            dynamic_cast<const ColourOperator&>(original_).reflectance(), stored->area());
    sampled.certificate = sampled_certificate(original_, difference, stored->area());
    sampled.decoding_difference = std::move(difference.rows);
    return with_order(std::move(matrix), compressed, std::move(sampled));
  }

  std::unique_ptr<LinearOperator> with_order(Copy matrix, const CompressedColours& compressed,
                                             DeviceOrigin origin) const {
    return std::make_unique<DeviceTextureOperator>(dynamic_cast<const ColourOperator&>(original_),
                                                   std::move(matrix), compressed.order(), std::move(origin));
  }

  std::unique_ptr<LinearOperator> copy_tiles(const HasCompressedKernel& stored) const {
    auto matrix =
        std::make_unique<TilesOnDevice>(device_, std::span(&stored.compressed_kernel(), 1), strategy_);
    return std::make_unique<DeviceKernelOperator>(dynamic_cast<const KernelOperator&>(original_),
                                                  std::move(matrix), origin(), stored.kernel_order());
  }

  std::unique_ptr<LinearOperator> copy_series(const HasStoredSeries& stored) const {
    std::vector<Copy> matrices;
    for (const RowGroups<float>* matrix : stored.stored_series()) matrices.push_back(copy_matrix(*matrix));
    return std::make_unique<DeviceSeriesOperator>(stored.reflectance(), std::move(matrices),
                                                  Eigen::VectorXd::Ones(original_.size()), origin());
  }

  std::unique_ptr<LinearOperator> copy_global(const GlobalOperator& global) const {
    GlobalFactors factors = global_factors_on_device(device_, global, strategy_);
    if (factors.products.empty()) refuse(original_.describe());
    return std::make_unique<DeviceSeriesOperator>(global.reflectance(), std::move(factors.products),
                                                  std::move(factors.before), origin());
  }

  std::unique_ptr<LinearOperator> copy_colours(const HasStoredColours& stored) const {
    std::vector<Copy> matrices;
    for (const StoredMatrix& matrix : stored.stored_colours()) matrices.push_back(copy_stored(matrix));
    return std::make_unique<DeviceBouncesOperator>(dynamic_cast<const ColourOperator&>(original_),
                                                   std::move(matrices), origin());
  }

  Copy copy_stored(const StoredMatrix& stored) const {
    return std::visit([this](const auto* matrix) { return copy_matrix(*matrix); }, stored);
  }
  template <typename Scalar>
  Copy copy_matrix(const SymmetricTiles<Scalar>& kernel) const {
    return dense(kernel);
  }
  template <typename Scalar>
  Copy copy_matrix(const RowMajorMatrix<Scalar>& matrix) const {
    return dense(matrix);
  }
  template <typename Scalar>
  Copy copy_matrix(const RowGroups<Scalar>& matrix) const {
    return std::make_unique<CsrOnDevice<Scalar>>(device_, matrix.compressed_rows(), strategy_);
  }
  template <template <typename> class Matrix, typename Scalar>
  Copy dense(const Matrix<Scalar>& matrix) const {
    return std::make_unique<DenseOnDevice<Scalar>>(device_, matrix, strategy_);
  }

  /// Called when everything is on the device.
  DeviceOrigin origin() const {
    const GlContext& context = *device_->context();
    return {spec_,
            original_.remark(),
            original_.certificate(),
            {"gl", context.renderer(), context.software(), 0, watch_.seconds(), 0},
            {}};
  }

  std::shared_ptr<GlDevice> device_;
  const LinearOperator& original_;
  RowStrategy strategy_;
  UploadChoice choice_;
  std::string spec_;
  Stopwatch watch_;
};

/// Both products are within 2 (n + 8) u |A| |X| of the true one, relative to which 1700 u allow for signs,
/// whose terms cancel.
double allowed_difference(const LinearOperator& original, const LinearOperator& copy) {
  constexpr double roundoffs_of_cancelling = 1700;  // 1e-4 in float32
  const double roundoff = std::max(original.product_roundoff(), copy.product_roundoff());
  return std::max(4 * (static_cast<double>(copy.size()) + 8), roundoffs_of_cancelling) * roundoff;
}

}  // namespace

const std::vector<std::string>& uploadable_specs() {
  static const std::vector<std::string> specs = {"dense:f64",
                                                 "dense:f32",
                                                 "dense:f16",
                                                 "csr:f64",
                                                 "csr:f32",
                                                 "quantized",
                                                 "quantized:bits=8",
                                                 "quantized:bits=2",
                                                 "topk",
                                                 "svd:k=64",
                                                 "svd:k=64,storage=f64",
                                                 "svd:k=64,global=1",
                                                 "rsvd:k=64",
                                                 "qr:k=64",
                                                 "2msc:k=64",
                                                 "2msc:k=64,sides=two",
                                                 "sparse-v:k=64",
                                                 "cur:k=64",
                                                 "wavelet:k=64",
                                                 "dct:k=64",
                                                 "neumann-sparse",
                                                 "bounces:k=3",
                                                 "dxt:codec=bc1",
                                                 "dxt:blocks=texture",
                                                 "dxt:codec=bc4",
                                                 "dxt:codec=u8",
                                                 "dxt:codec=u4",
                                                 "dxt:codec=f16",
                                                 "dxt:codec=bf16",
                                                 "dxt:matrix=kernel"};
  return specs;
}

void require_uploadable(const std::string& spec) {
  const std::string name = Spec::parse(spec).name();
  const auto& specs = uploadable_specs();
  if (std::none_of(specs.begin(), specs.end(),
                   [&](const std::string& known) { return Spec::parse(known).name() == name; }))
    refuse(spec);
}

double compare_products(const LinearOperator& original, const LinearOperator& copy,
                        const std::string& renderer, const Eigen::MatrixXd& allowed) {
  RandomStream random(1);
  const Field X = Field::NullaryExpr(original.size(), original.channels(), [&] { return random.uniform(); });
  Field Y(X.rows(), X.cols());
  Field Z(X.rows(), X.cols());
  original.apply(X, Y);
  copy.apply(X, Z);
  if (Y.size() == 0) return 0;
  const double largest = Y.cwiseAbs().maxCoeff();
  const double difference = (Z - Y).cwiseAbs().maxCoeff();
  Eigen::ArrayXXd limits =
      Eigen::ArrayXXd::Constant(Y.rows(), Y.cols(), allowed_difference(original, copy) * largest);
  if (allowed.size() > 0) limits += allowed.array();
  if (!((Z - Y).cwiseAbs().array() <= limits).all())
    fail(
        "{} on '{}' is off by {:.1e} of the CPU's product: its driver computes something else; use --device "
        "cpu",
        original.describe(), renderer, difference / largest);
  return largest == 0 ? 0 : difference / largest;
}

std::unique_ptr<LinearOperator> upload(const std::shared_ptr<GlDevice>& device,
                                       const LinearOperator& original, const UploadChoice& choice) {
  auto copy = Uploader(device, original, choice).copy();
  auto& on_device = dynamic_cast<OnDevice&>(*copy);
  on_device.set_difference(
      compare_products(original, *copy, device->context()->renderer(), on_device.decoding_difference()));
  return copy;
}

}  // namespace radiosity
