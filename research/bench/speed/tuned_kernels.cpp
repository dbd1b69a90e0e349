#include "research/bench/speed/tuned_kernels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "research/bench/speed/multiversion.hpp"

namespace kinesphere::program {
namespace {

constexpr std::size_t skin_lanes = 16;

struct Skins {
  Frame centres;
  const float* radii_squared;
  std::size_t size;
};

KINESPHERE_INLINE int has_left(const Skins& skins, const Frame& now, std::size_t at) {
  const float x = now.x[at] - skins.centres.x[at];
  const float y = now.y[at] - skins.centres.y[at];
  const float z = now.z[at] - skins.centres.z[at];
  return x * x + y * y + z * z < skins.radii_squared[at] ? 0 : 1;
}

KINESPHERE_INLINE void find_leaving_generic(const Skins& skins, const Frame& now, bool& any_has) {
  std::size_t at = 0;
  int any = 0;
  for (; any == 0 && at + skin_lanes <= skins.size; at += skin_lanes)
    for (std::size_t lane = 0; lane < skin_lanes; ++lane) any |= has_left(skins, now, at + lane);
  for (; at < skins.size; ++at) any |= has_left(skins, now, at);
  any_has = any != 0;
}
KINESPHERE_VERSIONS(find_leaving, (const Skins& skins, const Frame& now, bool& any_has),
                    (skins, now, any_has))

std::string text_of(const StripSettings& settings) {
  return fmt::format("{:.3g} x {:.3g}{}", settings.row_edge, settings.column_edge,
                     settings.order == StripOrder::forward ? "" : " larger first");
}

/// Appends the pairs that touch.
template <class Touch>
void sift(const std::vector<SpherePair>& pairs, std::vector<SpherePair>& touching, Touch touch) {
  for (const SpherePair& pair : pairs)
    if (touch(pair.first, pair.second)) touching.push_back(pair);
}

class GridKernel final : public StepKernel {
 public:
  GridKernel(std::vector<float> radii, const StripSettings& settings, SphereTest test)
      : name_("grid " + text_of(settings)), radii_(std::move(radii)), grid_(settings), test_(test) {}

  std::string name() const override { return name_; }

  void look(const Frame& before, const Frame& now, std::vector<SpherePair>& touching) override {
    if (test_ == SphereTest::at_steps) {
      grid_.find(now, radii_, near_);
      touching.insert(touching.end(), near_.begin(), near_.end());
      return;
    }
    surround_ways(before, now);
    grid_.find({middle_x_.data(), middle_y_.data(), middle_z_.data()}, wide_radii_, near_);
    sift(near_, touching, [&](std::uint32_t a, std::uint32_t b) {
      return touch_between(before, now, radii_[a] + radii_[b], a, b);
    });
  }

  std::size_t bytes() const override {
    return grid_.bytes() + sizeof(float) * (radii_.capacity() + 4 * middle_x_.capacity()) +
           sizeof(SpherePair) * near_.capacity();
  }

 private:
  /// Computes spheres around all places that each sphere passes in the step.
  void surround_ways(const Frame& before, const Frame& now) {
    const std::size_t size = radii_.size();
    for (auto* const array : {&middle_x_, &middle_y_, &middle_z_, &wide_radii_}) array->resize(size);
    for (std::size_t at = 0; at < size; ++at) {
      const float x = 0.5f * (now.x[at] - before.x[at]);
      const float y = 0.5f * (now.y[at] - before.y[at]);
      const float z = 0.5f * (now.z[at] - before.z[at]);
      middle_x_[at] = before.x[at] + x;
      middle_y_[at] = before.y[at] + y;
      middle_z_[at] = before.z[at] + z;
      wide_radii_[at] = 1.0001f * (radii_[at] + std::sqrt(x * x + y * y + z * z));
    }
  }

  std::string name_;
  std::vector<float> radii_;
  StripGrid grid_;
  SphereTest test_;
  std::vector<SpherePair> near_;
  std::vector<float> middle_x_, middle_y_, middle_z_, wide_radii_;  ///< spheres around the ways
};

/// Verlet lists: pairs nearer than the skins of the two spheres are listed, and the list is valid until a
/// sphere has left its skin.
class VerletList {
 public:
  explicit VerletList(const VerletSettings& settings) : grid_(settings.grid), settings_(settings) {}

