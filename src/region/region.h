#pragma once

#include "model/extent.h"
#include "vcarve/region.h"
#include "vcarve/scene.h"

#include <Eigen/Geometry>

#include <filesystem>
#include <memory>

namespace vcarve {

/// A closed set of places in the frame of a scene: its border belongs to it. Safe from many
/// threads.
class Region {
  public:
    Region() = default;
    virtual ~Region() = default;
    Region(const Region&) = delete;
    Region& operator=(const Region&) = delete;

    /// Whether a place lies within it.
    virtual bool contains(const Eigen::Vector3d& place) const = 0;
    /// Whether the segment between two places has a part within it.
    virtual bool meets(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const = 0;
    /// A box around it; endless where the region is.
    virtual Eigen::AlignedBox3d bounds() const = 0;
};

/// The region that was chosen, in the frame of a scene; null where that is everything. For
/// RegionChoice::Kind::looked_at it is the ball of region_of_interest(), since a ball turns with
/// the scene. Signs are exact, but for that ball, whose centre is a mean. Throws InputError where
/// the file of the region is missing, broken, or holds no closed surface or simple polygon. Cost: a
/// question takes O(1) of a box or ball, O(corners) of a polygon, about O(log(faces)) of a surface.
std::unique_ptr<Region> make_region(const RegionChoice& choice, const Scene& scene);
/// The same of a scene with that offset and that region of interest, which is not looked at where
/// something else was chosen.
std::unique_ptr<Region> make_region(const RegionChoice& choice, const Eigen::Vector3d& offset,
                                    const Ball& of_interest);

/// The inside of a closed surface, read from a PLY file in the coordinates of a model's file;
/// `offset` is subtracted. Vertices at one place count as one, and the orientation of faces does
/// not matter. A place within an even number of pieces of the surface is outside. Throws InputError
/// if the file is missing or broken, has no face, or has an edge of an odd number of faces.
std::unique_ptr<Region> read_mesh_region(const std::filesystem::path& path,
                                         const Eigen::Vector3d& offset);

/// Everything above and below a polygon, read from a text file: the x and y of one corner per line,
/// at least three, in order, in the coordinates of a model's file; # begins a comment line. The
/// first corner may be repeated at the end. `offset` is subtracted. Throws InputError if the file
/// is missing or broken, or the polygon touches itself.
std::unique_ptr<Region> read_polygon_region(const std::filesystem::path& path,
                                            const Eigen::Vector3d& offset);

} // namespace vcarve
