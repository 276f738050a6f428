#include "texture/left_out.h"

#include "base/parallel.h"
#include "io/images/read_photograph.h"
#include "picture/shade.h"
#include "texture/photo_pyramid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace vcarve {

namespace {

using Eigen::Array3f;

constexpr double kMostPixels = 1e6;

/// What is summed over pixels and squares.
struct Sums {
    double squares = 0.0; ///< of the differences of channels
    double covered = 0.0;
    double pixels = 0.0;
    double similarity = 0.0;
    double windows = 0.0;
};

/// The photograph at the size of a picture.
std::vector<Array3f> resized(const CalibratedPhoto& photo, const Picture& picture)
{
    const PhotoPyramid pyramid(read_photograph(photo.file));
    const double step_x = static_cast<double>(photo.size.width_px) / picture.width_px;
    const double step_y = static_cast<double>(photo.size.height_px) / picture.height_px;
    std::vector<Array3f> pixels(picture.pixels.size());
    parallel_for(pixels.size(), [&](std::size_t i) {
        const auto width = static_cast<std::size_t>(picture.width_px);
        const std::size_t column = i % width;
        const std::size_t row = i / width;
        const Eigen::Vector2d pixel((static_cast<double>(column) + 0.5) * step_x,
                                    (static_cast<double>(row) + 0.5) * step_y);
        pixels[i] = pyramid.at(pixel, std::max(step_x, step_y));
    });
    return pixels;
}

double grey(const Array3f& color)
{
    return 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2];
}

constexpr int kSide = 8; ///< of a square

/// Of one square, whose upper left corner is given.
double similarity(const Picture& picture, const std::vector<Array3f>& photo, int left, int top)
{
    constexpr double kCount = kSide * kSide;
    Eigen::Array2d sum = Eigen::Array2d::Zero();
    Eigen::Array2d sum_sq = Eigen::Array2d::Zero();
    double product = 0.0;
    for (int y = top; y < top + kSide; ++y) {
        for (int x = left; x < left + kSide; ++x) {
            const auto i = static_cast<std::size_t>(y) * picture.width_px + x;
            const Eigen::Array2d both(grey(picture.pixels[i]), grey(photo[i]));
            sum += both;
            sum_sq += both * both;
            product += both[0] * both[1];
        }
    }
    const Eigen::Array2d mean = sum / kCount;
    const Eigen::Array2d variance = (sum_sq / kCount - mean * mean).max(0.0);
    const double covariance = product / kCount - mean[0] * mean[1];
    constexpr double kFirst = 0.01 * 255.0 * 0.01 * 255.0;
    constexpr double kSecond = 0.03 * 255.0 * 0.03 * 255.0;
    return (2.0 * mean[0] * mean[1] + kFirst) * (2.0 * covariance + kSecond) /
           ((mean[0] * mean[0] + mean[1] * mean[1] + kFirst) * (variance.sum() + kSecond));
}

bool is_covered(const Looks& looks, int left, int top)
{
    for (int y = top; y < top + kSide; ++y) {
        for (int x = left; x < left + kSide; ++x) {
            if (looks.is_front[static_cast<std::size_t>(y) * looks.shaded.width_px + x] == 0) {
                return false;
            }
        }
    }
    return true;
}

void add(const Looks& looks, const std::vector<Array3f>& photo, Sums& sums)
{
    const Picture& picture = looks.shaded;
    sums.pixels += static_cast<double>(photo.size());
    for (std::size_t i = 0; i < photo.size(); ++i) {
        if (looks.is_front[i] == 0) continue;
        sums.covered += 1.0;
        sums.squares += (picture.pixels[i] - photo[i]).cast<double>().square().sum();
    }
    for (int top = 0; top + kSide <= picture.height_px; top += kSide) {
        for (int left = 0; left + kSide <= picture.width_px; left += kSide) {
            if (!is_covered(looks, left, top)) continue;
            sums.similarity += similarity(picture, photo, left, top);
            sums.windows += 1.0;
        }
    }
}

} // namespace

PhotoLikeness compare_with_photos(const TriMesh& mesh, const Texture& texture,
                                  const std::vector<CalibratedPhoto>& photos,
                                  const Progress& progress)
{
    Sums sums;
    for (std::size_t i = 0; i < photos.size(); ++i) {
        const CalibratedPhoto& photo = photos[i];
        Eye eye;
        eye.camera = photo.camera;
        eye.cam_from_world = photo.pose.cam_from_world;
        eye.center = photo.pose.center + mesh.offset;
        const double pixels =
            static_cast<double>(photo.size.width_px) * static_cast<double>(photo.size.height_px);
        const Looks looks = look_at(mesh, texture, eye, std::min(pixels, kMostPixels));
        add(looks, resized(photo, looks.shaded), sums);
        progress.tell(static_cast<double>(i + 1), static_cast<double>(photos.size()));
    }
    PhotoLikeness figures;
    figures.photos = photos.size();
    if (sums.covered == 0.0) return figures;
    const double mean_square = std::max(sums.squares / (3.0 * sums.covered), 1e-3);
    figures.psnr_db = 10.0 * std::log10(255.0 * 255.0 / mean_square);
    figures.structure = sums.windows > 0.0 ? sums.similarity / sums.windows : 0.0;
    figures.covered = sums.covered / sums.pixels;
    return figures;
}

SplitPhotos split_photos(const std::vector<CalibratedPhoto>& photos)
{
    constexpr std::size_t kEvery = 4;
    SplitPhotos split;
    for (std::size_t i = 0; i < photos.size(); ++i) {
        (i % kEvery == 2 ? split.left_out : split.kept).push_back(photos[i]);
    }
    return split;
}

} // namespace vcarve
