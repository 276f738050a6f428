#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <filesystem>
#include <vector>

namespace vcarve::observed {

/// A ray along which a scanner measures.
struct Beam {
    Eigen::Vector3d from;
    Eigen::Vector3d way; ///< unit
};

/// About `count` beams of a scanner on a tripod, in rows of 360 degrees, from 60 degrees down to
/// straight up. Beams in a row have the same spacing as rows.
std::vector<Beam> tripod_beams(const Eigen::Vector3d& place, std::size_t count);

/// A scan: one point per beam that hit the surface.
struct Scan {
    std::vector<Eigen::Vector3d> positions;
    std::vector<Eigen::Vector3d> scanners; ///< scanner position of each point
};

/// The points that beams hit. Ranges have a normally distributed error of .003 units (about
/// meters). A beam has a half width of 0.3 milliradians: if its edge hits another depth than its
/// center, the range is between both. One range in four hundred is false and too short. The same on
/// every machine, up to rounding.
Scan scan(const TriMesh& surface, const std::vector<Beam>& beams);

/// Writes a scan as binary PLY in floats, with x_origin, y_origin and z_origin. Coordinates are
/// rounded to multiples of `step`; 0 disables this.
void write_scan(const std::filesystem::path& path, const Scan& scan, double step);

} // namespace vcarve::observed
