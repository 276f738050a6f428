#include "texture/face_colors.h"

#include "base/parallel.h"
#include "base/statistics.h"
#include "geometry/triangle.h"
#include "model/colors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Array3f;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Returns nothing if the photograph is transparent at one of the four positions.
std::optional<ColorsOfFace> colors_in(const PhotoPyramid& pyramid, const CalibratedPhoto& photo,
                                      const std::array<Vector3d, 3>& corners, double area_px2)
{
    bool is_shown = true;
    const double side_px = std::sqrt(area_px2);
    const double corner_px = std::clamp(0.4 * side_px, 2.0, 24.0);
    ColorsOfFace colors{};
    const auto look = [&](const Vector3d& place, double width_px) {
        const auto pixel = pixel_beyond(photo, place);
        if (!pixel) return Color{};
        is_shown = is_shown && pyramid.shows(*pixel, width_px);
        return rounded_color(pyramid.at(*pixel, width_px));
    };
    for (int i = 0; i < 3; ++i) {
        colors[i] = look(corners[i], corner_px);
    }
    colors[3] = look((corners[0] + corners[1] + corners[2]) / 3.0, 0.6 * side_px);
    if (!is_shown) return std::nullopt;
    return colors;
}

/// Keeps the photographs of a face for which keep(index) is true. Returns the number of drops.
template <typename Keep>
std::uint8_t keep_photos(PhotosOfFace& photos,
                         std::array<ColorsOfFace, PhotosOfFace::kMost>& colors, const Keep& keep)
{
    std::uint8_t kept = 0;
    for (std::uint8_t i = 0; i < photos.count; ++i) {
        if (!keep(i)) continue;
        photos.best[kept] = photos.best[i];
        colors[kept] = colors[i];
        ++kept;
    }
    const auto dropped = static_cast<std::uint8_t>(photos.count - kept);
    photos.count = kept;
    return dropped;
}

double mean_level(const Color& color)
{
    return (color[0] + color[1] + color[2]) / 3.0;
}

/// The median of each channel.
Array3f median_color(std::span<const Array3f> colors)
{
    Array3f median;
    for (int channel = 0; channel < 3; ++channel) {
        std::vector<double> values;
        values.reserve(colors.size());
        for (const Array3f& color : colors) {
            values.push_back(color[channel]);
        }
        median[channel] = static_cast<float>(median_in_place(values));
    }
    return median;
}

/// The distance of each photograph of a face from the median of all, in levels of 255.
std::vector<double>
distances_from_median(const PhotosOfFace& photos,
                      const std::array<ColorsOfFace, PhotosOfFace::kMost>& colors,
                      const Gains& gains)
{
    std::vector<double> distances(photos.count);
    std::vector<Array3f> shown(photos.count);
    for (std::size_t place = 0; place < 4; ++place) {
        for (std::size_t i = 0; i < shown.size(); ++i) {
            shown[i] = channels_of(colors[i][place]) * gains[photos.best[i].photo];
        }
        const Array3f median = median_color(shown);
        for (std::size_t i = 0; i < shown.size(); ++i) {
            distances[i] += (shown[i] - median).abs().mean() / 4.0;
        }
    }
    return distances;
}

/// The mean color around a face's centroid in its other photographs.
Array3f shown_by_others(const FaceOfPhoto& look, const PhotosOfFace& photos,
                        const FaceColors& colors, const Gains& gains)
{
    Array3f sum = Array3f::Zero();
    for (std::size_t i = 0; i < photos.count; ++i) {
        if (i == look.place) continue;
        sum += channels_of(colors[look.face][i][3]) * gains[photos.best[i].photo];
    }
    return sum / static_cast<float>(photos.count - 1);
}

/// The ratios of the other photographs' colors to a photograph's own, for each channel.
std::array<std::vector<double>, 3> quotients_of(const std::vector<FaceOfPhoto>& faces,
                                                const std::vector<PhotosOfFace>& photos_of_faces,
                                                const FaceColors& colors, const Gains& gains)
{
    constexpr std::size_t kMostFaces = 4000;
    constexpr double kBlack = 16.0; // clipped colors do not depend on the exposure
    constexpr double kWhite = 240.0;
    std::array<std::vector<double>, 3> quotients;
    const std::size_t step = faces.size() / kMostFaces + 1;
    for (std::size_t i = 0; i < faces.size(); i += step) {
        const FaceOfPhoto& look = faces[i];
        const PhotosOfFace& photos = photos_of_faces[look.face];
        const Color& color = colors[look.face][look.place][3];
        if (photos.count < 2 || mean_level(color) < kBlack || mean_level(color) > kWhite) continue;
        const Array3f others = shown_by_others(look, photos, colors, gains);
        for (int channel = 0; channel < 3; ++channel) {
            const float own = color[channel];
            if (own > 4.0F) quotients[channel].push_back(others[channel] / own);
        }
    }
    return quotients;
}

