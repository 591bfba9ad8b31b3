#include "base/thread_priority.h"

#ifdef __linux__
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#endif

namespace unshot {

void workInBackground() {
#ifdef __linux__
  constexpr int kNice = 10;  // a tenth of what a thread of the usual priority has
  errno = 0;
  const int present = getpriority(PRIO_PROCESS, 0);  // on Linux: of the calling thread
  // Lowering is always allowed; if it were not, all would be as it is without.
  if (errno == 0) setpriority(PRIO_PROCESS, 0, std::max(present, kNice));
#endif
}

}  // namespace unshot
