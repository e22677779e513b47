#include "apps/device_choice.hpp"
#include "apps/group_summary.hpp"
#include "apps/memory_need.hpp"
#include "apps/program.hpp"
#include "apps/run_options.hpp"
#include "apps/scene_options.hpp"
#include "experiments/json_objects.hpp"
#include "foundation/error.hpp"
#include "foundation/memory.hpp"
#include "foundation/parallel.hpp"
#include "gpu/gl_device.hpp"
#include "scene/built_in.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace radiosity {
namespace {

struct InfoOptions {
  SceneOptions scene;
  RunOptions run;
  bool list = false;
  std::filesystem::path json_file;
};

/// On two lines where the spec is long.
void print_entry(const std::string& defaults, const std::string& summary) {
  if (defaults.size() <= 20)
    fmt::print("  {:<20} {}\n", defaults, summary);
  else
    fmt::print("  {}\n{:23}{}\n", defaults, ' ', summary);
}

void print_list(const Program& program) {
  fmt::print("Built-in scenes\n");
  for (const BuiltInScene& scene : built_in_scenes()) print_entry(scene.defaults, scene.summary);
  fmt::print("\nOperators\n");
  for (const OperatorEntry& entry : program.operators.entries()) print_entry(entry.defaults, entry.summary);
  fmt::print("\nSolvers\n");
  for (const SolverEntry& entry : program.solvers.entries()) print_entry(entry.defaults, entry.summary);
}

std::string connectivity_text(const Topology& topology) {
  if (!topology.closed) return "open";
  if (!topology.enclosure) return "closed, seen from outside";
  return topology.convex ? "closed, convex room" : "closed room";
}

void print_scene(const PatchMesh& mesh, bool quiet) {
  fmt::print("scene      {}\n", mesh.scene->name);
  fmt::print("triangles  {}\n", triangle_count(*mesh.scene));
  fmt::print("patches    {}\n", mesh.patch_count());
  fmt::print("area       {:.6g}\n", mesh.area.sum());
  fmt::print("surface    {}\n", connectivity_text(mesh.topology));
  fmt::print("channels   {}\n", mesh.channels());

  fmt::print("\n{:<24} {:>8} {:>12}   {:<24} {}\n", "group", "patches", "area", "reflectance", "emission");
  const auto emissions = summarize_groups(mesh, mesh.emission);
  std::size_t next = 0;
  for (const GroupSummary& group : summarize_groups(mesh, mesh.reflectance))
    fmt::print("{:<24} {:>8} {:>12.6g}   {:<24} {}\n", group.name, group.patches, group.area,
               channel_text(group.mean), channel_text(emissions[next++].mean));

  fmt::print("\nmemory of an operator, at most\n");
  for (const MemoryNeed& need : memory_needs(mesh))
    fmt::print("  {:<10} {:>10}\n", need.operator_spec, byte_text(need.bytes));
  if (!quiet)
    for (const std::string& note : mesh.notes) fmt::print("note: {}\n", note);
}

void print_device(const GlContext& context) {
  const GlLimits& limits = context.limits();
  fmt::print("device           {}\n", renderer_text(context));
  fmt::print("vendor           {}\n", context.vendor());
  fmt::print("opened by        {}\n", context.platform());
  fmt::print("storage block    {}\n", byte_text(static_cast<double>(limits.storage_block_bytes)));
  fmt::print("shared memory    {}\n", byte_text(limits.shared_bytes));
  fmt::print("work group       {} invocations, {} x {} x {} at most\n", limits.group_invocations,
             limits.group_size[0], limits.group_size[1], limits.group_size[2]);
  fmt::print("work groups      {} x {} x {}\n", limits.group_count[0], limits.group_count[1],
             limits.group_count[2]);
}

/// Null for the CPU.
Json device_json(const GlDevice* device) {
  if (device == nullptr) return {};
  const GlContext& context = *device->context();
  const GlLimits& limits = context.limits();
  return {{"name", "gl"},
          {"renderer", context.renderer()},
          {"vendor", context.vendor()},
          {"version", context.version()},
          {"platform", context.platform()},
          {"software", context.software()},
          {"storage_block_bytes", limits.storage_block_bytes},
          {"shared_bytes", limits.shared_bytes},
          {"group_invocations", limits.group_invocations},
          {"group_size", limits.group_size},
          {"group_count", limits.group_count}};
}

void write_scene_json(const std::filesystem::path& file, const PatchMesh& mesh, const GlDevice* device) {
  Json scene = scene_json(mesh);
  scene["surface"] = connectivity_text(mesh.topology);
  Json groups = Json::array();
  const auto emissions = summarize_groups(mesh, mesh.emission);
  std::size_t next = 0;
  for (const GroupSummary& group : summarize_groups(mesh, mesh.reflectance))
    groups.push_back({{"name", group.name},
                      {"patches", group.patches},
                      {"area", group.area},
                      {"reflectance", numbers_json(group.mean)},
                      {"emission", numbers_json(emissions[next++].mean)}});
  Json memory = Json::object();
  for (const MemoryNeed& need : memory_needs(mesh)) memory[need.operator_spec] = need.bytes;
  write_json(file, {{"scene", scene},
                    {"groups", groups},
                    {"memory", memory},
                    {"notes", mesh.notes},
                    {"device", device_json(device)}});
}

void run_info(const InfoOptions& options, const Program& program) {
  const ThreadLimit limit(options.run.threads);
  const std::shared_ptr<GlDevice> device = open_device(options.run);
  const bool scene = !options.scene.scene.empty();
  if (device) {
    print_device(*device->context());
    if (scene || options.list) fmt::print("\n");
  }
  if (options.list) {
    print_list(program);
    if (scene) fmt::print("\n");
  }
  if (!scene && (device || options.list) && options.json_file.empty()) return;
  const auto mesh = open_mesh(options.scene);
  if (!options.json_file.empty()) write_scene_json(options.json_file, *mesh, device.get());
  print_scene(*mesh, options.run.quiet);
}

}  // namespace

void add_info_command(CLI::App& app, const Program& program) {
  CLI::App* command =
      app.add_subcommand("info", "what a scene consists of and how much memory its operators take");
  const auto options = std::make_shared<InfoOptions>();
  add_scene_options(*command, options->scene);
  command->add_flag("--list", options->list,
                    "list the built-in scenes, the operators and the solvers with their defaults");
  command->add_option("--json", options->json_file, "write the same as JSON")->option_text("FILE");
  add_run_options(*command, options->run);
  command->get_option("--device")
      ->description("also describe a graphics device: gl, which may be left out")
      ->expected(0, 1)
      ->default_str("gl")
      ->option_text("[gl]");
  command->callback([options, &program] { run_info(*options, program); });
}

}  // namespace radiosity
