#include "steps/1_points/thin.h"

#include "base/median.h"
#include "base/parallel.h"
#include "base/parallel_sort.h"
#include "model/camera.h"
#include "model/scene_points.h"
#include "model/united_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::uint32_t kAlone =
    0xffffffffU;            ///< stands for the cluster of a point that has none yet
constexpr int kLevels = 21; ///< of cubes, one within the other; 3 x 21 bits number them

/// Points or clusters of points: where they are, how fine they were seen, and how much they weigh.
struct Dots {
    std::vector<Vector3d> positions;
    std::vector<Vector3f> normals;  ///< empty, or one a dot
    std::vector<double> footprints; ///< infinite: never merged
    std::vector<std::uint32_t> num_views;

    std::size_t size() const { return positions.size(); }
    /// Whether two dots may be the same piece of surface.
    bool agree(std::uint32_t a, std::uint32_t b) const
    {
        constexpr float kAgreement = 0.5F; // cosine
        return normals.empty() || normals[a].dot(normals[b]) >= kAgreement || normals[a].isZero() ||
               normals[b].isZero();
    }
};

/// Cubes whose sides are a power of two times one length.
struct CubeGrid {
    Vector3d corner;
    double finest; ///< side

    /// Which of the finest cubes holds a place, numbered so that the cubes within a larger one
    /// follow each other (Morton order); nothing where it lies beyond all that are numbered.
    std::optional<std::uint64_t> code(const Vector3d& place) const
    {
        constexpr double kMost = 1U << kLevels;
        std::uint64_t code = 0;
        const Vector3d cell = ((place - corner) / finest).array().floor();
        if (!(cell.minCoeff() >= 0.0 && cell.maxCoeff() < kMost)) return std::nullopt;
        for (int bit = kLevels - 1; bit >= 0; --bit) {
            for (int axis = 0; axis < 3; ++axis) {
                const auto number = static_cast<std::uint64_t>(cell[axis]);
                code = (code << 1U) | ((number >> static_cast<unsigned>(bit)) & 1U);
            }
        }
        return code;
    }
};

/// A dot and its cube.
struct Placed {
    std::uint64_t code;
    std::uint32_t dot;

    bool operator<(const Placed& other) const
    {
        return code != other.code ? code < other.code : dot < other.dot;
    }
    std::uint64_t cube(int level) const { return code >> static_cast<unsigned>(3 * level); }
};

/// Finds the clusters of dots. Each is named by its leader, one of its dots.
class Clustering {
  public:
    /// Dots join a leader nearer than `reach` times the side of their cube.
    Clustering(const Dots& dots, double reach) : dots_(dots), reach_(reach) {}

    /// The leader of every dot.
    std::vector<std::uint32_t> leaders(double unit, const Vector3d& shift)
    {
        leader_of_.resize(dots_.size());
        for (std::uint32_t dot = 0; dot < dots_.size(); ++dot) {
            leader_of_[dot] = dot;
        }
        constexpr int kFiner = 6; // levels below the usual footprint; finer ones count as these
        constexpr int kUsed = 16;
        grid_.finest = std::ldexp(unit, -kFiner);
        grid_.corner = Vector3d::Constant(-std::ldexp(grid_.finest, kLevels - 1)) + unit * shift;
        const std::vector<std::vector<Placed>> levels = by_level(kUsed);
        for (int level = 0; level < kUsed; ++level) {
            add_level(levels[static_cast<std::size_t>(level)], level);
        }
        return std::move(leader_of_);
    }

  private:
    /// The dots whose footprint is nearest to the side of a level's cubes, as a factor, by cube.
    std::vector<std::vector<Placed>> by_level(int count) const
    {
        std::vector<std::vector<Placed>> levels(static_cast<std::size_t>(count));
        for (std::uint32_t dot = 0; dot < dots_.size(); ++dot) {
            const double footprint = dots_.footprints[dot];
            const std::optional<std::uint64_t> code = grid_.code(dots_.positions[dot]);
            if (!code || !std::isfinite(footprint)) continue;
            const double level = std::round(std::log2(footprint / grid_.finest));
            const double known = std::clamp(level, 0.0, static_cast<double>(count - 1));
            levels[static_cast<std::size_t>(known)].push_back({*code, dot});
        }
        for (std::vector<Placed>& level : levels) {
            parallel_sort(level);
        }
        return levels;
    }

