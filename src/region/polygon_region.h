#pragma once

#include "region/region.h"

#include <filesystem>
#include <memory>

namespace vcarve {

/// Everything above and below a polygon, read from a text file: the x and y of one corner a line,
/// at least three, in order, in the coordinates of a model's file; # begins a comment line. The
/// first corner may stand at the end once more. `offset` is subtracted. Throws InputError where
/// the file is missing or broken, or the polygon touches itself.
std::unique_ptr<Region> read_polygon_region(const std::filesystem::path& path,
                                            const Eigen::Vector3d& offset);

} // namespace vcarve
