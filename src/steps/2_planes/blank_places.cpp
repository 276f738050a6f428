#include "steps/2_planes/blank_places.h"

#include "base/parallel.h"
#include "steps/2_planes/covers.h"
#include "steps/2_planes/plane_grid.h"
#include "steps/2_planes/plane_hull.h"
#include "steps/2_planes/shown_points.h"
#include "steps/2_planes/sights_through.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// Walks over the squares of a grid, ring by ring around some, through those that may_enter(square)
/// lets it enter, and calls visit(square) for each of these, `most` at most.
template <typename MayEnter, typename Visit>
void spread(std::set<Square> from, std::size_t most, const MayEnter& may_enter, const Visit& visit)
{
    std::vector<Square> ring(from.begin(), from.end());
    std::set<Square>& reached = from;
    std::size_t visited = 0;
    while (!ring.empty()) {
        std::vector<Square> next;
        for (const Square& square : ring) {
            for (const Square& beside : squares_beside(square)) {
                if (!reached.insert(beside).second || !may_enter(beside)) continue;
                if (visited++ == most) return;
                visit(beside);
                next.push_back(beside);
            }
        }
        ring = std::move(next);
    }
}

/// The points of a patch nearest to a place, the nearest first.
std::vector<std::uint32_t> nearest_few(const Patch& patch, const Vector3d& place)
{
    constexpr std::size_t kFew = 4;
    std::vector<PointTree::Near> nearest;
    patch.tree.find_nearest(place, kFew, nearest);
    std::vector<std::uint32_t> points(nearest.size());
    std::ranges::transform(nearest, points.begin(), [&](const PointTree::Near& near) {
        return patch.region->points[near.point];
    });
    return points;
}

/// The place for a point of a square: near its middle, and next to the plane, as far off as the
/// square's numbers tell. Of points in rows on a plane rounding would tell which cells there are.
Vector3d place_in(const Square& square, const PlaneGrid& grid, const Vector3d& normal)
{
    constexpr double kAside = 0.1; // of a side, at most
    constexpr double kOff = 1e-3;  // the same
    const auto column = static_cast<double>(square.first);
    const auto row = static_cast<double>(square.second);
    const auto turned = [&](double a, double b, double c) {
        const double turns = a * column * column + b * row * row + c * column * row;
        return 2.0 * (turns - std::floor(turns)) - 1.0;
    };
    const double right = turned(0.6180339887, 0.4142135624, 0.7320508076);
    const double up = turned(0.2360679775, 0.6457513111, 0.3166247904);
    const double off = turned(0.1622776602, 0.8729833462, 0.5825756950);
    return grid.place_in(square, 0.5 + kAside * right, 0.5 + kAside * up) +
           kOff * grid.side() * off * normal;
}

/// A square of a patch's plane in which the patch has no point.
struct PatchSquare {
    std::uint32_t patch = 0;
    Square square;
};

/// One of them, and a place in it.
struct Blank : AddedPlace, PatchSquare {};

/// A view that looks at a blank.
struct Look {
    std::uint32_t view;
    std::uint32_t blank;
};

/// Finds the blanks of a scene's flat parts.
class Blanks {
  public:
    Blanks(const Scene& scene, const NearestNeighbors& tree, const FlatParts& parts, double step)
        : scene_(scene), tree_(tree), parts_(parts)
    {
        for (const Patch& patch : parts.patches) {
            grids_.emplace_back(patch.region->plane, step * patch.region->spacing);
        }
    }

    std::vector<AddedPlace> places(const Progress& progress) const
    {
        const auto squares = squares_without_points(progress.part(0.0, 0.1));
        if (squares.empty()) return {};
        std::vector<Blank> blanks = places_in(squares, progress.part(0.1, 0.3));
        keep_tracks_that_look(blanks, progress.part(0.3, 0.7));
        std::erase_if(blanks, [](const Blank& blank) { return blank.track.size() < 2; });
        leave_out_seen_through(blanks, progress.part(0.7, 1.0));
        return connected(blanks);
    }

  private:
    std::set<Square> squares_with_points(std::uint32_t patch) const
    {
        std::set<Square> squares;
        for (const Vector3d& position : parts_.patches[patch].positions) {
            squares.insert(grids_[patch].square_of(position));
        }
        return squares;
    }

    /// The squares without points within the hull of each patch: no more of a patch than it has
    /// points, those next to these first.
    std::vector<PatchSquare> squares_without_points(const Progress& progress) const
    {
        constexpr std::size_t kFewest = 100; // a smaller part may be a piece of something round
        const auto look = [&](std::size_t i, std::vector<PatchSquare>& found) {
            const auto patch = static_cast<std::uint32_t>(i);
            const std::vector<Vector3d>& points = parts_.patches[patch].positions;
            if (points.size() < kFewest || !grids_[patch].can_number(points)) return;
            const PlaneHull hull(points, grids_[patch].frame());
            spread(
                squares_with_points(patch), points.size(),
                [&](const Square& square) {
                    return std::ranges::all_of(
                        grids_[patch].corners_of(square),
                        [&](const Vector3d& corner) { return hull.contains(corner); });
                },
                [&](const Square& square) {
                    found.push_back({patch, square});
                });
        };
        return parallel_collect<PatchSquare>(grids_.size(), progress, look, 1);
    }

