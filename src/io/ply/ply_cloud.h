#pragma once

#include "base/progress.h"
#include "io/ply/ply_header.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <filesystem>
#include <vector>

namespace vcarve {

/// The points of a PLY file, in its order. The optional arrays are empty or have one entry a point.
struct PointCloud {
    std::vector<Eigen::Vector3d> positions; ///< offset added; also those that are not finite
    std::vector<Eigen::Vector3f> normals;   ///< optional: as they stand in the file
    std::vector<Color> colors;              ///< optional
};

/// Reads the vertices of an ascii, little endian or big endian PLY file, numbers of any type; text
/// is read with all its digits, also where the header calls it float. Other properties and elements
/// before them are skipped; what follows them is not read. Throws InputError: no such file, not
/// PLY, cut off, no vertices with x, y and z; and Cancelled. Cost: linear in the size of the file,
/// which is mapped, and in parallel where every vertex takes as many bytes, in binary files without
/// lists; allocations never exceed a small multiple of it.
PointCloud read_ply_cloud(const std::filesystem::path& path, const Progress& progress = {});

/// Only the header of a file. Throws InputError. Cost: none.
PlyHeader read_ply_header(const std::filesystem::path& path);

} // namespace vcarve
