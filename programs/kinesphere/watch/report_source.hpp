// Where the text of a stream comes from.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace kinesphere::program {

class ReportSource {
 public:
  virtual ~ReportSource() = default;

  enum class Outcome {
    text,   ///< some has come
    quiet,  ///< none has come in time
    end,    ///< there is no more
  };
  /// Waits for text, at most so long or until the program is asked to stop. The text may end anywhere; it is
  /// valid until the next call. Throws ProgramError naming the source.
  virtual Outcome next(std::chrono::milliseconds patience, std::string_view& text) = 0;
  /// For messages.
  virtual std::string name() const = 0;
};

}  // namespace kinesphere::program