    /// A place in each square, unless a point is near, with the views that may look at it.
    std::vector<Blank> places_in(const std::vector<PatchSquare>& squares,
                                 const Progress& progress) const
    {
        const Covers covers(parts_);
        const auto look = [&](std::size_t i, std::vector<Blank>& blanks) {
            const auto& [patch, square] = squares[i];
            const PlaneGrid& grid = grids_[patch];
            const Vector3d place =
                place_in(square, grid, parts_.patches[patch].region->plane.normal);
            if (!tree_.has_nearer(place, 0.5 * grid.side())) {
                blanks.push_back(blank_in(squares[i], place, covers));
            }
        };
        return parallel_collect<Blank>(squares.size(), progress, look, 64);
    }

    Blank blank_in(const PatchSquare& in, const Vector3d& place, const Covers& covers) const
    {
        constexpr double kClearly = 0.5; // spacings over its plane
        const std::uint32_t patch = in.patch;
        const PlanarRegion& region = *parts_.patches[patch].region;
        const Vector3d& normal = region.plane.normal;
        Blank blank{{.position = place,
                     .step = grids_[patch].side(),
                     .id = kBlankPointId,
                     .beside = nearest_few(parts_.patches[patch], place)},
                    in};
        blank.track = views_showing(scene_, blank.beside, place);
        const std::vector<std::uint32_t> over =
            covers.over(place, normal, kClearly * region.spacing);
        std::erase_if(blank.track, [&](std::uint32_t view) {
            const Vector3d& center = scene_.views[view].center;
            return normal.dot(center - place) <= 0.0 ||
                   std::ranges::any_of(over, [&](std::uint32_t cover) {
                       const Plane& plane = parts_.patches[cover].region->plane;
                       return plane.normal.dot(center - plane.center) > 0.0;
                   });
        });
        return blank;
    }

    /// Of each track only the views that look at the blank. One view after the other is asked about
    /// all that it may look at.
    void keep_tracks_that_look(std::vector<Blank>& blanks, const Progress& progress) const
    {
        std::vector<std::vector<std::uint32_t>> asked(scene_.views.size()); // blanks, by view
        for (std::uint32_t i = 0; i < blanks.size(); ++i) {
            for (const std::uint32_t view : std::exchange(blanks[i].track, {})) {
                asked[view].push_back(i);
            }
        }
        std::vector<std::vector<std::uint32_t>> points(asked.size()); // by view
        for (std::uint32_t point = 0; point < scene_.num_points(); ++point) {
            for (const std::uint32_t view : scene_.tracks[point]) {
                if (!asked[view].empty()) points[view].push_back(point);
            }
        }
        const auto ask = [&](std::size_t i, std::vector<Look>& looks) {
            const auto view = static_cast<std::uint32_t>(i);
            if (asked[view].empty()) return;
            const ShownPoints shown(scene_, view, std::move(points[view]));
            for (const std::uint32_t blank : asked[view]) {
                if (shown.looks_at(blanks[blank].position, parts_, blanks[blank].patch))
                    looks.push_back({view, blank});
            }
        };
        for (const auto& [view, blank] : parallel_collect<Look>(asked.size(), progress, ask, 1)) {
            blanks[blank].track.push_back(view);
        }
    }

    /// Leaves out squares through which a sight passes: there is no surface.
    void leave_out_seen_through(std::vector<Blank>& blanks, const Progress& progress) const
    {
        std::vector<std::array<Vector3d, 3>> triangles;
        for (const Blank& blank : blanks) {
            std::ranges::copy(grids_[blank.patch].halves_of(blank.square),
                              std::back_inserter(triangles));
        }
        const auto counts = sights_through(scene_, triangles, parts_.planes.spacings, progress);
        auto next = counts.begin();
        std::erase_if(blanks, [&](const Blank&) {
            const auto first = std::exchange(next, next + 2);
            return *first + *(first + 1) > 0;
        });
    }

    /// Of blanks, which are in the order of their patches, those that hang together with their
    /// patch's points.
    std::vector<AddedPlace> connected(const std::vector<Blank>& blanks) const
    {
        const auto look = [&](std::size_t patch, std::vector<AddedPlace>& found) {
            const auto first = std::ranges::lower_bound(blanks, patch, {}, &Blank::patch);
            const auto last = std::ranges::upper_bound(blanks, patch, {}, &Blank::patch);
            const std::span<const Blank> own(first, last);
            if (own.empty()) return;
            std::map<Square, const Blank*> blank_of;
            for (const Blank& blank : own) {
                blank_of[blank.square] = &blank;
            }
            spread(
                squares_with_points(static_cast<std::uint32_t>(patch)), own.size(),
                [&](const Square& square) { return blank_of.contains(square); },
                [&](const Square& square) { found.push_back(*blank_of.at(square)); });
        };
        return parallel_collect<AddedPlace>(parts_.patches.size(), look, 1);
    }

    const Scene& scene_;
    const NearestNeighbors& tree_;
    const FlatParts& parts_;
    std::vector<PlaneGrid> grids_; ///< of each patch
};

} // namespace

std::vector<AddedPlace> blank_places(const Scene& scene, const NearestNeighbors& tree,
                                     const FlatParts& parts, double step, const Progress& progress)
{
    return Blanks(scene, tree, parts, step).places(progress);
}

} // namespace vcarve
