#pragma once

#include <string>

/// Small valid files of every format, for the importers: a quad and a triangle, or two triangles.
std::string sample_obj();
std::string sample_mtl();
std::string sample_ascii_ply();
std::string sample_binary_ply();
std::string sample_ascii_stl();
std::string sample_binary_stl();
std::string sample_gltf();  ///< with its buffer embedded
std::string sample_glb();
