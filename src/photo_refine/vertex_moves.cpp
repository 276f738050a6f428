#include "photo_refine/vertex_moves.h"

#include "base/arrays.h"
#include "base/parallel.h"
#include "mesh/vertices.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

Vector3d normal_of(const std::array<Vector3d, 3>& corners)
{
    return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

/// Averages normals with similar ones around them.
std::vector<Vector3d> smoothed(std::span<const Vector3d> normals, const RowTable& neighbors)
{
    constexpr double kSpread = 0.06; // of 1 - cosine
    std::vector<Vector3d> result(normals.size());
    parallel_for(normals.size(), [&](std::size_t v) {
        Vector3d sum = normals[v];
        for (const std::uint32_t other : neighbors[v]) {
            sum += std::exp((normals[v].dot(normals[other]) - 1.0) / kSpread) * normals[other];
        }
        result[v] = sum.normalized();
    });
    return result;
}

/// The bending of a surface, linear in the shifts of its vertices: the distance of each vertex from
/// the mean of its neighbors along its normal, in steps.
class Bending {
  public:
    Bending(const TriMesh& mesh, std::span<const Vector3d> normals, std::span<const float> steps,
            const RowTable& neighbors)
        : at_rest(static_cast<Eigen::Index>(normals.size()))
    {
        const std::vector<Vector3d> once = smoothed(normals, neighbors);
        const std::vector<Vector3d> similar = smoothed(once, neighbors);
        const auto count = static_cast<Eigen::Index>(normals.size());
        matrix_.resize(count, count);
        matrix_.resizeNonZeros(static_cast<Eigen::Index>(neighbors.items.size()) + count);
        int* const begins = matrix_.outerIndexPtr();
        begins[0] = 0;
        for (Eigen::Index v = 0; v < count; ++v) {
            begins[v + 1] = begins[v] + static_cast<int>(neighbors[v].size()) + 1;
        }
        parallel_for(normals.size(), [&](std::size_t v) {
            int at = begins[v];
            const auto set = [&](std::size_t column, double value) {
                matrix_.innerIndexPtr()[at] = static_cast<int>(column);
                matrix_.valuePtr()[at] = value;
                ++at;
            };
            double all = 0.0;
            for (const std::uint32_t other : neighbors[v]) {
                all += weight(similar[v], similar[other]);
            }
            const bool bends = steps[v] > 0.0F && all > 0.0;
            Vector3d mean = Vector3d::Zero();
            for (const std::uint32_t other : neighbors[v]) {
                const double share = bends ? weight(similar[v], similar[other]) / all : 0.0;
                mean += share * (mesh.positions[other] - mesh.positions[v]);
                set(other,
                    bends ? share * normals[v].dot(normals[other]) * steps[other] / steps[v] : 0.0);
            }
            set(v, bends ? -1.0 : 0.0);
            at_rest[static_cast<Eigen::Index>(v)] = bends ? normals[v].dot(mean) / steps[v] : 0.0;
        });
    }

    VectorXd times(const VectorXd& shifts) const { return matrix_ * shifts; }
    VectorXd transposed_times(const VectorXd& bends) const { return matrix_.transpose() * bends; }

    VectorXd at_rest; ///< without shifts

  private:
    /// Small across a crease.
    static double weight(const Vector3d& a, const Vector3d& b)
    {
        constexpr double kCrease = 0.0937; // 1 - cosine of 25 degrees
        const double turn = (1.0 - a.dot(b)) / kCrease;
        return std::exp(-turn * turn) + 1e-4;
    }

    Eigen::SparseMatrix<double, Eigen::RowMajor> matrix_;
};

/// Solves (weights + stiffness B^T B) x = right by conjugate gradients.
VectorXd solve(const Bending& bending, const VectorXd& weights, double stiffness,
               const VectorXd& right)
{
    constexpr int kIterations = 25;
    const VectorXd scale = (weights.array() + 1.2 * stiffness).inverse();
    VectorXd solution = VectorXd::Zero(right.size());
    VectorXd rest = right;
    VectorXd scaled = scale.cwiseProduct(rest);
    VectorXd direction = scaled;
    double length = rest.dot(scaled);
    for (int i = 0; i < kIterations && length > 0.0; ++i) {
        const VectorXd image = weights.cwiseProduct(direction) +
                               stiffness * bending.transposed_times(bending.times(direction));
        const double along = length / direction.dot(image);
        solution += along * direction;
        rest -= along * image;
        scaled = scale.cwiseProduct(rest);
        const double before = std::exchange(length, rest.dot(scaled));
        direction = scaled + length / before * direction;
    }
    return solution;
}

/// Vertices at edges of one face.
std::vector<char> boundary_vertices(const TriMesh& mesh, const RowTable& neighbors)
{
    std::vector<char> is_boundary(mesh.positions.size(), 0);
    for (const Face& face : mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = face[i];
            const std::uint32_t b = face[(i + 1) % 3];
            if (std::ranges::count(neighbors[b], a) == 1) continue;
            is_boundary[a] = is_boundary[b] = 1;
        }
    }
    return is_boundary;
}

