#pragma once

#include "model/extent.h"
#include "vcarve/region.h"
#include "vcarve/scene.h"

#include <Eigen/Geometry>

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

} // namespace vcarve
