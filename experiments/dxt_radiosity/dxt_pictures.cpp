#include "experiments/dxt_radiosity/dxt_pictures.hpp"

#include "compression/largest_of_rows.hpp"
#include "compression/log_map.hpp"
#include "experiments/dxt_radiosity/bounce_methods.hpp"
#include "experiments/dxt_radiosity/colour_matrices.hpp"
#include "experiments/dxt_radiosity/improvement_steps.hpp"
#include "experiments/json_objects.hpp"
#include "experiments/low_rank_radiosity/patch_drawing.hpp"
#include "experiments/reference_solution.hpp"
#include "foundation/error.hpp"
#include "foundation/output_file.hpp"
#include "render/image_file.hpp"
#include "scene/built_in.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace radiosity {
namespace {

CodePicture in_order(const CodePicture& picture, const std::vector<Index>& order) {
  CodePicture moved;
  for (std::size_t c = 0; c < picture.size(); ++c) moved[c] = picture[c](order, order);
  return moved;
}

CodePicture codes_of_texture(const ColourTexture& texture) {
  const LogMap map(1, texture.curve().range);
  CodePicture picture;
  for (std::size_t c = 0; c < picture.size(); ++c) {
    picture[c].resize(texture.rows(), texture.columns());
    for (Index i = 0; i < texture.rows(); ++i)
      for (Index j = 0; j < texture.columns(); ++j)
        picture[c](i, j) = static_cast<std::uint8_t>(
            std::lround(map.code(static_cast<double>(texture.texel(i, j, static_cast<int>(c))))));
  }
  return picture;
}

std::uint8_t amplified(std::uint8_t code, int gain) {
  return static_cast<std::uint8_t>(std::min(255, gain * code));
}

/// Pictures side by side with a white gap, each code times `gain`.
void write_codes(const std::filesystem::path& file, const std::vector<CodePicture>& pictures, int gain) {
  constexpr Index gap = 12;
  const Index n = pictures.front()[0].rows();
  const auto count = static_cast<Index>(pictures.size());
  const Index width = count * n + (count - 1) * gap;
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(3 * width * n), 255);
  for (Index p = 0; p < count; ++p)
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j)
        for (std::size_t c = 0; c < 3; ++c)
          bytes[static_cast<std::size_t>(3 * (i * width + p * (n + gap) + j)) + c] =
              amplified(pictures[static_cast<std::size_t>(p)][c](i, j), gain);
  write_png(file, static_cast<int>(width), static_cast<int>(n), bytes);
}

CodePicture red_alone(const CodePicture& picture) {
  return {picture[0], picture[0], picture[0]};
}

/// The scene lit by both, and their difference, relative in the area norm, which is returned.
double draw_lit_scene(const std::filesystem::path& file, const FormFactors& form_factors,
                      const DxtPicturesOptions& options, const OperatorRegistry& operators,
                      Monitor& monitor) {
  const PatchMesh& mesh = *form_factors.mesh;
  Field naive, compressed;
  naive_method(form_factors, options.bounces).answer(mesh.emission, naive);
  summed_method("", fmt::format("{}:bounces={}", document_variant, options.bounces), form_factors, operators)
      .answer(mesh.emission, compressed);
  const PictureOptions size{.width = options.picture_size, .height = options.picture_size};
  std::vector<Picture> pictures = {render_picture(mesh, naive, size, monitor),
                                   render_picture(mesh, compressed, size, monitor)};
  pictures.push_back(
      render_picture(mesh, Field(options.light_gain * (naive - compressed).cwiseAbs()), size, monitor));
  expose_alike(pictures);
  write_drawing(file, side_by_side(pictures));
  return relative_errors(mesh, compressed, naive).front();
}

double mean_code(const CodePicture& picture) {
  double sum = 0;
  for (const CodeMatrix& channel : picture) sum += channel.cast<double>().mean();
  return sum / static_cast<double>(picture.size());
}

}  // namespace

