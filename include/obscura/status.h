#ifndef OBSCURA_STATUS_H_
#define OBSCURA_STATUS_H_

#include <string>
#include <utility>

namespace obscura {

enum class StatusCode {
  kOk = 0,
  kInvalidArgument,  // a setting is out of range or does not apply
  kInvalidInput,     // the data are unusable: wrong size, NaN where a number is needed, ...
  kUnsupported,      // a valid request that this method or this build cannot serve
  kOutOfMemory,
  kCancelled,  // the progress callback asked to stop
  kInternal,
};

// The outcome of a call. The message is one sentence that names the field and the value that is
// wrong and says what would be right. When a call fails, its outputs are untouched, except after
// kCancelled, when they are unspecified.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(StatusCode code, std::string message) : code_(code), message_(std::move(message)) {}

  bool ok() const { return code_ == StatusCode::kOk; }
  StatusCode code() const { return code_; }
  const std::string& message() const { return message_; }

 private:
  StatusCode code_ = StatusCode::kOk;
  std::string message_;
};

inline Status invalid_argument(std::string message) {
  return {StatusCode::kInvalidArgument, std::move(message)};
}
inline Status invalid_input(std::string message) {
  return {StatusCode::kInvalidInput, std::move(message)};
}
inline Status unsupported(std::string message) {
  return {StatusCode::kUnsupported, std::move(message)};
}

}  // namespace obscura

#endif  // OBSCURA_STATUS_H_
