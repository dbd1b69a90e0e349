// Where the text of a stream comes from.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "tracks/time_text.hpp"

namespace kinesphere::program {

/// How far a stream has been read.
struct StreamPlace {
  std::string stream;          ///< its name
  std::uint64_t position = 0;  ///< in it: bytes, as they are when unpacked, or messages
  std::uint32_t check = 0;     ///< of which stream this is, where it can be read again; else 0
};

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
  /// How far it has been handed over, without so many bytes at the end, as StreamPlace counts: of messages up
  /// to the last one.
  virtual std::uint64_t position(std::size_t without) const = 0;
  /// The same, for a later run to go on from.
  virtual StreamPlace place(std::size_t without) const = 0;
  /// The same for all who read this stream from its begin, whenever they do. None where what has been read
  /// cannot be read again: a later run goes on with what comes then.
  virtual std::optional<std::string> identity() const = 0;
  /// Whether no record goes on in the next text.
  virtual bool has_whole_records() const { return false; }
  /// Whether it says itself when texts come in: then all that read it go by the same clock.
  virtual bool has_clock() const { return false; }
  /// By that clock: when the last text came in.
  virtual FileTime arrival() const { return {}; }
  /// For messages.
  virtual std::string name() const = 0;
};

}  // namespace kinesphere::program
