#pragma once

#include "form_factors/exact_rooms.hpp"

namespace radiosity::testing {

/// `count` spheres of n patches each that do not see one another: F has rank `count` exactly.
exact_rooms::Room separate_spheres(int count, Index n, double reflectance);

}  // namespace radiosity::testing