    /// Gives the dots of a level to leaders, old ones or new, cube by cube.
    void add_level(const std::vector<Placed>& dots, int level)
    {
        std::vector<std::size_t> begins; // of the cubes that hold dots
        for (std::size_t i = 0; i < dots.size(); ++i) {
            if (i == 0 || dots[i].cube(level) != dots[i - 1].cube(level)) begins.push_back(i);
        }
        begins.push_back(dots.size());
        auto found = parallel_collect<Placed>(
            begins.size() - 1,
            [&](std::size_t cube, auto& fresh) {
                const std::span<const Placed> own(dots.data() + begins[cube],
                                                  dots.data() + begins[cube + 1]);
                const auto key = [&](const Placed& placed) { return placed.cube(level); };
                const std::uint64_t number = own[0].cube(level);
                const auto first = std::ranges::lower_bound(leaders_, number, {}, key);
                const auto last = std::ranges::upper_bound(leaders_, number, {}, key);
                join(own, {first, last}, level, fresh);
            },
            256);
        std::vector<Placed> all(leaders_.size() + found.size());
        parallel_sort(found);
        std::merge(leaders_.begin(), leaders_.end(), found.begin(), found.end(), all.begin());
        leaders_ = std::move(all);
    }

    /// Gives the dots of a cube to its leaders, the nearest that agrees each; of those left over,
    /// the ones with most views lead.
    void join(std::span<const Placed> own, std::vector<Placed> leaders, int level,
              std::vector<Placed>& fresh)
    {
        std::vector<Placed> by_views(own.begin(), own.end());
        std::ranges::sort(by_views, [&](const Placed& a, const Placed& b) {
            return std::pair(dots_.num_views[b.dot], a.dot) <
                   std::pair(dots_.num_views[a.dot], b.dot);
        });
        for (const Placed& placed : by_views) {
            const std::uint32_t leader = nearest(placed.dot, leaders, level);
            if (leader == kAlone) {
                leaders.push_back(placed);
                fresh.push_back(placed);
            } else {
                leader_of_[placed.dot] = leader;
            }
        }
    }

    std::uint32_t nearest(std::uint32_t dot, const std::vector<Placed>& leaders, int level) const
    {
        const double reach = reach_ * std::ldexp(grid_.finest, level);
        double least_sq = reach * reach;
        std::uint32_t best = kAlone;
        for (const Placed& leader : leaders) {
            const double distance_sq =
                (dots_.positions[leader.dot] - dots_.positions[dot]).squaredNorm();
            if (distance_sq >= least_sq || !dots_.agree(leader.dot, dot)) continue;
            least_sq = distance_sq;
            best = leader.dot;
        }
        return best;
    }

    const Dots& dots_;
    double reach_;
    CubeGrid grid_{};
    std::vector<Placed> leaders_; ///< so far, by code
    std::vector<std::uint32_t> leader_of_;
};

/// What so many pixels cover at a point's distance, in the view that shows it largest;
/// infinite for a point that is not to be merged.
double footprint(const Scene& scene, std::size_t point, double pixels,
                 const std::vector<double>& focals)
{
    double least = std::numeric_limits<double>::infinity();
    if (scene.errors_px[point] >= 0.0) return least;
    for (const std::uint32_t v : scene.tracks[point]) {
        const View& view = scene.views[v];
        const double distance = (view.center - scene.positions[point]).norm();
        least = std::min(least, pixels * distance / focals[view.camera]);
    }
    return least;
}

Dots dots_of(const Scene& scene, double merge_px)
{
    const std::vector<double> focals = mean_focals_px(scene.cameras);
    Dots dots{scene.positions, scene.normals, std::vector<double>(scene.num_points()),
              std::vector<std::uint32_t>(scene.num_points())};
    parallel_for(scene.num_points(), [&](std::size_t i) {
        dots.footprints[i] = footprint(scene, i, merge_px, focals);
        dots.num_views[i] = static_cast<std::uint32_t>(scene.tracks[i].size());
    });
    return dots;
}

/// The members of every cluster, the clusters in the order of their leaders.
class Members {
  public:
    explicit Members(const std::vector<std::uint32_t>& leader_of) : members_(leader_of.size())
    {
        std::vector<std::uint32_t> counts(leader_of.size() + 1, 0);
        for (const std::uint32_t leader : leader_of) {
            ++counts[leader];
        }
        std::vector<std::size_t> ends(leader_of.size());
        std::size_t sum = 0;
        for (std::uint32_t dot = 0; dot < leader_of.size(); ++dot) {
            ends[dot] = sum;
            if (counts[dot] == 0) continue;
            leaders_.push_back(dot);
            begins_.push_back(sum);
            sum += counts[dot];
        }
        begins_.push_back(sum);
        for (std::uint32_t dot = 0; dot < leader_of.size(); ++dot) {
            members_[ends[leader_of[dot]]++] = dot;
        }
    }

