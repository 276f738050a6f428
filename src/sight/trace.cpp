#include "sight/trace.h"

#include "base/error.h"
#include "sight/each_vertex.h"
#include "sight/edge_lengths.h"
#include "sight/walk.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr std::int32_t kUnit = 256;

/// Adds to the network from many threads, and remembers whether a sum came near the end of 32 bits.
class VoteSums {
  public:
    explicit VoteSums(FlowNetwork& network) : network_(network) {}

    void add_residual(Index cell, int slot, std::int32_t vote)
    {
        add(network_.residuals[cell][slot], vote);
    }
    void add_excess(Index cell, std::int32_t flow) { add(network_.excesses[cell], flow); }
    bool is_exceeded() const { return is_exceeded_; }

  private:
    void add(std::int32_t& sum, std::int32_t value)
    {
        // The cut adds a few sums and the costs of facets: a quarter of the range is theirs.
        constexpr std::int32_t kMaxSum = 1 << 29;
        const std::int32_t before =
            std::atomic_ref<std::int32_t>(sum).fetch_add(value, std::memory_order_relaxed);
        if (before > kMaxSum || before < -kMaxSum) {
            is_exceeded_.store(true, std::memory_order_relaxed);
        }
    }

    FlowNetwork& network_;
    std::atomic<bool> is_exceeded_ = false;
};

void count_one(std::uint32_t& count)
{
    std::atomic_ref<std::uint32_t>(count).fetch_add(1, std::memory_order_relaxed);
}

std::vector<Vector3d> centers_of(const std::vector<View>& views)
{
    std::vector<Vector3d> centers(views.size());
    std::transform(views.begin(), views.end(), centers.begin(),
                   [](const View& view) { return view.center; });
    return centers;
}

/// Counts the facets that sights from a vertex cross, on both sides.
void count_facets(const TetMesh& cells, Index vertex, std::span<const std::uint32_t> track,
                  const std::vector<Vector3d>& centers, Crossings& crossings)
{
    SightWalk(cells, vertex)
        .to_each(
            track.size(), [&](std::size_t k) -> const Vector3d& { return centers[track[k]]; },
            [&](std::size_t, Index cell, int slot) {
                const Index beyond = cells.cells[cell].neighbors[slot];
                count_one(crossings[cell][slot]);
                count_one(crossings[beyond][cells.mirror(cell, slot)]);
            },
            [](std::size_t, const WalkEnds&) {});
}

/// A view on the border of cells is found in different ones; the smallest does not depend on order.
void lower(Index& least, Index value)
{
    const std::atomic_ref<Index> shared(least);
    Index seen = shared.load(std::memory_order_relaxed);
    while (value < seen && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
    }
}

/// Distance from a point to where the line through it in a direction meets a facet's plane.
double distance_to_facet(const TetMesh& mesh, CrossedFacet facet, const Vector3d& point,
                         const Vector3d& direction)
{
    const Cell& cell = mesh.cells[facet.cell];
    const auto& corners = kFacetCorners[facet.slot];
    const Vector3d& a = mesh.positions[cell.vertices[corners[0]]];
    const Vector3d& b = mesh.positions[cell.vertices[corners[1]]];
    const Vector3d& c = mesh.positions[cell.vertices[corners[2]]];
    const Vector3d normal = (b - a).cross(c - a);
    const double along = normal.dot(direction);
    return along == 0.0 ? 0.0 : std::abs(normal.dot(a - point) / along);
}

/// What each cell keeps of the flow of one sight, cell by cell from the point on. The next cell is
/// not the one reached where the sight met an edge or a vertex: there one stretch ends, with a
/// source (or sink) of its own, and another begins.
class Push {
  public:
    enum class Sign : std::int32_t { source = 1, sink = -1 };

    Push(const TetMesh& mesh, VoteSums& sums, Sign sign)
        : mesh_(mesh), sums_(sums), sign_(static_cast<std::int32_t>(sign))
    {
    }

    std::int32_t carried() const { return carried_; }

    void cross(Index near, Index far, std::int32_t vote)
    {
        arrive(near, vote);
        reached_ = far;
        carried_ = vote;
    }

    void end(Index last, std::int32_t full) { arrive(last, full); }

  private:
    void arrive(Index cell, std::int32_t vote)
    {
        if (reached_ != kInfinite && reached_ != cell) {
            keep(reached_, vote - carried_);
            carried_ = 0;
        }
        keep(cell, vote - carried_);
    }

    void keep(Index cell, std::int32_t flow)
    {
        // Infinite cells are outside whatever they keep.
        if (flow != 0 && cell != kInfinite && !mesh_.cells[cell].is_infinite()) {
            sums_.add_excess(cell, sign_ * flow);
        }
    }

