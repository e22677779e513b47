#include "experiments/dxt_radiosity/frame_comparison.hpp"

#include "experiments/device/repeated_timing.hpp"
#include "foundation/stopwatch.hpp"
#include "frame/direct_light.hpp"
#include "frame/frame_renderer.hpp"
#include "frame/instant_radiosity.hpp"
#include "frame/light_propagation.hpp"
#include "gpu/gl_operators.hpp"
#include "render/camera_rays.hpp"
#include "scene/built_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace radiosity {
namespace {

/// A method of radiosity, with an operator on the device.
struct RadiosityMethod {
  const char* name;
  const char* spec;
  int products;  ///< a frame
};

/// The document's method is three bounces in one product with the compressed sum, its naive one as many
/// products with F; the last has nearly all bounces.
constexpr std::array<RadiosityMethod, 4> radiosity_methods = {
    {{"document 000, compressed", "dxt:bounces=3", 1},
     {"compressed, improved", "dxt:bounces=3,range=auto,fill=1,reorder=morton,fit=cluster", 1},
     {"naive radiosity", "dense:f32", 3},
     {"radiosity, all bounces", "dense:f32", 8}}};

/// From the light, of instant radiosity in equal time.
constexpr double most_paths = 1 << 14;

/// A lamp over the nave that shines onto the red cloth: the sides of the right-hand columns towards the nave
/// are out of its cone, and have indirect light only.
FrameLight lamp_of_colonnade() {
  return {FrameLightKind::spot, {6, 4.6, 5.4}, {5.2, 1.2, 0}, Color(100, 95, 85), 35};
}

std::vector<std::size_t> shadowed_pixels(const PatchMesh& mesh, const std::vector<FrameLight>& lights,
                                         const Camera& camera, int width, int height) {
  const PatchRays rays(mesh);
  const DirectLight direct(mesh, rays, lights);
  const CameraRays camera_rays(camera, width, height);
  std::vector<std::size_t> pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const PatchHit hit = rays.first_front(camera_rays.origin(), camera_rays.direction(x + 0.5, y + 0.5));
      if (hit.missed() || !(direct.irradiance(hit) > 0).any())
        pixels.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x));
    }
  return pixels;
}

/// Some pixels in a row.
Picture taken_from(const Picture& picture, const std::vector<std::size_t>& pixels) {
  Picture row{static_cast<int>(pixels.size()), 1, {}};
  for (const std::size_t pixel : pixels)
    row.pixels.insert(row.pixels.end(), picture.pixels.begin() + static_cast<std::ptrdiff_t>(3 * pixel),
                      picture.pixels.begin() + static_cast<std::ptrdiff_t>(3 * pixel + 3));
  return row;
}

double mean_of_channels(const std::array<double, 3>& numbers) {
  return (numbers[0] + numbers[1] + numbers[2]) / 3;
}

std::string paths_text(int paths) {
  return fmt::format("{} path{}", paths, paths == 1 ? "" : "s");
}

/// One frame by method after method.
class Comparer {
 public:
  Comparer(std::shared_ptr<GlDevice> device, const FrameComparisonOptions& options,
           const OperatorRegistry& operators, Monitor& monitor)
      : device_(std::move(device)), options_(options), operators_(operators), monitor_(monitor) {
    PatchMesh mesh = make_patches(built_in_scene(options.scene), {.patches = options.patches});
    mesh.emission.setZero();
    camera_ = *mesh.scene->camera;
    result_.mesh = std::make_shared<const PatchMesh>(std::move(mesh));
    result_.renderer = device_->context()->renderer();
    result_.software = device_->context()->software();
    result_.bands = column_bands(*result_.mesh, options.column, -Vector3::UnitZ(), camera_, options.width,
                                 options.height, options.bands);
    shadowed_ = shadowed_pixels(*result_.mesh, lights_, camera_, options.width, options.height);
    result_.shadowed_part = static_cast<double>(shadowed_.size()) / (options.width * options.height);
  }

  void trace_reference() {
    const Stopwatch watch;
    result_.reference = traced(options_.reference_paths, options_.seed);
    result_.reference_seconds = watch.seconds();
    result_.reference_profile = profile_of(result_.reference.picture, result_.bands);
  }

  void draw_by_radiosity() {
    const FormFactors form_factors = compute_form_factors(
        result_.mesh, {.tolerance = options_.tolerance, .seed = options_.seed}, monitor_);
    const FrameScene scene = frame_scene(result_.mesh, options_.points);
    const OperatorRegistry device_operators = gl_operators(device_, operators_);
    for (const RadiosityMethod& method : radiosity_methods) {
      monitor_.checkpoint(method.name, 0);
      const auto transport = device_operators.make(method.spec, form_factors);
      FrameRenderer renderer(
          device_, scene, *transport, {lights_.front().kind},
          {options_.width, options_.height, options_.shadow_size, method.products, Injection::points});
      const Timing timing = time_by_clock(options_.seconds, [&] {
        renderer.draw(lights_, camera_);
        renderer.collect();
      });
      add(method.name,
          fmt::format("{}, {} product{}", method.spec, method.products, method.products == 1 ? "" : "s"),
          on_device_, timing.median, renderer.radiance(lights_, camera_));
    }
  }

