#include "texture/vertex_colors.h"

#include "base/median.h"
#include "base/parallel.h"
#include "base/sort_unique.h"
#include "mesh/vertex_faces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Array3d;

constexpr Color kGrey = {160, 160, 160};

Color rounded(const Array3d& channels)
{
    Color color;
    for (int i = 0; i < 3; ++i) {
        color[i] = static_cast<std::uint8_t>(std::lround(std::clamp(channels[i], 0.0, 255.0)));
    }
    return color;
}

/// What the photographs show at a vertex, each the mean over the faces it shows there.
std::vector<Array3d> shown_at(std::uint32_t vertex, std::span<const std::uint32_t> faces,
                              const TriMesh& mesh, const std::vector<PhotosOfFace>& photos_of_faces,
                              const FaceColors& colors, const Gains& gains)
{
    std::map<std::uint32_t, std::pair<Array3d, double>> sums;
    for (const std::uint32_t face : faces) {
        const auto corner = static_cast<std::size_t>(std::ranges::find(mesh.faces[face], vertex) -
                                                     mesh.faces[face].begin());
        const auto shown = photos_of_faces[face].shown();
        for (std::size_t place = 0; place < shown.size(); ++place) {
            const Color& color = colors[face][place][corner];
            auto& [sum, count] =
                sums.try_emplace(shown[place].photo, Array3d::Zero(), 0.0).first->second;
            sum += Array3d(color[0], color[1], color[2]) * gains[shown[place].photo].cast<double>();
            count += 1.0;
        }
    }
    std::vector<Array3d> means;
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

/// Colours the vertices that have none by those beside them, ring by ring.
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
            for (const std::uint32_t face : faces_at[vertex]) {
                for (const std::uint32_t other : mesh.faces[face]) {
                    if (!colors[other]) next.push_back(other);
                }
            }
        }
        sort_unique(next);
        std::vector<Array3d> means;
        for (const std::uint32_t vertex : next) {
            Array3d sum = Array3d::Zero();
            double count = 0.0;
            for (const std::uint32_t face : faces_at[vertex]) {
                for (const std::uint32_t other : mesh.faces[face]) {
                    if (!colors[other]) continue;
                    sum += *colors[other];
                    count += 1.0;
                }
            }
            means.emplace_back(sum / count);
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
    const VertexFaces faces_at(mesh.faces, mesh.positions.size());
    std::vector<std::optional<Array3d>> found(mesh.positions.size());
    parallel_for(found.size(), [&](std::size_t i) {
        const auto vertex = static_cast<std::uint32_t>(i);
        const std::vector<Array3d> shown =
            shown_at(vertex, faces_at[vertex], mesh, photos_of_faces, colors, gains);
        if (!shown.empty()) found[i] = robust_mean(shown);
    });
    const std::size_t seen = static_cast<std::size_t>(
        std::ranges::count_if(found, [](const auto& color) { return color.has_value(); }));
    spread(faces_at, found, mesh);
    mesh.colors.resize(mesh.positions.size(), kGrey);
    for (std::size_t vertex = 0; vertex < found.size(); ++vertex) {
        if (found[vertex]) mesh.colors[vertex] = rounded(*found[vertex]);
    }
    return seen;
}

} // namespace vcarve
