#include "apps/device_choice.hpp"
#include "apps/form_factor_options.hpp"
#include "apps/frame_files.hpp"
#include "apps/frame_report.hpp"
#include "apps/number_ranges.hpp"
#include "apps/output_check.hpp"
#include "apps/program.hpp"
#include "apps/run_options.hpp"
#include "apps/scene_options.hpp"
#include "apps/simplification.hpp"
#include "apps/terminal_monitor.hpp"
#include "foundation/error.hpp"
#include "foundation/parallel.hpp"
#include "frame/frame_path.hpp"
#include "frame/frame_renderer.hpp"
#include "frame/traced_frame.hpp"
#include "gpu/gl_operators.hpp"
#include "gpu/upload.hpp"
#include "render/image_file.hpp"
#include "render/tone_mapping.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace radiosity {
namespace {

constexpr int frames_of_an_orbit = 20;
constexpr double spot_half_angle = 50;

struct RenderOptions {
  SceneOptions scene;
  FormFactorChoice form_factors;
  FrameOptions frame;
  RunOptions run;
  std::string operator_spec = "dense:f32";
  std::string path = "orbit";
  std::string light = "point";
  std::string injection = "points";
  std::string size;
  std::string pattern;
  std::optional<int> frames;
  int points = 36;
  int reference = 0;
  bool emitters = false;
  std::optional<std::string> simplify;
  std::filesystem::path json_file;
};

FrameLightKind kind_of(const RenderOptions& options) {
  if (options.light == "point") return FrameLightKind::point;
  if (options.light == "spot") return FrameLightKind::spot;
  fail<UsageError>("--light {}: there is no such light; the known ones are point and spot", options.light);
}

Injection injection_of(const RenderOptions& options) {
  if (options.injection == "points") return Injection::points;
  if (options.injection == "cube") return Injection::cube;
  fail<UsageError>("--injection {}: there is no such way; the known ones are points and cube",
                   options.injection);
}

/// "1280x720".
void read_size(const std::string& text, FrameOptions& options) {
  if (text.empty()) return;
  const char* last = text.data() + text.size();
  const auto width = std::from_chars(text.data(), last, options.width);
  const bool separated = width.ec == std::errc{} && width.ptr != last && *width.ptr == 'x';
  const auto height = std::from_chars(separated ? width.ptr + 1 : last, last, options.height);
  constexpr int most = 16384;
  if (!separated || height.ec != std::errc{} || height.ptr != last || options.width < 1 ||
      options.height < 1 || options.width > most || options.height > most)
    fail<UsageError>("--size {}: write it as 1280x720, with 1 to {} pixels each way", text, most);
}

/// What makes a device do half of a product only is found before anything is computed.
void check_operator(const RenderOptions& options) {
  if (options.run.device != "gl")
    fail<UsageError>("--device {}: render draws on an OpenGL device; leave the option out",
                     options.run.device);
  require_uploadable(options.operator_spec);
  Spec spec = Spec::parse(options.operator_spec);
  if (spec.text("closure", "none") != "none")
    fail<UsageError>("{}: a closure is computed on the CPU, which no frame waits for; leave closure= out",
                     options.operator_spec);
}

std::shared_ptr<const PatchMesh> mesh_of(const RenderOptions& options) {
  if (!options.scene.emission_file.empty() && !options.emitters)
    fail<UsageError>(
        "--emission {}: the moving light takes the place of emitters; add --emitters to have both",
        options.scene.emission_file);
  auto mesh = open_mesh(options.scene);
  if (options.emitters) return mesh;
  PatchMesh dark = *mesh;
  dark.emission.setZero();
  return std::make_shared<const PatchMesh>(std::move(dark));
}

std::vector<FrameView> views_of(const RenderOptions& options, const PatchMesh& mesh) {
  if (options.path == "orbit") return orbit_path(mesh, options.frames.value_or(frames_of_an_orbit));
  std::vector<FrameView> views = read_frame_path(options.path);
  if (!options.frames) return views;
  if (static_cast<std::size_t>(*options.frames) > views.size())
    fail<UsageError>("--frames {}: the path '{}' has {} line{}, one a frame", *options.frames, options.path,
                     views.size(), views.size() == 1 ? "" : "s");
  views.resize(static_cast<std::size_t>(*options.frames));
  return views;
}

/// A light of 1 W, as --lights has them; spots, as bright on their axis, look at the middle of the floor.
std::vector<FrameLight> lights_of(const FrameView& view, FrameLightKind kind, const PatchMesh& mesh) {
  Vector3 low = mesh.centroid.rowwise().minCoeff();
  Vector3 target = 0.5 * (low + mesh.centroid.rowwise().maxCoeff());
  target.y() = low.y();
  if (target == view.light) target.y() -= 1;
  return {{kind, view.light, target, Color::Constant(intensity_of_a_watt), spot_half_angle}};
}

int strata_of(int points) {
  return static_cast<int>(std::ceil(std::sqrt(points) - 1e-9));
}

/// Draws all frames, each collected and written while the device works on the next.
void draw_frames(FrameRenderer& renderer, const std::vector<FrameView>& views, FrameLightKind kind,
                 const PatchMesh& shown, const FrameFiles& files, FrameReport& report, Monitor& monitor) {
  report.stage_seconds.resize(frame_stages.size());
  const auto draw = [&](std::size_t k) {
    renderer.draw(lights_of(views[k], kind, shown), camera_of(views[k], shown));
  };
  draw(0);  // what drivers do at the first time is not measured
  renderer.collect();
  for (std::size_t k = 0; k <= views.size(); ++k) {
    const Stopwatch watch;
    if (k < views.size()) draw(k);
    const FinishedFrame* frame = k > 0 ? &renderer.collect() : nullptr;
    if (k < views.size()) report.frame_seconds.push_back(watch.seconds());
    if (frame == nullptr) continue;
    for (std::size_t stage = 0; stage < frame_stages.size(); ++stage)
      report.stage_seconds[stage].push_back(frame->stage_seconds[stage]);
    if (files.wanted())
      write_png(files.frame(static_cast<int>(k - 1)), report.options.width, report.options.height,
                frame->bytes);
    monitor.checkpoint("drawing", static_cast<double>(k) / static_cast<double>(views.size()));
  }
}

/// Path tracing of the last frame, written beside it.
FrameReference compare_last(FrameRenderer& renderer, const RenderOptions& options, const FrameView& last,
                            const PatchMesh& shown, const FrameFiles& files, double exposure,
                            Monitor& monitor) {
  const std::vector<FrameLight> lights = lights_of(last, kind_of(options), shown);
  const Camera camera = camera_of(last, shown);
  const Stopwatch watch;
  const TracedFrame reference =
      trace_frame(shown, lights, camera,
                  {options.frame.width, options.frame.height, options.reference, options.run.seed}, monitor);
  const double seconds = watch.seconds();
  FrameReference result{options.reference, seconds,
                        difference_of(renderer.radiance(lights, camera), reference)};
  if (files.wanted()) {
    const auto write = [&](const char* name, const Picture& picture) {
      write_png(files.beside(name), picture.width, picture.height, tone_mapped(picture, exposure));
    };
    write("reference.png", reference.picture);
    write("difference.png", result.difference.picture);
  }
  return result;
}

void run_render(RenderOptions options, const Program& cpu_program) {
  const ThreadLimit limit(options.run.threads);
  const FrameLightKind kind = kind_of(options);
  options.frame.injection = injection_of(options);
  read_size(options.size, options.frame);
  check_operator(options);
  const std::optional<Index> voxels = wanted_voxels(options.simplify);
  require_writable(options.json_file);
  require_writable(options.form_factors.save_file);
  const FrameFiles files(options.pattern);
  options.form_factors.options.seed = options.run.seed;

  TerminalMonitor monitor(options.run.quiet);
  const auto shown = mesh_of(options);
  const std::vector<FrameView> views = views_of(options, *shown);
  const auto device = open_device(options.run, {.otherwise = ""});
  std::optional<SimplifiedScene> simplified;
  if (voxels) simplified = simplify_to_voxels(*shown, *voxels);
  const int strata = strata_of(options.points);
  const FrameScene scene = simplified ? frame_scene(*simplified, shown, strata) : frame_scene(shown, strata);
  const auto solved = simplified ? simplified->mesh : shown;
  const OperatorRegistry operators = gl_operators(device, cpu_program.operators);
  FormFactors form_factors;
  form_factors.mesh = solved;
  if (operators.needs_form_factors(options.operator_spec))
    form_factors = obtain_form_factors(solved, options.form_factors, monitor);
  const auto transport = operators.make(options.operator_spec, form_factors);

  FrameRenderer renderer(device, scene, *transport, {kind}, options.frame);
  FrameReport report;
  report.operator_name = transport->describe();
  report.device = transport->device_use().value_or(DeviceUse{});
  report.version = device->context()->version();
  report.options = options.frame;
  report.spot = kind == FrameLightKind::spot;
  report.products = transport->global() ? 1 : options.frame.products;
  report.points = scene.points.per_patch;
  report.patches = solved->patch_count();
  report.exposure = exposure_of(
      renderer.radiance(lights_of(views.front(), kind, *shown), camera_of(views.front(), *shown)));
  renderer.set_exposure(report.exposure);
  draw_frames(renderer, views, kind, *shown, files, report, monitor);
  if (options.reference > 0)
    report.reference = compare_last(renderer, options, views.back(), *shown, files, report.exposure, monitor);
  if (!options.json_file.empty()) write_frames_json(options.json_file, *shown, report);
  monitor.clear();
  print_frames(*shown, report);
  if (options.run.quiet) return;
  for (const std::string& note : shown->notes) fmt::print("note: {}\n", note);
}

}  // namespace

