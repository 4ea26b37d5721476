#pragma once

namespace curvefusion {

/// Sets memory aside for when operator new finds none. The first lack is bridged by one half, as it
/// may happen in a destructor, which must not throw (those of JSON values take memory); the other
/// half is there for the destructors that run once std::bad_alloc is thrown. Throws std::bad_alloc
/// where there is not even so much.
void SetMemoryAside();

}  // namespace curvefusion
