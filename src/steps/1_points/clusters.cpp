#include "steps/1_points/clusters.h"

#include "base/arrays.h"
#include "base/parallel.h"
#include "model/colors.h"
#include "model/scene_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::uint32_t kAlone = 0xffffffffU; ///< the leader of a dot without a cluster
constexpr int kLevels = 21;         ///< nested cube sizes; a cube's number has 3 x 21 bits
constexpr int kFiner = 6;           ///< levels below the unit; still finer dots use the finest
constexpr std::uint32_t kUsed = 16; ///< levels on which dots are merged

/// Inserts two zeros before each bit of a number below 2^21.
std::uint64_t spread_bits(std::uint64_t number)
{
    number = (number | (number << 32U)) & 0x001f00000000ffffU;
    number = (number | (number << 16U)) & 0x001f0000ff0000ffU;
    number = (number | (number << 8U)) & 0x100f00f00f00f00fU;
    number = (number | (number << 4U)) & 0x10c30c30c30c30c3U;
    return (number | (number << 2U)) & 0x1249249249249249U;
}

/// Cubes whose sides are powers of two times one length.
struct CubeGrid {
    Vector3d corner;
    double finest; ///< smallest side

    /// The Morton code of the finest cube that contains a position, so that the cubes within a
    /// larger one are consecutive. Returns nothing if the position is outside the numbered cubes.
    std::optional<std::uint64_t> code(const Vector3d& place) const
    {
        constexpr double kMost = 1U << kLevels;
        const Vector3d cell = ((place - corner) / finest).array().floor();
        // The comparison also rejects NaN.
        if (!(cell.array() >= 0.0 && cell.array() < kMost).all()) return std::nullopt;
        std::uint64_t code = 0;
        for (int axis = 0; axis < 3; ++axis) {
            code = (code << 1U) | spread_bits(static_cast<std::uint64_t>(cell[axis]));
        }
        return code;
    }
};

/// A dot with its cube and level.
struct Placed {
    std::uint64_t code;
    std::uint32_t dot;
    std::uint32_t level; ///< kUsed for a dot that is not merged

    bool operator<(const Placed& other) const
    {
        return std::tie(level, code, dot) < std::tie(other.level, other.code, other.dot);
    }
    std::uint64_t cube(std::uint32_t of_level) const { return code >> (3 * of_level); }
};

/// A dot that leads a cluster, and its cube.
struct Leader {
    std::uint64_t code;
    std::uint32_t dot;

    bool operator<(const Leader& other) const
    {
        return std::tie(code, dot) < std::tie(other.code, other.dot);
    }
};

/// Whether the normals allow two dots to be merged.
bool agree(const Dots& dots, std::uint32_t a, std::uint32_t b)
{
    constexpr float kAgreement = 0.5F; // cosine
    const auto& normals = dots.normals;
    return normals.empty() || normals[a].dot(normals[b]) >= kAgreement || normals[a].isZero() ||
           normals[b].isZero();
}

/// Finds the clusters of dots.
class Clustering {
  public:
    Clustering(const Dots& dots, const CubesForDots& cubes) : dots_(dots), reach_(cubes.reach)
    {
        grid_.finest = std::ldexp(cubes.unit, -kFiner);
        grid_.corner =
            Vector3d::Constant(cubes.unit * cubes.shift - std::ldexp(grid_.finest, kLevels - 1));
    }

    std::vector<std::uint32_t> leaders()
    {
        leader_of_.resize(dots_.size());
        UnsetArray<Placed> placed(dots_.size());
        parallel_for(dots_.size(), [&](std::size_t dot) {
            leader_of_[dot] = static_cast<std::uint32_t>(dot);
            placed[dot] = place(static_cast<std::uint32_t>(dot));
        });
        parallel_sort(placed);
        auto begin = placed.begin();
        for (std::uint32_t level = 0; level < kUsed; ++level) {
            const auto end =
                std::ranges::upper_bound(begin, placed.end(), level, {}, &Placed::level);
            add_level({begin, end}, level);
            begin = end;
        }
        return std::move(leader_of_);
    }

  private:
    /// Selects the level whose side is nearest to the footprint of a dot, as a ratio.
    Placed place(std::uint32_t dot) const
    {
        const double footprint = dots_.footprints[dot];
        const std::optional<std::uint64_t> code = grid_.code(dots_.positions[dot]);
        if (!code || !std::isfinite(footprint)) return {0, dot, kUsed};
        const double level = std::round(std::log2(footprint / grid_.finest));
        return {*code, dot, static_cast<std::uint32_t>(std::clamp(level, 0.0, kUsed - 1.0))};
    }

    /// Assigns the dots of a level to existing or new leaders, cube by cube.
    void add_level(std::span<const Placed> dots, std::uint32_t level)
    {
        const auto begins_cube = [&](std::size_t i) {
            return i == 0 || dots[i].cube(level) != dots[i - 1].cube(level);
        };
        auto fresh = parallel_collect<Leader>(dots.size(), [&](std::size_t i, auto& found) {
            if (!begins_cube(i)) return;
            std::size_t end = i + 1;
            while (end < dots.size() && !begins_cube(end)) {
                ++end;
            }
            const auto cube = [&](const Leader& leader) { return leader.code >> (3 * level); };
            const std::uint64_t number = dots[i].cube(level);
            const auto first = std::ranges::lower_bound(leaders_, number, {}, cube);
            const auto last = std::ranges::upper_bound(leaders_, number, {}, cube);
            join(dots.subspan(i, end - i), {first, last}, found);
        });
        parallel_sort(fresh);
        std::vector<Leader> all(leaders_.size() + fresh.size());
        std::merge(leaders_.begin(), leaders_.end(), fresh.begin(), fresh.end(), all.begin());
        leaders_ = std::move(all);
    }