/// Shortens moves until no face turns by more than 60 degrees or loses its area.
void hold_faces(const TriMesh& mesh, std::vector<Vector3d>& moves)
{
    constexpr int kRounds = 8;
    constexpr double kLeastTurn = 0.5; // cosine
    constexpr double kLeastArea = 0.05;
    for (int round = 0; round < kRounds; ++round) {
        std::vector<char> is_held(moves.size(), 0);
        bool any = false;
        for (const Face& face : mesh.faces) {
            std::array<Vector3d, 3> corners;
            std::array<Vector3d, 3> moved;
            for (std::size_t i = 0; i < 3; ++i) {
                corners[i] = mesh.positions[face[i]];
                moved[i] = corners[i] + moves[face[i]];
            }
            const Vector3d before = normal_of(corners);
            const Vector3d after = normal_of(moved);
            const double length = after.norm();
            const double length_before = before.norm();
            if (after.dot(before) >= kLeastTurn * length * length_before &&
                length >= kLeastArea * length_before)
                continue;
            any = true;
            for (const std::uint32_t corner : face) {
                is_held[corner] = 1;
            }
        }
        if (!any) return;
        for (std::size_t v = 0; v < moves.size(); ++v) {
            if (is_held[v] != 0) moves[v] *= round + 2 < kRounds ? 0.5 : 0.0;
        }
    }
}

} // namespace

WantedShift wanted_shift(const PhotoCurve& curve)
{
    constexpr float kLeastCorrelation = 0.3F;
    constexpr float kLeastCurvature = 0.004F;
    constexpr float kCurvatureAtEnd = 0.3F;
    constexpr float kFewPairs = 8.0F;
    if (curve.pairs < 2 || curve.weight <= 0.0F) return {};
    const auto& costs = curve.costs;
    const auto best = static_cast<int>(std::ranges::min_element(costs) - costs.begin());
    const float correlation = 1.0F - costs[best];
    if (correlation < kLeastCorrelation) return {};
    const int middle = std::clamp(best, 1, kShifts - 2);
    const float bent = costs[middle - 1] - 2.0F * costs[middle] + costs[middle + 1];
    WantedShift wanted;
    float curvature = bent;
    if (best != middle) {
        wanted.steps = static_cast<float>(best - kMostShift);
        curvature = kCurvatureAtEnd * std::max(bent, 0.0F);
    } else if (bent > 0.0F) {
        wanted.steps = static_cast<float>(middle - kMostShift) +
                       0.5F * (costs[middle - 1] - costs[middle + 1]) / bent;
    }
    const float pairs = std::min(1.0F, static_cast<float>(curve.pairs) / kFewPairs);
    const float trust = std::min(1.0F, (correlation - kLeastCorrelation) / 0.4F);
    wanted.weight =
        std::max(0.0F, curvature - kLeastCurvature) / (1.0F - correlation + 0.02F) * pairs * trust;
    return wanted;
}