    const TetMesh& mesh_;
    VoteSums& sums_;
    std::int32_t sign_;
    std::int32_t carried_ = 0;
    Index reached_ = kInfinite;
};

/// The votes of one point's sights.
class Voter {
  public:
    Voter(const TetMesh& mesh, VoteSums& sums, double weight, double sigma)
        : mesh_(mesh), sums_(sums), full_(std::lround(kUnit * weight)), sigma_(sigma)
    {
    }

    /// Outside, from the point to each view of its track. Calls on_end(view, cell) with the cell of
    /// the view, kInfinite if that lies out of the hull.
    template <typename OnEnd>
    void vote_outside(SightWalk& walk, const Vector3d& point, std::span<const std::uint32_t> track,
                      const std::vector<Vector3d>& centers, const OnEnd& on_end) const
    {
        struct Sight {
            Vector3d direction;
            Push push;
        };
        std::vector<Sight> sights;
        sights.reserve(track.size());
        for (const std::uint32_t view : track) {
            sights.push_back(
                {(centers[view] - point).normalized(), Push(mesh_, sums_, Push::Sign::source)});
        }
        walk.to_each(
            track.size(), [&](std::size_t k) -> const Vector3d& { return centers[track[k]]; },
            [&](std::size_t k, Index cell, int slot) {
                auto& [direction, push] = sights[k];
                const std::int32_t vote =
                    push.carried() == full_ ? full_ : soft_vote({cell, slot}, point, direction);
                // The sight's flow comes from the view and falls towards the point: it fills the
                // arc inwards, opens the one outwards, and what the next facet will not take stays
                // here.
                sums_.add_residual(cell, slot, vote);
                push.cross(cell, mesh_.cells[cell].neighbors[slot], vote);
            },
            [&](std::size_t k, const WalkEnds& ends) {
                sights[k].push.end(ends.last, full_);
                const bool in_hull =
                    ends.last != kInfinite && !mesh_.cells[ends.last].is_infinite();
                on_end(track[k], in_hull ? ends.last : kInfinite);
            });
    }

    /// Inside, from the point away from the view, down to a depth of `sink_depth` sigmas.
    void vote_inside(SightWalk& walk, const Vector3d& point, const Vector3d& center,
                     double sink_depth) const
    {
        const Vector3d direction = (point - center).normalized();
        const double depth = sink_depth * sigma_;
        if (depth == 0.0) {
            const Index behind = walk.first_cell(2.0 * point - center);
            if (behind != kInfinite) {
                sums_.add_excess(behind, -full_);
            }
            return;
        }
        Push push(mesh_, sums_, Push::Sign::sink);
        const WalkEnds ends = walk.to(point + depth * direction, [&](Index cell, int slot) {
            const std::int32_t vote = soft_vote({cell, slot}, point, direction);
            const Index beyond = mesh_.cells[cell].neighbors[slot];
            sums_.add_residual(beyond, mesh_.mirror(cell, slot), vote);
            push.cross(cell, beyond, vote);
        });
        push.end(ends.last, full_);
    }

  private:
    std::int32_t soft_vote(CrossedFacet facet, const Vector3d& point,
                           const Vector3d& direction) const
    {
        if (sigma_ == 0.0) {
            return full_;
        }
        const double distance = distance_to_facet(mesh_, facet, point, direction) / sigma_;
        const double soft = 1.0 - std::exp(-0.5 * distance * distance);
        return static_cast<std::int32_t>(std::lround(full_ * soft));
    }

    const TetMesh& mesh_;
    VoteSums& sums_;
    std::int32_t full_;
    double sigma_;
};

double views_weight(std::size_t views, double views_sigma)
{
    if (views_sigma == 0.0) {
        return 1.0;
    }
    const double ratio = static_cast<double>(views) / views_sigma;
    return 1.0 - std::exp(-0.5 * ratio * ratio);
}

