#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vcarve {

/// Bilateral weights exp(-d^2 / 2 sigma^2) of differences d in gray levels, for the middles of
/// quarters of a level.
class GrayWeights {
  public:
    explicit GrayWeights(float sigma)
    {
        for (std::size_t i = 0; i < weights_.size(); ++i) {
            const float relative = (static_cast<float>(i) + 0.5F) / (kSteps * sigma);
            weights_[i] = std::exp(-0.5F * relative * relative);
        }
    }

    float of(float difference) const
    {
        const auto place = static_cast<std::size_t>(kSteps * std::abs(difference));
        return weights_[std::min(place, weights_.size() - 1)];
    }

  private:
    static constexpr float kSteps = 4.0F; ///< per gray level
    std::array<float, 1024> weights_{};
};

} // namespace vcarve
