#pragma once

#include "model/flow_network.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace vcarve {

/// Which fields of a noun a stage file holds: `static void visit(const auto& field, auto& noun)`
/// calls field() with each, in order, and serves for writing and for reading. A noun that lacks a
/// field here comes back without it, so tests compare what comes back.
template <typename Noun>
struct KeptFields;

template <>
struct KeptFields<Camera> {
    static void visit(const auto& field, auto& camera)
    {
        field(camera.id);
        field(camera.model);
        field(camera.width_px);
        field(camera.height_px);
        field(camera.params);
        field(camera.measures_range);
    }
};

template <>
struct KeptFields<View> {
    static void visit(const auto& field, auto& view)
    {
        field(view.id);
        field(view.camera);
        field(view.name);
        field(view.cam_from_world);
        field(view.center);
    }
};

template <>
struct KeptFields<Scene> {
    static void visit(const auto& field, auto& scene)
    {
        field(scene.cameras);
        field(scene.views);
        field(scene.positions);
        field(scene.colors);
        field(scene.errors_px);
        field(scene.point_ids);
        field(scene.normals);
        field(scene.tracks.begins);
        field(scene.tracks.views);
        field(scene.offset);
    }
};

template <>
struct KeptFields<TetMesh> {
    static void visit(const auto& field, auto& cells)
    {
        field(cells.positions);
        field(cells.cells);
        field(cells.mirrors);
        field(cells.cell_of_vertex);
    }
};

template <>
struct KeptFields<VisibilityEnergy> {
    static void visit(const auto& field, auto& energy)
    {
        field(energy.network.arc_capacities);
        field(energy.network.terminal_capacities);
        field(energy.cell_of_view);
        field(energy.unit);
    }
};

template <>
struct KeptFields<TriMesh> {
    static void visit(const auto& field, auto& mesh)
    {
        field(mesh.positions);
        field(mesh.faces);
        field(mesh.colors);
        field(mesh.normals);
        field(mesh.points);
        field(mesh.offset);
    }
};

/// Whether the bytes of a value in memory are all there is to it.
template <typename T>
inline constexpr bool kIsPlain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;
template <typename T, int Rows, int Columns>
inline constexpr bool kIsPlain<Eigen::Matrix<T, Rows, Columns>> = Rows > 0 && Columns > 0;
template <typename T>
inline constexpr bool kIsPlain<Eigen::Quaternion<T>> = true;

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
