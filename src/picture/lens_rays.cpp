#include "picture/lens_rays.h"

#include "base/parallel.h"
#include "model/camera.h"

namespace vcarve {

LensRays::LensRays(const Camera& camera, const Eigen::Array2i& size_px)
    : camera_(camera),
      step_(Eigen::Array2d(static_cast<double>(camera.width_px),
                           static_cast<double>(camera.height_px)) /
            size_px.cast<double>()),
      columns_(size_px.x() + 1),
      corners_(static_cast<std::size_t>(columns_) * (size_px.y() + 1), Eigen::Vector3d::Zero())
{
    parallel_for(corners_.size(), [&](std::size_t i) {
        const std::size_t row = i / columns_;
        const Eigen::Array2d place(static_cast<double>(i % columns_), static_cast<double>(row));
        corners_[i] = exact(place).value_or(Eigen::Vector3d::Zero());
    });
}

std::optional<Eigen::Vector3d> LensRays::exact(const Eigen::Array2d& place) const
{
    return ray(camera_, (step_ * place).matrix());
}

std::optional<Eigen::Vector3d> LensRays::at(int x, int y, const Eigen::Array2d& within) const
{
    const std::size_t first = static_cast<std::size_t>(y) * columns_ + x;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int down : {0, 1}) {
        for (const int right : {0, 1}) {
            const Eigen::Vector3d& corner =
                corners_[first + static_cast<std::size_t>(down) * columns_ + right];
            if (corner.isZero(0.0)) return exact(Eigen::Array2d(x, y) + within);
            const double weight_x = right == 0 ? 1.0 - within.x() : within.x();
            const double weight_y = down == 0 ? 1.0 - within.y() : within.y();
            sum += weight_x * weight_y * corner;
        }
    }
    return sum.normalized();
}

} // namespace vcarve
