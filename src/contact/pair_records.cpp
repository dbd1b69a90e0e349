#include "contact/pair_records.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {

const PairRecord* PairRecords::find(std::uint32_t a, std::uint32_t b) const {
  const auto records = of(a);
  const auto found =
      std::find_if(records.begin(), records.end(), [=](const auto& each) { return each.partner == b; });
  return found != records.end() ? &*found : nullptr;
}

bool PairRecords::has_turned(std::uint32_t body) const {
  const auto records = of(body);
  return std::any_of(records.begin(), records.end(), [](const auto& each) { return each.is_turned(); });
}

void PairRecords::set_state(std::uint32_t a, std::uint32_t b, std::int32_t state) {
  const PairRecord* const known = find(a, b);
  PairRecord record = known != nullptr ? *known : PairRecord{};
  record.state = state;
  keep(a, b, record);
}

void PairRecords::set_turned(std::uint32_t a, std::uint32_t b, std::optional<double> distance) {
  const PairRecord* const known = find(a, b);
  if (known == nullptr && !distance) return;
  PairRecord record = known != nullptr ? *known : PairRecord{};
  record.turned_at = distance.value_or(-1.0);
  keep(a, b, record);
}

void PairRecords::forget_turns(std::uint32_t body) {
  const std::vector<PairRecord> records(of(body).begin(), of(body).end());
  for (const PairRecord& record : records) set_turned(body, record.partner, std::nullopt);
}

void PairRecords::forget(std::uint32_t body) {
  const std::vector<PairRecord> records(of(body).begin(), of(body).end());
  for (const PairRecord& record : records) keep(body, record.partner, PairRecord{});
}

void PairRecords::keep(std::uint32_t a, std::uint32_t b, const PairRecord& record) {
  keep_half(a, {b, record.state, record.turned_at});
  keep_half(b, {a, record.state, record.turned_at});
}

void PairRecords::keep_half(std::uint32_t body, const PairRecord& record) {
  const bool is_empty = record.state == 0 && !record.is_turned();
  if (body >= lists_.size()) {
    if (is_empty) return;
    lists_.resize(body + std::size_t{1});
  }
  std::vector<PairRecord>& list = lists_[body];
  const auto place = std::find_if(list.begin(), list.end(),
                                  [&](const PairRecord& each) { return each.partner == record.partner; });
  if (is_empty) {
    if (place != list.end()) list.erase(place);
  } else if (place != list.end()) {
    *place = record;
  } else {
    list.push_back(record);
  }
}

bool PairRecords::is_valid(std::size_t bodies) const {
  if (lists_.size() > bodies) return false;
  for (std::uint32_t body = 0; body < lists_.size(); ++body) {
    for (const PairRecord& record : lists_[body]) {
      if (record.partner == body || (record.state == 0 && !record.is_turned())) return false;
      if (std::isnan(record.turned_at)) return false;
      if (find(body, record.partner) != &record) return false;  // it is there twice
      const PairRecord* const back = find(record.partner, body);
      if (back == nullptr || back->state != record.state || back->turned_at != record.turned_at) return false;
    }
  }
  return true;
}

}  // namespace kinesphere
