#pragma once

#include "form_factors/form_factors.hpp"

#include <memory>
#include <string>

namespace radiosity {

/// What assembling the form factors of a scene costs, against the ray tracer alone.
struct FormFactorBenchmark {
  std::string scene;
  Index patches = 0;
  FormFactorQuality quality;
  double microseconds_per_factor = 0;  ///< CPU microseconds a directed form factor (n^2 of them)
  double assembly_rate =
      0;  ///< rays / CPU second of the whole assembly: quadrature, proofs, sampling, tracing
  double tracer_rate =
      0;  ///< rays / CPU second of rtcOccluded16 alone on a sample of the same packets, median
  double fastest_tracer_rate = 0;  ///< of its ten replays
  double load = 0;                 ///< of the machine, one-minute average at the end
};

/// Assembles without closure and replays up to four million of the same rays, spread over the scene's pairs.
FormFactorBenchmark benchmark_form_factors(std::shared_ptr<const PatchMesh> mesh,
                                           const FormFactorOptions& options, Monitor& monitor);

/// A few lines for the terminal.
std::string form_factor_benchmark_text(const FormFactorBenchmark& benchmark);

}  // namespace radiosity
