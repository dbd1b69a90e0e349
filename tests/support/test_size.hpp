// How much random tests do: less in each run, and more at one's wish.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace kinesphere {

/// Returns how many rounds a random test goes that takes seconds for `all`: a quarter, or all of them if the
/// environment variable KINESPHERE_ROUNDS is `all`, as in scripts/test.sh --all and scripts/mutants.sh.
template <class Count>
Count rounds_of(Count all) {
  const char* const wanted = std::getenv("KINESPHERE_ROUNDS");
  return wanted != nullptr && std::string_view(wanted) == "all" ? all : (all + 3) / 4;
}

/// Returns each kind with its own seed and, if the environment variable KINESPHERE_SCENES is a number above
/// 1, with as many seeds. No two scenes have the same seed if the kinds have the seeds 1, 2, 3 and so on.
template <class Kind>
std::vector<Kind> scenes_of_each(const std::vector<Kind>& kinds) {
  const char* const wanted = std::getenv("KINESPHERE_SCENES");
  const std::uint64_t count = wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : 1;
  std::vector<Kind> scenes = kinds;
  for (std::uint64_t round = 1; round < count; ++round)
    for (Kind kind : kinds) {
      kind.seed += round * kinds.size();
      scenes.push_back(kind);
    }
  return scenes;
}

}  // namespace kinesphere
