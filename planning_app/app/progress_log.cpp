#include "app/progress_log.hpp"

#include <unistd.h>

namespace berm::app {

void ProgressLog::event(const std::string& name, nlohmann::ordered_json fields) const {
  nlohmann::ordered_json line{{"event", name}};
  line.update(fields);
  const std::string text = line.dump() + '\n';
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(fd_, text.data() + done, text.size() - done);
    if (n <= 0) return;
    done += static_cast<std::size_t>(n);
  }
}

}  // namespace berm::app
