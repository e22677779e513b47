#pragma once

#include <string>

namespace radiosity {

/// What a timing was measured on.
struct Machine {
  std::string cpu;                 ///< the processor's model name
  int threads = 0;                 ///< in force for parallel loops
  double read_bandwidth_gb_s = 0;  ///< 1e9 bytes a second, see measure_read_bandwidth
  double load = 0;                 ///< the system's load average of the last minute: above 0 means company
};

/// The model name of the processor.
std::string processor_name();

/// Reads the description of this machine and measures its bandwidth; takes about half a second.
Machine measure_machine();

/// Largest rate at which all threads together read a buffer much larger than the last cache (256 to 512 MB),
/// in 1e9 bytes a second: the limit of every operator that the caches do not hold. Passes over the buffer
/// until `seconds` are over.
double measure_read_bandwidth(double seconds = 0.2);

/// The system's load average of the last minute; 0 where the system does not say.
double load_average();

}  // namespace radiosity
