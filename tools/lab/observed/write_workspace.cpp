#include "observed/write_workspace.h"

#include "observed/observe.h"
#include "observed/write_model.h"

#include <cmath>
#include <cstdint>
#include <fstream>
#include <vector>

namespace vcarve::observed {

namespace {

/// The views in the order a mapper might have registered them in: every eleventh, round and round.
std::vector<std::uint32_t> registered_order(std::size_t num_views)
{
    std::vector<std::uint32_t> order;
    for (std::size_t first = 0; first < 11; ++first) {
        for (std::size_t view = first; view < num_views; view += 11) {
            order.push_back(static_cast<std::uint32_t>(view));
        }
    }
    return order;
}

template <typename Number>
void put(std::ofstream& file, Number value)
{
    file.write(reinterpret_cast<const char*>(&value), sizeof(value));
}

float rounded(double value, double step)
{
    return static_cast<float>(step > 0.0 ? step * std::round(value / step) : value);
}

void write_cloud(const std::filesystem::path& path, const Scene& scene, double step)
{
    std::ofstream file(path, std::ios::binary);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << scene.num_points();
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) {
        file << "\nproperty float " << name;
    }
    file << "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        for (const double coordinate : scene.positions[i]) {
            put(file, rounded(coordinate, step));
        }
        for (const float coordinate : scene.normals[i]) {
            put(file, rounded(coordinate, step));
        }
        for (const std::uint8_t channel : scene.colors[i]) {
            put(file, channel);
        }
    }
}

void write_visibility(const std::filesystem::path& path, const Scene& scene,
                      const std::vector<std::uint32_t>& order)
{
    std::vector<std::uint32_t> place_of(order.size());
    for (std::uint32_t place = 0; place < order.size(); ++place) {
        place_of[order[place]] = place;
    }
    std::ofstream file(path, std::ios::binary);
    put(file, std::uint64_t{scene.num_points()});
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        put(file, static_cast<std::uint32_t>(scene.tracks[i].size()));
        for (const std::uint32_t view : scene.tracks[i]) {
            put(file, place_of[view]);
        }
    }
}

} // namespace

void write_workspace(const std::filesystem::path& folder, const Scene& scene, double step)
{
    const std::vector<std::uint32_t> order = registered_order(scene.views.size());
    ObservedModel model;
    model.scene.cameras = scene.cameras;
    for (const std::uint32_t view : order) {
        model.scene.views.push_back(scene.views[view]);
    }
    model.observations.resize(scene.views.size());
    write_model(folder / "sparse", model);
    write_cloud(folder / "fused.ply", scene, step);
    write_visibility(folder / "fused.ply.vis", scene, order);
}

} // namespace vcarve::observed
