// glTF 2.0, https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html; the numbers are its own.
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
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Json = nlohmann::json;

constexpr std::uint64_t kMostBytes = 0xffffffffU - 0x10000U; ///< leaves room for the JSON text
constexpr std::uint32_t kMagic = 0x46546c67;                 // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;             // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004e4942;
constexpr int kFloat = 5126;
constexpr int kUnsignedShort = 5123;
constexpr int kUnsignedInt = 5125;
constexpr int kVertexData = 34962;
constexpr int kIndexData = 34963;

std::uint64_t buffer_bytes(const TriMesh& mesh)
{
    std::uint64_t vertex_bytes = 3 * sizeof(float);
    if (!mesh.normals.empty()) vertex_bytes += 3 * sizeof(float);
    if (!mesh.colors.empty()) vertex_bytes += 4 * sizeof(std::uint16_t);
    return mesh.positions.size() * vertex_bytes + mesh.faces.size() * sizeof(Face);
}

/// A document with one buffer. All its views have multiples of four bytes, so each is aligned.
struct Document {
    Json json;
    std::string bytes;

    template <typename Number>
    void put(Number number)
    {
        const auto little = little_endian(number);
        bytes.append(little.begin(), little.end());
    }

    /// Appends to an array of the document; returns the new element's index.
    std::size_t add(const char* array, Json element)
    {
        json[array].push_back(std::move(element));
        return json[array].size() - 1;
    }

    /// Adds a view of the bytes from `begin` on.
    std::size_t add_view(std::size_t begin, std::optional<int> target)
    {
        Json view = {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes.size() - begin}};
        if (target) view["target"] = *target;
        bytes.resize((bytes.size() + 3) / 4 * 4);
        return add("bufferViews", std::move(view));
    }

    /// Adds `count` elements, which `put_all` appends to the bytes.
    std::size_t add_accessor(Json accessor, std::size_t count, int target, const auto& put_all)
    {
        const std::size_t begin = bytes.size();
        put_all();
        accessor["bufferView"] = add_view(begin, target);
        accessor["count"] = count;
        return add("accessors", std::move(accessor));
    }

    std::size_t add_floats(const char* type, const auto& elements)
    {
        const Json accessor = {{"componentType", kFloat}, {"type", type}};
        return add_accessor(accessor, elements.size(), kVertexData, [&] {
            for (const auto& element : elements) {
                for (const float number : element) {
                    put(number);
                }
            }
        });
    }
};

/// Colours of photographs are sRGB, those of vertices in glTF are linear. With 16 bits all 256
/// values of a channel stay apart.
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

/// float32, relative to `center`, with the bounding box that glTF requires.
std::size_t add_positions(Document& document, const TriMesh& mesh, const Vector3d& center)
{
    std::vector<Vector3f> rounded;
    rounded.reserve(mesh.positions.size());
    Eigen::AlignedBox3f box;
    for (const Vector3d& position : mesh.positions) {
        rounded.emplace_back((position - center).cast<float>());
        box.extend(rounded.back());
    }
    const std::size_t index = document.add_floats("VEC3", rounded);
    Json& accessor = document.json["accessors"][index];
    accessor["min"] = std::vector<float>(box.min().begin(), box.min().end());
    accessor["max"] = std::vector<float>(box.max().begin(), box.max().end());
    return index;
}

/// Normals must have length 1, so a vertex without a normal gets (0, 0, 1).
std::size_t add_normals(Document& document, std::vector<Vector3f> normals)
{
    for (Vector3f& normal : normals) {
        if (normal.isZero()) normal = Vector3f::UnitZ();
    }
    return document.add_floats("VEC3", normals);
}

std::size_t add_colors(Document& document, const std::vector<Color>& colors)
{
    const Json accessor = {
        {"componentType", kUnsignedShort}, {"type", "VEC4"}, {"normalized", true}};
    return document.add_accessor(accessor, colors.size(), kVertexData, [&] {
        const auto linear = linear_values();
        for (const Color& color : colors) {
            for (const std::uint8_t channel : color) {
                document.put(linear[channel]);
            }
            document.put(std::uint16_t{0xffff}); // opaque
        }
    });
}

std::size_t add_indices(Document& document, std::span<const Face> faces)
{
    const Json accessor = {{"componentType", kUnsignedInt}, {"type", "SCALAR"}};
    return document.add_accessor(accessor, 3 * faces.size(), kIndexData, [&] {
        for (const Face& face : faces) {
            for (const std::uint32_t vertex : face) {
                document.put(vertex);
            }
        }
    });
}

/// Matt and double-sided; glTF's default is metal that shows its front only.
Json matt()
{
    Json material;
    material["pbrMetallicRoughness"]["metallicFactor"] = 0.0;
    material["doubleSided"] = true;
    return material;
}

/// {"offset": [x, y, z], "up": [x, y, z], "comments": []}, as far as the format has them.
Json extras_json(const MeshFormat& format)
{
    const auto numbers = [](const Vector3d& v) { return std::vector<double>(v.begin(), v.end()); };
    Json extras;
    if (!format.offset.isZero(0.0)) extras[std::string(kOffsetWord)] = numbers(format.offset);
    if (!format.up.isZero(0.0)) extras["up"] = numbers(format.up);
    if (!format.comments.empty()) extras["comments"] = format.comments;
    return extras;
}