  /// With what the document compares its method (section 4.3).
  void propagate_light() {
    const PatchRays rays(*result_.mesh);
    LightPropagation propagation(*result_.mesh, rays,
                                 {.width = options_.width,
                                  .height = options_.height,
                                  .cells = options_.cells,
                                  .steps = options_.steps,
                                  .seed = options_.seed});
    Picture picture;
    const Timing timing =
        time_by_clock(options_.seconds, [&] { picture = propagation.draw(lights_, camera_, monitor_); });
    const auto& cells = propagation.volume().cells();
    add("light propagation volumes",
        fmt::format("{} x {} x {} cells, {} steps", cells[0], cells[1], cells[2], options_.steps), on_cpu_,
        timing.median, std::move(picture));
  }

  /// As many paths as have the error of the first frame, at most as many as the reference.
  void trace_to_equal_error() {
    const double wanted = mean_of_channels(result_.frames.front().shadowed.rms);
    const double error_of_a_path =
        mean_of_channels(result_.frames.front().shadowed.noise) * std::sqrt(options_.reference_paths);
    const double needed = wanted > 0 ? std::pow(error_of_a_path / wanted, 2) : options_.reference_paths;
    const int paths = static_cast<int>(std::clamp(std::ceil(needed), 1.0, 1.0 * options_.reference_paths));
    const Stopwatch watch;
    const TracedFrame frame = traced(paths, options_.seed + 1);
    const double seconds = watch.seconds();
    result_.equal_error_paths = needed;
    result_.equal_error_seconds = seconds * std::max(1.0, needed / paths);
    add(path_tracing_name, paths_text(paths) + " a pixel", on_cpu_, seconds, frame.picture);
  }

  /// As many paths from the light as take the time of the first frame, and many more: what clamping costs.
  void light_in_equal_time() {
    constexpr int many_paths = 33;
    const PatchRays rays(*result_.mesh);
    const double one = seconds_of_instant_radiosity(rays, 1);
    const double a_path = (seconds_of_instant_radiosity(rays, many_paths) - one) / (many_paths - 1);
    const double further = a_path > 0 ? (result_.frames.front().seconds - one) / a_path : 0;
    const int paths = static_cast<int>(std::clamp(std::round(1 + further), 1.0, most_paths));
    const int many = options_.times_more * paths;
    add_instant_radiosity("instant radiosity", rays, paths, all_reflections);
    add_instant_radiosity(fmt::format("instant radiosity, {} times more", options_.times_more), rays, many,
                          all_reflections);
    add_instant_radiosity("its first reflection alone", rays, many, 1);
  }

  FrameComparison result() && { return std::move(result_); }

 private:
  TracedFrame traced(int paths, std::uint64_t seed) {
    return trace_frame(*result_.mesh, lights_, camera_, {options_.width, options_.height, paths, seed},
                       monitor_);
  }

  InstantRadiosityFrame instant(const PatchRays& rays, int paths, int reflections) {
    return instant_radiosity(
        *result_.mesh, rays, lights_, camera_,
        {options_.width, options_.height, paths, options_.closest, options_.seed, reflections}, monitor_);
  }

  double seconds_of_instant_radiosity(const PatchRays& rays, int paths) {
    constexpr double no_longer = 0;  // than three times
    return time_by_clock(no_longer, [&] { instant(rays, paths, all_reflections); }).median;
  }

  void add_instant_radiosity(const std::string& name, const PatchRays& rays, int paths, int reflections) {
    const Stopwatch watch;
    const InstantRadiosityFrame frame = instant(rays, paths, reflections);
    const double seconds = watch.seconds();
    add(name, fmt::format("{} from the light, virtual lights: {}", paths_text(paths), frame.virtual_lights),
        on_cpu_, seconds, frame.picture);
  }

  void add(const std::string& name, const std::string& settings, const char* computed_on, double seconds,
           Picture picture) {
    ComparedFrame frame;
    frame.name = name;
    frame.settings = settings;
    frame.computed_on = computed_on;
    frame.seconds = seconds;
    frame.whole = difference_of(picture, result_.reference);
    frame.shadowed = difference_of(taken_from(picture, shadowed_),
                                   {taken_from(result_.reference.picture, shadowed_),
                                    taken_from(result_.reference.standard_error, shadowed_)});
    frame.profile = profile_of(picture, result_.bands);
    result_.frames.push_back(std::move(frame));
    result_.pictures.push_back(std::move(picture));
  }

  static constexpr const char* on_device_ = "device";
  static constexpr const char* on_cpu_ = "cpu";

  std::shared_ptr<GlDevice> device_;
  const FrameComparisonOptions& options_;
  const OperatorRegistry& operators_;
  Monitor& monitor_;
  const std::vector<FrameLight> lights_ = {lamp_of_colonnade()};
  Camera camera_;
  std::vector<std::size_t> shadowed_;
  FrameComparison result_;
};

}  // namespace

FrameComparison measure_frame_comparison(const std::shared_ptr<GlDevice>& device,
                                         const FrameComparisonOptions& options,
                                         const OperatorRegistry& operators, Monitor& monitor) {
  Comparer comparer(device, options, operators, monitor);
  comparer.trace_reference();
  comparer.draw_by_radiosity();
  comparer.propagate_light();
  comparer.trace_to_equal_error();
  comparer.light_in_equal_time();
  return std::move(comparer).result();
}

double gradient_of(const FrameComparison& comparison, const ComparedFrame& frame) {
  return colour_gradient(comparison.bands, frame.profile);
}

}  // namespace radiosity
