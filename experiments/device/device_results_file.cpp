// The JSON of `radiosity bench --device gl`.

#include "experiments/device/device_results.hpp"
#include "experiments/json_objects.hpp"
#include "foundation/error.hpp"

#include <nlohmann/json.hpp>

#include <fstream>

namespace radiosity {
namespace {

constexpr const char* kind_of_file = "radiosity device benchmark";

Json write_timing(const Timing& timing) {
  return {{"min_seconds", timing.min}, {"median_seconds", timing.median}};
}

Timing read_timing(const Json& json) {
  return {json.at("min_seconds").get<double>(), json.at("median_seconds").get<double>()};
}

Json write_frame(const DeviceFrameTimes& times) {
  return {{"sums", write_timing(times.sums)},
          {"frame", write_timing(times.frame)},
          {"with_transfers", write_timing(times.with_transfers)}};
}

DeviceFrameTimes read_frame(const Json& json) {
  return {read_timing(json.at("sums")), read_timing(json.at("frame")),
          read_timing(json.at("with_transfers"))};
}

/// Null for what is not there.
template <typename Value, typename Write>
Json write_optional(const std::optional<Value>& value, const Write& write) {
  return value ? write(*value) : Json();
}

template <typename Read>
auto read_optional(const Json& json, const Read& read) {
  using Value = decltype(read(json));
  return json.is_null() ? std::optional<Value>() : std::optional<Value>(read(json));
}

Json write_frames(const DeviceFrames& frames) {
  return {{"n", frames.size.rows},
          {"k", frames.size.rank},
          {"columns", frames.columns},
          {"upload_seconds", frames.upload_seconds},
          {"sparse", write_frame(frames.sparse)},
          {"full", write_optional(frames.full, write_frame)},
          {"hybrid_sparse", write_timing(frames.hybrid_sparse)},
          {"hybrid_full", write_optional(frames.hybrid_full, write_timing)},
          {"cpu_sparse", write_timing(frames.cpu_sparse)},
          {"cpu_full", write_optional(frames.cpu_full, write_timing)}};
}

DeviceFrames read_frames(const Json& json) {
  return {.size = {json.at("n").get<Index>(), json.at("k").get<Index>()},
          .columns = json.at("columns").get<Index>(),
          .upload_seconds = json.at("upload_seconds").get<double>(),
          .sparse = read_frame(json.at("sparse")),
          .full = read_optional(json.at("full"), read_frame),
          .hybrid_sparse = read_timing(json.at("hybrid_sparse")),
          .hybrid_full = read_optional(json.at("hybrid_full"), read_timing),
          .cpu_sparse = read_timing(json.at("cpu_sparse")),
          .cpu_full = read_optional(json.at("cpu_full"), read_timing)};
}

Json write_method(const DeviceMethodSpeed& method) {
  return {{"name", method.name},
          {"bytes", method.bytes},
          {"on_device", write_timing(method.on_device)},
          {"with_transfers", write_timing(method.with_transfers)},
          {"difference", method.difference}};
}

DeviceMethodSpeed read_method(const Json& json) {
  return {json.at("name").get<std::string>(), json.at("bytes").get<std::size_t>(),
          read_timing(json.at("on_device")), read_timing(json.at("with_transfers")),
          json.at("difference").get<double>()};
}

template <typename Value, typename Write>
Json write_list(const std::vector<Value>& values, const Write& write) {
  Json list = Json::array();
  for (const Value& value : values) list.push_back(write(value));
  return list;
}

template <typename Read>
auto read_list(const Json& json, const Read& read) {
  std::vector<decltype(read(json))> values;
  for (const Json& value : json) values.push_back(read(value));
  return values;
}

Json write_round(const DeviceSpeedRound& round) {
  return {{"patches", round.patches},
          {"channels", round.channels},
          {"bounces", round.bounces},
          {"methods", write_list(round.methods, write_method)}};
}

DeviceSpeedRound read_round(const Json& json) {
  return {json.at("patches").get<Index>(), json.at("channels").get<Index>(), json.at("bounces").get<long>(),
          read_list(json.at("methods"), read_method)};
}

Json write_cost(const ProductCost& cost) {
  return {{"product", cost.product},         {"columns", cost.columns},
          {"cpu_seconds", cost.cpu_seconds}, {"device_cpu_seconds", cost.device_cpu_seconds},
          {"ratio", cost.ratio()},           {"limit", cost.limit}};
}

ProductCost read_cost(const Json& json) {
  return {json.at("product").get<std::string>(), json.at("columns").get<Index>(),
          json.at("cpu_seconds").get<double>(), json.at("device_cpu_seconds").get<double>(),
          json.at("limit").get<double>()};
}

DeviceResults read_results(const Json& json) {
  DeviceResults results;
  results.renderer = json.at("renderer").get<std::string>();
  results.vendor = json.at("vendor").get<std::string>();
  results.version = json.at("version").get<std::string>();
  results.software = json.at("software").get<bool>();
  results.cpu = json.at("cpu").get<std::string>();
  results.threads = json.at("threads").get<int>();
  results.full = json.at("full").get<bool>();
  results.frames = read_list(json.at("frames"), read_frames);
  results.over_patches = read_list(json.at("over_patches"), read_round);
  results.over_bounces = read_list(json.at("over_bounces"), read_round);
  results.costs = read_list(json.at("costs"), read_cost);
  return results;
}

}  // namespace

Json device_results_json(const DeviceResults& results) {
  return {{"kind", kind_of_file},
          {"renderer", results.renderer},
          {"vendor", results.vendor},
          {"version", results.version},
          {"software", results.software},
          {"cpu", results.cpu},
          {"threads", results.threads},
          {"full", results.full},
          {"frames", write_list(results.frames, write_frames)},
          {"over_patches", write_list(results.over_patches, write_round)},
          {"over_bounces", write_list(results.over_bounces, write_round)},
          {"costs", write_list(results.costs, write_cost)}};
}

void write_device_results(const std::filesystem::path& file, const DeviceResults& results) {
  write_json(file, device_results_json(results));
}

DeviceResults read_device_results(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) fail("{} cannot be read: radiosity bench --device gl --json FILE writes one", file.string());
  try {
    const Json json = Json::parse(stream);
    if (json.value("kind", "") == kind_of_file) return read_results(json);
  } catch (const Json::exception& error) {
    fail("{} is not what radiosity bench --device gl --json FILE writes: {}", file.string(), error.what());
  }
  fail("{} is not what radiosity bench --device gl --json FILE writes", file.string());
}

}  // namespace radiosity
