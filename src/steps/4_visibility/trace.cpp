#include "steps/4_visibility/trace.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "geometry/triangle.h"
#include "steps/4_visibility/energy_sums.h"
#include "steps/4_visibility/ray_weights.h"
#include "steps/4_visibility/walk.h"
#include "vcarve/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// A network with zero capacities.
FlowNetwork empty_network(const TetMesh& mesh)
{
    const std::size_t count = mesh.cells.size();
    return {filled_array(count, std::array<std::int32_t, 4>{}), filled_array(count, 0)};
}

/// The distance from a point along a direction to a facet's plane; 0 if they are parallel.
double distance_to_facet(const TetMesh& mesh, CellFacet facet, const Vector3d& point,
                         const Vector3d& direction)
{
    const Cell& cell = mesh.cells[facet.cell];
    const auto& corners = kFacetCorners[facet.slot];
    const Vector3d& a = mesh.positions[cell.vertices[corners[0]]];
    const Vector3d& b = mesh.positions[cell.vertices[corners[1]]];
    const Vector3d& c = mesh.positions[cell.vertices[corners[2]]];
    const Vector3d normal = scaled_normal(a, b, c);
    const double along = normal.dot(direction);
    return along == 0.0 ? 0.0 : std::abs(normal.dot(a - point) / along);
}

/// Pushes the flow of one ray, cell by cell from its point, and records the excess of each cell. If
/// the ray meets an edge or a vertex, the next cell is not the one it reached. There one stretch
/// ends in a separate source (or sink), and another begins.
class Push {
  public:
    enum class Sign : std::int32_t { source = 1, sink = -1 };

    Push(const TetMesh& mesh, EnergySums& sums, Sign sign)
        : mesh_(mesh), sums_(sums), sign_(static_cast<std::int32_t>(sign))
    {
    }

    std::int32_t carried() const { return carried_; }

    void cross(Index near, Index far, std::int32_t weight)
    {
        arrive(near, weight);
        reached_ = far;
        carried_ = weight;
    }

    void end(Index last, std::int32_t full) { arrive(last, full); }

  private:
    void arrive(Index cell, std::int32_t weight)
    {
        if (reached_ != kInfinite && reached_ != cell) {
            keep(reached_, weight - carried_);
            carried_ = 0;
        }
        keep(cell, weight - carried_);
    }

    void keep(Index cell, std::int32_t flow)
    {
        // Infinite cells are outside whatever their excess.
        if (flow != 0 && cell != kInfinite && !mesh_.cells[cell].is_infinite()) {
            sums_.add_terminal_capacity(cell, sign_ * flow);
        }
    }

    const TetMesh& mesh_;
    EnergySums& sums_;
    std::int32_t sign_;
    std::int32_t carried_ = 0;
    Index reached_ = kInfinite;
};

/// A ray from a point to a view, and the state of its push.
struct OutwardRay {
    Ray ray;
    std::uint32_t view;
    std::int32_t full;   ///< weight before the factor for the distance
    std::int32_t bundle; ///< number of rays that continue as one, far from their points
    Vector3d direction;
    Push push;
    int crossed = 0;        ///< number of facets
    std::uint32_t lead = 1; ///< number of rays for which one continues
    bool leads = true;

    /// Whether the ray crosses one more facet; updates its weight. One ray of a bundle continues
    /// for all. Consecutive points are neighbors in space, so a bundle consists of neighbors.
    bool continues()
    {
        ++crossed;
        if (crossed == kBundledAfter[0] + 1 || crossed == kBundledAfter[1] + 1) {
            lead *= static_cast<std::uint32_t>(bundle);
            full *= bundle;
            leads = (ray.vertex + view) % lead == 0;
        }
        return leads; // called again if the exact walk reports all its facets
    }
};

/// Adds the terms of rays to the network.
class RayTerms {
  public:
    RayTerms(const TetMesh& mesh, EnergySums& sums, double sigma)
        : mesh_(mesh), sums_(sums), sigma_(sigma)
    {
    }

    /// The ray from a vertex to a view.
    OutwardRay outward(Index vertex, std::uint32_t view, const Vector3d& center, std::int32_t full,
                       std::int32_t bundle) const
    {
        return {{vertex, center},
                view,
                full,
                bundle,
                (center - mesh_.positions[vertex]).normalized(),
                Push(mesh_, sums_, Push::Sign::source)};
    }

    /// Adds the votes for outside along the rays from points to views. Calls on_end(view, cell)
    /// with the cell of the view, kInfinite if the view is outside the hull.
    template <typename OnEnd>
    void add_outside_terms(RayWalk& walk, std::vector<OutwardRay>& rays, const OnEnd& on_end) const
    {
        walk.along_each(
            rays.size(), [&](std::size_t k) -> const Ray& { return rays[k].ray; },
            [&](std::size_t k, Index cell, int slot) {
                const Index beyond = mesh_.cells[cell].neighbors[slot];
                sums_.fetch(beyond);
                // The flow runs from the view to the point and decreases on its way. It saturates
                // the inward arc, opens the outward arc, and the rest stays here as excess. Where
                // a bundle begins, rays that end pass their weight to the ray that continues, and
                // vote for that cell to be outside.
                OutwardRay& on = rays[k];
                if (!on.continues()) return false;
                const std::int32_t weight =
                    on.push.carried() == on.full
                        ? on.full
                        : soft_weight({cell, slot}, mesh_.positions[on.ray.vertex], on.direction,
                                      on.full);
                sums_.add_arc_capacity(cell, slot, weight);
                on.push.cross(cell, beyond, weight);
                return true;
            },
            [&](std::size_t k, const WalkEnds& ends) {
                rays[k].push.end(ends.last, rays[k].full);
                const bool in_hull =
                    ends.last != kInfinite && !mesh_.cells[ends.last].is_infinite();
                on_end(rays[k].view, in_hull ? ends.last : kInfinite);
            });
    }

