#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vcarve {

/// A new folder for one test. The destructor removes it and its content.
class TemporaryFolder {
  public:
    TemporaryFolder()
    {
        std::string pattern = (std::filesystem::temp_directory_path() / "vcarve-XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path_ = pattern;
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    /// Writes a file and creates its parent folders; returns its path.
    std::filesystem::path write(const std::string& name, std::string_view bytes) const
    {
        const std::filesystem::path path = path_ / name;
        std::filesystem::create_directories(path.parent_path());
        // Remove first: some file systems wait for the disk when a file is truncated and rewritten.
        std::filesystem::remove(path);
        std::ofstream file(path, std::ios::binary);
        file << bytes;
        return path;
    }

    /// Copies a folder and its content.
    void copy(const std::filesystem::path& from, const std::string& name) const
    {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::filesystem::copy(from, path_ / name, std::filesystem::copy_options::recursive);
    }

    std::size_t num_entries() const
    {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(path_), {}));
    }

  private:
    std::filesystem::path path_;
};

inline std::string bytes_of(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The message of the Expected that `action` throws, or a description of what it did instead.
template <typename Expected, typename Action>
std::string refusal(const Action& action)
{
    try {
        action();
    } catch (const Expected& error) {
        return error.what();
    } catch (const std::exception& error) {
        return std::string("another exception: ") + error.what();
    }
    return "no exception";
}

} // namespace vcarve
