// Handles of objects, checked at each use: those of destroyed objects are recognised, and so are numbers that
// never were handles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <thread>
#include <utility>
#include <vector>

namespace kinesphere::c {

/// Which threads use an object at present. Callbacks of an object may use it again in the same thread; the
/// object knows what is allowed to them.
class Usage {
 public:
  /// Return false if another thread changes the object or, for a change, uses it.
  bool begin_reading();
  bool begin_changing();
  void end_reading();
  void end_changing();
  /// Marks the object as used for ever. Returns false if any thread uses it.
  bool begin_destroying();

 private:
  std::mutex mutex_;
  int readers_ = 0;
  int changes_ = 0;  ///< nested calls of `owner_`, the first of which changes the object
  std::thread::id owner_;
};

enum class HandleState { valid, stale, invalid };

/// Objects by handle. A handle has the slot of its object and the generation of the slot, which each new
/// object raises. Kinds distinguish handles of different tables. All members may be called by several
/// threads.
template <class Object>
class HandleTable {
 public:
  struct Found {
    std::shared_ptr<Object> object;  ///< null unless the handle is valid
    HandleState state;
  };

  explicit HandleTable(std::uint8_t kind) : kind_(kind) {}

  std::uint64_t insert(std::shared_ptr<Object> object) {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) {
      if (slots_.size() == most_slots) throw std::bad_alloc();
      slots_.emplace_back();
      // erase() must not fail.
      free_.reserve(slots_.size());
      free_.push_back(static_cast<std::uint32_t>(slots_.size() - 1));
    }
    const std::uint32_t index = free_.back();
    free_.pop_back();
    Slot& slot = slots_[index];
    slot.object = std::move(object);
    ++slot.generation;
    return std::uint64_t{slot.generation} << 32 | std::uint64_t{kind_} << kind_shift | index;
  }

  Found find(std::uint64_t handle) {
    const std::lock_guard lock(mutex_);
    const std::uint32_t generation = generation_of(handle), index = index_of(handle);
    if ((handle >> kind_shift & 0xff) != kind_ || index >= slots_.size() || generation == 0 ||
        generation > slots_[index].generation)
      return {nullptr, HandleState::invalid};
    const Slot& slot = slots_[index];
    if (generation < slot.generation || slot.object == nullptr) return {nullptr, HandleState::stale};
    return {slot.object, HandleState::valid};
  }

  /// Needs a valid handle. Others that have found the object may keep it for a while.
  void erase(std::uint64_t handle) {
    const std::lock_guard lock(mutex_);
    Slot& slot = slots_[index_of(handle)];
    slot.object.reset();
    // A slot whose generations are used up is never used again.
    if (slot.generation != UINT32_MAX) free_.push_back(index_of(handle));
  }

 private:
  struct Slot {
    std::uint32_t generation = 0;
    std::shared_ptr<Object> object;
  };
  static constexpr int kind_shift = 24;
  static std::uint32_t generation_of(std::uint64_t handle) {
    return static_cast<std::uint32_t>(handle >> 32);
  }
  static constexpr std::uint32_t most_slots = 1u << kind_shift;
  static std::uint32_t index_of(std::uint64_t handle) { return handle & (most_slots - 1); }

  std::mutex mutex_;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_;
  std::uint8_t kind_;
};

}  // namespace kinesphere::c
