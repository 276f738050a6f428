#include "steps/2_planes/border_places.h"

#include "base/parallel.h"
#include "base/sort_unique.h"
#include "geometry/triangle_tree.h"
#include "steps/2_planes/plane_frame.h"
#include "steps/2_planes/sights_through.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <tuple>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<
                CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>>>;

/// A rectangle in a plane around some places in it and what is so near.
std::array<Vector3d, 4> rectangle_around(const std::vector<Vector2d>& places,
                                         const PlaneFrame& frame, double near)
{
    Eigen::AlignedBox2d box;
    for (const Vector2d& place : places) {
        box.extend(place);
    }
    const Vector2d low = box.min().array() - near;
    const Vector2d high = box.max().array() + near;
    return {frame.in_space(low), frame.in_space({high.x(), low.y()}), frame.in_space(high),
            frame.in_space({low.x(), high.y()})};
}

/// Where a sight passes through the plane of a patch.
struct Passage {
    std::uint32_t patch;
    Vector2d place;      ///< in the plane
};

/// Whether a patch has a point so near to a place.
bool has_point_near(const Patch& patch, const Vector3d& place, double near)
{
    constexpr double kDone = -1.0; // no box is so near
    double most = near;
    patch.tree.visit_near(place, {0, 0}, most, [&](std::size_t i) {
        if ((patch.positions[i] - place).norm() <= near) most = kDone;
    });
    return most == kDone;
}

/// A point of a patch beside a passage through its plane.
struct Pair {
    double apart; ///< how far
    std::uint32_t point;
    std::uint32_t passage;
};

/// The pairs of neighbours in the Delaunay triangulation of places in a plane, of which the first
/// so many are points and the others passages, that are no farther apart than `most`; the nearest
/// first.
std::vector<Pair> pairs_beside(const std::vector<Vector2d>& places, std::size_t num_points,
                               double most)
{
    std::vector<std::pair<Kernel::Point_2, std::uint32_t>> numbered(places.size());
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        numbered[i] = {{places[i].x(), places[i].y()}, i};
    }
    const Triangulation triangulation(numbered.begin(), numbered.end());
    std::vector<Pair> pairs;
    for (const auto& [face, slot] : triangulation.finite_edges()) {
        const auto [point, passage] = std::minmax({face->vertex(Triangulation::ccw(slot))->info(),
                                                   face->vertex(Triangulation::cw(slot))->info()});
        if (point >= num_points || passage < num_points) continue;
        const double apart = (places[passage] - places[point]).norm();
        if (apart <= most) pairs.push_back({apart, point, passage});
    }
    std::ranges::sort(
        pairs, {}, [](const Pair& pair) { return std::tie(pair.apart, pair.point, pair.passage); });
    return pairs;
}

/// Finds where the flat parts of a scene end.
class Borders {
  public:
    Borders(const Scene& scene, const NearestNeighbors& tree, const FlatParts& parts, double gap)
        : scene_(scene), tree_(tree), parts_(parts), patches_(parts.patches), gap_(gap)
    {
        for (const Patch& patch : patches_) {
            frames_.emplace_back(patch.region->plane);
        }
    }

    /// The places along all borders, in an order that does not depend on the threads.
    std::vector<AddedPlace> places(const Progress& progress) const
    {
        const std::vector<Passage> passages = this->passages(progress.part(0.0, 0.6));
        const auto look = [&](std::size_t patch, std::vector<AddedPlace>& found) {
            add_places(patch, passages, found);
        };
        return parallel_collect<AddedPlace>(patches_.size(), progress.part(0.6, 1.0), look, 1);
    }

  private:
    /// How far from the points of a patch passages count.
    double near(std::size_t patch) const { return gap_ * patches_[patch].region->spacing; }

    /// The places in the plane of a patch of its points that have neighbours to one side only, as
    /// those along a border have.
    std::vector<Vector2d> one_sided(std::uint32_t patch) const
    {
        std::vector<Vector2d> places;
        for (std::size_t i = 0; i < patches_[patch].positions.size(); ++i) {
            if (parts_.planes.is_one_sided[patches_[patch].region->points[i]] != 0)
                places.push_back(frames_[patch].in_plane(patches_[patch].positions[i]));
        }
        return places;
    }

