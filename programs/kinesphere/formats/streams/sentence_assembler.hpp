// Puts the sentences of a message of AIS together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/nmea/ais_message.hpp"
#include "formats/nmea/nmea_line.hpp"
#include "formats/streams/source_report.hpp"

namespace kinesphere::program {

/// Joins sentences that agree in their number, sequence identifier and channel, and in source and group where
/// both have one. They may come in any order, mixed with those of other messages. A message waits for the
/// rest of it while `longest_wait` other sentences come, or seconds of its line's time pass; at most
/// `most_waiting` wait. What is dropped is refused, with the line in which it began.
class SentenceAssembler {
 public:
  struct Message {
    AisBits bits;
    std::optional<TimeField> received;  ///< of the first of its sentences that has a time
  };
  static constexpr std::size_t most_waiting = 64;
  static constexpr std::uint64_t longest_wait = 100;
  static constexpr double longest_wait_seconds = 10.0;

  /// Adds the sentence of a line. Precondition: it has one. Returns the message that it completes.
  std::optional<Message> add(const NmeaLine& line, std::size_t line_number, ReportSink& sink);
  /// Drops all that waits. Call it at the end of the stream.
  void finish(ReportSink& sink);
  /// Returns how many messages wait.
  std::size_t waiting() const { return waiting_.size(); }

  static void serialize(auto& self, auto& archive) {
    auto& [waiting, sentences] = self;
    archive(waiting, sentences);
  }

 private:
  struct Part {
    std::string payload;  ///< empty: it has not come
    std::size_t fill_bits = 0;
  };
  struct Waiting {
    std::size_t count = 0;
    std::string sequence, channel, source, group;
    std::optional<TimeField> received;
    std::uint64_t begun = 0;  ///< number of the sentence
    std::size_t line = 0;
    std::array<Part, 9> parts;
  };

  void drop_old(const NmeaLine& line, ReportSink& sink);
  static void drop(const Waiting& waiting, ReportSink& sink);
  static bool belongs(const NmeaLine& line, const Waiting& waiting);

  std::vector<Waiting> waiting_;  ///< in the order in which they began
  std::uint64_t sentences_ = 0;
};

}  // namespace kinesphere::program