    std::size_t size() const { return leaders_.size(); }
    std::uint32_t leader(std::size_t cluster) const { return leaders_[cluster]; }
    std::span<const std::uint32_t> operator[](std::size_t cluster) const
    {
        return {members_.data() + begins_[cluster], members_.data() + begins_[cluster + 1]};
    }

  private:
    std::vector<std::uint32_t> members_;
    std::vector<std::uint32_t> leaders_;
    std::vector<std::size_t> begins_;
};

Vector3d mean_position(const Scene& scene, std::span<const std::uint32_t> members)
{
    Vector3d sum = Vector3d::Zero();
    for (const std::uint32_t member : members) {
        sum += scene.positions[member];
    }
    return sum / static_cast<double>(members.size());
}

/// The clusters as dots, at the means of their members.
Dots dots_of(const Scene& scene, const Dots& dots, const Members& clusters)
{
    Dots result{std::vector<Vector3d>(clusters.size()), {}, {}, {}};
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        const std::uint32_t leader = clusters.leader(i);
        result.footprints.push_back(dots.footprints[leader]);
        result.num_views.push_back(dots.num_views[leader]);
        if (!dots.normals.empty()) result.normals.push_back(dots.normals[leader]);
    }
    parallel_for(clusters.size(),
                 [&](std::size_t i) { result.positions[i] = mean_position(scene, clusters[i]); });
    return result;
}

Color mean_color(const Scene& scene, std::span<const std::uint32_t> members)
{
    std::array<std::size_t, 3> sums = {0, 0, 0};
    for (const std::uint32_t member : members) {
        for (std::size_t i = 0; i < 3; ++i) {
            sums[i] += scene.colors[member][i];
        }
    }
    Color mean;
    for (std::size_t i = 0; i < 3; ++i) {
        mean[i] = static_cast<std::uint8_t>((sums[i] + members.size() / 2) / members.size());
    }
    return mean;
}

Vector3f mean_normal(const Scene& scene, std::span<const std::uint32_t> members)
{
    Vector3f sum = Vector3f::Zero();
    for (const std::uint32_t member : members) {
        sum += scene.normals[member];
    }
    return sum.normalized(); // leaves zero as it is
}

Scene merged(const Scene& scene, const Members& clusters)
{
    Scene result = without_points(scene);
    result.positions.resize(clusters.size());
    result.colors.resize(clusters.size());
    if (!scene.normals.empty()) result.normals.resize(clusters.size());
    std::vector<std::vector<std::uint32_t>> tracks(clusters.size());
    parallel_for(clusters.size(), [&](std::size_t i) {
        result.positions[i] = mean_position(scene, clusters[i]);
        result.colors[i] = mean_color(scene, clusters[i]);
        if (!scene.normals.empty()) result.normals[i] = mean_normal(scene, clusters[i]);
        tracks[i] = united_views(scene, clusters[i]);
    });
    for (std::size_t i = 0; i < clusters.size(); ++i) {
        result.errors_px.push_back(scene.errors_px[clusters.leader(i)]);
        result.point_ids.push_back(scene.point_ids[clusters.leader(i)]);
    }
    result.tracks = make_tracks(tracks.size(), [&](std::size_t i) { return std::span(tracks[i]); });
    return result;
}

double median_of_finite(std::vector<double> values)
{
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    return median_in_place(values);
}

} // namespace

Scene thin_points(const Scene& scene, const ThinOptions& options, const Progress& progress)
{
    const Dots dots = dots_of(scene, options.merge_px);
    const double unit = median_of_finite(dots.footprints);
    if (!(unit > 0.0)) return scene;
    constexpr double kWhole = 2.0; // more than the diagonal of a cube
    std::vector<std::uint32_t> leader_of = Clustering(dots, kWhole).leaders(unit, Vector3d::Zero());
    progress.tell(0.5);
    const Members first(leader_of);
    const std::vector<std::uint32_t> second =
        Clustering(dots_of(scene, dots, first), 0.5).leaders(unit, Vector3d::Constant(1.0 / 3.0));
    progress.tell(0.8);
    for (std::size_t i = 0; i < first.size(); ++i) {
        for (const std::uint32_t member : first[i]) {
            leader_of[member] = first.leader(second[i]);
        }
    }
    return merged(scene, Members(leader_of));
}

} // namespace vcarve
