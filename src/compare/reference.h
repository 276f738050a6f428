#pragma once

#include "geometry/triangle_tree.h"
#include "vcarve/compare.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vcarve {

/// A mesh in the frame of a reference, ready to be measured.
struct MeasuredMesh {
    TriMesh mesh; ///< offset is the reference's origin
    TriangleTree tree;
};

inline constexpr std::uint32_t kNoView = 0xffffffffU;

/// The part of the true surface that counts: where at least 3 views see it.
struct Truth {
    MeasuredMesh surface;
    /// Samples by area of what at least 3 views see. A view sees a point of the truth where nothing
    /// of the truth lies between them and the line meets the surface at under 80 degrees from its
    /// normal, from either side; where the view's image ends plays no part.
    std::vector<Eigen::Vector3d> samples;
    std::vector<std::uint32_t>
        views; ///< per sample: one of the views that see it, picked at random
    std::vector<std::uint32_t>
        image_views; ///< the same of those whose image holds the sample; kNoView where none does
    double diagonal = 0.0;   ///< of the box of the samples
    double seen_share = 0.0; ///< of the truth's area

    /// How many samples have an image view.
    std::int64_t image_samples() const
    {
        return std::ssize(image_views) - std::ranges::count(image_views, kNoView);
    }
};

/// The line of sight of a pixel: from the view's centre through `towards` and on.
struct ViewRay {
    std::uint32_t view;
    Eigen::Vector3d towards;
};

/// What meshes are measured against: the points and views of a model, and the truth where it is
/// known. Everything is in one frame, world minus `origin`, so no precision is lost far from zero.
struct Reference {
    CompareOptions options;
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Scene scene;                  ///< its finite points with at least two views; offset is `origin`
    std::vector<double> spacings; ///< per point, see point_spacings()
    double median_spacing = 0.0;
    std::vector<ViewRay> rays; ///< see view_rays()
    /// Per ray: 1 where the closed surface of the model has a face, see add_closed_surface().
    std::optional<std::vector<char>> closed_hits;
    std::optional<Truth> truth;
};

/// Prepares a model, and the truth unless it is null; not yet its closed surface. Throws InputError
/// where the model has fewer than two points that two views saw, or the truth has no faces, lies in
/// another frame than the model, or is nowhere seen by three views. Cost: with a truth, about
/// samples / seen share x (lines until 3 views are found, all where unseen).
Reference make_reference(const Scene& model, const NamedMesh* truth, const CompareOptions& options);

/// What random numbers are for: each has a sequence of its own.
enum class RandomStream { pilot = 1, truth, mesh, view, sight, area, place };
std::uint64_t stream_seed(const CompareOptions& options, RandomStream stream);

/// 0 of none.
inline double share_of(std::size_t some, std::size_t all)
{
    return all == 0 ? 0.0 : static_cast<double>(some) / static_cast<double>(all);
}

/// Whether a surface stands between a place and an eye, farther than `skip` from the place.
bool is_hidden(const Eigen::Vector3d& place, const Eigen::Vector3d& eye, const TriangleTree& by,
               double skip);

/// From places to the nearest point of a surface. Cost: a query a place, parallel.
std::vector<double> distances_to(const TriangleTree& surface,
                                 std::span<const Eigen::Vector3d> places);

/// The same mesh with `origin` for its offset.
TriMesh in_frame(TriMesh mesh, const Eigen::Vector3d& origin);

/// A mesh in the reference's frame. Throws InputError where it has no face with area, or where it
/// evidently lies in another frame than the model: where its box lies more than a diagonal beside
/// the box of the middle nine tenths of the points, or the two differ more than 50 times in size.
MeasuredMesh place_mesh(const NamedMesh& named, const Reference& reference);

/// How far apart points lie around each point: the distance to its 6th nearest other point, or to
/// the farthest where there are fewer. Points that coincide would have none, so no spacing is less
/// than a hundredth of the median one. Precondition: at least two points, all finite. Cost: O(n log
/// n), parallel.
std::vector<double> point_spacings(const std::vector<Eigen::Vector3d>& points);

/// Points spread over a surface, and the faces they lie on. The arrays run parallel.
struct SurfaceSamples {
    std::vector<Eigen::Vector3d> positions; ///< in the frame of the mesh's positions
    std::vector<std::uint32_t> faces;       ///< ascending
};

/// `count` samples by area: the area is cut into `count` equal parts, one random sample in each, so
/// a face of a share s of the area gets s x count samples, give or take one. Empty where no face
/// has area. Cost: O(faces + count).
SurfaceSamples sample_surface(const TriMesh& mesh, std::size_t count, std::uint64_t seed);

} // namespace vcarve