    /// The passages of sights through the planes of patches near their points, by patch: of each
    /// point's sights the first and the last one, since those between pass between them. Patches
    /// that hardly end anywhere, as those of something round, are not asked.
    std::vector<Passage> passages(const Progress& progress) const
    {
        constexpr std::size_t kFewest = 20;        // smaller ones are often no planes
        constexpr std::size_t kFewestOneSided = 3; // by chance one or two are anywhere
        std::vector<std::array<Vector3d, 3>> triangles;
        std::vector<std::uint32_t> owners; // of both triangles of a patch
        for (std::uint32_t i = 0; i < patches_.size(); ++i) {
            if (patches_[i].positions.size() < kFewest) continue;
            const std::vector<Vector2d> one_sided = this->one_sided(i);
            if (one_sided.size() < kFewestOneSided) continue;
            owners.push_back(i);
            const auto [a, b, c, d] = rectangle_around(one_sided, frames_[i], near(i));
            triangles.push_back({a, b, c});
            triangles.push_back({c, d, a});
        }
        const TriangleTree tree(triangles);
        const auto look = [&](std::size_t point, std::vector<Passage>& found) {
            thread_local std::vector<std::uint32_t> met;
            const auto through = [&](const Vector3d& from, const Vector3d& to) {
                met.clear();
                tree.visit_met(from, to,
                               [&](std::size_t triangle) { met.push_back(owners[triangle / 2]); });
                sort_unique(met);
                for (const std::uint32_t patch : met) {
                    add_passage(patch, from, to, found);
                }
            };
            const auto track = scene_.tracks[point];
            if (track.empty()) return;
            for (const std::uint32_t view : {track.front(), track.back()}) {
                visit_sight(scene_, point, view, parts_.planes.spacings[point], through);
            }
        };
        std::vector<Passage> found =
            parallel_collect<Passage>(scene_.num_points(), progress, look, 4096);
        std::ranges::stable_sort(found, {}, &Passage::patch);
        return found;
    }

    /// That of a sight through the plane of a patch, if it is near the patch's points.
    void add_passage(std::uint32_t patch, const Vector3d& from, const Vector3d& to,
                     std::vector<Passage>& found) const
    {
        const Plane& plane = patches_[patch].region->plane;
        const double before = plane.normal.dot(from - plane.center);
        const double behind = plane.normal.dot(to - plane.center);
        if (before == behind) return; // in the plane
        const Vector3d place = from + before / (before - behind) * (to - from);
        if (has_point_near(patches_[patch], place, near(patch)))
            found.push_back({patch, frames_[patch].in_plane(place)});
    }

    void add_places(std::size_t patch, const std::vector<Passage>& all,
                    std::vector<AddedPlace>& found) const
    {
        constexpr double kShare = 0.3; // of the way from the point to the passage
        const auto first = std::ranges::lower_bound(all, patch, {}, &Passage::patch);
        const auto last = std::ranges::upper_bound(all, patch, {}, &Passage::patch);
        const std::span<const Passage> passages(first, last);
        if (passages.empty()) return;
        const std::vector<Vector3d>& points = patches_[patch].positions;
        std::vector<Vector2d> places(points.size());
        std::ranges::transform(points, places.begin(), [&](const Vector3d& position) {
            return frames_[patch].in_plane(position);
        });
        std::ranges::transform(passages, std::back_inserter(places), &Passage::place);
        for (const Pair& pair : pairs_beside(places, points.size(), near(patch))) {
            const Vector3d& point = points[pair.point];
            const Passage& passage = passages[pair.passage - points.size()];
            AddedPlace place{.step = patches_[patch].region->spacing, .id = kBorderPointId};
            place.position = point + kShare * (frames_[patch].in_space(passage.place) - point);
            if (is_right(patch, place)) found.push_back(std::move(place));
        }
    }

    /// Whether a place is to have a point; it is told what stands beside it and who sees it.
    bool is_right(std::size_t patch, AddedPlace& place) const
    {
        constexpr double kThere = 0.2; // spacings
        constexpr std::size_t kLook = 8;
        constexpr std::size_t kMost = 5;
        const PlanarRegion& region = *patches_[patch].region;
        std::vector<NearestNeighbors::Neighbor> around;
        tree_.find(place.position, kLook, around);
        const double there = kThere * region.spacing;
        if (around.front().distance_sq < there * there) return false;
        std::vector<Near> own;
        for (const NearestNeighbors::Neighbor& near : around) {
            if (parts_.region_of[near.point] == patch)
                own.emplace_back(std::sqrt(near.distance_sq), near.point);
        }
        if (own.size() < kMost) return false;
        const std::vector<std::uint32_t> beside = nearest_two(own, kRounding * region.spacing);
        place.beside = {beside.front()};
        place.track = views_showing(scene_, beside, place.position);
        std::erase_if(place.track, [&](std::uint32_t view) {
            return region.plane.normal.dot(scene_.views[view].center - place.position) <= 0.0;
        });
        return place.track.size() >= 2;
    }

    const Scene& scene_;
    const NearestNeighbors& tree_;
    const FlatParts& parts_;
    const std::vector<Patch>& patches_;
    double gap_;
    std::vector<PlaneFrame> frames_;
};

} // namespace

std::vector<AddedPlace> border_places(const Scene& scene, const NearestNeighbors& tree,
                                       const FlatParts& parts, double gap, const Progress& progress)
{
    if (parts.patches.empty()) return {};
    return Borders(scene, tree, parts, gap).places(progress);
}

} // namespace vcarve
