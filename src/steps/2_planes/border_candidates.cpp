#include "base/arrays.h"
#include "base/parallel.h"
#include "geometry/cgal_kernel.h"
#include "geometry/triangle_tree.h"
#include "steps/2_planes/added_points.h"
#include "steps/2_planes/candidates.h"
#include "steps/2_planes/planar_regions.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
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

using Triangulation = CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<
                CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>>>;

/// The intersection of a ray with the plane of a region.
struct Crossing {
    std::uint32_t region;
    Vector2d place; ///< in the plane's frame
};

/// A point of a region and a neighboring crossing of its plane.
struct BorderPair {
    double apart; ///< distance
    std::uint32_t point;
    std::uint32_t crossing;
};

/// Returns the edges between points and crossings in the Delaunay triangulation of positions in a
/// plane. The first `num_points` positions are points. Edges are at most `most` long, and the
/// shortest come first.
std::vector<BorderPair> pairs_beside(const std::vector<Vector2d>& places, std::size_t num_points,
                                     double most)
{
    std::vector<std::pair<Kernel::Point_2, std::uint32_t>> numbered(places.size());
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        numbered[i] = {{places[i].x(), places[i].y()}, i};
    }
    const Triangulation triangulation(numbered.begin(), numbered.end());
    std::vector<BorderPair> pairs;
    for (const auto& [face, slot] : triangulation.finite_edges()) {
        const auto [point, crossing] = std::minmax({face->vertex(Triangulation::ccw(slot))->info(),
                                                    face->vertex(Triangulation::cw(slot))->info()});
        if (point >= num_points || crossing < num_points) continue;
        const double apart = (places[crossing] - places[point]).norm();
        if (apart <= most) pairs.push_back({apart, point, crossing});
    }
    std::ranges::sort(pairs, {}, [](const BorderPair& pair) {
        return std::tie(pair.apart, pair.point, pair.crossing);
    });
    return pairs;
}

/// Finds the borders of the planar regions of a scene.
class Borders {
  public:
    Borders(const Scene& scene, const PlanarRegions& planes, double gap)
        : scene_(scene), planes_(planes), gap_(gap)
    {
        for (const PlanarRegion& region : planes.regions) {
            frames_.emplace_back(region.plane);
        }
    }

    std::vector<Candidate> candidates(const Progress& progress) const
    {
        const std::vector<Crossing> crossings = this->crossings(progress.part(0.0, 0.6));
        const auto look = [&](std::size_t region, std::vector<Candidate>& found) {
            const auto number = static_cast<std::uint32_t>(region);
            const auto first = std::ranges::lower_bound(crossings, number, {}, &Crossing::region);
            const auto last = std::ranges::upper_bound(crossings, number, {}, &Crossing::region);
            if (first != last) add_candidates(number, {first, last}, found);
        };
        return parallel_collect<Candidate>(frames_.size(), progress.part(0.6, 1.0), look, 1);
    }

  private:
    /// Maximum distance of a crossing to the points of a region.
    double near(std::size_t region) const { return gap_ * planes_.regions[region].spacing; }

    /// A rectangle in the plane around the points of a region and all possible crossings.
    std::array<Vector3d, 4> rectangle_around(std::size_t region) const
    {
        const PlaneFrame& frame = frames_[region];
        Eigen::AlignedBox2d box;
        for (const Vector3d& position : planes_.regions[region].positions) {
            box.extend(frame.in_plane(position));
        }
        const Vector2d low = box.min().array() - near(region);
        const Vector2d high = box.max().array() + near(region);
        return {frame.in_space(low), frame.in_space({high.x(), low.y()}), frame.in_space(high),
                frame.in_space({low.x(), high.y()})};
    }

    /// The crossings of planes near the points of their regions, sorted by region. Only the first
    /// and the last ray of each point are tested, because the others are between them.
    std::vector<Crossing> crossings(const Progress& progress) const
    {
        constexpr std::size_t kFewest = 20;
        std::vector<std::array<Vector3d, 3>> triangles;
        std::vector<std::uint32_t> owners; // one per two triangles
        for (std::uint32_t i = 0; i < planes_.regions.size(); ++i) {
            if (planes_.regions[i].points.size() < kFewest) continue;
            owners.push_back(i);
            const auto [a, b, c, d] = rectangle_around(i);
            triangles.push_back({a, b, c});
            triangles.push_back({c, d, a});
        }
        if (triangles.empty()) return {};
        const TriangleTree tree(triangles);
        const auto look = [&](std::size_t point, std::vector<Crossing>& found) {
            thread_local std::vector<std::uint32_t> met;
            const auto through = [&](const Vector3d& from, const Vector3d& to) {
                met.clear();
                tree.visit_met(from, to,
                               [&](std::size_t triangle) { met.push_back(owners[triangle / 2]); });
                sort_unique(met);
                for (const std::uint32_t region : met) {
                    add_crossing(region, from, to, found);
                }
            };
            const auto track = scene_.tracks[point];
            if (track.empty()) return;
            for (const std::uint32_t view : {track.front(), track.back()}) {
                visit_ray(scene_, point, view, planes_.spacings[point], through);
            }
        };
        std::vector<Crossing> found =
            parallel_collect<Crossing>(scene_.num_points(), progress, look, 4096);
        std::ranges::stable_sort(found, {}, &Crossing::region);
        return found;
    }

    /// Adds the crossing of a ray with the plane of a region, if it is near the region's points.
    void add_crossing(std::uint32_t region, const Vector3d& from, const Vector3d& to,
                      std::vector<Crossing>& found) const
    {
        const Plane& plane = planes_.regions[region].plane;
        const double before = plane.height_of(from);
        const double behind = plane.height_of(to);
        if (before == behind) return; // parallel to the plane
        const Vector3d place = from + before / (before - behind) * (to - from);
        if (planes_.regions[region].has_point_near(place, near(region)))
            found.push_back({region, frames_[region].in_plane(place)});
    }

    void add_candidates(std::uint32_t region, std::span<const Crossing> crossings,
                        std::vector<Candidate>& found) const
    {
        constexpr double kShare = 0.3; // of the distance from the point to the crossing
        const std::vector<Vector3d>& points = planes_.regions[region].positions;
        std::vector<Vector2d> places(points.size());
        std::ranges::transform(points, places.begin(), [&](const Vector3d& position) {
            return frames_[region].in_plane(position);
        });
        std::ranges::transform(crossings, std::back_inserter(places), &Crossing::place);
        for (const BorderPair& pair : pairs_beside(places, points.size(), near(region))) {
            const Vector3d& point = points[pair.point];
            const Vector3d crossing = frames_[region].in_space(places[pair.crossing]);
            found.push_back({.position = point + kShare * (crossing - point),
                             .kind = PointKind::border,
                             .step = planes_.regions[region].spacing,
                             .regions = {region, region}});
        }
    }

    const Scene& scene_;
    const PlanarRegions& planes_;
    double gap_;
    std::vector<PlaneFrame> frames_; ///< one per region
};

} // namespace

std::vector<Candidate> border_candidates(const Scene& scene, const PlanarRegions& planes,
                                         double gap, const Progress& progress)
{
    return Borders(scene, planes, gap).candidates(progress);
}

} // namespace vcarve