    /// Assigns each dot of a cube to the nearest leader with a similar normal. Dots without such a
    /// leader become leaders, in descending order of views.
    void join(std::span<const Placed> own, std::vector<Leader> leaders, std::vector<Leader>& fresh)
    {
        std::vector<Placed> by_views(own.begin(), own.end());
        std::ranges::sort(by_views, [&](const Placed& a, const Placed& b) {
            return std::pair(dots_.num_views[b.dot], a.dot) <
                   std::pair(dots_.num_views[a.dot], b.dot);
        });
        for (const Placed& placed : by_views) {
            const std::uint32_t leader = nearest(placed, leaders);
            if (leader == kAlone) {
                leaders.push_back({placed.code, placed.dot});
                fresh.push_back(leaders.back());
            } else {
                leader_of_[placed.dot] = leader;
            }
        }
    }

    std::uint32_t nearest(const Placed& placed, const std::vector<Leader>& leaders) const
    {
        const double reach = reach_ * std::ldexp(grid_.finest, static_cast<int>(placed.level));
        double least_sq = reach * reach;
        std::uint32_t best = kAlone;
        for (const Leader& leader : leaders) {
            const double distance_sq =
                (dots_.positions[leader.dot] - dots_.positions[placed.dot]).squaredNorm();
            if (distance_sq >= least_sq || !agree(dots_, leader.dot, placed.dot)) continue;
            least_sq = distance_sq;
            best = leader.dot;
        }
        return best;
    }

    const Dots& dots_;
    double reach_;
    CubeGrid grid_{};
    std::vector<Leader> leaders_; ///< found so far, sorted by code
    std::vector<std::uint32_t> leader_of_;
};

/// The points of one cluster.
class Members {
  public:
    Members(const MergedPoints& points, std::span<const std::uint32_t> places)
        : points_(points), places_(places)
    {
        for (const std::uint32_t place : places_) {
            weight_ += weight(place);
        }
    }

    std::uint32_t count() const { return static_cast<std::uint32_t>(weight_); }

    Vector3d mean_position() const
    {
        Vector3d sum = Vector3d::Zero();
        for (const std::uint32_t place : places_) {
            sum += weight(place) * points_.scene.positions[place];
        }
        return sum / weight_;
    }

    Color mean_color() const
    {
        return vcarve::mean_color(points_.scene, places_,
                                  [&](std::uint32_t place) { return weight(place); });
    }

    Vector3f mean_normal() const
    {
        Vector3f sum = Vector3f::Zero();
        for (const std::uint32_t place : places_) {
            sum += static_cast<float>(weight(place)) * points_.scene.normals[place];
        }
        return sum.normalized(); // keeps zero
    }

  private:
    double weight(std::uint32_t place) const
    {
        return points_.counts.empty() ? 1.0 : points_.counts[place];
    }

    const MergedPoints& points_;
    std::span<const std::uint32_t> places_;
    double weight_ = 0.0; ///< sum over all members
};

} // namespace

std::vector<std::uint32_t> leaders_in_cubes(const Dots& dots, const CubesForDots& cubes)
{
    return Clustering(dots, cubes).leaders();
}

Clusters::Clusters(const std::vector<std::uint32_t>& leader_of)
    : members_(
          gather_rows(leader_of.size(), leader_of.size(), [&](std::size_t dot, const auto& visit) {
              visit(leader_of[dot], static_cast<std::uint32_t>(dot));
          }))
{
    for (std::uint32_t dot = 0; dot < leader_of.size(); ++dot) {
        if (leader_of[dot] == dot) leaders_.push_back(dot);
    }
}

MergedPoints merge_points(const MergedPoints& points, const Clusters& clusters)
{
    const Scene& scene = points.scene;
    MergedPoints result{without_points(scene), std::vector<std::uint32_t>(clusters.size())};
    Scene& merged = result.scene;
    merged.positions.resize(clusters.size());
    merged.colors.resize(clusters.size());
    if (!scene.normals.empty()) merged.normals.resize(clusters.size());
    parallel_for(clusters.size(), [&](std::size_t i) {
        const Members members(points, clusters[i]);
        merged.positions[i] = members.mean_position();
        merged.colors[i] = members.mean_color();
        if (!scene.normals.empty()) merged.normals[i] = members.mean_normal();
        result.counts[i] = members.count();
    });
    merged.errors_px = values_at(clusters.leaders(), scene.errors_px);
    merged.point_ids = values_at(clusters.leaders(), scene.point_ids);
    merged.tracks = united_tracks(scene.tracks, clusters);
    return result;
}

void append(MergedPoints& points, MergedPoints more)
{
    if (more.counts.empty()) more.counts.assign(more.scene.num_points(), 1);
    if (points.scene.num_points() == 0) {
        points = std::move(more);
        return;
    }
    const auto add = [](auto& values, const auto& others) {
        values.insert(values.end(), others.begin(), others.end());
    };
    const std::size_t first = points.scene.num_rays();
    add(points.scene.positions, more.scene.positions);
    add(points.scene.colors, more.scene.colors);
    add(points.scene.errors_px, more.scene.errors_px);
    add(points.scene.point_ids, more.scene.point_ids);
    add(points.scene.normals, more.scene.normals);
    add(points.scene.tracks.views, more.scene.tracks.views);
    add(points.counts, more.counts);
    std::vector<std::uint64_t>& begins = points.scene.tracks.begins;
    for (std::size_t i = 1; i <= more.scene.num_points(); ++i) {
        begins.push_back(first + more.scene.tracks.begins[i]);
    }
}

} // namespace vcarve
