// %% [markdown]
// # From histogram to compressed product
//
// Document 000 stores form factors as a texture: each is multiplied by the colour of its sender, the largest
// are kept apart, the logarithms of the rest become codes from 0 to 255, and 4 x 4 of them share 8 bytes of
// BC1 (DXT1). This notebook takes the matrix of a Cornell box through all of its steps (Section 3.5), by
// hand, until each block is that of the library, lights the box with what is left, and then asks where the
// error comes from: not from the 4 bits a texel, but from what they are spent on.
//
// The cells below are also a program: `notebook_04_from_histogram_to_compressed_product FOLDER` writes its
// plots and pictures into FOLDER, prints what it finds, and fails if one of the facts that it states is
// wrong.

// %%
#include "compression/bc1_codec.hpp"
#include "compression/colour_codes.hpp"
#include "compression/colour_compression.hpp"
#include "compression/dds_file.hpp"
#include "compression/largest_of_rows.hpp"
#include "compression/log_map.hpp"
#include "compression/row_order.hpp"
#include "experiments/dxt_radiosity/colour_matrices.hpp"
#include "experiments/dxt_radiosity/dxt_pictures.hpp"
#include "experiments/dxt_radiosity/entry_histograms.hpp"
#include "experiments/lights.hpp"
#include "experiments/reference_solution.hpp"
#include "experiments/svg_plot.hpp"
#include "form_factors/form_factors.hpp"
#include "kernels/colour_texture.hpp"
#include "operators/colour_operator.hpp"
#include "operators/operator_registry.hpp"
#include "operators/texel_order.hpp"
#include "render/image_file.hpp"
#include "scene/built_in.hpp"
#include "scene/patch_mesh.hpp"
#include "solvers/solver_registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

using namespace radiosity;

const std::vector<std::string> channel_names = {"red", "green", "blue"};
bool all_facts_hold = true;

void state(const std::string& fact, bool holds) {
  fmt::print("{}: {}\n", holds ? "true " : "FALSE", fact);
  all_facts_hold = all_facts_hold && holds;
}

PlotSeries outline(const std::string& name, const Histogram& histogram) {
  PlotSeries series{.name = name, .points = {}, .markers = false};
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin)
    series.points.push_back(
        {histogram.centre(bin),
         100 * static_cast<double>(histogram.counts[bin]) / static_cast<double>(histogram.total()), 0, ""});
  return series;
}

/// Red, green and blue of each code, a pixel an entry, with rows and columns in an order.
void write_codes(const std::filesystem::path& file, const CodePicture& codes,
                 const std::vector<Index>& order) {
  const auto n = static_cast<int>(order.size());
  std::vector<std::uint8_t> bytes;
  for (const Index i : order)
    for (const Index j : order)
      for (const CodeMatrix& channel : codes) bytes.push_back(channel(i, j));
  write_png(file, n, n, bytes);
}

Index blocks_along(Index n) {
  return (n + ColourTexture::block_side - 1) / ColourTexture::block_side;
}

/// The codes of a block of places, in the given order of rows and columns.
Bc1Texels texels_at(const CodePicture& codes, const std::vector<Index>& order, Index block_row,
                    Index block_column) {
  Bc1Texels texels;
  const auto n = static_cast<Index>(order.size());
  for (Index t = 0; t < 16; ++t) {
    const Index p = 4 * block_row + t / 4, q = 4 * block_column + t % 4;
    if (p >= n || q >= n) {
      texels.weight[t] = 0;  // beyond the matrix: nobody reads it
      continue;
    }
    for (std::size_t c = 0; c < 3; ++c)
      texels.code[c][t] = codes[c](order[static_cast<std::size_t>(p)], order[static_cast<std::size_t>(q)]);
  }
  return texels;
}

/// Whether a channel of a block has zeros beside numbers: they share the line from one colour to the other.
bool mixes_zeros(const Bc1Texels& texels) {
  return std::any_of(texels.code.begin(), texels.code.end(), [&](const Texels& code) {
    const auto counted = texels.weight > 0;
    return (counted && code == 0).any() && (counted && code > 0).any();
  });
}