/// The median of the quotients, drawn to 1 if there are few.
float gain_of(std::vector<double>& quotients)
{
    constexpr double kPrior = 20.0; // number of faces whose median counts half
    const auto count = static_cast<double>(quotients.size());
    const double gain = std::clamp(median_in_place(quotients), 0.4, 2.5);
    return static_cast<float>((count * gain + kPrior) / (count + kPrior));
}

} // namespace

std::vector<std::string>
for_each_photograph(const std::vector<CalibratedPhoto>& photos, std::size_t at_a_time,
                    const Progress& progress,
                    const std::function<void(std::uint32_t, const PhotoPyramid&)>& body)
{
    std::vector<std::string> problems(photos.size());
    for (std::size_t first = 0; first < photos.size(); first += at_a_time) {
        const std::size_t count = std::min(at_a_time, photos.size() - first);
        parallel_for(
            count,
            [&](std::size_t i) {
                const auto photo = static_cast<std::uint32_t>(first + i);
                body(photo, PhotoPyramid(photograph_of(photos[photo], problems[photo])));
            },
            1);
        progress.report(static_cast<double>(first + count), static_cast<double>(photos.size()));
    }
    std::erase(problems, "");
    return problems;
}

ShownColors look_up_colors(const TriMesh& mesh, const std::vector<CalibratedPhoto>& photos,
                           std::vector<PhotosOfFace>& photos_of_faces, std::size_t at_a_time,
                           const Progress& progress)
{
    FaceColors colors(mesh.faces.size());
    std::vector<std::array<bool, PhotosOfFace::kMost>> shown(mesh.faces.size());
    const auto faces = faces_of_photos(photos.size(), photos_of_faces);
    const auto look = [&](std::uint32_t photo, const PhotoPyramid& pyramid) {
        for (const auto& [face, place] : faces[photo]) {
            const auto found =
                colors_in(pyramid, photos[photo], corners_of(mesh.positions, mesh.faces[face]),
                          photos_of_faces[face].best[place].area_px2);
            shown[face][place] = found.has_value();
            if (found) colors[face][place] = *found;
        }
    };
    std::vector<std::string> unreadable = for_each_photograph(photos, at_a_time, progress, look);
    parallel_for(shown.size(), [&](std::size_t face) {
        keep_photos(photos_of_faces[face], colors[face],
                    [&](std::size_t place) { return shown[face][place]; });
    });
    return {std::move(colors), std::move(unreadable)};
}

Gains find_gains(std::size_t num_photos, const std::vector<PhotosOfFace>& photos_of_faces,
                 const FaceColors& colors)
{
    Gains gains(num_photos, Array3f::Ones());
    constexpr int kRounds = 8;
    const auto faces = faces_of_photos(num_photos, photos_of_faces);
    for (int round = 0; round < kRounds; ++round) {
        Gains next = gains;
        parallel_for(
            num_photos,
            [&](std::size_t photo) {
                auto quotients = quotients_of(faces[photo], photos_of_faces, colors, gains);
                for (int channel = 0; channel < 3; ++channel) {
                    if (quotients[channel].empty()) continue;
                    next[photo][channel] = gain_of(quotients[channel]);
                }
            },
            1);
        Array3f mean = Array3f::Zero();
        for (const Array3f& gain : next) {
            mean += gain / static_cast<float>(num_photos);
        }
        for (std::size_t photo = 0; photo < num_photos; ++photo) {
            // Update halfway, so that two photographs do not oscillate.
            gains[photo] = 0.5F * (gains[photo] + next[photo] / mean);
        }
    }
    return gains;
}

std::size_t drop_outliers(const Gains& gains, std::vector<PhotosOfFace>& photos_of_faces,
                          FaceColors& colors)
{
    constexpr double kLeastLevels = 24.0;
    constexpr double kTimesMedian = 3.0;
    std::vector<std::uint8_t> dropped(photos_of_faces.size());
    parallel_for(photos_of_faces.size(), [&](std::size_t face) {
        PhotosOfFace& photos = photos_of_faces[face];
        if (photos.count < 3) return;
        const std::vector<double> distances = distances_from_median(photos, colors[face], gains);
        const double most = std::max(kLeastLevels, kTimesMedian * median(distances));
        dropped[face] = keep_photos(photos, colors[face],
                                    [&](std::size_t place) { return distances[place] <= most; });
    });
    std::size_t sum = 0;
    for (const std::uint8_t count : dropped) {
        sum += count;
    }
    return sum;
}

} // namespace vcarve
