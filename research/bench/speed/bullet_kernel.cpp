// Bullet's dynamic bounding-volume trees as a fixed-step detector.
#include "research/bench/speed/bullet_kernel.hpp"

#ifdef KINESPHERE_WITH_BULLET

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "research/bench/speed/step_kernel.hpp"

namespace kinesphere::program {
namespace {

class BulletKernel final : public StepKernel {
 public:
  BulletKernel(std::vector<float> radii, float margin, bool is_default)
      : name_(fmt::format("margin {:.3g}{}", margin, is_default ? " (the default)" : "")),
        radii_(std::move(radii)),
        margin_(margin) {}

  std::string name() const override { return name_; }

  void look(const Frame&, const Frame& now, std::vector<SpherePair>& touching) override {
    const btScalar others = std::exchange(gDbvtMargin, margin_);
    if (proxies_.empty())
      add_all(now);
    else
      for (std::size_t at = 0; at < radii_.size(); ++at)
        tree_.setAabb(proxies_[at], lower(now, at), upper(now, at), nullptr);
    tree_.calculateOverlappingPairs(nullptr);
    gDbvtMargin = others;
    const btBroadphasePairArray& pairs = tree_.getOverlappingPairCache()->getOverlappingPairArray();
    for (int k = 0; k < pairs.size(); ++k) {
      const std::uint32_t a = number_of(pairs[k].m_pProxy0), b = number_of(pairs[k].m_pProxy1);
      if (touch_at(now, radii_[a] + radii_[b], a, b)) touching.push_back({a, b});
    }
  }

  /// The sum of a node of a tree, a proxy and the pairs; Bullet reports no more.
  std::size_t bytes() const override {
    auto* const pairs = const_cast<btDbvtBroadphase&>(tree_).getOverlappingPairCache();
    return radii_.size() * (2 * sizeof(btDbvtNode) + sizeof(btDbvtProxy)) +
           static_cast<std::size_t>(pairs->getNumOverlappingPairs()) *
               (sizeof(btBroadphasePair) + 2 * sizeof(int));
  }

 private:
  void add_all(const Frame& now) {
    for (std::size_t at = 0; at < radii_.size(); ++at) {
      // NOLINTNEXTLINE(performance-no-int-to-ptr): Bullet keeps a number for us that is a pointer.
      void* const number = reinterpret_cast<void*>(at);
      proxies_.push_back(tree_.createProxy(lower(now, at), upper(now, at), 0, number, 1, 1, nullptr));
    }
  }
  btVector3 lower(const Frame& now, std::size_t at) const {
    const float radius = radii_[at];
    return {now.x[at] - radius, now.y[at] - radius, now.z[at] - radius};
  }
  btVector3 upper(const Frame& now, std::size_t at) const {
    const float radius = radii_[at];
    return {now.x[at] + radius, now.y[at] + radius, now.z[at] + radius};
  }
  static std::uint32_t number_of(const btBroadphaseProxy* proxy) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(proxy->m_clientObject));
  }

  std::string name_;
  std::vector<float> radii_;
  float margin_;
  btDbvtBroadphase tree_;
  std::vector<btBroadphaseProxy*> proxies_;
};

}  // namespace

std::unique_ptr<StepKernel> make_bullet_kernel(std::vector<float> radii, std::optional<float> margin) {
  return std::make_unique<BulletKernel>(std::move(radii), margin.value_or(gDbvtMargin), !margin);
}

}  // namespace kinesphere::program

#else

namespace kinesphere::program {
std::unique_ptr<StepKernel> make_bullet_kernel(std::vector<float>, std::optional<float>) { return nullptr; }
}  // namespace kinesphere::program

#endif
