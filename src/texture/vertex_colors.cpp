#include "texture/vertex_colors.h"

#include "base/arrays.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "mesh/vertices.h"
#include "model/colors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Array3d;

constexpr Color kGray = {160, 160, 160};

/// The input of color_vertices().
struct Known {
    const TriMesh& mesh;
    const std::vector<PhotosOfFace>& photos_of_faces;
    const FaceColors& colors;
    const Gains& gains;
};

/// The color of each photograph at a vertex: the mean over the faces that it shows there.
std::vector<Array3d> shown_at(std::uint32_t vertex, std::span<const std::uint32_t> faces,
                              const Known& known)
{
    std::map<std::uint32_t, std::pair<Array3d, double>> sums;
    for (const std::uint32_t face : faces) {
        const std::size_t corner = corner_of(known.mesh.faces[face], vertex);
        const auto shown = known.photos_of_faces[face].shown();
        for (std::size_t place = 0; place < shown.size(); ++place) {
            const Color& color = known.colors[face][place][corner];
            auto& [sum, count] =
                sums.try_emplace(shown[place].photo, Array3d::Zero(), 0.0).first->second;
            sum +=
                channels_of(color).cast<double>() * known.gains[shown[place].photo].cast<double>();
            count += 1.0;
        }
    }
    std::vector<Array3d> means;
    means.reserve(sums.size());
    for (const auto& [photo, sum] : sums) {
        means.push_back(sum.first / sum.second);
    }
    return means;
}

Array3d robust_mean(const std::vector<Array3d>& shown)
{
    constexpr double kNear = 20.0; // levels of 255
    Array3d mean;
    for (int channel = 0; channel < 3; ++channel) {
        std::vector<double> values;
        values.reserve(shown.size());
        for (const Array3d& color : shown) {
            values.push_back(color[channel]);
        }
        const double middle = median(values);
        double sum = 0.0;
        double count = 0.0;
        for (const double value : values) {
            if (std::abs(value - middle) > kNear) continue;
            sum += value;
            count += 1.0;
        }
        mean[channel] = sum / count;
    }
    return mean;
}

/// Calls visit(other) for the vertices of the faces at a vertex, including itself; some repeat.
template <typename Visit>
void visit_around(std::uint32_t vertex, const VertexFaces& faces_at, const TriMesh& mesh,
                  const Visit& visit)
{
    for (const std::uint32_t face : faces_at[vertex]) {
        for (const std::uint32_t other : mesh.faces[face]) {
            visit(other);
        }
    }
}

/// Gives vertices without a color the mean color of their neighbors, ring by ring.
void spread(const VertexFaces& faces_at, std::vector<std::optional<Array3d>>& colors,
            const TriMesh& mesh)
{
    std::vector<std::uint32_t> ring;
    for (std::uint32_t vertex = 0; vertex < colors.size(); ++vertex) {
        if (colors[vertex]) ring.push_back(vertex);
    }
    while (!ring.empty()) {
        std::vector<std::uint32_t> next;
        for (const std::uint32_t vertex : ring) {
            visit_around(vertex, faces_at, mesh, [&](std::uint32_t other) {
                if (!colors[other]) next.push_back(other);
            });
        }
        sort_unique(next);
        std::vector<Array3d> means(next.size());
        for (std::size_t i = 0; i < next.size(); ++i) {
            Array3d sum = Array3d::Zero();
            double count = 0.0;
            visit_around(next[i], faces_at, mesh, [&](std::uint32_t other) {
                if (!colors[other]) return;
                sum += *colors[other];
                count += 1.0;
            });
            means[i] = sum / count;
        }
        for (std::size_t i = 0; i < next.size(); ++i) {
            colors[next[i]] = means[i];
        }
        ring = std::move(next);
    }
}

} // namespace

std::size_t color_vertices(const std::vector<PhotosOfFace>& photos_of_faces,
                           const FaceColors& colors, const Gains& gains, TriMesh& mesh)
{
    const Known known = {mesh, photos_of_faces, colors, gains};
    const VertexFaces faces_at(mesh.faces, mesh.positions.size());
    std::vector<std::optional<Array3d>> found(mesh.positions.size());
    parallel_for(found.size(), [&](std::size_t i) {
        const auto vertex = static_cast<std::uint32_t>(i);
        const std::vector<Array3d> shown = shown_at(vertex, faces_at[vertex], known);
        if (!shown.empty()) found[i] = robust_mean(shown);
    });
    const std::size_t seen = static_cast<std::size_t>(
        std::ranges::count_if(found, [](const auto& color) { return color.has_value(); }));
    spread(faces_at, found, mesh);
    mesh.colors.resize(mesh.positions.size(), kGray);
    for (std::size_t vertex = 0; vertex < found.size(); ++vertex) {
        if (found[vertex]) mesh.colors[vertex] = rounded_color(*found[vertex]);
    }
    return seen;
}

} // namespace vcarve
