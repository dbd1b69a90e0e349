// Callsigns and ships' names that came in messages of their own, by the ids of the tracks.
#include "watch/known_names.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "watch/track_names.hpp"

namespace kinesphere::program {

void KnownNames::set(std::string_view id, std::string_view name) {
  name = shown_name(name);
  if (name.empty()) return;
  std::string& kept = recent_[std::string(id)];
  kept = name;
  if (recent_.size() < most) return;
  earlier_ = std::move(recent_);
  recent_.clear();
}

std::string_view KnownNames::name_of(std::string_view id) {
  const std::string key(id);
  if (const auto at = recent_.find(key); at != recent_.end()) return at->second;
  const auto at = earlier_.find(key);
  if (at == earlier_.end()) return {};
  const std::string name = at->second;
  set(id, name);
  const auto kept = recent_.find(key);
  return kept != recent_.end() ? kept->second : earlier_.find(key)->second;
}

nlohmann::json KnownNames::save() const { return {{"recent", recent_}, {"earlier", earlier_}}; }

void KnownNames::restore(const nlohmann::json& state) {
  recent_ = state.at("recent");
  earlier_ = state.at("earlier");
}

}  // namespace kinesphere::program