CodePicture MatrixPictures::difference() const {
  CodePicture apart;
  for (std::size_t c = 0; c < apart.size(); ++c)
    apart[c] = (compressed[c].cast<int>() - reordered[c].cast<int>()).cwiseAbs().cast<std::uint8_t>();
  return apart;
}

BlockTexture<Bc1Block> block_texture(const ColourTexture& texture) {
  BlockTexture<Bc1Block> blocks{static_cast<int>(texture.columns()), static_cast<int>(texture.rows()), {}};
  for (Index row = 0; row < texture.block_rows(); ++row)
    blocks.blocks.insert(blocks.blocks.end(), texture.block_row(row),
                         texture.block_row(row) + blocks.block_columns());
  return blocks;
}

MatrixPictures matrix_pictures(const std::vector<ColourMatrix>& matrices, const PatchMesh& mesh) {
  if (matrices.size() != 3) fail<UsageError>("{} channels do not make a colour", matrices.size());
  const ColourCompressionOptions document;
  const LogMap map(1, document.range);
  MatrixPictures pictures;
  for (std::size_t c = 0; c < 3; ++c)
    pictures.before[c] = code_channel(
                             matrices[c], largest_of_rows(matrices[c], document.exact),
                             [&](double part) { return map.code(part); }, document.fill)
                             .code;
  const CompressedColours compressed = compress_colours(matrices, document, make_texel_order({}, mesh));
  pictures.reordered = in_order(pictures.before, compressed.order());
  pictures.compressed = codes_of_texture(*compressed.texture());
  pictures.texture = block_texture(*compressed.texture());
  return pictures;
}

ReportSection dxt_pictures(const std::filesystem::path& folder, const std::string& command,
                           const DxtPicturesOptions& options, const OperatorRegistry& operators,
                           Monitor& monitor) {
  make_folder(folder);
  const auto mesh = std::make_shared<const PatchMesh>(
      make_patches(built_in_scene(options.scene), {.patches = options.patches}));
  const FormFactors form_factors = compute_form_factors(mesh, {.seed = options.seed}, monitor);
  const MatrixPictures pictures = matrix_pictures(colour_form_factors(form_factors), *mesh);
  const CodePicture difference = pictures.difference();
  write_codes(folder / "dxt_order.png", {pictures.before, pictures.reordered}, 1);
  write_codes(folder / "dxt_compressed.png", {pictures.compressed}, 1);
  write_codes(folder / "dxt_difference.png", {red_alone(difference), difference}, options.difference_gain);
  write_dds(folder / "dxt_texture.dds", pictures.texture);
  const double lit = draw_lit_scene(folder / "dxt_lit.png", form_factors, options, operators, monitor);
  write_json(folder / "dxt_pictures.json", {{"scene", scene_json(*mesh)},
                                            {"mean_code", mean_code(pictures.reordered)},
                                            {"mean_difference", mean_code(difference)},
                                            {"lit_difference", lit}});

  ReportSection section{"Form factors as a compressed texture: pictures (document 000)", {}};
  section.blocks.emplace_back(png_figure(
      folder / "dxt_order.png",
      fmt::format(
          "Figures 5 and 6: codes of F^c, {} x {}, red, green and blue, without the exact 4 %: patches "
          "in the order of faces, and reordered by rows and columns.",
          mesh->patch_count(), mesh->patch_count()),
      command));
  section.blocks.emplace_back(png_figure(
      folder / "dxt_compressed.png",
      "Figure 8: the compressed matrix, decoded. Its blocks are in results/dxt_texture.dds.", command));
  section.blocks.emplace_back(png_figure(
      folder / "dxt_difference.png",
      fmt::format("Figures 9 and 10: how far codes before and after compression are apart, {} times: "
                  "red alone, and all. {:.2f} of 255 in the mean.",
                  options.difference_gain, mean_code(difference)),
      command));
  section.blocks.emplace_back(png_figure(
      folder / "dxt_lit.png",
      fmt::format(
          "{} bounces by the naive solver and by the compressed sum, and {} times what is between them: "
          "{:.2e} of the radiosity in the area norm.",
          options.bounces, options.light_gain, lit),
      command));
  return section;
}

}  // namespace radiosity
