// Feeds any bytes to the decoder of AIS, for fuzz_nmea and for a test with random bytes.
#include "program/formats/ais/any_sentences.hpp"

#include <algorithm>
#include <cmath>

#include "formats/nmea/ais_message.hpp"
#include "formats/streams/report_format.hpp"

namespace kinesphere::program {
namespace {

class NoReports final : public ReportSink {
 public:
  void take(const SourceReport&) override {}
  void time_is(const FileTime&, TimeKind) override {}
  void pass_over(Passed) override {}
  void refuse(std::size_t, const std::string&) override {}
};

bool is_within(const std::optional<double>& value, double least, double most) {
  return !value || (*value >= least && *value <= most);
}

std::optional<std::string> defect_of(const AisMessage& message) {
  if (message.mmsi == 0 || message.mmsi > 999'999'999) return "an MMSI of no station";
  if (const auto& p = message.position) {
    if (!is_within(p->longitude, -180.0, 180.0) || !is_within(p->latitude, -90.0, 90.0))
      return "a place off the earth";
    if (!is_within(p->speed, 0.0, 1021.0) || !is_within(p->course, 0.0, 359.9))
      return "a speed or course off its range";
    if (p->second && (*p->second < 0 || *p->second > 59)) return "a second off the minute";
  }
  const double radius = message.dimensions ? message.dimensions->radius() : 0.0;
  if (!(radius >= 0.0 && radius < 520.0)) return "a ship of a wrong size";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> AnySentences::complaint(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (auto defect = complaint_of_line(line)) return defect;
  }
  ByteWriter state, again;
  state(assembler_);
  SentenceAssembler restored;
  ByteReader reader(state.bytes());
  reader(restored);
  again(restored);
  if (reader.failed() || !std::ranges::equal(again.bytes(), state.bytes()))
    return "another state after it was restored";
  if (assembler_.waiting() > SentenceAssembler::most_waiting) return "more messages wait than may";
  return std::nullopt;
}

std::optional<std::string> AnySentences::complaint_of_line(std::string_view line) {
  looks_like_nmea(line);
  NoReports sink;
  try {
    const NmeaLine read = parse_nmea_line(line);
    if (read.received && !(read.received->time.fraction >= 0.0 && read.received->time.fraction < 1.0))
      return "a time that is not in order";
    if (!read.sentence) return std::nullopt;
    const auto whole = assembler_.add(read, ++lines_, sink);
    if (!whole) return std::nullopt;
    if (whole->bits.size() > 9 * 6 * longest_ais_payload) return "a message of too many bits";
    const auto message = ais_message_of(whole->bits);
    if (!message) return std::nullopt;
    ++messages_;
    return defect_of(*message);
  } catch (const MalformedRecord&) {
    return std::nullopt;
  }
}

}  // namespace kinesphere::program