/// The sum of all differences between F^c and its compressed form, in an order of rows and columns.
double total_error(const std::vector<ColourMatrix>& matrices, const TexelOrder& order) {
  return entry_errors(matrices, compress_colours(matrices, {}, order)).total;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value / static_cast<double>(values.size());
  return sum;
}

/// B = E + T B.
Field lit_by(const LinearOperator& transport, const PatchMesh& mesh, const Field& E) {
  const SolverProblem problem{transport, mesh.area.cwiseSqrt(), {.tolerance = 1e-6}};
  return solve(*cpu_solvers().make("gmres", problem), E);
}

// %% tags=["program"]
int main(int argc, char** argv) try {
  const std::filesystem::path folder = argc > 1 ? argv[1] : ".";

  // %% tags=["notebook"]
  // const std::filesystem::path folder = ".";

  // %% [markdown]
  // ## The matrix
  //
  // F^c_ij = F_ij color_j (Eq. 5): what patch j reflects of the light on it and sends to i, one matrix for
  // red, one for green and one for blue. Light L that arrives becomes F^c L after a bounce, and no other
  // multiplication is left for the graphics processor. A row sums to the mean colour that its patch sees.

  // %%
  std::filesystem::create_directories(folder);
  const auto mesh =
      std::make_shared<const PatchMesh>(make_patches(built_in_scene("cornell-box-closed"), {.patches = 360}));
  SilentMonitor monitor;
  const FormFactors form_factors = compute_form_factors(mesh, {}, monitor);
  const Index n = form_factors.patch_count();
  const Eigen::MatrixXd colours = sender_colours(mesh->reflectance);
  std::vector<ColourMatrix> matrices;
  for (Index c = 0; c < 3; ++c)
    matrices.emplace_back((form_factors.matrix() * colours.col(c).asDiagonal()).cast<float>());
  const double brightest = matrices[0].rowwise().sum().maxCoeff();
  state(fmt::format("there are {} patches, and three matrices of {} entries", n, n * n),
        300 <= n && n <= 420);
  state(fmt::format("no patch sees more than {:.3f} of red, and the brightest patch has {:.3f}", brightest,
                    colours.col(0).maxCoeff()),
        brightest <= colours.col(0).maxCoeff());

  // %% [markdown]
  // ## Their histogram
  //
  // On a linear scale all numbers are small: nearly all are below 0.005, as the document has it (Figure 1),
  // and yet they are a good part of the light. Their logarithms fill some decades evenly enough for codes.

  // %%
  const auto logarithms = [](const ColourMatrix& matrix) {
    Histogram histogram(-8, 0, 80);
    for (const float entry : matrix.reshaped())
      histogram.add(entry > 0 ? std::log10(static_cast<double>(entry)) : -100);
    return histogram;
  };
  const auto is_small = (matrices[0].array() < 0.005F).eval();
  const double small = static_cast<double>(is_small.count()) / static_cast<double>(n * n);
  const float light_of_small = is_small.select(matrices[0].array(), 0.F).sum() / matrices[0].sum();
  state(fmt::format("{:.0f} % of the red entries are below 0.005, and carry {:.0f} % of the light",
                    100 * small, 100 * light_of_small),
        small > 0.8 && light_of_small > 0.2F);

  Plot entry_plot;
  entry_plot.title = fmt::format("Entries of F^c, Cornell box, n = {}", n);
  PlotPanel entry_panel{
      .title = "", .x = {.label = "log10 of the entry"}, .y = {.label = "% of all entries"}, .series = {}};
  for (std::size_t c = 0; c < 3; ++c)
    entry_panel.series.push_back(outline(channel_names[c], logarithms(matrices[c])));
  entry_plot.panels.push_back(entry_panel);
  write_svg(folder / "entries.svg", entry_plot);

  // %% [markdown]
  // ## The largest are kept apart
  //
  // 4 % of each row and channel stay as they are, in float32 with their columns. They are half of the light,
  // and the largest number of the rest is much smaller.

  // %%
  const double fraction = 0.04;
  std::vector<CsrMatrix<float>> exact;
  exact.reserve(matrices.size());
  for (const ColourMatrix& matrix : matrices) exact.push_back(largest_of_rows(matrix, fraction));
  const auto per_row = static_cast<Index>(std::lround(fraction * static_cast<double>(n)));
  double exact_light = 0;
  for (const float value : exact[0].value) exact_light += static_cast<double>(value);
  exact_light /= static_cast<double>(matrices[0].sum());
  const auto largest = static_cast<double>(matrices[0].maxCoeff());
  const double rest = largest_of_rest(matrices[0], exact[0]);
  state(fmt::format("{} entries of a row are {:.0f} % of its light", per_row, 100 * exact_light),
        static_cast<Index>(exact[0].value.size()) == n * per_row && exact_light > 0.2);
  state(fmt::format("the largest red entry is {:.3f}, of the rest {:.4f}", largest, rest),
        rest < largest / 4);

  // %% [markdown]
  // ## Codes
  //
  // code = (ln(v / largest) + 25) 255 / 25, rounded: 0 is e^-25 of the largest and less, 255 the largest. A
  // step of 1 is a factor of 1.10, so that rounding costs 5 % at most, of small numbers and of large ones.
  // But the codes crowd at the upper end (Figure 4), and the lower half stands for hardly any light.

  // %%
  const LogMap map(1);
  const auto code_of_part = [](double part) { return LogMap(1).code(part); };
  std::vector<CodedChannel> channels;
  CodePicture codes;
  for (std::size_t c = 0; c < 3; ++c) {
    channels.push_back(code_channel(matrices[c], exact[c], code_of_part, false));
    codes[c] = channels[c].code;
  }
  double worst_rounding = 0;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      if (const int code = codes[0](i, j); code > 0) {
        const double number = static_cast<double>(matrices[0](i, j)) / channels[0].largest;
        worst_rounding = std::max(worst_rounding, std::abs(map.value(code) / number - 1));
      }
  state(fmt::format("rounding to codes is off by {:.1f} % at most", 100 * worst_rounding),
        worst_rounding <= std::expm1(0.5 * 25 / 255) * (1 + 1e-6));
  const double spanned = spanned_range(matrices[0], exact[0], neglected_share);
  state(fmt::format("all but a thousandth of the rest's light is within {:.1f} natural logarithms of 25",
                    spanned),
        spanned < 12.5);

  Plot code_plot;
  code_plot.title = "Codes of what is not exact";
  PlotPanel code_panel{.title = "", .x = {.label = "code"}, .y = {.label = "% of all entries"}, .series = {}};
  for (std::size_t c = 0; c < 3; ++c) {
    Histogram histogram(0.5, 255.5, 85);
    for (const std::uint8_t code : codes[c].reshaped()) histogram.add(code);
    code_panel.series.push_back(outline(channel_names[c], histogram));
  }
  code_plot.panels.push_back(code_panel);
  write_svg(folder / "codes.svg", code_plot);

  // %% [markdown]
  // ## Similar rows become neighbours
  //
  // Four rows and four columns will share a block, and had better be alike. The shortest path through all
  // rows is hard to find; the document goes from each row to the nearest that is left, then does the same
  // with columns. Rows, columns and patches move together. What it gains depends on where one starts: patches
  // of a face follow each other in the mesh, which is an order already.

  // %%
  const TexelOrder at_random = make_texel_order({.reorder = "none", .start = "random"}, *mesh);
  const TexelOrder by_faces = make_texel_order({.reorder = "none"}, *mesh);
  const TexelOrder in_order = make_texel_order({.reorder = "both"}, *mesh);
  const std::vector<Index> shuffled = at_random(codes), faces = by_faces(codes);

  const Eigen::MatrixXd row_distances = squared_row_distances(codes);
  const std::vector<Index> by_rows = greedy_order(row_distances);
  const CodePicture transposed = {codes[0].transpose(), codes[1].transpose(), codes[2].transpose()};
  const Eigen::MatrixXd column_distances = squared_row_distances(transposed);
  std::vector<Index> order;
  for (const Index place : greedy_order(column_distances(by_rows, by_rows)))
    order.push_back(by_rows[static_cast<std::size_t>(place)]);
  state("rows, then columns: it is the library's order", order == in_order(codes));

  const double longest = path_length(row_distances, shuffled);
  const double along_faces = path_length(row_distances, faces) / longest;
  const double greedily = path_length(row_distances, by_rows) / longest;
  state(fmt::format("the path through all rows is {:.2f} of that of a random order by faces, {:.2f} greedily",
                    along_faces, greedily),
        greedily < along_faces && along_faces < 0.6);
  write_codes(folder / "codes_at_random.png", codes, shuffled);
  write_codes(folder / "codes_by_faces.png", codes, faces);
  write_codes(folder / "codes_in_order.png", codes, order);

  // %% [markdown]
  // ## Blocks
  //
  // A BC1 block has two colours of 5, 6 and 5 bits and two mixtures of them, and says of each of 16 texels
  // which of the four it has: 8 bytes for 48 codes. The colours lie on a line. That suits logarithms: another
  // F is the same step in all channels, so that the codes of senders of one colour lie on a line, too.

  // %%
  ColourTexture texture(n, n, 3, {.logarithmic = true, .range = LogMap::document_range});
  for (int c = 0; c < 3; ++c) texture.set_scale(c, channels[static_cast<std::size_t>(c)].largest);
  for (Index row = 0; row < blocks_along(n); ++row)
    for (Index column = 0; column < blocks_along(n); ++column)
      texture.set_block(row, column, encode_bc1(texels_at(codes, order, row, column), Bc1Fit::range));

  const BlockTexture<Bc1Block> blocks = block_texture(texture);
  const CompressedColours compressed = compress_colours(matrices, {}, in_order);
  state(fmt::format("{} blocks in {} rows are those of the library", blocks.blocks.size(), blocks_along(n)),
        blocks.blocks == block_texture(*compressed.texture()).blocks);
  write_dds(folder / "texture.dds", blocks);
  state("and come back from a DDS file", read_dds<Bc1Block>(folder / "texture.dds").blocks == blocks.blocks);
  const double texels_take =
      static_cast<double>(blocks.blocks.size() * sizeof(Bc1Block)) / static_cast<double>(n * n);
  const double all_takes = bytes_per_entry(compressed);
  state(fmt::format("an entry takes {:.2f} bytes as a texel and {:.2f} in all, of 12 in float32", texels_take,
                    all_takes),
        texels_take < 0.51 && 12 / all_takes > 8);

  CodePicture decoded_codes = codes;
  for (Index p = 0; p < n; ++p)
    for (Index q = 0; q < n; ++q)
      for (std::size_t c = 0; c < 3; ++c)
        decoded_codes[c](order[static_cast<std::size_t>(p)], order[static_cast<std::size_t>(q)]) =
            static_cast<std::uint8_t>(
                std::lround(map.code(static_cast<double>(texture.texel(p, q, static_cast<int>(c))))));
  write_codes(folder / "codes_decoded.png", decoded_codes, order);

  // %% [markdown]
  // ## What blocks cost
  //
  // Figure 7 sums the differences of all entries, and finds 5 times less of them after reordering. Here a
  // random order gains about half of that, and the order of faces, which was nearly as good, hardly anything.

  // %%
  const double total_in_order = total_error(matrices, in_order);
  const double gain = total_error(matrices, at_random) / total_in_order;
  const double gain_over_faces = total_error(matrices, by_faces) / total_in_order;
  state(fmt::format("the total error falls to 1/{:.1f} of that of a random order, and to 1/{:.1f} of faces",
                    gain, gain_over_faces),
        gain > 2 && gain_over_faces > 1 && gain_over_faces < 1.5);

  // %% [markdown]
  // What is left is not for want of bits. The exact entries have left holes of code 0, as do patches that do
  // not see each other. Nearly every block with a hole has black as one of its two colours. Its mixtures, a
  // third and two thirds of the way from there, are codes up to 170, which hardly any number has: one colour
  // is left for all numbers of the block.

  // %%
  double squared_with_holes = 0, squared_without = 0, blocks_with_holes = 0, blocks_without = 0, black = 0;
  for (Index row = 0; row < blocks_along(n); ++row)
    for (Index column = 0; column < blocks_along(n); ++column) {
      const Bc1Texels texels = texels_at(codes, order, row, column);
      const bool holes = mixes_zeros(texels);
      const Bc1Block block = encode_bc1(texels, Bc1Fit::range);
      (holes ? blocks_with_holes : blocks_without) += 1;
      (holes ? squared_with_holes : squared_without) += squared_error(texels, block);
      if (holes && block.second == 0) black += 1;  // the darker colour
    }
  const double code_error_with_holes = std::sqrt(squared_with_holes / (48 * blocks_with_holes));
  const double code_error_without = std::sqrt(squared_without / (48 * blocks_without));
  state(fmt::format("{:.0f} % of the blocks have holes; their codes are off by {:.0f} of 255, those of "
                    "others by {:.1f}",
                    100 * blocks_with_holes / (blocks_with_holes + blocks_without), code_error_with_holes,
                    code_error_without),
        code_error_with_holes > 3 * code_error_without);
  double numbers = 0, reached_by_mixtures = 0;
  for (const CodeMatrix& channel : codes)
    for (const std::uint8_t code : channel.reshaped()) {
      numbers += code > 0 ? 1 : 0;
      reached_by_mixtures += code > 0 && code <= 170 ? 1 : 0;
    }
  state(fmt::format("{:.0f} % of them have black, and {:.1f} % of the numbers have codes up to 170",
                    100 * black / blocks_with_holes, 100 * reached_by_mixtures / numbers),
        black > 0.8 * blocks_with_holes && reached_by_mixtures < 0.05 * numbers);

  // %% [markdown]
  // ## The product
  //
  // What the texture decodes to at its place, plus the exact entries, is F^c again, nearly. T E = R F^c L
  // with the light L = E / color that arrives. The library's operator decodes inside of the product and gives
  // the same.

  // %%
  const auto dense = cpu_operators().make("dense", form_factors);
  const auto dxt = cpu_operators().make("dxt", form_factors);
  const LightSet lights = draw_lights(*mesh, {.area = 4}, 1, monitor);
  const Field& E = lights.emission;
  Field by_hand(n, E.cols()), by_library(n, E.cols()), truth(n, E.cols());
  Eigen::VectorXd excess = Eigen::VectorXd::Zero(n);
  for (Index c = 0; c < 3; ++c) {
    const CsrMatrix<float>& kept = exact[static_cast<std::size_t>(c)];
    Eigen::MatrixXd decoded(n, n);
    decoded(order, order) = materialize(texture, static_cast<int>(c));
    for (Index i = 0; i < n; ++i)
      for (auto k = static_cast<std::size_t>(kept.row_begin[static_cast<std::size_t>(i)]);
           k < static_cast<std::size_t>(kept.row_begin[static_cast<std::size_t>(i) + 1]); ++k)
        decoded(i, kept.column[k]) += static_cast<double>(kept.value[k]);
    for (Index light = c; light < E.cols(); light += 3)
      by_hand.col(light) =
          mesh->reflectance.col(c).asDiagonal() * (decoded * E.col(light).cwiseQuotient(colours.col(c)));
    const Eigen::VectorXd sums = matrices[static_cast<std::size_t>(c)].cast<double>().rowwise().sum();
    excess += (decoded.rowwise().sum() - sums).cwiseQuotient(sums) / 3;
  }
  dxt->apply(E, by_library);
  dense->apply(E, truth);
  const double disagreement = (by_library - by_hand).norm() / by_hand.norm();
  state(fmt::format("by hand and by the library: a difference of {:.0e}", disagreement),
        disagreement <= 1e-6);

  // %% [markdown]
  // It is not a good bounce yet, and it brings more light than there is. Logarithms are off as far up as
  // down, if they count by the light they stand for. But a number that is off by a factor up gains more than
  // one that is off by the same factor down loses: (e^x + e^-x) / 2 > 1.

  // %%
  const double bounce_error = mean(relative_errors(*mesh, by_library, truth));
  state(fmt::format("a bounce is off by {:.2f}, and its row sums are {:.0f} % too large in the mean",
                    bounce_error, 100 * excess.mean()),
        bounce_error > 0.1 && bounce_error < 0.3 && excess.mean() > 0.1);
  double coded_light = 0, logarithms_off = 0, numbers_off = 0;
  for (std::size_t c = 0; c < 3; ++c)
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) {
        const int before = codes[c](i, j), after = decoded_codes[c](i, j);
        if (before == 0 || after == 0) continue;
        const double logarithm_off = (after - before) * LogMap::document_range / LogMap::largest_code;
        coded_light += map.value(before);
        logarithms_off += map.value(before) * logarithm_off;
        numbers_off += map.value(before) * std::expm1(logarithm_off);
      }
  state(fmt::format("logarithms are off by {:.2f} in the mean, and numbers are {:.0f} % too large",
                    logarithms_off / coded_light, 100 * numbers_off / coded_light),
        std::abs(logarithms_off) < 0.05 * coded_light && numbers_off > 0.2 * coded_light);

  // %% [markdown]
  // ## The light
  //
  // What a bounce brings too much, the next multiplies. B = E + T B with both operators; errors are means
  // over four discs of light on the walls.

  // %%
  const Field B = lit_by(*dense, *mesh, E);
  const Field document_B = lit_by(*dxt, *mesh, E);
  const double document_error = mean(relative_errors(*mesh, document_B, B));
  const double indirect_error = mean(relative_errors(*mesh, document_B - E, B - E));
  state(fmt::format("B is off by {:.2f}, and reflected light by {:.2f}: more than one bounce", document_error,
                    indirect_error),
        document_error < 0.2 && indirect_error > bounce_error);

  // %% [markdown]
  // ## What improves it
  //
  // As many bits, spent better. Codes over the logarithms that the numbers span (range=auto) make finer
  // steps, and bring mixtures with black among the numbers. Holes may hold what suits their block, if the
  // exact entry is stored less that (fill=1). The two colours of a block are fitted by least squares
  // (fit=cluster). And F^c is F times a diagonal: one symmetric kernel, of which half is stored, serves all
  // channels (matrix=kernel), in BC4 blocks of eight levels in place of four.

  // %%
  const std::vector<std::string> variants = {"dxt:start=random,reorder=none",
                                             "dxt",
                                             "dxt:range=auto",
                                             "dxt:range=auto,fill=1",
                                             "dxt:range=auto,fill=1,fit=cluster",
                                             "dxt:matrix=kernel,codec=bc4,range=auto,fill=1"};
  const std::vector<std::string> changes = {"random order", "document 000", "range=auto",
                                            "fill=1",       "fit=cluster",  "kernel, BC4"};
  PlotSeries variant_series{.name = "dxt", .points = {}};
  std::vector<double> errors, bytes;
  for (std::size_t v = 0; v < variants.size(); ++v) {
    const auto transport = cpu_operators().make(variants[v], form_factors);
    bytes.push_back(static_cast<double>(transport->bytes().total()) / static_cast<double>(n * n));
    errors.push_back(mean(relative_errors(*mesh, lit_by(*transport, *mesh, E), B)));
    fmt::print("       {:<46} {:.2f} bytes an entry, error in B {:.4f}\n", variants[v], bytes[v], errors[v]);
    variant_series.points.push_back({static_cast<double>(v), errors[v], 0, changes[v]});
  }
  state("each is better than the one before", std::is_sorted(errors.rbegin(), errors.rend()));
  state("in random order the error is larger than the light", errors[0] > 1);
  state(fmt::format("BC1 at its best is {:.0f} times as good as the document's in as many bytes",
                    errors[1] / errors[4]),
        errors[1] > 10 * errors[4] && std::abs(bytes[4] / bytes[1] - 1) < 0.01);
  state(fmt::format("the kernel in BC4 is {:.0f} times as good in {:.2f} of the bytes", errors[1] / errors[5],
                    bytes[5] / bytes[1]),
        errors[1] > 30 * errors[5] && bytes[5] < bytes[1] / 2);

  Plot error_plot;
  error_plot.title = fmt::format("Error in B, 4 bits a texel, n = {}", n);
  error_plot.panels.push_back({.title = "",
                               .x = {.label = "step", .low = -0.5, .high = 6},
                               .y = {.label = "relative error", .scale = Scale::logarithmic},
                               .series = {variant_series}});
  write_svg(folder / "errors.svg", error_plot);

  // %% tags=["program"]
  return all_facts_hold ? 0 : 1;
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
