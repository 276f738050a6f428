#include "photo_refine/divide_faces.h"

#include "base/parallel.h"
#include "mesh/edge_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace vcarve {

namespace {

constexpr std::uint32_t kWhole = 0xffffffffU; ///< the edge is not divided

/// The edges of a mesh that are to be divided.
class LongEdges {
  public:
    LongEdges(const TriMesh& mesh, const std::vector<float>& spacing)
        : mesh_(mesh), spacing_(spacing), flags_(3 * mesh.faces.size())
    {
        parallel_for(mesh.faces.size(), [&](std::size_t face) { flag(face); });
    }

    bool has(HalfEdge half_edge) const { return flags_[half_edge] != 0; }

  private:
    /// A face with a much too long edge divides all its long edges.
    void flag(std::size_t face)
    {
        constexpr double kTooLong = 1.4; // spacings
        constexpr double kAsLong = 0.72; // of the longest edge
        std::array<double, 3> lengths{};
        std::array<double, 3> longest{};
        bool is_long = false;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = mesh_.faces[face][i];
            const std::uint32_t b = mesh_.faces[face][(i + 1) % 3];
            lengths[i] = (mesh_.positions[a] - mesh_.positions[b]).norm();
            longest[i] = std::min(spacing_[a], spacing_[b]);
            is_long = is_long || lengths[i] > kTooLong * longest[i];
        }
        const double edge = std::ranges::max(lengths);
        for (std::size_t i = 0; is_long && i < 3; ++i) {
            flags_[3 * face + i] = lengths[i] > kAsLong * edge && lengths[i] > longest[i] ? 1 : 0;
        }
    }

    const TriMesh& mesh_;
    const std::vector<float>& spacing_;
    std::vector<char> flags_;
};

float between(float a, float b)
{
    return std::isfinite(a) && std::isfinite(b) ? 0.5F * (a + b)
                                                : std::numeric_limits<float>::infinity();
}

/// Adds the midpoints of long edges. Returns the midpoint of each half-edge, or kWhole; empty if
/// there is none, or if there would be more than `most` vertices.
std::vector<std::uint32_t> add_midpoints(TriMesh& mesh, std::vector<float>& spacing,
                                         std::size_t most)
{
    const LongEdges is_long(mesh, spacing);
    const EdgeTable edges = gather_edges(mesh.faces, mesh.positions.size());
    std::vector<std::uint32_t> divided;
    for (std::uint32_t edge = 0; edge < edges.size(); ++edge) {
        if (std::ranges::any_of(edges[edge], [&](HalfEdge e) { return is_long.has(e); })) {
            divided.push_back(edge);
        }
    }
    if (divided.empty() || mesh.positions.size() + divided.size() > most) return {};
    std::vector<std::uint32_t> middles(3 * mesh.faces.size(), kWhole);
    for (const std::uint32_t edge : divided) {
        const std::uint32_t a = tail(mesh.faces, edges[edge][0]);
        const std::uint32_t b = head(mesh.faces, edges[edge][0]);
        for (const HalfEdge half_edge : edges[edge]) {
            middles[half_edge] = static_cast<std::uint32_t>(mesh.positions.size());
        }
        mesh.positions.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
        spacing.push_back(between(spacing[a], spacing[b]));
        if (!mesh.points.empty()) mesh.points.push_back(std::uint32_t(mesh.points[a]));
    }
    return middles;
}

/// Appends the parts of a face, whose edges have these midpoints. The first edge of a face is
/// divided if any is, and the last is whole if any is.
void append_parts(const TriMesh& mesh, Face face, std::array<std::uint32_t, 3> middles,
                  std::vector<Face>& parts)
{
    const auto whole = std::ranges::count(middles, kWhole);
    while (whole > 0 && whole < 3 && (middles[0] == kWhole || middles[2] != kWhole)) {
        std::rotate(face.begin(), face.begin() + 1, face.end());
        std::rotate(middles.begin(), middles.begin() + 1, middles.end());
    }
    const auto& [a, b, c] = face;
    const auto& [ab, bc, ca] = middles;
    if (whole == 3) {
        parts.push_back(face);
    } else if (whole == 2) {
        parts.insert(parts.end(), {{a, ab, c}, {ab, b, c}});
    } else if (whole == 0) {
        parts.insert(parts.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    } else {
        // The shorter diagonal divides the quadrangle a, ab, bc, c.
        const auto& x = mesh.positions;
        parts.push_back({ab, b, bc});
        if ((x[a] - x[bc]).squaredNorm() < (x[ab] - x[c]).squaredNorm()) {
            parts.insert(parts.end(), {{a, ab, bc}, {a, bc, c}});
        } else {
            parts.insert(parts.end(), {{a, ab, c}, {ab, bc, c}});
        }
    }
}

} // namespace

void divide_faces(TriMesh& mesh, std::vector<float>& spacing, std::size_t most)
{
    constexpr int kMostRounds = 16;
    mesh.colors.clear();
    mesh.normals.clear();
    for (int round = 0; round < kMostRounds; ++round) {
        const std::vector<std::uint32_t> middles = add_midpoints(mesh, spacing, most);
        if (middles.empty()) return;
        std::vector<Face> parts;
        parts.reserve(2 * mesh.faces.size());
        for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
            append_parts(mesh, mesh.faces[face],
                         {middles[3 * face], middles[3 * face + 1], middles[3 * face + 2]}, parts);
        }
        mesh.faces = std::move(parts);
    }
}

} // namespace vcarve