/// The middle one, the larger of two; nothing where there are none.
template <typename Value>
std::optional<Value> median(std::vector<Value> values)
{
    if (values.empty()) {
        return std::nullopt;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Says what a sight weighs by the point it leads to: more with more views, less with a larger
/// reprojection error.
class SightWeights {
  public:
    SightWeights(const Scene& scene, const TraceOptions& options)
        : scene_(scene), options_(options), median_error_px_(median(known_errors_px(scene)))
    {
        // Full weight is what the median of the points that are seen gets, so that a model of
        // two-view points is not all doubt.
        full_ = views_weight(median(track_lengths(scene.tracks)).value_or(1), options.views_sigma);
    }

    double of(Index point) const
    {
        const double by_views = views_weight(scene_.tracks[point].size(), options_.views_sigma);
        return by_views / full_ * by_error(scene_.errors_px[point]);
    }

  private:
    static std::vector<std::size_t> track_lengths(const Tracks& tracks)
    {
        std::vector<std::size_t> lengths;
        for (std::size_t point = 0; point < tracks.size(); ++point) {
            if (!tracks[point].empty()) {
                lengths.push_back(tracks[point].size());
            }
        }
        return lengths;
    }

    static std::vector<double> known_errors_px(const Scene& scene)
    {
        std::vector<double> errors;
        std::copy_if(scene.errors_px.begin(), scene.errors_px.end(), std::back_inserter(errors),
                     [](double error) { return error >= 0.0; });
        return errors;
    }

    /// Errors up to the median one, and unknown ones, take nothing away.
    double by_error(double error_px) const
    {
        const double unit_px = median_error_px_.value_or(0.0);
        if (options_.error_sigma == 0.0 || unit_px == 0.0) {
            return 1.0;
        }
        const double ratio = error_px / unit_px;
        const double beyond = std::max(0.0, ratio * ratio - 1.0);
        return std::exp(-0.5 * beyond / (options_.error_sigma * options_.error_sigma));
    }

    const Scene& scene_;
    const TraceOptions& options_;
    std::optional<double> median_error_px_;
    double full_ = 1.0;
};

void require_exact(const VoteSums& sums, const Scene& scene)
{
    if (sums.is_exceeded()) {
        throw InputError(fmt::format("the {} sights of the model add up to more than 32 bits hold "
                                     "at one facet; a surface needs fewer points or views",
                                     scene.num_sights()));
    }
}

} // namespace

Crossings count_crossings(const TetMesh& cells, const Scene& scene, Stage& stage)
{
    Crossings crossings(cells.cells.size(), {0, 0, 0, 0});
    const std::vector<Vector3d> centers = centers_of(scene.views);
    for_each_vertex(cells, stage, [&](Index vertex) {
        count_facets(cells, vertex, scene.tracks[vertex], centers, crossings);
    });
    return crossings;
}

void add_crossings(const TetMesh& cells, const VirtualSights& sights, double weight,
                   Crossings& crossings, Stage& stage)
{
    Crossings more(cells.cells.size(), {0, 0, 0, 0});
    for_each_vertex(cells, stage, [&](Index vertex) {
        count_facets(cells, vertex, sights.tracks[vertex], sights.centers, more);
    });
    parallel_for(more.size(), [&](std::size_t cell) {
        for (int slot = 0; slot < 4; ++slot) {
            crossings[cell][slot] += static_cast<std::uint32_t>(weight * more[cell][slot]);
        }
    });
}

Votes trace_sights(const TetMesh& cells, const Scene& scene, const TraceOptions& options,
                   Stage& stage)
{
    Votes votes;
    votes.unit = kUnit;
    votes.network.residuals.assign(cells.cells.size(), {0, 0, 0, 0});
    votes.network.excesses.assign(cells.cells.size(), 0);
    votes.cell_of_view.assign(scene.views.size(), kInfinite);
    VoteSums sums(votes.network);
    const double sigma = options.softness * short_edge_length(cells);
    const SightWeights weights(scene, options);
    const std::vector<Vector3d> centers = centers_of(scene.views);

    for_each_vertex(cells, stage, [&](Index vertex) {
        const auto track = scene.tracks[vertex];
        const Voter voter(cells, sums, weights.of(vertex), sigma);
        const Vector3d& point = cells.positions[vertex];
        SightWalk walk(cells, vertex);
        for (const std::uint32_t view : track) {
            voter.vote_inside(walk, point, centers[view], options.sink_depth);
        }
        voter.vote_outside(walk, point, track, centers, [&](std::uint32_t view, Index last) {
            lower(votes.cell_of_view[view], last);
        });
    });
    require_exact(sums, scene);
    return votes;
}

// NOLINTNEXTLINE(readability-function-size): the pass has that many inputs
void add_votes(const TetMesh& cells, const Scene& scene, const VirtualSights& sights, double weight,
               const TraceOptions& options, Votes& votes, Stage& stage)
{
    VoteSums sums(votes.network);
    const double sigma = options.softness * short_edge_length(cells);
    const SightWeights weights(scene, options);
    for_each_vertex(cells, stage, [&](Index vertex) {
        const Voter voter(cells, sums, weight * weights.of(vertex), sigma);
        SightWalk walk(cells, vertex);
        voter.vote_outside(walk, cells.positions[vertex], sights.tracks[vertex], sights.centers,
                           [](std::uint32_t, Index) {});
    });
    require_exact(sums, scene);
}

} // namespace vcarve
