#include "photo_refine/shift_noise.h"

#include "base/parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

constexpr int kRings = 8; ///< of vertices, over which noise is averaged

/// Sums around a vertex.
struct Around {
    float noise = 0.0F;   ///< squared differences of the halves, weighted
    float halves = 0.0F;  ///< weights of these
    float texture = 0.0F; ///< weights of all photographs

    Around operator+(const Around& other) const
    {
        return {noise + other.noise, halves + other.halves, texture + other.texture};
    }
    Around operator*(float factor) const
    {
        return {factor * noise, factor * halves, factor * texture};
    }
};

Around at_vertex(const GroupShifts& shifts)
{
    const float weight = std::min(shifts.even.weight, shifts.odd.weight);
    const float difference = shifts.even.steps - shifts.odd.steps;
    return {0.5F * weight * difference * difference, weight, shifts.all.weight};
}

std::vector<Around> averages(std::vector<Around> values, const RowTable& neighbors)
{
    std::vector<Around> spread(values.size());
    for (int ring = 0; ring < kRings; ++ring) {
        parallel_for(values.size(), [&](std::size_t v) {
            Around sum = values[v];
            for (const std::uint32_t other : neighbors[v]) {
                sum = sum + values[other];
            }
            spread[v] = sum * (1.0F / (1.0F + static_cast<float>(neighbors[v].size())));
        });
        std::swap(values, spread);
    }
    return values;
}

float trust(const Around& around)
{
    constexpr float kUsualNoise = 0.03F;   // steps squared
    constexpr float kUnknownNoise = 0.06F; // assumed if few photographs see a place
    constexpr float kFewHalves = 0.02F;    // weight of this assumption
    constexpr float kUsualTexture = 1.0F;
    constexpr float kLeast = 0.05F;
    const float noise = (around.noise + kFewHalves * kUnknownNoise) / (around.halves + kFewHalves);
    const float by_noise = std::min(1.0F, kUsualNoise / noise);
    const float by_texture = std::min(1.0F, around.texture / kUsualTexture);
    const float trust = by_noise * by_noise * by_texture * by_texture;
    return trust < kLeast ? 0.0F : trust;
}

} // namespace

std::vector<WantedShift> trusted_shifts(std::span<const GroupShifts> shifts,
                                        const RowTable& neighbors)
{
    std::vector<Around> values;
    values.reserve(shifts.size());
    for (const GroupShifts& each : shifts) {
        values.push_back(at_vertex(each));
    }
    values = averages(std::move(values), neighbors);
    std::vector<WantedShift> trusted(shifts.size());
    parallel_for(trusted.size(), [&](std::size_t v) {
        trusted[v] = shifts[v].all;
        trusted[v].weight *= trust(values[v]);
    });
    return trusted;
}

} // namespace vcarve
