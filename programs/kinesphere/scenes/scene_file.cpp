// Scenes by name or from JSON files.
#include "scenes/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/input_file.hpp"
#include "base/program_error.hpp"

namespace kinesphere::program {
namespace {

using Json = nlohmann::json;

template <class Names>
std::size_t index_in(const Names& names, std::string_view text, std::string_view where) {
  const auto found = std::find(names.begin(), names.end(), text);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  throw ProgramError(
      fmt::format("{}: expected one of {}, but got '{}'", where, fmt::join(names, ", "), text));
}

/// One field of a scene file, with its line for messages.
struct Field {
  std::string where;
  const Json& value;

  [[noreturn]] void expected(std::string_view what) const {
    std::string got = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (got.size() > 60) got = got.substr(0, 57) + "...";
    throw ProgramError(fmt::format("{}: expected {}, but got {}", where, what, got));
  }
  double number() const { return value.is_number() ? value.get<double>() : (expected("a number"), 0.0); }
  std::uint64_t whole_number(std::uint64_t largest) const {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > largest) {
      expected(fmt::format("a whole number from 0 to {}", largest));
    }
    return value.get<std::uint64_t>();
  }
  bool flag() const { return value.is_boolean() ? value.get<bool>() : (expected("true or false"), false); }
  const std::string& text() const {
    if (!value.is_string()) expected("a text in quotes");
    return value.get_ref<const std::string&>();
  }
  template <std::size_t n>
  std::array<double, n> numbers(const Json& array, std::string_view what) const {
    const auto is_number = [](const Json& element) { return element.is_number(); };
    if (!array.is_array() || array.size() != n || !std::all_of(array.begin(), array.end(), is_number)) {
      expected(what);
    }
    return array.get<std::array<double, n>>();
  }
  void range(double& least, double& largest) const {
    const auto [low, high] = numbers<2>(value, "two numbers [least, largest]");
    least = low;
    largest = high;
  }
  Vec3 vector() const {
    const auto [x, y, z] = numbers<3>(value, "three numbers [x, y, z]");
    return {x, y, z};
  }
  Box box() const {
    constexpr std::string_view what = "two corners [[x, y, z], [x, y, z]]";
    if (!value.is_array() || value.size() != 2) expected(what);
    const auto lower = numbers<3>(value[0], what);
    const auto upper = numbers<3>(value[1], what);
    return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}};
  }
};

struct FieldKind {
  std::string_view name;
  void (*set)(SceneParameters&, const Field&);
};

constexpr FieldKind field_kinds[] = {
    {"name", [](SceneParameters& p, const Field& f) { p.name = f.text(); }},
    {"motion", [](SceneParameters& p, const Field& f) { p.motion = motion_named(f.text(), f.where); }},
    {"bodies",
     [](SceneParameters& p, const Field& f) {
       p.bodies = static_cast<std::uint32_t>(f.whole_number(std::numeric_limits<std::uint32_t>::max()));
     }},
    {"radius", [](SceneParameters& p, const Field& f) { f.range(p.radius_min, p.radius_max); }},
    {"speed", [](SceneParameters& p, const Field& f) { f.range(p.speed_min, p.speed_max); }},
    {"limit", [](SceneParameters& p, const Field& f) { f.range(p.limit_min, p.limit_max); }},
    {"gravity", [](SceneParameters& p, const Field& f) { p.gravity = f.vector(); }},
    {"box", [](SceneParameters& p, const Field& f) { p.box = f.box(); }},
    {"packing", [](SceneParameters& p, const Field& f) { p.packing = f.number(); }},
    {"periodic", [](SceneParameters& p, const Field& f) { p.periodic = f.flag(); }},
    {"walls", [](SceneParameters& p, const Field& f) { p.walls = f.flag(); }},
    {"redraw_interval", [](SceneParameters& p, const Field& f) { p.redraw_interval = f.number(); }},
    {"response", [](SceneParameters& p, const Field& f) { p.response = response_named(f.text(), f.where); }},
    {"restitution", [](SceneParameters& p, const Field& f) { p.restitution = f.number(); }},
    {"resting_speed", [](SceneParameters& p, const Field& f) { p.resting_speed = f.number(); }},
    {"contact_tolerance", [](SceneParameters& p, const Field& f) { p.contact_tolerance = f.number(); }},
    {"zeno_interval", [](SceneParameters& p, const Field& f) { p.zeno_interval = f.number(); }},
    {"seconds", [](SceneParameters& p, const Field& f) { p.seconds = f.number(); }},
    {"seed", [](SceneParameters& p,
                const Field& f) { p.seed = f.whole_number(std::numeric_limits<std::uint64_t>::max()); }},
};

/// Nested brackets; more than any field of a scene needs.
constexpr int deepest_nesting = 16;

