#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace vcarve {

/// Makes `text` safe for messages: truncates it to 60 bytes and replaces control characters.
std::string printable(std::string_view text);

/// A cursor over the words of a text file, line by line. Lines end in LF or CR LF. Blanks and tabs
/// separate words. Lines that begin with # are comments. Numbers are parsed in the C locale. Errors
/// throw InputError with the file and the line; `what` names the expected data in the message.
class TextReader {
  public:
    /// `bytes` must outlive the reader. `name` is the file name in messages.
    TextReader(std::span<const char> bytes, std::string name);

    /// Advances to the next line that is not a comment; it may be blank. Returns false at the end.
    bool next_line();
    /// Advances to the next line that is neither comment nor blank. Returns false at the end.
    bool next_record();

    /// The number of bytes read so far, including all of the current line.
    std::size_t offset() const { return size_ - unread_.size(); }
    /// The fraction of the file that was read, 0 to 1.
    double share_read() const
    {
        return 1.0 - static_cast<double>(unread_.size()) / static_cast<double>(size_);
    }

    /// Skips blanks; returns whether no word of the line remains.
    bool at_line_end();
    /// The rest of the line, without leading and trailing blanks.
    std::string_view rest();

    std::string_view read_word(const char* what);
    double read_double(const char* what);
    std::uint8_t read_uint8(const char* what);
    std::uint32_t read_uint32(const char* what);
    std::uint64_t read_uint64(const char* what);
    /// The same, but a negative number means none and becomes the maximum of the type.
    std::uint32_t read_uint32_or_none(const char* what);
    std::uint64_t read_uint64_or_none(const char* what);

    /// Throws InputError with "NAME: line N: sentence".
    [[noreturn]] void fail(const std::string& sentence) const;

  private:
    template <typename T>
    T read_number(const char* what, const char* kind);
    bool take_none();

    std::string_view unread_; ///< the file after the current line
    std::string_view line_;   ///< the rest of the current line
    std::size_t size_;
    std::size_t line_number_ = 0;
    std::string name_;
};

} // namespace vcarve
