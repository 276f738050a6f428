#include "run/scene_digest.h"

#include "model/place.h"
#include "run/kept_fields.h"

#include <algorithm>
#include <numeric>

namespace vcarve {

namespace {

template <typename T>
void add(RunningDigest& digest, const T& value)
{
    if constexpr (kIsPlain<T>) {
        digest.add({reinterpret_cast<const char*>(&value), sizeof(T)});
    } else if constexpr (kIsArray<T>) {
        add(digest, std::uint64_t{value.size()});
        for (const auto& item : value) {
            add(digest, item);
        }
    } else {
        for_each_field(value, [&](const auto& field) { add(digest, field); });
    }
}

/// Models list their points in any order.
std::vector<std::size_t> order_by_id(const std::vector<std::uint64_t>& ids)
{
    std::vector<std::size_t> order(ids.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t point) { return ids[point]; });
    return order;
}

} // namespace

Digest digest_of(const Scene& scene)
{
    RunningDigest digest;
    add(digest, scene.cameras);
    add(digest, scene.views);
    add(digest, scene.offset);
    for (const std::size_t point : order_by_id(scene.point_ids)) {
        if (!is_place(scene.positions[point])) continue;
        add(digest, scene.point_ids[point]);
        add(digest, scene.positions[point]);
        add(digest, scene.colors[point]);
        add(digest, scene.errors_px[point]);
        if (!scene.normals.empty()) add(digest, scene.normals[point]);
        for (const std::uint32_t view : scene.tracks[point]) {
            add(digest, view);
        }
    }
    return digest.value();
}

} // namespace vcarve
