// FCL's dynamic tree of boxes as a fixed-step detector.
#include "bench/speed/tree_kernels.hpp"

#ifdef KINESPHERE_WITH_FCL

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>

#include <utility>

#include "bench/speed/touch.hpp"

namespace kinesphere::program {
namespace {

using Object = fcl::CollisionObjectd;

class FclKernel final : public StepKernel {
 public:
  explicit FclKernel(std::vector<float> radii) : radii_(std::move(radii)) {}

  std::string name() const override { return "dynamic tree"; }

  void look(const Frame&, const Frame& now, std::vector<SpherePair>& touching) override {
    const bool first = objects_.empty();
    if (first) make_objects();
    for (std::size_t at = 0; at < radii_.size(); ++at) {
      objects_[at]->setTranslation(fcl::Vector3d(now.x[at], now.y[at], now.z[at]));
      objects_[at]->computeAABB();
      if (first) manager_.registerObject(objects_[at].get());
    }
    if (first)
      manager_.setup();
    else
      manager_.update();
    Search search{radii_, now, touching};
    manager_.collide(&search, note);
  }

  /// FCL does not tell more.
  std::size_t bytes() const override {
    return radii_.size() *
           (sizeof(Object) + sizeof(fcl::Sphered) + 2 * sizeof(fcl::detail::NodeBase<fcl::AABBd>));
  }

 private:
  struct Search {
    const std::vector<float>& radii;
    const Frame& now;
    std::vector<SpherePair>& touching;
  };

  static bool note(Object* first, Object* second, void* data) {
    const auto& search = *static_cast<Search*>(data);
    const auto number = [](const Object* object) {
      return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object->getUserData()));
    };
    const std::uint32_t a = number(first), b = number(second);
    if (touch_at(search.now, search.radii[a] + search.radii[b], a, b)) search.touching.push_back({a, b});
    return false;  // go on
  }

  void make_objects() {
    for (std::size_t at = 0; at < radii_.size(); ++at) {
      objects_.push_back(std::make_unique<Object>(std::make_shared<fcl::Sphered>(radii_[at])));
      // NOLINTNEXTLINE(performance-no-int-to-ptr): FCL keeps a number for us that is a pointer.
      objects_.back()->setUserData(reinterpret_cast<void*>(at));
    }
  }

  std::vector<float> radii_;
  std::vector<std::unique_ptr<Object>> objects_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
};

}  // namespace

std::unique_ptr<StepKernel> make_fcl_kernel(std::vector<float> radii) {
  return std::make_unique<FclKernel>(std::move(radii));
}

}  // namespace kinesphere::program

#else

namespace kinesphere::program {
std::unique_ptr<StepKernel> make_fcl_kernel(std::vector<float>) { return nullptr; }
}  // namespace kinesphere::program

#endif
