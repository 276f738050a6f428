#pragma once

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <streambuf>
#include <string_view>
#include <vector>

namespace vcarve {

/// Where the file `path` is written until it is whole: "OUT.ply.part-PID" beside it, so that the
/// final rename stays within one file system. The name does not change while the process lives, so
/// a signal handler can be told in advance what to unlink.
std::filesystem::path part_path(const std::filesystem::path& path);

/// Throws UsageError, one sentence, where `path` could not be written: an empty path, a folder, a
/// folder that does not exist or takes no new file, a protected file. Leaves nothing behind.
void require_writable(const std::filesystem::path& path);

/// Writes to the standard output. Throws UsageError where that takes not all of it.
void print(std::string_view text);

/// A file that appears whole or not at all: what is streamed goes to part_path(path), commit()
/// renames it, and without a commit the destructor removes it. A file that is replaced passes on
/// its permissions. A character device (/dev/null, /dev/stdout) cannot be replaced and is written
/// straight. One object a path at a time.
class OutputFile {
  public:
    /// Throws UsageError as require_writable does.
    explicit OutputFile(std::filesystem::path path);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile();

    std::ostream& stream() { return stream_; }

    /// Makes sure that every byte is on the disk, then renames. Throws UsageError where the disk is
    /// full or anything went wrong while writing; nothing is left behind then. Call it once, last.
    void commit();

  private:
    /// Bytes on their way to a file descriptor; remembers the first error.
    class Sink : public std::streambuf {
      public:
        Sink();
        void write_to(int descriptor) { descriptor_ = descriptor; }
        int error() const { return error_; }
        bool flush();

      protected:
        int_type overflow(int_type byte) override;
        std::streamsize xsputn(const char* bytes, std::streamsize count) override;
        int sync() override { return flush() ? 0 : -1; }

      private:
        bool write_all(const char* bytes, std::size_t count);

        int descriptor_ = -1;
        int error_ = 0;
        std::vector<char> buffer_;
    };

    std::filesystem::path path_;   ///< as the user wrote it, for messages
    std::filesystem::path target_; ///< what is replaced: symbolic links followed
    std::filesystem::path part_;   ///< empty where the target is written straight
    Sink sink_;
    std::ostream stream_;
    int descriptor_; ///< opened last, so that memory which runs out before leaves no part
};

} // namespace vcarve
