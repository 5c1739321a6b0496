// The thread sanitizer under told.hpp: told_test race-in-loop|race-of-nodes|ordered-nodes|ordered-loops. It must
// report the first two, and nothing of the others, whose order oneTBB keeps.
#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace {

using Message = tbb::flow::continue_msg;
using Node = tbb::flow::continue_node<Message>;

// Long enough for another thread to take the next task.
void wait_a_little() {
  volatile double x = 0;
  for (int i = 0; i < 20000; ++i) x = x + i;
}

// Holds the first task until a second one runs beside it, however late a busy machine wakes another thread. All is
// relaxed: nothing of it orders the tasks, so that their race stays one.
class Meeting {
 public:
  void wait() {
    inside_.fetch_add(1, std::memory_order_relaxed);
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (inside_.load(std::memory_order_relaxed) < 2 && std::chrono::steady_clock::now() < end)
      wait_a_little();
  }

 private:
  std::atomic<int> inside_{0};  // tasks that have come, ever
};

}  // namespace

int main(int, char** words) {
  const std::string mode = words[1];
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 3);
  constexpr std::size_t places = 1000;
  double sum = 0;
  std::vector<double> values(places);
  Meeting meeting;
  const auto node = [&](Message) {
    wait_a_little();
    if (mode.ends_with("nodes")) {
      if (mode.starts_with("race")) meeting.wait();
      sum += 1;
      return;
    }
    tbb::parallel_for(std::size_t{0}, places, [&](std::size_t i) {
      wait_a_little();
      if (mode.starts_with("race")) meeting.wait();
      (mode == "race-in-loop" ? sum : values[i]) += 1;
    });
  };
  tbb::flow::graph graph;
  tbb::flow::broadcast_node<Message> start(graph);
  std::vector<std::unique_ptr<Node>> nodes;
  for (int n = 0; n < 3; ++n) nodes.push_back(std::make_unique<Node>(graph, node));
  tbb::flow::make_edge(start, *nodes[0]);
  for (std::size_t n = 1; n < 3; ++n)
    if (mode == "race-of-nodes")
      tbb::flow::make_edge(start, *nodes[n]);
    else
      tbb::flow::make_edge(*nodes[n - 1], *nodes[n]);
  for (int run = 0; run < 20; ++run) {
    start.try_put(Message{});
    graph.wait_for_all();
  }
  std::printf("%g %g\n", sum, values.back());
}
