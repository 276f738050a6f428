#include "stereo/stereo_view.h"

#include "model/camera.h"
#include "model/colors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

/// Samples a photograph through its lens at pixels of the pinhole image.
class Undistorter {
  public:
    /// `width_px` is the width of a sample in photograph pixels.
    Undistorter(const CalibratedPhoto& photo, const Pinhole& camera, double width_px,
                std::string& problem)
        : photo_(photo), camera_(camera), level_(photograph_of(photo, problem))
    {
        for (double rounded = std::round(std::log2(std::max(width_px, 1.0))); rounded > 0.0;
             --rounded) {
            level_ = halved(level_);
            scale_ *= 0.5;
        }
        gray_ = gray_of(level_);
    }

    /// The position of a pixel in the photograph; NaN if it is outside.
    Eigen::Vector2f place(int x, int y) const
    {
        const auto shown =
            project(photo_.camera,
                    camera_.ray(static_cast<float>(x), static_cast<float>(y)).cast<double>());
        if (!shown) return Eigen::Vector2f::Constant(kNoGray);
        return (scale_ * (shown->array() * photo_.scale) - 0.5).matrix().cast<float>();
    }

    /// The mean of four samples of a pixel, whose steps to the next pixels are given; of one, if
    /// the pixel is not much larger than the photograph's.
    float mean_at(const Eigen::Vector2f& place, const Eigen::Vector2f& right,
                  const Eigen::Vector2f& down) const
    {
        constexpr float kNotLarger = 1.5F;
        if (right.squaredNorm() < kNotLarger * kNotLarger) return sample(place);
        const Eigen::Vector2f diagonal = 0.25F * (right + down);
        const Eigen::Vector2f other = 0.25F * (right - down);
        return 0.25F * (sample(place + diagonal) + sample(place - diagonal) +
                        sample(place + other) + sample(place - other));
    }

    Color color_at(const Eigen::Vector2f& place) const
    {
        return rounded_color(
            between_pixels(level_, (place.array() + 0.5F).matrix().cast<double>()));
    }

  private:
    static GrayImage gray_of(const Photograph& photo)
    {
        GrayImage image{photo.width_px, photo.height_px, {}};
        image.pixels.resize(photo.rgb.size() / 3);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const std::uint8_t* const rgb = &photo.rgb[3 * i];
            const bool is_shown = photo.alpha.empty() || photo.alpha[i] != 0;
            image.pixels[i] =
                is_shown ? 0.299F * rgb[0] + 0.587F * rgb[1] + 0.114F * rgb[2] : kNoGray;
        }
        return image;
    }

    /// Interpolates bilinearly, up to half a pixel beyond the outer pixel centers.
    float sample(const Eigen::Vector2f& at) const
    {
        const auto last_x = static_cast<float>(gray_.width_px - 1);
        const auto last_y = static_cast<float>(gray_.height_px - 1);
        if (!(at.x() >= -0.5F && at.y() >= -0.5F && at.x() <= last_x + 0.5F &&
              at.y() <= last_y + 0.5F))
            return kNoGray;
        const float column = std::clamp(at.x(), 0.0F, last_x);
        const float row = std::clamp(at.y(), 0.0F, last_y);
        const int x = static_cast<int>(column);
        const int y = static_cast<int>(row);
        const float right = column - static_cast<float>(x);
        const float down = row - static_cast<float>(y);
        const float* const upper = &gray_.pixels[static_cast<std::size_t>(y) * gray_.width_px + x];
        const float* const lower = upper + (y + 1 < gray_.height_px ? gray_.width_px : 0);
        const int next = x + 1 < gray_.width_px ? 1 : 0;
        const float above = upper[0] + right * (upper[next] - upper[0]);
        const float below = lower[0] + right * (lower[next] - lower[0]);
        return above + down * (below - above);
    }

    const CalibratedPhoto& photo_;
    const Pinhole& camera_;
    Photograph level_;   ///< the photograph at half its size, or a quarter and so on
    double scale_ = 1.0; ///< pixels of the level per photograph pixel
    GrayImage gray_;     ///< the level
};

/// The positions of the pixels of a row. Every fourth pixel is projected, and those between are
/// interpolated: lenses bend little within four pixels.
class PlaceRows {
  public:
    PlaceRows(const Undistorter& photograph, int width_px)
        : photograph_(photograph),
          upper_(width_px / kStep + 2),
          lower_(upper_.size()),
          row_(width_px + 1),
          next_(row_.size())
    {
        project(0, lower_);
        interpolate(next_);
    }