  /// Makes the list hold all pairs that touch anywhere on the way from `before` to `now`.
  void follow(const Frame& before, const Frame& now, const std::vector<float>& radii);
  const std::vector<SpherePair>& pairs() const { return pairs_; }
  std::size_t bytes() const;

 private:
  bool serves(const Frame& now) const;
  void rebuild(const Frame& before, const Frame& now, const std::vector<float>& radii);

  StripGrid grid_;
  VerletSettings settings_;
  std::vector<float> x_, y_, z_;      ///< places for which the list was made
  std::vector<float> skins_squared_;  ///< by body: squared ways allowed from these places
  std::vector<float> wide_radii_;
  std::vector<SpherePair> pairs_;
};

void VerletList::follow(const Frame& before, const Frame& now, const std::vector<float>& radii) {
  if (x_.empty() || !serves(now)) rebuild(before, now, radii);
}

bool VerletList::serves(const Frame& now) const {
  bool any_has_left = false;
  find_leaving({{x_.data(), y_.data(), z_.data()}, skins_squared_.data(), x_.size()}, now, any_has_left);
  return !any_has_left;
}

/// Rebuilds the list for `now`. The list also holds the pairs that touch on the way from `before`.
void VerletList::rebuild(const Frame& before, const Frame& now, const std::vector<float>& radii) {
  const std::size_t size = radii.size();
  x_.assign(now.x, now.x + size);
  y_.assign(now.y, now.y + size);
  z_.assign(now.z, now.z + size);
  skins_squared_.resize(size);
  wide_radii_.resize(size);
  const float steps = std::max(1.001f, settings_.steps);
  for (std::size_t at = 0; at < size; ++at) {
    const float x = now.x[at] - before.x[at];
    const float y = now.y[at] - before.y[at];
    const float z = now.z[at] - before.z[at];
    const float skin = settings_.skin + steps * std::sqrt(x * x + y * y + z * z);
    skins_squared_[at] = skin * skin;
    wide_radii_[at] = 1.0001f * (radii[at] + skin);
  }
  grid_.find(now, wide_radii_, pairs_);
}

std::size_t VerletList::bytes() const {
  return grid_.bytes() + sizeof(float) * (5 * x_.capacity()) + sizeof(SpherePair) * pairs_.capacity();
}

class VerletKernel final : public StepKernel {
 public:
  VerletKernel(std::vector<float> radii, const VerletSettings& settings, SphereTest test)
      : name_(fmt::format("Verlet skin {:.3g} + {} steps on grid {}", settings.skin, settings.steps,
                          text_of(settings.grid))),
        radii_(std::move(radii)),
        list_(settings),
        test_(test) {}

  std::string name() const override { return name_; }

  void look(const Frame& before, const Frame& now, std::vector<SpherePair>& touching) override {
    list_.follow(before, now, radii_);
    if (test_ == SphereTest::at_steps) {
      sift(list_.pairs(), touching,
           [&](std::uint32_t a, std::uint32_t b) { return touch_at(now, radii_[a] + radii_[b], a, b); });
    } else {
      sift(list_.pairs(), touching, [&](std::uint32_t a, std::uint32_t b) {
        return touch_between(before, now, radii_[a] + radii_[b], a, b);
      });
    }
  }

  std::size_t bytes() const override { return list_.bytes() + sizeof(float) * radii_.capacity(); }

 private:
  std::string name_;
  std::vector<float> radii_;
  VerletList list_;
  SphereTest test_;
};

}  // namespace

std::unique_ptr<StepKernel> make_grid_kernel(std::vector<float> radii, const StripSettings& settings,
                                             SphereTest test) {
  return std::make_unique<GridKernel>(std::move(radii), settings, test);
}

std::unique_ptr<StepKernel> make_verlet_kernel(std::vector<float> radii, const VerletSettings& settings,
                                               SphereTest test) {
  return std::make_unique<VerletKernel>(std::move(radii), settings, test);
}

}  // namespace kinesphere::program
