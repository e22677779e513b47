#pragma once

#include <radiosity/operators/operator_registry.hpp>

/// `threshold:below=X`: the symmetric kernel without the entries smaller than X times the largest; 0 <= X <=
/// 1, default 0.01. The registry entry, ready to be added next to the library's own operators.
radiosity::OperatorEntry threshold_operator();