void add_render_command(CLI::App& app, const Program& program) {
  CLI::App* command = app.add_subcommand(
      "render", "frames of a scene in a moving light, on an OpenGL device, and the time of each stage");
  const auto options = std::make_shared<RenderOptions>();
  options->run.device = "gl";
  add_scene_options(*command, options->scene);
  command->add_option("--frames", options->frames, "how many; default 20 of an orbit, all lines of a file")
      ->check(integer_between(1, 1'000'000))
      ->option_text("N");
  command
      ->add_option("--path", options->path,
                   "of the light: orbit (default), or a text file with one line a frame: the light's x y z, "
                   "or nine numbers, light, camera and the point that it looks at; # begins a comment")
      ->option_text("orbit|FILE");
  command
      ->add_option("-o,--output", options->pattern,
                   "write each frame, as in frames/%04d.png; with --reference also reference.png and "
                   "difference.png beside them")
      ->option_text("PATTERN");
  command
      ->add_option("--operator", options->operator_spec,
                   "transport of light, one that runs on the device; default dense:f32")
      ->option_text("SPEC");
  command
      ->add_option("--bounces", options->frame.products,
                   "products a frame, for operators that are no sum of bounces themselves; default 8")
      ->check(integer_between(1, 1000))
      ->option_text("N");
  command->add_option("--size", options->size, "of a frame, pixels; default 1280x720")->option_text("WxH");
  command
      ->add_option("--light", options->light,
                   "point (default) or spot, which looks at the middle of the floor; in place of the scene's "
                   "own emitters")
      ->option_text("point|spot");
  command->add_flag("--emitters", options->emitters, "the scene's own emitters shine as well");
  command
      ->add_option("--points", options->points,
                   "on each patch, where its direct light is measured; rounded up to a square; default 36")
      ->check(integer_between(1, 4096))
      ->option_text("N");
  command
      ->add_option("--injection", options->injection,
                   "how patches get their direct light: points (default) looks from them into shadow maps, "
                   "cube draws them around the light, 128 x 128 pixels a face")
      ->option_text("points|cube");
  command
      ->add_option("--shadow-size", options->frame.shadow_size,
                   "texels of a side of each shadow map; default 1024")
      ->check(integer_between(4, 16384))
      ->option_text("TEXELS");
  add_simplify_option(*command, options->simplify);
  command
      ->add_option("--reference", options->reference,
                   "compare the last frame with path tracing, that many paths a pixel")
      ->check(integer_between(1, 1 << 20))
      ->option_text("SAMPLES");
  command->add_option("--json", options->json_file, "write times and errors as JSON")->option_text("FILE");
  add_form_factor_options(*command, options->form_factors);
  add_run_options(*command, options->run);
  command->callback([options, &program] { run_render(*options, program); });
}

}  // namespace radiosity
