#include "operators/dxt_operator.hpp"

#include "foundation/error.hpp"
#include "foundation/memory.hpp"
#include "operators/bounce_sums.hpp"
#include "operators/colour_certificate.hpp"
#include "operators/colour_operator.hpp"
#include "operators/compressed_kernel_operator.hpp"
#include "operators/storage_choice.hpp"
#include "operators/stored_matrix.hpp"
#include "operators/texel_order.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

struct DxtChoice {
  ColourCompressionOptions options;
  TexelOrderChoice order;
  BounceCount bounces = 1;
  bool kernel = false;

  std::string text() const;
};

struct CodecName {
  const char* name;
  TexelCodec codec;
};
constexpr CodecName codec_names[] = {{"bc1", TexelCodec::bc1}, {"bc4", TexelCodec::bc4},
                                     {"u8", TexelCodec::u8},   {"u4", TexelCodec::u4},
                                     {"f16", TexelCodec::f16}, {"bf16", TexelCodec::bf16}};

TexelCodec take_codec(Spec& spec, const std::string& fallback) {
  std::vector<std::string> names;
  for (const CodecName& known : codec_names) names.emplace_back(known.name);
  const std::string chosen = spec.choice("codec", fallback, names);
  return std::find_if(std::begin(codec_names), std::end(codec_names),
                      [&](const CodecName& known) { return chosen == known.name; })
      ->codec;
}

std::string name_of(TexelCodec codec) {
  return std::find_if(std::begin(codec_names), std::end(codec_names),
                      [&](const CodecName& known) { return codec == known.codec; })
      ->name;
}

DxtChoice take_choice(Spec& spec) {
  DxtChoice choice;
  choice.bounces = take_bounces(spec, "bounces", 1);
  choice.kernel = spec.choice("matrix", "colour", {"colour", "kernel"}) == "kernel";
  choice.options.exact = spec.number("exact", choice.options.exact, 0, 1);
  choice.order = TexelOrderChoice::take(spec);
  choice.options.codec = take_codec(spec, choice.kernel ? "bc4" : "bc1");
  choice.options.logarithmic = spec.choice("map", "log", {"log", "linear"}) == "log";
  const bool automatic = spec.text("range", "") == "auto";
  choice.options.range = automatic ? 0 : spec.number("range", choice.options.range, 1e-3, 80);
  choice.options.fill = spec.flag("fill");
  choice.options.fit =
      spec.choice("fit", "range", {"range", "cluster"}) == "cluster" ? Bc1Fit::cluster : Bc1Fit::range;
  spec.finish();
  if (choice.kernel && choice.bounces != 1L)
    fail<UsageError>("'{}': the kernel that all channels share knows one bounce: take matrix=colour",
                     spec.text());
  if (choice.kernel && choice.options.codec == TexelCodec::bc1)
    fail<UsageError>("'{}': BC1 holds three channels, and the kernel is one matrix: take codec=bc4",
                     spec.text());
  return choice;
}

std::string DxtChoice::text() const {
  std::string spec =
      fmt::format("dxt:bounces={},exact={},{},codec={},range={},fill={}", bounce_text(bounces), options.exact,
                  order.text(), name_of(options.codec),
                  options.range == 0 ? "auto" : fmt::format("{}", options.range), options.fill ? 1 : 0);
  if (kernel) spec += ",matrix=kernel";
  if (!options.logarithmic) spec += ",map=linear";
  if (options.fit == Bc1Fit::cluster) spec += ",fit=cluster";
  return spec;
}

/// The document's matrices, one a channel, in float.
std::vector<ColourMatrix> colour_matrices(const FormFactors& form_factors, const Eigen::MatrixXd& colours,
                                          const BounceCount& bounces) {
  std::vector<ColourMatrix> matrices;
  const Eigen::MatrixXd& reflectance = form_factors.mesh->reflectance;
  const Eigen::MatrixXd F = form_factors.matrix();
  for (Index channel = 0; channel < reflectance.cols(); ++channel)
    matrices.emplace_back(
        bounce_sum(F, reflectance.col(channel), colours.col(channel), bounces).cast<float>());
  return matrices;
}

class DxtOperator final : public ColourOperator, public HasCompressedColours {
 public:
  DxtOperator(const FormFactors& form_factors, const DxtChoice& choice, CompressedColours compressed,
              Certificate certificate)
      : ColourOperator(form_factors, choice.bounces != 1L),
        spec_(choice.text()),
        mesh_(form_factors.mesh),
        compressed_(std::move(compressed)),
        certificate_(std::move(certificate)) {}

  ByteCount bytes() const override {
    ByteCount bytes{compressed_.byte_parts()};
    bytes.parts.emplace_back("diagonals", diagonal_bytes(size(), channels()));
    return bytes;
  }
  std::string describe() const override { return spec_; }
  const CompressedColours& compressed_colours() const override { return compressed_; }
  const Eigen::VectorXd& area() const override { return mesh_->area; }
  Certificate certificate() const override { return certificate_; }
  double product_roundoff() const override { return 0x1p-24; }

 protected:
  void multiply_colours(const ConstFieldRef& X, FieldRef Y) const override { compressed_.multiply(X, Y); }
  void multiply_colours_transposed(const ConstFieldRef& X, FieldRef Y) const override {
    compressed_.multiply_transposed(X, Y);
  }

 private:
  std::string spec_;
  std::shared_ptr<const PatchMesh> mesh_;
  CompressedColours compressed_;
  Certificate certificate_;
};

std::unique_ptr<LinearOperator> compress_colour(const DxtChoice& choice, const FormFactors& form_factors) {
  const PatchMesh& mesh = *form_factors.mesh;
  const auto n = static_cast<double>(mesh.patch_count());
  const double in_float = sizeof(float) * n * n * static_cast<double>(mesh.channels());
  require_available_memory(fmt::format("{} of {} patches", choice.text(), mesh.patch_count()),
                           bounce_sum_bytes(mesh.patch_count(), choice.bounces) + in_float,
                           "take fewer patches, or matrix=kernel, which takes less");
  const Eigen::MatrixXd colours = sender_colours(mesh.reflectance);
  const std::vector<ColourMatrix> matrices = colour_matrices(form_factors, colours, choice.bounces);
  CompressedColours compressed =
      compress_colours(matrices, choice.options, make_texel_order(choice.order, mesh));
  Certificate certificate;
  if (choice.bounces == 1L)
    certificate = colour_certificate(compressed, matrices, mesh.reflectance, colours, mesh.area);
  return std::make_unique<DxtOperator>(form_factors, choice, std::move(compressed), std::move(certificate));
}

}  // namespace

std::unique_ptr<LinearOperator> make_dxt_operator(Spec& spec, const FormFactors& form_factors) {
  const DxtChoice choice = take_choice(spec);
  if (!choice.kernel) return compress_colour(choice, form_factors);
  return make_compressed_kernel(choice.options, make_texel_order(choice.order, *form_factors.mesh),
                                choice.text(), form_factors);
}

}  // namespace radiosity
