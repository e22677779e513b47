// %% [markdown]
// # From shadow map to frame
//
// Document 000 ends with a list (Section 3.6): how a frame comes about on a graphics processor when the light
// moves. Shadow maps; a compute shader that finds the emission of every patch in them; another that
// multiplies with the form factors; one that carries the indirect light from patches to the vertices of the
// scene; and the scene, drawn with direct light and shadows in every pixel. This notebook takes one frame of
// a Cornell box apart, and checks each stage against a computation that knows nothing of the device.
//
// The cells below are also a program: `notebook_05_from_shadow_map_to_frame FOLDER` writes its plots and
// pictures into FOLDER, prints what it finds, and fails if one of the facts that it states is wrong. Where
// there is no OpenGL it says so and ends.

// %%
#include "experiments/svg_plot.hpp"
#include "form_factors/form_factors.hpp"
#include "frame/frame_path.hpp"
#include "frame/frame_renderer.hpp"
#include "frame/picture_difference.hpp"
#include "frame/traced_frame.hpp"
#include "gpu/gl_operators.hpp"
#include "render/image_file.hpp"
#include "render/patch_rays.hpp"
#include "render/picture.hpp"
#include "render/tone_mapping.hpp"
#include "scene/built_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

using namespace radiosity;

bool all_facts_hold = true;

void state(const std::string& fact, bool holds) {
  fmt::print("{}: {}\n", holds ? "true " : "FALSE", fact);
  all_facts_hold = all_facts_hold && holds;
}

/// Nothing where there is no OpenGL.
std::shared_ptr<GlDevice> device_or_nothing() try { return GlDevice::open(); } catch (const Error& error) {
  fmt::print("{}\n", error.what());
  return nullptr;
}

/// Patches in flat colours, or smoothly shaded.
void write_patches(const std::filesystem::path& file, const PatchMesh& mesh, const Eigen::MatrixXd& B,
                   double exposure, bool smooth) {
  SilentMonitor monitor;
  const PictureOptions options{.width = 320, .height = 240, .supersampling = 1, .interpolate = smooth};
  const Picture picture = render_picture(mesh, B, options, monitor);
  write_png(file, picture.width, picture.height, tone_mapped(picture, exposure));
}

/// |A - B| over |B|, weighted by area.
double difference(const PatchMesh& mesh, const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return (mesh.area.asDiagonal() * (A - B).cwiseAbs()).sum() / (mesh.area.asDiagonal() * B).sum();
}

/// What patches reflect of the light, by rays from the points in place of shadow maps.
Eigen::MatrixXd emission_by_rays(const PatchMesh& mesh, const EmissionPoints& points,
                                 const FrameLight& light) {
  const PatchRays rays(mesh);
  Eigen::MatrixXd E = points.emission;
  for (Index k = 0; k < points.position.cols(); ++k) {
    const Index patch = k / points.per_patch;
    const Vector3 point = points.position.col(k);
    const Vector3 way = light.position - point;
    const PatchHit hit = rays.from_patch(patch, point, way.normalized());
    if (!hit.missed() && (hit.point - point).norm() < way.norm()) continue;
    const Color received = unshadowed_irradiance(light, point, points.normal.col(k));
    E.row(patch) += points.reflectance.row(patch).cwiseProduct(received.matrix().transpose()) /
                    static_cast<double>(points.per_patch);
  }
  return E;
}

