// Puts the sentences of a message of AIS together.
#include "formats/streams/sentence_assembler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace kinesphere::program {
namespace {

bool agree_if_known(std::string_view a, std::string_view b) { return a.empty() || b.empty() || a == b; }

}  // namespace

bool SentenceAssembler::belongs(const NmeaLine& line, const Waiting& waiting) {
  const AisSentence& sentence = *line.sentence;
  return sentence.count == waiting.count && sentence.sequence == waiting.sequence &&
         sentence.channel == waiting.channel && agree_if_known(line.source, waiting.source) &&
         agree_if_known(line.group, waiting.group);
}

void SentenceAssembler::drop(const Waiting& waiting, ReportSink& sink) {
  const auto is_there = [](const Part& part) { return !part.payload.empty(); };
  sink.refuse(waiting.line, fmt::format("expected {} sentences of a message, but only {} of them came",
                                        waiting.count, std::ranges::count_if(waiting.parts, is_there)));
}

void SentenceAssembler::drop_old(const NmeaLine& line, ReportSink& sink) {
  std::erase_if(waiting_, [&](const Waiting& waiting) {
    const bool is_old =
        sentences_ - waiting.begun > longest_wait ||
        (line.received && waiting.received &&
         std::abs(seconds_between(waiting.received->time, line.received->time)) > longest_wait_seconds);
    if (is_old) drop(waiting, sink);
    return is_old;
  });
}

std::optional<SentenceAssembler::Message> SentenceAssembler::add(const NmeaLine& line,
                                                                 std::size_t line_number, ReportSink& sink) {
  const AisSentence& sentence = *line.sentence;
  ++sentences_;
  drop_old(line, sink);
  Message message{.bits = {}, .received = line.received};
  if (sentence.count == 1) {
    message.bits.append(sentence.payload, sentence.fill_bits);
    return message;
  }
  auto at = std::ranges::find_if(waiting_, [&](const Waiting& each) { return belongs(line, each); });
  if (at != waiting_.end()) {
    const Part& same = at->parts[sentence.number - 1];
    if (same.payload == sentence.payload) return std::nullopt;
    // Sequence identifiers come again after ten messages: this is another one.
    if (!same.payload.empty()) {
      drop(*at, sink);
      waiting_.erase(at);
      at = waiting_.end();
    }
  }
  if (at == waiting_.end()) {
    if (waiting_.size() == most_waiting) {
      drop(waiting_.front(), sink);
      waiting_.erase(waiting_.begin());
    }
    waiting_.push_back({.count = sentence.count,
                        .sequence = std::string(sentence.sequence),
                        .channel = std::string(sentence.channel),
                        .source = std::string(line.source),
                        .group = std::string(line.group),
                        .received = line.received,
                        .begun = sentences_,
                        .line = line_number,
                        .parts = {}});
    at = waiting_.end() - 1;
  }
  at->parts[sentence.number - 1] = {std::string(sentence.payload), sentence.fill_bits};
  if (!at->received) at->received = line.received;
  const auto parts = std::span(at->parts).first(at->count);
  if (std::ranges::any_of(parts, [](const Part& part) { return part.payload.empty(); })) return std::nullopt;
  const Waiting whole = std::move(*at);
  waiting_.erase(at);
  message.received = whole.received;
  for (const Part& part : std::span(whole.parts).first(whole.count))
    message.bits.append(part.payload, part.fill_bits);
  return message;
}

void SentenceAssembler::finish(ReportSink& sink) {
  for (const Waiting& waiting : waiting_) drop(waiting, sink);
  waiting_.clear();
}

}  // namespace kinesphere::program