/// Adds a matt material with this image, which is stored in the file.
std::size_t add_page(Document& document, const Photograph& page)
{
    const std::size_t begin = document.bytes.size();
    const auto encoded = encode_jpeg(page, kTextureQuality);
    document.bytes.append(encoded.begin(), encoded.end());
    const std::size_t view = document.add_view(begin, std::nullopt);
    const std::size_t image =
        document.add("images", {{"bufferView", view}, {"mimeType", "image/jpeg"}});
    if (image == 0) {
        document.add("samplers", {{"magFilter", 9729}, // linear
                                  {"minFilter", 9987}, // linear, between levels, too
                                  {"wrapS", 33071},    // clamp to edge
                                  {"wrapT", 33071}});
    }
    const std::size_t texture = document.add("textures", {{"sampler", 0}, {"source", image}});
    Json material = matt();
    material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = texture;
    return document.add("materials", std::move(material));
}

/// Adds a primitive for each texture page, or one if there is no texture.
void add_primitives(Document& document, const TriMesh& mesh, Json attributes,
                    const MeshFormat& format, const UnwrappedMesh* unwrapped)
{
    Json& primitives = document.json["meshes"][0]["primitives"];
    const auto add = [&](std::span<const Face> faces, std::size_t material) {
        const std::size_t indices = add_indices(document, faces);
        primitives.push_back({{"attributes", attributes},
                              {"indices", indices},
                              {"material", material},
                              {"mode", 4}}); // triangles
    };
    if (unwrapped == nullptr) {
        add(mesh.faces, document.add("materials", matt()));
        return;
    }
    attributes["TEXCOORD_0"] = document.add_floats("VEC2", unwrapped->places);
    for (std::size_t page = 0; page < format.texture->pages.size(); ++page) {
        const std::size_t first = unwrapped->begins[page];
        add(std::span(mesh.faces).subspan(first, unwrapped->begins[page + 1] - first),
            add_page(document, format.texture->pages[page]));
    }
}

/// One mesh in one node, which moves the mesh back to its place minus the offset and turns it
/// upright.
void add_mesh(Document& document, const TriMesh& mesh, const MeshFormat& format,
              const UnwrappedMesh* unwrapped)
{
    Eigen::AlignedBox3d box;
    for (const Vector3d& position : mesh.positions) {
        box.extend(position);
    }
    const Vector3d center = box.center();
    Json attributes;
    attributes["POSITION"] = add_positions(document, mesh, center);
    if (!mesh.normals.empty()) attributes["NORMAL"] = add_normals(document, mesh.normals);
    if (!mesh.colors.empty()) attributes["COLOR_0"] = add_colors(document, mesh.colors);
    add_primitives(document, mesh, std::move(attributes), format, unwrapped);
    Json& node = document.json["nodes"][0];
    node["mesh"] = 0;
    Vector3d translation = mesh.offset - format.offset + center;
    if (!format.up.isZero(0.0)) {
        const auto turn = Eigen::Quaterniond::FromTwoVectors(format.up, Vector3d::UnitY());
        node["rotation"] = std::vector<double>{turn.x(), turn.y(), turn.z(), turn.w()};
        translation = turn * translation;
    }
    node["translation"] = std::vector<double>(translation.begin(), translation.end());
    document.json["scenes"][0]["nodes"] = Json::array({0});
    document.json["scene"] = 0;
    document.json["buffers"][0]["byteLength"] = document.bytes.size();
}

void write_number(std::ostream& out, std::uint64_t number)
{
    const auto bytes = little_endian(static_cast<std::uint32_t>(number));
    out.write(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

void write_chunk(std::ostream& out, std::uint32_t kind, const std::string& bytes)
{
    write_number(out, bytes.size());
    write_number(out, kind);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

} // namespace

void require_glb_room(std::uint64_t bytes)
{
    if (bytes <= kMostBytes) return;
    throw UsageError(fmt::format("the surface takes {} bytes, and binary glTF holds at most {}; "
                                 "PLY holds more",
                                 bytes, kMostBytes));
}

void write_glb(std::ostream& out, const TriMesh& mesh, const MeshFormat& format)
{
    require_glb_room(buffer_bytes(mesh));
    Document document;
    document.bytes.reserve(buffer_bytes(mesh));
    Json& asset = document.json["asset"];
    asset["version"] = "2.0";
    if (!format.comments.empty()) asset["generator"] = format.comments.front();
    if (Json extras = extras_json(format); !extras.empty()) asset["extras"] = std::move(extras);
    if (!mesh.faces.empty()) { // glTF has no empty buffers, meshes or scenes
        std::optional<UnwrappedMesh> unwrapped;
        if (format.texture != nullptr) unwrapped = unwrap(mesh, *format.texture);
        add_mesh(document, unwrapped ? unwrapped->mesh : mesh, format,
                 unwrapped ? &*unwrapped : nullptr);
    }
    std::string text = document.json.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t binary = document.bytes.empty() ? 0 : 8 + document.bytes.size();
    write_number(out, kMagic);
    write_number(out, 2);
    write_number(out, 12 + 8 + text.size() + binary);
    write_chunk(out, kJsonChunk, text);
    if (binary > 0) write_chunk(out, kBinaryChunk, document.bytes);
}

} // namespace vcarve
