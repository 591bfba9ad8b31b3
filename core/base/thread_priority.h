// Threads that work for a long time beside one that answers a user.
#pragma once

namespace unshot {

/// From now on the calling thread, and those that it begins, have little of a core that another thread wants,
/// and all of it else. Where the system knows no priorities of threads (other than Linux) it does nothing.
void workInBackground();

}  // namespace unshot
