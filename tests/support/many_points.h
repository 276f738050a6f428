#pragma once

#include "base/free_memory.h"
#include "base/numbers.h"
#include "base/process_usage.h"
#include "vcarve/scene.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace vcarve {

/// Points in a thin layer, each seen by three of six views above it. They are made fast, so that
/// tests can have many.
inline Scene many_points(std::size_t count)
{
    Scene scene;
    scene.cameras = {{.id = 1,
                      .model = 0,
                      .width_px = 100,
                      .height_px = 100,
                      .params = {100.0, 50.0, 50.0},
                      .measures_range = false}};
    for (std::uint32_t i = 0; i < 6; ++i) {
        const double turn = i * std::numbers::pi / 3.0;
        View view;
        view.id = i + 1;
        view.name = std::to_string(i) + ".jpg";
        view.center = {3.0 * std::cos(turn), 3.0 * std::sin(turn), 4.0};
        scene.views.push_back(view);
    }
    const std::vector<std::uint32_t> track = {0, 2, 4};
    scene.positions.reserve(count);
    scene.tracks.begins.reserve(count + 1);
    scene.tracks.views.reserve(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        scene.positions.emplace_back(random_number(1, i), random_number(2, i),
                                     0.01 * random_number(3, i));
        scene.tracks.push_back(track);
    }
    scene.colors.resize(count, {1, 2, 3});
    scene.errors_px.resize(count, 0.5);
    scene.point_ids.resize(count);
    std::iota(scene.point_ids.begin(), scene.point_ids.end(), std::uint64_t{1});
    return scene;
}

/// The memory of the points and tracks of a scene, in bytes.
inline double bytes_of_points(const Scene& scene)
{
    constexpr double kPoint = 24 + 3 + 8 + 8 + 8;
    return kPoint * static_cast<double>(scene.num_points()) +
           4.0 * static_cast<double>(scene.num_rays());
}

/// The peak memory of an action in bytes, beyond the memory in use before it.
template <typename Action>
double memory_taken(const Action& action)
{
#ifdef __GLIBC__
    // Return freed arrays to the system at once, as happens with larger models.
    mallopt(M_MMAP_THRESHOLD, 1 << 17);
#endif
    return_freed_memory();
    if (!reset_peak_memory()) throw std::runtime_error("cannot reset the peak of memory");
    const std::int64_t before = peak_memory_bytes();
    action();
    return static_cast<double>(peak_memory_bytes() - before);
}

} // namespace vcarve