    /// Goes to the next row; the first call to the first.
    void next()
    {
        ++y_;
        std::swap(row_, next_);
        interpolate(next_);
    }
    Eigen::Vector2f place(int x) const { return row_[x]; }
    float mean_at(int x) const
    {
        return photograph_.mean_at(row_[x], row_[x + 1] - row_[x], next_[x] - row_[x]);
    }

  private:
    static constexpr int kStep = 4;

    void project(int y, std::vector<Eigen::Vector2f>& nodes) const
    {
        for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
            nodes[i] = photograph_.place(kStep * i, y);
        }
    }

    /// Fills the row after y_.
    void interpolate(std::vector<Eigen::Vector2f>& row)
    {
        const int y = y_ + 1;
        if (y % kStep == 0) {
            std::swap(upper_, lower_);
            project(y + kStep, lower_);
        }
        const float down = static_cast<float>(y % kStep) / kStep;
        for (int x = 0; x < static_cast<int>(row.size()); ++x) {
            const int i = x / kStep;
            const float right = static_cast<float>(x % kStep) / kStep;
            const Eigen::Vector2f above = upper_[i] + right * (upper_[i + 1] - upper_[i]);
            const Eigen::Vector2f below = lower_[i] + right * (lower_[i + 1] - lower_[i]);
            row[x] = above + down * (below - above);
        }
    }

    const Undistorter& photograph_;
    int y_ = -1;
    std::vector<Eigen::Vector2f> upper_; ///< positions of every fourth pixel
    std::vector<Eigen::Vector2f> lower_; ///< four rows below
    std::vector<Eigen::Vector2f> row_;
    std::vector<Eigen::Vector2f> next_;
};

} // namespace

GrayImage halved(const GrayImage& image)
{
    GrayImage half{image.width_px / 2, image.height_px / 2, {}};
    half.pixels.resize(static_cast<std::size_t>(half.width_px) * half.height_px);
    for (int y = 0; y < half.height_px; ++y) {
        for (int x = 0; x < half.width_px; ++x) {
            half.pixels[static_cast<std::size_t>(y) * half.width_px + x] =
                0.25F * (image.at(2 * x, 2 * y) + image.at(2 * x + 1, 2 * y) +
                         image.at(2 * x, 2 * y + 1) + image.at(2 * x + 1, 2 * y + 1));
        }
    }
    return half;
}

Pinhole halved(const Pinhole& camera)
{
    return {0.5F * camera.focal_px, 0.5F * camera.principal_px - Eigen::Vector2f::Constant(0.25F)};
}

double working_scale(const PhotographSize& photograph, int size_px)
{
    const int longest = std::max(photograph.width_px, photograph.height_px);
    return std::min(1.0, static_cast<double>(size_px) / longest);
}

StereoView view_without_pixels(const CalibratedPhoto& photo, int size_px)
{
    const double scale = working_scale(photo.size, size_px);
    StereoView result;
    result.view = photo.view;
    result.cam_from_world = photo.pose.cam_from_world.toRotationMatrix();
    result.center = photo.pose.center;
    const Eigen::Array2d principal = intrinsics(photo.camera)->principal_px.array() * photo.scale;
    result.camera = {static_cast<float>(photo.focal_px * scale),
                     (principal * scale - 0.5).matrix().cast<float>()};
    result.image.width_px = std::max(1, static_cast<int>(std::lround(photo.size.width_px * scale)));
    result.image.height_px =
        std::max(1, static_cast<int>(std::lround(photo.size.height_px * scale)));
    return result;
}

StereoView stereo_view(const CalibratedPhoto& photo, int size_px)
{
    StereoView result = view_without_pixels(photo, size_px);
    GrayImage& image = result.image;
    image.pixels.reserve(static_cast<std::size_t>(image.width_px) * image.height_px);
    const double sample_px = 0.5 / working_scale(photo.size, size_px);
    const Undistorter photograph(photo, result.camera, sample_px, result.problem);
    PlaceRows rows(photograph, image.width_px);
    for (int y = 0; y < image.height_px; ++y) {
        rows.next();
        for (int x = 0; x < image.width_px; ++x) {
            const float gray = rows.mean_at(x);
            image.pixels.push_back(gray);
            if (x % kDepthStep == 0 && y % kDepthStep == 0) {
                result.colors.push_back(std::isnan(gray) ? Color()
                                                         : photograph.color_at(rows.place(x)));
            }
        }
    }
    return result;
}

} // namespace vcarve
