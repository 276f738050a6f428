#pragma once

#include "model/extent.h"
#include "vcarve/region.h"
#include "vcarve/scene.h"

#include <Eigen/Geometry>

#include <filesystem>
#include <memory>

namespace vcarve {

/// A closed set of positions, in the frame of a scene: the boundary belongs to the region.
/// Thread-safe.
class Region {
  public:
    Region() = default;
    virtual ~Region() = default;
    Region(const Region&) = delete;
    Region& operator=(const Region&) = delete;

    /// Whether the region contains a position.
    virtual bool contains(const Eigen::Vector3d& place) const = 0;
    /// Whether the segment between two positions intersects the region.
    virtual bool meets(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const = 0;
    /// The bounding box; infinite in the directions in which the region is.
    virtual Eigen::AlignedBox3d bounds() const = 0;
};

/// The chosen region in the frame of a scene; null for Kind::everything. Kind::looked_at is the
/// ball of region_of_interest(), because a ball rotates with the scene. Answers are exact, except
/// for this ball, whose center is a mean. Throws InputError if the region's file is missing or
/// broken, or has no closed surface or simple polygon. Cost of a query: O(1) for a box or ball,
/// O(corners) for a polygon, about O(log(faces)) for a surface.
std::unique_ptr<Region> make_region(const RegionChoice& choice, const Scene& scene);
/// The same for a scene with this offset and region of interest. `of_interest` is used only for
/// Kind::looked_at.
std::unique_ptr<Region> make_region(const RegionChoice& choice, const Eigen::Vector3d& offset,
                                    const Ball& of_interest);

/// The inside of a closed surface, read from a PLY file in the coordinates of a model's file;
/// `offset` is subtracted. Vertices with equal positions are merged. The orientation of faces does
/// not matter. A position inside an even number of nested components is outside. Throws InputError
/// if the file is missing or broken, has no face, or has an edge with an odd number of faces.
std::unique_ptr<Region> read_mesh_region(const std::filesystem::path& path,
                                         const Eigen::Vector3d& offset);

/// The vertical prism over a polygon, without limits in z. Reads a text file with the x and y of
/// one corner per line, at least three, in order, in the coordinates of a model's file; # begins a
/// comment line. The first corner may be repeated at the end. `offset` is subtracted. Throws
/// InputError if the file is missing or broken, or the polygon touches itself.
std::unique_ptr<Region> read_polygon_region(const std::filesystem::path& path,
                                            const Eigen::Vector3d& offset);

} // namespace vcarve