/// Passes characters to the JSON parser, which does not report where a value stands, and counts lines.
struct CountingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at;
  int* line;

  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    if (*at++ == '\n') ++*line;
    return *this;
  }
  CountingIterator operator++(int) {
    const CountingIterator before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) { return a.at == b.at; }
};

/// Returns the parser's message without its error number and column count.
std::string reason_of(const Json::exception& error) {
  std::string reason = error.what();
  for (std::string_view end_of_prefix : {"] ", "column "}) {
    const std::size_t found = reason.find(end_of_prefix);
    if (found != std::string::npos) reason.erase(0, found + end_of_prefix.size());
  }
  const std::size_t colon = reason.find(": ");
  return colon == std::string::npos ? reason : reason.substr(colon + 2);
}

Json parse_json(std::string_view text, SceneSource& source) {
  int line = 1;
  int field_line = 1;
  const auto note_field = [&](int depth, Json::parse_event_t event, Json& parsed) {
    // Walking through nested values, also in their destructor, is recursive.
    if (depth > deepest_nesting)
      throw ProgramError(fmt::format("{}:{}: expected at most {} brackets within each other", source.file,
                                     line, deepest_nesting));
    if (depth == 1 && event == Json::parse_event_t::key) {
      field_line = line;
      const auto [place, is_new] = source.lines.emplace(parsed.get<std::string>(), line);
      if (!is_new) {
        throw ProgramError(fmt::format("{}:{}: expected each field once, but '{}' is in line {} already",
                                       source.file, line, place->first, place->second));
      }
    }
    return true;
  };
  const char* const end = text.data() + text.size();
  try {
    return Json::parse(CountingIterator{text.data(), &line}, CountingIterator{end, &line}, note_field);
  } catch (const Json::parse_error& error) {
    const auto stop = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte - 1, text.size()));
    const auto lines_before = std::count(text.begin(), stop, '\n');
    throw ProgramError(
        fmt::format("{}:{}: expected JSON: {}", source.file, lines_before + 1, reason_of(error)));
  } catch (const Json::exception& error) {
    throw ProgramError(fmt::format("{}:{}: expected JSON: {}", source.file, field_line, reason_of(error)));
  }
}

std::string joined_names(const std::vector<std::string_view>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

SceneSource parse_scene(std::string_view text, const std::string& file) {
  SceneSource source;
  source.file = file;
  const Json json = parse_json(text, source);
  if (!json.is_object()) throw ProgramError(fmt::format("{}:1: expected a scene {{...}}", file));
  for (const auto& [name, line] : source.lines) {
    const std::string where = fmt::format("{}:{}: '{}'", file, line, name);
    const auto kind =
        std::find_if(std::begin(field_kinds), std::end(field_kinds),
                     [&, key = std::string_view(name)](const FieldKind& k) { return k.name == key; });
    if (kind == std::end(field_kinds)) {
      std::vector<std::string_view> names;
      for (const FieldKind& known : field_kinds) names.push_back(known.name);
      throw ProgramError(fmt::format("{} is no field: expected one of {}", where, joined_names(names)));
    }
    kind->set(source.parameters, {where, json.at(name)});
  }
  return source;
}

SceneSource find_scene(const std::string& name_or_file) {
  std::vector<std::string_view> names;
  for (const SceneParameters& scene : built_in_scenes()) {
    if (scene.name == name_or_file) return {scene, "", {}};
    names.push_back(scene.name);
  }
  if (!std::filesystem::exists(name_or_file)) {
    throw ProgramError(
        fmt::format("'{}' is neither a file nor a built-in scene: expected a JSON file or one of {}",
                    name_or_file, joined_names(names)));
  }
  return parse_scene(read_input(name_or_file), name_or_file);
}

Scene make_scene(const SceneSource& source) {
  Result<Scene> scene = kinesphere::make_scene(source.parameters);
  if (scene) return std::move(scene).value();
  const Error& error = scene.error();
  // radius_min and radius_max are both given by the field "radius"; other pairs likewise.
  for (const auto& [name, line] : source.lines) {
    if (error.argument.starts_with(name)) {
      throw ProgramError(fmt::format("{}:{}: {}", source.file, line, message_of(error)));
    }
  }
  throw ProgramError(message_of(error));
}

std::string_view name_of(SceneParameters::MotionKind motion) {
  return motion_names.at(static_cast<std::size_t>(motion));
}

std::string_view name_of(SceneResponse response) {
  return response_names.at(static_cast<std::size_t>(response));
}

SceneParameters::MotionKind motion_named(std::string_view text, std::string_view where) {
  return static_cast<SceneParameters::MotionKind>(index_in(motion_names, text, where));
}

SceneResponse response_named(std::string_view text, std::string_view where) {
  return static_cast<SceneResponse>(index_in(response_names, text, where));
}

}  // namespace kinesphere::program
