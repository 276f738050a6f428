// Specification of glTF 2.0: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
#include "io/files/block_writer.h"
#include "io/formats/mesh_file.h"
#include "io/formats/textured_files.h"
#include "io/images/encode_image.h"
#include "vcarve/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using nlohmann::json;

constexpr std::uint64_t kMostGlbBytes = 0xffffffffU - 0x10000U; ///< leaves room for the JSON

/// The type of an accessor's elements, and the target of their buffer view.
struct ElementType {
    const char* type;
    int component_type; ///< as in OpenGL: 5123 uint16, 5125 uint32, 5126 float
    std::size_t bytes;
    int target; ///< 34962 for vertices, 34963 for indices
};
constexpr ElementType kVector3f = {"VEC3", 5126, 12, 34962};
constexpr ElementType kVector2f = {"VEC2", 5126, 8, 34962};
constexpr ElementType kColor16 = {"VEC4", 5123, 8, 34962};
constexpr ElementType kIndex = {"SCALAR", 5125, 4, 34963};

/// Converts a range of numbers to a JSON array.
template <typename Range>
json list_of(const Range& numbers)
{
    return std::vector(numbers.begin(), numbers.end());
}

/// Builds the JSON chunk and the binary chunk, to which accessors and images are appended. Element
/// sizes are multiples of four bytes, so all accessors are aligned.
class GlbBuilder {
  public:
    explicit GlbBuilder(std::size_t expected_bytes) { bytes_.reserve(expected_bytes); }

    json text = {{"asset", {{"version", "2.0"}}}};

    /// Appends an item to a list of the JSON. Returns its index.
    std::size_t add(const char* list, json item)
    {
        text[list].push_back(std::move(item));
        return text[list].size() - 1;
    }

    /// Appends the numbers numbers_of(item) of each item. Returns the accessor's index.
    template <typename Items, typename NumbersOf = std::identity>
    std::size_t add_accessor(const ElementType& element, const Items& items,
                             const NumbersOf& numbers_of = {})
    {
        const std::size_t begin = bytes_.size();
        for (const auto& item : items) {
            for (const auto number : numbers_of(item)) {
                const auto raw = little_endian(number);
                bytes_.insert(bytes_.end(), raw.begin(), raw.end());
            }
        }
        const std::size_t view = add_view(begin);
        text["bufferViews"][view]["target"] = element.target;
        return add("accessors", {{"bufferView", view},
                                 {"componentType", element.component_type},
                                 {"count", (bytes_.size() - begin) / element.bytes},
                                 {"type", element.type}});
    }

    /// Embeds a file. Returns the index of its buffer view.
    std::size_t add_file(const std::vector<std::uint8_t>& file)
    {
        const std::size_t begin = bytes_.size();
        bytes_.insert(bytes_.end(), file.begin(), file.end());
        const std::size_t view = add_view(begin);
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        return view;
    }

    void write(std::ostream& out)
    {
        require_glb_room(bytes_.size());
        if (!bytes_.empty()) add("buffers", {{"byteLength", bytes_.size()}});
        // Comments may have any bytes, but JSON must be UTF-8.
        std::string chunk = text.dump(-1, ' ', false, json::error_handler_t::replace);
        chunk.resize((chunk.size() + 3) / 4 * 4, ' ');
        const auto put_words = [&](std::initializer_list<std::size_t> words) {
            for (const std::size_t word : words) {
                const auto raw = little_endian(static_cast<std::uint32_t>(word));
                out.write(raw.data(), raw.size());
            }
        };
        const std::size_t binary = bytes_.empty() ? 0 : 8 + bytes_.size();
        put_words({0x46546C67, 2, 20 + chunk.size() + binary, chunk.size(), 0x4E4F534A});
        out.write(chunk.data(), static_cast<std::streamsize>(chunk.size()));
        if (bytes_.empty()) return;
        put_words({bytes_.size(), 0x004E4942});
        out.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    }

  private:
    /// Adds a buffer view of all bytes from `begin`.
    std::size_t add_view(std::size_t begin)
    {
        return add("bufferViews",
                   {{"buffer", 0}, {"byteLength", bytes_.size() - begin}, {"byteOffset", begin}});
    }

    std::vector<char> bytes_;
};

/// The linear value of each sRGB value. Photographs have sRGB colors, but vertex colors of glTF are
/// linear. 16 bits keep all 256 values of a channel distinct.
std::array<std::uint16_t, 256> linear_values()
{
    std::array<std::uint16_t, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double share = static_cast<double>(i) / 255.0;
        const double linear =
            share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
        values[i] = static_cast<std::uint16_t>(std::lround(65535.0 * linear));
    }
    return values;
}

