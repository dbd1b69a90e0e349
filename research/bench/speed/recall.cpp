#include "research/bench/speed/recall.hpp"

#include <tuple>

#include "research/bench/speed/step_recording.hpp"

namespace kinesphere::program {

ContactCounts contacts_at_steps(const Scene& scene, double step, std::size_t steps, SphereTest test) {
  ContactCounts seen;
  std::map<ContactCounts::key_type, std::size_t> last_touch;
  record_steps(scene, step, steps, test,
               [&](std::size_t number, std::uint32_t first, std::uint32_t second, Wall wall) {
                 const ContactCounts::key_type pair{first, second, wall};
                 const auto [last, is_new] = last_touch.try_emplace(pair, number);
                 if (is_new || last->second + 1 < number) ++seen[pair];
                 last->second = number;
               });
  return seen;
}

}  // namespace kinesphere::program