RowTable neighbors_of(const TriMesh& mesh)
{
    return gather_rows(mesh.faces.size(), mesh.positions.size(),
                       [&](std::size_t face, const auto& visit) {
                           const auto& [a, b, c] = mesh.faces[face];
                           visit(a, b);
                           visit(b, c);
                           visit(c, a);
                       });
}

struct ShiftSolver::Plate {
    const RowTable& neighbors;
    Bending bending;
};

ShiftSolver::ShiftSolver(const TriMesh& mesh, std::span<const Vector3d> normals,
                         std::span<const float> steps, const RowTable& neighbors)
    : mesh_(mesh),
      normals_(normals),
      steps_(steps),
      plate_(
          std::make_unique<const Plate>(Plate{neighbors, Bending(mesh, normals, steps, neighbors)}))
{
}

ShiftSolver::~ShiftSolver() = default;

VectorXd ShiftSolver::shifts(std::span<const WantedShift> wanted, double stiffness) const
{
    // Without data, the plate smooths pits but does not follow its surroundings far.
    constexpr double kStay = 0.002;
    constexpr double kStayWithoutData = 0.1;
    const Bending& bending = plate_->bending;
    VectorXd weights(static_cast<Eigen::Index>(wanted.size()));
    VectorXd right = -stiffness * bending.transposed_times(bending.at_rest);
    for (Eigen::Index v = 0; v < weights.size(); ++v) {
        const bool moves = steps_[v] > 0.0F;
        weights[v] = wanted[v].weight > 0.0F ? wanted[v].weight + kStay : kStayWithoutData;
        right[v] = moves ? right[v] + wanted[v].weight * wanted[v].steps : 0.0;
    }
    return solve(bending, weights, stiffness, right);
}

std::vector<Vector3d> ShiftSolver::moved(const VectorXd& shifts) const
{
    constexpr double kTangential = 0.2;
    constexpr double kFlat = 0.9; // least cosine between the normals of neighbors that spread
    const RowTable& neighbors = plate_->neighbors;
    const std::vector<char> is_boundary = boundary_vertices(mesh_, neighbors);
    std::vector<Vector3d> moves(normals_.size(), Vector3d::Zero());
    parallel_for(moves.size(), [&](std::size_t v) {
        if (!(steps_[v] > 0.0F)) return;
        const double shift =
            std::clamp<double>(shifts[static_cast<Eigen::Index>(v)], -kMostShift, kMostShift);
        moves[v] = shift * steps_[v] * normals_[v];
        if (is_boundary[v] != 0) return;
        Vector3d mean = Vector3d::Zero();
        double flat = 1.0;
        for (const std::uint32_t other : neighbors[v]) {
            mean += (mesh_.positions[other] - mesh_.positions[v]) /
                    static_cast<double>(neighbors[v].size());
            flat = std::min(flat, normals_[v].dot(normals_[other]));
        }
        if (flat > kFlat) moves[v] += kTangential * (mean - normals_[v].dot(mean) * normals_[v]);
    });
    hold_faces(mesh_, moves);
    std::vector<Vector3d> positions = mesh_.positions;
    for (std::size_t v = 0; v < moves.size(); ++v) {
        positions[v] += moves[v];
    }
    return positions;
}

std::vector<Vector3d> normals_of_vertices(const TriMesh& mesh)
{
    const VertexFaces faces_at(mesh.faces, mesh.positions.size());
    std::vector<Vector3d> normals(mesh.positions.size());
    parallel_for(normals.size(), [&](std::size_t v) {
        Vector3d sum = Vector3d::Zero();
        for (const std::uint32_t index : faces_at[v]) {
            const Face face = turned_to(mesh.faces[index], static_cast<std::uint32_t>(v));
            const Vector3d right = mesh.positions[face[1]] - mesh.positions[v];
            const Vector3d left = mesh.positions[face[2]] - mesh.positions[v];
            const Vector3d normal = right.cross(left);
            const double length = normal.norm();
            if (length > 0.0) sum += std::atan2(length, right.dot(left)) / length * normal;
        }
        normals[v] = sum.normalized();
    });
    return normals;
}

} // namespace vcarve
