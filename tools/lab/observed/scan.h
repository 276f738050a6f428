#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <vector>

namespace vcarve::observed {

/// Where a scanner measures to.
struct Beam {
    Eigen::Vector3d from;
    Eigen::Vector3d way; ///< unit
};

/// About `count` beams of a scanner on a tripod: rows all round from 60 degrees down to straight
/// up, the beams of a row as far apart as the rows.
std::vector<Beam> tripod_beams(const Eigen::Vector3d& place, std::size_t count);

/// What a scanner measured: a point a beam that met something.
struct Scan {
    std::vector<Eigen::Vector3d> positions;
    std::vector<Eigen::Vector3d> scanners; ///< where it stood
};

/// The points that beams meet. Ranges are off by 3 thousandths (a normal distribution, in the
/// units of the surface, about metres). A beam is 0.3 milliradians wide each way: where its
/// edge meets something else than its middle, the range is somewhere in between. One range in four
/// hundred is false, shorter than it should be. The same on every machine, up to rounding.
Scan scan(const TriMesh& surface, const std::vector<Beam>& beams);

/// Writes a scan as binary PLY in floats, with x_origin, y_origin and z_origin. Coordinates are
/// multiples of `step`, or as near as floats come where that is 0.
void write_scan(const std::filesystem::path& path, const Scan& scan, double step);

} // namespace vcarve::observed
