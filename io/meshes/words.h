#ifndef OBSCURA_IO_MESHES_WORDS_H_
#define OBSCURA_IO_MESHES_WORDS_H_

#include <charconv>
#include <string>
#include <string_view>

namespace obscura::tools {

// Lines of a text that ends them in \n or \r\n, without their ends; an empty text has none.
class Lines {
 public:
  explicit Lines(std::string_view text) : text_(text) {}

  bool next(std::string_view* line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    *line = text_.substr(at_, end - at_);
    if (line->ends_with('\r')) line->remove_suffix(1);
    at_ = std::min(end + 1, text_.size());
    ++number_;
    return true;
  }
  std::size_t position() const { return at_; }    // of the coming line, in bytes
  std::size_t number() const { return number_; }  // of the line given last, from 1

 private:
  std::string_view text_;
  std::size_t at_ = 0, number_ = 0;
};

// Words of a text between white space; "" behind the last.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  std::string_view next() {
    constexpr std::string_view kSpace = " \t\r\n\v\f";
    const std::size_t begin = text_.find_first_not_of(kSpace, at_);
    if (begin == std::string_view::npos) {
      at_ = text_.size();
      return {};
    }
    at_ = std::min(text_.find_first_of(kSpace, begin), text_.size());
    return text_.substr(begin, at_ - begin);
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

// The whole word as a number; a leading + is allowed.
template <class T>
bool parse_number(std::string_view word, T* value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), *value);
  return error == std::errc() && end == word.data() + word.size() && !word.empty();
}

// At most forty characters of a file's own bytes, what is not printable as '?', for messages.
inline std::string printable(std::string_view bytes) {
  constexpr std::size_t kLongest = 40;
  std::string text(bytes.substr(0, kLongest));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return bytes.size() > kLongest ? text + "..." : text;
}

}  // namespace obscura::tools

#endif  // OBSCURA_IO_MESHES_WORDS_H_
