#pragma once

#include "region/region.h"

#include <filesystem>
#include <memory>

namespace vcarve {

/// What a closed surface encloses, read from a PLY file in the coordinates of a model's file;
/// `offset` is subtracted. Vertices at one place count as one. Which way faces look does not
/// matter; what lies within an even number of pieces of the surface lies outside. Throws InputError
/// where the file is missing or broken, has no face, or an edge of an odd number of faces.
std::unique_ptr<Region> read_mesh_region(const std::filesystem::path& path,
                                         const Eigen::Vector3d& offset);

} // namespace vcarve