// %% tags=["program"]
int main(int argc, char** argv) try {
  const std::filesystem::path folder = argc > 1 ? argv[1] : ".";

  // %% tags=["notebook"]
  // const std::filesystem::path folder = ".";

  // %% [markdown]
  // ## The scene and the light
  //
  // Some 400 patches, whose form factors do not depend on the light, and a lamp of 1 W that hangs in the
  // box. The operator is built on the CPU and copied to the device once, before the first frame.

  // %%
  std::filesystem::create_directories(folder);
  const auto device = device_or_nothing();
  // %% tags=["program"]
  if (device == nullptr) return 0;
  // %%
  PatchMesh dark = make_patches(built_in_scene("cornell-box"), {.patches = 400});
  dark.emission.setZero();
  const auto mesh = std::make_shared<const PatchMesh>(dark);
  SilentMonitor monitor;
  const FormFactors form_factors = compute_form_factors(mesh, {.tolerance = 1e-3}, monitor);
  const OperatorRegistry operators = gl_operators(device, cpu_operators());
  const auto transport = operators.make("dense:f32", form_factors);
  const FrameLight light{.position = orbit_path(*mesh, 4)[3].light,
                         .intensity = Color::Constant(intensity_of_a_watt)};
  const Camera camera = camera_of({}, *mesh);
  fmt::print("{} patches on {}\n", mesh->patch_count(), device->context()->renderer());

  // %% [markdown]
  // ## One frame
  //
  // `draw` asks the device for a frame and returns; `collect` gives the oldest that is done. Of each stage
  // the device tells how long it took (a software renderer is right, but tells nothing of a graphics
  // processor).

  // %%
  constexpr int bounces = 8;
  const FrameScene scene = frame_scene(mesh, 6);
  FrameRenderer renderer(device, scene, *transport, {FrameLightKind::point},
                         {.width = 320, .height = 240, .products = bounces});
  const Picture radiance = renderer.radiance({light}, camera);
  const double exposure = exposure_of(radiance);
  renderer.set_exposure(exposure);
  renderer.draw({light}, camera);
  const FinishedFrame& frame = renderer.collect();
  write_png(folder / "frame.png", radiance.width, radiance.height, frame.bytes);
  for (std::size_t stage = 0; stage < frame_stages.size(); ++stage)
    fmt::print("       {:<12} {:7.3f} ms\n", frame_stages[stage], 1e3 * frame.stage_seconds[stage]);

  // %% [markdown]
  // ## Emission
  //
  // Each patch looks from 36 stratified points into the shadow map and reflects the mean of what arrives
  // there: lit fraction, cosine, distance and all. Rays from the same points find the same, but for points
  // that lie within a texel of a shadow's border.

  // %%
  const Eigen::MatrixXd E = renderer.emission();
  write_patches(folder / "emission.png", *mesh, E, exposure, false);
  const double emission_error = difference(*mesh, E, emission_by_rays(*mesh, scene.points, light));
  state(fmt::format("emission by shadow maps is that of rays to {:.2f} %", 100 * emission_error),
        emission_error < 0.01);

  // %% [markdown]
  // ## Transport
  //
  // B = E + T E + ... with as many products as there are bounces, on the device, which keeps the fields: the
  // irradiance H of the patches is where the next stage finds it. The same products on the CPU, in double
  // precision, differ by rounding: n sums in float32, eight times.

  // %%
  const Eigen::MatrixXd H = renderer.irradiance();
  const Eigen::MatrixXd reflected = mesh->reflectance.cwiseProduct(H);
  write_patches(folder / "indirect_patches.png", *mesh, reflected, exposure, false);
  Field product(mesh->patch_count(), 3);
  Field B = E;
  const auto on_cpu = cpu_operators().make("dense:f32", form_factors);
  for (int bounce = 0; bounce < bounces; ++bounce) {
    on_cpu->apply(B, product);
    B = E + product;
  }
  const double roundoff = (reflected - product).cwiseAbs().maxCoeff() / product.maxCoeff();
  const double n_u = static_cast<double>(mesh->patch_count()) * 0x1p-24;
  state(fmt::format("the device's products are the CPU's to {:.1e}, n u is {:.1e}", roundoff, n_u),
        roundoff < bounces * n_u);

  // %% [markdown]
  // ## Transfer
  //
  // The vertices take the mean of the patches around them, and pixels interpolate: indirect light is smooth,
  // and direct light, which is not, never passes through patches on its way to a pixel.

  // %%
  write_patches(folder / "indirect_vertices.png", *mesh, reflected, exposure, true);

  // %% [markdown]
  // ## The frame beside path tracing
  //
  // Path tracing knows neither patches nor maps. What is left of the difference beside its own noise are the
  // patches, of constant light each, and the borders of shadows and silhouettes.

  // %%
  const TracedFrame traced =
      trace_frame(*mesh, {light}, camera, {.width = 320, .height = 240, .samples = 24}, monitor);
  const PictureDifference beside = difference_of(radiance, traced);
  write_png(folder / "reference.png", 320, 240, tone_mapped(traced.picture, exposure));
  write_png(folder / "difference.png", 320, 240, tone_mapped(beside.picture, exposure));
  for (std::size_t c = 0; c < 3; ++c)
    state(fmt::format("{} differs by {:+.2f} % in the mean and {:.1f} % root mean square (noise {:.0f} %)",
                      std::vector<std::string>{"red", "green", "blue"}[c], 100 * beside.mean[c],
                      100 * beside.rms[c], 100 * beside.noise[c]),
          std::abs(beside.mean[c]) < 0.02 && beside.rms[c] < 0.1);

  // %% [markdown]
  // ## Bounces
  //
  // Each product adds one bounce. The document puts three of them into its matrix; with few, the picture is
  // too dark.

  // %%
  PlotSeries series{.name = "dense:f32", .points = {}};
  std::vector<double> missing;
  for (const int products : {1, 2, 3, 4, 6, 8}) {
    FrameRenderer few(device, scene, *transport, {FrameLightKind::point},
                      {.width = 160, .height = 120, .products = products});
    FrameRenderer many(device, scene, *transport, {FrameLightKind::point},
                       {.width = 160, .height = 120, .products = 30});
    const Picture whole = many.radiance({light}, camera);
    Picture nothing = whole;
    nothing.pixels.assign(nothing.pixels.size(), 0.0F);
    missing.push_back(-difference_of(few.radiance({light}, camera), {whole, nothing}).mean[0]);
    series.points.push_back({static_cast<double>(products), missing.back(), 0, ""});
    fmt::print("       {} products: {:.2e} of the red light is missing\n", products, missing.back());
  }
  state("every bounce brings less than the one before", std::is_sorted(missing.rbegin(), missing.rend()));
  state("three bounces leave out less than a twentieth", missing[2] < 0.05);
  Plot plot;
  plot.title = "Red light that is missing in the frame";
  plot.panels.push_back({.title = "",
                         .x = {.label = "products", .low = 0, .high = 9},
                         .y = {.label = "part of the light", .scale = Scale::logarithmic},
                         .series = {series}});
  write_svg(folder / "bounces.svg", plot);

  // %% tags=["program"]
  return all_facts_hold ? 0 : 1;
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