    /// Adds the votes for inside behind a vertex, away from the origins of its rays, to a depth of
    /// `sink_depth` sigmas.
    void add_inside_terms(RayWalk& walk, Index vertex, const RaySource& source, std::int32_t full,
                          double sink_depth) const
    {
        walk.move_to(vertex);
        for (const std::uint32_t origin : (*source.rays)[vertex]) {
            add_inside_terms(walk, mesh_.positions[vertex], source.origins[origin], full,
                             sink_depth);
        }
    }

  private:
    /// The same for one ray, from the vertex of the walk.
    void add_inside_terms(RayWalk& walk, const Vector3d& point, const Vector3d& center,
                          std::int32_t full, double sink_depth) const
    {
        const Vector3d direction = (point - center).normalized();
        const double depth = sink_depth * sigma_;
        if (depth == 0.0) {
            const Index behind = walk.first_cell(2.0 * point - center);
            if (behind != kInfinite) {
                sums_.add_terminal_capacity(behind, -full);
            }
            return;
        }
        Push push(mesh_, sums_, Push::Sign::sink);
        const WalkEnds ends = walk.to(point + depth * direction, [&](Index cell, int slot) {
            const std::int32_t weight = soft_weight({cell, slot}, point, direction, full);
            const Index beyond = mesh_.cells[cell].neighbors[slot];
            sums_.add_arc_capacity(beyond, mesh_.mirror(cell, slot), weight);
            push.cross(cell, beyond, weight);
        });
        push.end(ends.last, full);
    }

    std::int32_t soft_weight(CellFacet facet, const Vector3d& point, const Vector3d& direction,
                             std::int32_t full) const
    {
        if (sigma_ == 0.0) {
            return full;
        }
        const double distance = distance_to_facet(mesh_, facet, point, direction) / sigma_;
        const double soft = 1.0 - std::exp(-0.5 * distance * distance);
        return round_half_up(full * soft);
    }

    const TetMesh& mesh_;
    EnergySums& sums_;
    double sigma_;
};

/// Finds the cells of origins without rays, for example if the filter dropped all points of a view:
/// cameras without points are in free space, too.
void locate_other_origins(const TetMesh& cells, const std::vector<Vector3d>& origins,
                          std::vector<Index>& cell_of_origin)
{
    if (cells.positions.empty()) return;
    RayWalk walk(cells, 0);
    for (std::size_t origin = 0; origin < origins.size(); ++origin) {
        if (cell_of_origin[origin] != kInfinite) continue;
        const Index last = walk.to(origins[origin], [](Index, int) {}).last;
        if (last != kInfinite && !cells.cells[last].is_infinite()) cell_of_origin[origin] = last;
    }
}

void require_exact(bool is_exact, const Scene& scene)
{
    if (!is_exact) {
        throw InputError(fmt::format("the weights of the {} rays of the model exceed 32 bits "
                                     "in one cell; use fewer points or views",
                                     scene.num_rays()));
    }
}

} // namespace

void RayCaster::cast(const RaySource& source, VisibilityEnergy& energy,
                     const Progress& progress) const
{
    if (energy.network.arc_capacities.empty()) {
        energy.unit = RayWeights::kUnit;
        energy.network = empty_network(cells_);
    }
    if (source.is_measured) energy.cell_of_view.resize(source.origins.size(), kInfinite);
    std::vector<Index>& cell_of_origin = energy.cell_of_view;
    EnergySums sums(energy.network);
    const RayTerms terms(cells_, sums, options_.distance_sigma * scales_.short_edge);
    const RayWeights weights(scene_, scales_, options_);

    for_each_run_of_vertices(cells_, progress, [&](Index first, Index last) {
        RayWalk walk(cells_);
        std::vector<OutwardRay> rays;
        for (Index vertex = first; vertex < last; ++vertex) {
            const PointKind kind = scene_.kind_of(vertex);
            const bool is_witness = kind == PointKind::witness;
            const double rays_of_one = is_witness ? scales_.points_of_witness : 1.0;
            const std::int32_t full = weights.full_weight(vertex, source.weight * rays_of_one);
            const bool bundles = scene_.is_dense && !is_witness;
            if (source.is_measured && kind != PointKind::border)
                terms.add_inside_terms(walk, vertex, source, full, options_.sink_depth);
            for (const std::uint32_t view : (*source.rays)[vertex]) {
                rays.push_back(terms.outward(vertex, view, source.origins[view], full,
                                             bundles ? options_.bundle_rays : 1));
            }
        }
        terms.add_outside_terms(walk, rays, [&](std::uint32_t view, Index cell) {
            // Rays find different cells for a view on the boundary between cells.
            if (source.is_measured) atomic_min(cell_of_origin[view], cell);
        });
    });
    sums.limit_full_arcs();
    require_exact(!sums.is_exceeded(), scene_);
    if (source.is_measured) locate_other_origins(cells_, source.origins, cell_of_origin);
}

} // namespace vcarve