/// Adds the attributes of all vertices. Positions are relative to `center`.
json add_attributes(GlbBuilder& glb, const TriMesh& mesh, const Vector3d& center)
{
    Eigen::AlignedBox3f box; // required by glTF
    const auto rounded = [&](const Vector3d& position) {
        Vector3f result = (position - center).cast<float>();
        box.extend(result);
        return result;
    };
    json attributes = {{"POSITION", glb.add_accessor(kVector3f, mesh.positions, rounded)}};
    glb.text["accessors"].back()["min"] = list_of(box.min());
    glb.text["accessors"].back()["max"] = list_of(box.max());
    const auto unit = [](const Vector3f& normal) { // glTF requires unit length
        return normal.isZero() ? Vector3f::UnitZ().eval() : normal;
    };
    if (!mesh.normals.empty()) {
        attributes["NORMAL"] = glb.add_accessor(kVector3f, mesh.normals, unit);
    }
    if (mesh.colors.empty()) return attributes;
    const auto opaque = [linear = linear_values()](const Color& color) {
        return std::array<std::uint16_t, 4>{linear[color[0]], linear[color[1]], linear[color[2]],
                                            0xffff};
    };
    attributes["COLOR_0"] = glb.add_accessor(kColor16, mesh.colors, opaque);
    glb.text["accessors"].back()["normalized"] = true;
    return attributes;
}

/// Adds a matt material that is visible from both sides, and its page unless null. The default
/// material is metallic and visible only from the front.
std::size_t add_material(GlbBuilder& glb, const Photograph* page)
{
    json surface = {{"metallicFactor", 0.0}};
    if (page != nullptr) {
        const std::size_t view = glb.add_file(encode_jpeg(*page, kTextureQuality));
        const std::size_t image =
            glb.add("images", {{"bufferView", view}, {"mimeType", "image/jpeg"}});
        glb.text["samplers"][0] = {{"magFilter", 9729}, // linear, with mipmaps
                                   {"minFilter", 9987},
                                   {"wrapS", 33071}, // clamp to edge
                                   {"wrapT", 33071}};
        surface["baseColorTexture"]["index"] =
            glb.add("textures", {{"sampler", 0}, {"source", image}});
    }
    return glb.add("materials", {{"doubleSided", true}, {"pbrMetallicRoughness", surface}});
}

/// Adds a mesh with one primitive per page, and a node. The node moves the mesh to its original
/// position minus the offset, and rotates it upright.
void add_mesh(GlbBuilder& glb, const TriMesh& mesh, const MeshFormat& format,
              const UnwrappedMesh* unwrapped)
{
    Eigen::AlignedBox3d box;
    for (const Vector3d& position : mesh.positions) {
        box.extend(position);
    }
    const Vector3d center = box.center();
    json primitive = {{"attributes", add_attributes(glb, mesh, center)}, {"mode", 4}}; // triangles
    std::vector<std::size_t> begins = {0, mesh.faces.size()};
    if (unwrapped != nullptr) {
        primitive["attributes"]["TEXCOORD_0"] = glb.add_accessor(kVector2f, unwrapped->places);
        begins = unwrapped->begins;
    }
    json primitives = json::array();
    for (std::size_t page = 0; page + 1 < begins.size(); ++page) {
        primitive["indices"] = glb.add_accessor(
            kIndex, std::span(mesh.faces).subspan(begins[page], begins[page + 1] - begins[page]));
        primitive["material"] =
            add_material(glb, unwrapped != nullptr ? &format.texture->pages[page] : nullptr);
        primitives.push_back(primitive);
    }
    glb.add("meshes", {{"primitives", primitives}});
    json node = {{"mesh", 0}};
    Vector3d translation = mesh.offset - format.offset + center;
    if (!format.up.isZero(0.0)) {
        const auto turn = Eigen::Quaterniond::FromTwoVectors(format.up, Vector3d::UnitY());
        node["rotation"] = {turn.x(), turn.y(), turn.z(), turn.w()};
        translation = turn * translation;
    }
    node["translation"] = list_of(translation);
    glb.add("nodes", node);
    glb.add("scenes", {{"nodes", json::array({0})}});
    glb.text["scene"] = 0;
}

} // namespace

void require_glb_room(std::uint64_t bytes)
{
    if (bytes <= kMostGlbBytes) return;
    throw UsageError(fmt::format("the mesh needs {} bytes, but binary glTF holds at most {}; "
                                 "write PLY instead",
                                 bytes, kMostGlbBytes));
}

void write_glb(std::ostream& out, const TriMesh& mesh, const MeshFormat& format)
{
    const std::size_t vertex_bytes =
        12 + (mesh.normals.empty() ? 0 : 12) + (mesh.colors.empty() ? 0 : 8);
    const std::size_t number_bytes =
        mesh.positions.size() * vertex_bytes + mesh.faces.size() * sizeof(Face);
    require_glb_room(number_bytes);
    GlbBuilder glb(number_bytes);
    json& asset = glb.text["asset"];
    if (!format.comments.empty()) asset["generator"] = format.comments.front();
    if (!format.comments.empty()) asset["extras"]["comments"] = format.comments;
    if (!format.offset.isZero(0.0)) asset["extras"]["offset"] = list_of(format.offset);
    if (!format.up.isZero(0.0)) asset["extras"]["up"] = list_of(format.up);
    std::optional<UnwrappedMesh> unwrapped;
    if (format.texture != nullptr) unwrapped = unwrap(mesh, *format.texture);
    if (!mesh.faces.empty()) { // glTF does not allow empty meshes
        add_mesh(glb, unwrapped ? unwrapped->mesh : mesh, format,
                 unwrapped ? &*unwrapped : nullptr);
    }
    glb.write(out);
}

} // namespace vcarve
