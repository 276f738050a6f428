#pragma once

#include "model/flow_network.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace vcarve {

/// How many fields a noun has that stands in a stage file. All of them are kept, in order: a number
/// that is not that of the fields does not compile, so that none can be forgotten.
template <typename Noun>
inline constexpr int kNumFields = 0;

template <>
inline constexpr int kNumFields<Camera> = 6;
template <>
inline constexpr int kNumFields<View> = 5;
template <>
inline constexpr int kNumFields<Tracks> = 2;
template <>
inline constexpr int kNumFields<Scene> = 11;
template <>
inline constexpr int kNumFields<TetMesh> = 4;
template <>
inline constexpr int kNumFields<FlowNetwork> = 2;
template <>
inline constexpr int kNumFields<VisibilityEnergy> = 3;
template <>
inline constexpr int kNumFields<TriMesh> = 6;
template <typename First, typename Second>
inline constexpr int kNumFields<std::pair<First, Second>> = 2;

/// Calls field() with each field of a noun.
template <typename Noun, typename Field>
void for_each_field(Noun& noun, const Field& field)
{
    const auto all = [&](auto&... fields) { (field(fields), ...); };
    constexpr int kCount = kNumFields<std::remove_const_t<Noun>>;
    if constexpr (kCount == 2) {
        auto& [a, b] = noun;
        all(a, b);
    } else if constexpr (kCount == 3) {
        auto& [a, b, c] = noun;
        all(a, b, c);
    } else if constexpr (kCount == 4) {
        auto& [a, b, c, d] = noun;
        all(a, b, c, d);
    } else if constexpr (kCount == 5) {
        auto& [a, b, c, d, e] = noun;
        all(a, b, c, d, e);
    } else if constexpr (kCount == 6) {
        auto& [a, b, c, d, e, f] = noun;
        all(a, b, c, d, e, f);
    } else {
        static_assert(kCount == 11, "say how many fields it has");
        auto& [a, b, c, d, e, f, g, h, i, j, k] = noun;
        all(a, b, c, d, e, f, g, h, i, j, k);
    }
}

/// Whether the bytes of a value in memory are all there is to it.
template <typename T>
inline constexpr bool kIsPlain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;
template <typename T, int Rows, int Columns>
inline constexpr bool kIsPlain<Eigen::Matrix<T, Rows, Columns>> = Rows > 0 && Columns > 0;
template <typename T>
inline constexpr bool kIsPlain<Eigen::Quaternion<T>> = true;
template <typename T, std::size_t kSize>
inline constexpr bool kIsPlain<std::array<T, kSize>> = kIsPlain<T>;

template <typename T>
inline constexpr bool kIsOptional = false;
template <typename T>
inline constexpr bool kIsOptional<std::optional<T>> = true;

template <typename T>
inline constexpr bool kIsArray = false;
template <typename T, typename Allocator>
inline constexpr bool kIsArray<std::vector<T, Allocator>> = true;
template <>
inline constexpr bool kIsArray<std::string> = true;

} // namespace vcarve
