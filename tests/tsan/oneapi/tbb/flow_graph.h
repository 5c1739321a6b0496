// See tests/tsan/told.hpp.
#pragma once
#pragma GCC system_header
#include_next <oneapi/tbb/flow_graph.h>

#include "tests/tsan/told.hpp"

namespace told {

// try_put comes before every node, every node before the end of wait_for_all.
inline Tag graph_begun, graph_done;

template <class Message>
class Node : public tbb::flow::continue_node<Message> {
  using Plain = tbb::flow::continue_node<Message>;

 public:
  template <class Body>
  Node(tbb::flow::graph& graph, const Body& body)
      : Plain(
            graph, [ this, body ](const Message& message)
                       __attribute__((no_sanitize("thread"))) { run(body, message); }) {}
  void comes_after(const Node& other) { predecessors_.push_back(&other.done_); }

 private:
  template <class Body>
  __attribute__((no_sanitize("thread"))) void run(const Body& body, const Message& message) {
    after(graph_begun);
    for (const Tag* other : predecessors_) after(*other);
    struct End {
      const Tag& own;
      ~End() {
        before(own);
        before(graph_done);
      }
    } end{done_};
    body(message);
  }
  Tag done_ = 0;
  std::vector<const Tag*> predecessors_;
};

// Nodes come before the end of wait_for_all where one of them throws, too.
class Graph : public tbb::flow::graph {
 public:
  using tbb::flow::graph::graph;
  void wait_for_all() {
    struct End {
      ~End() { after(graph_done); }
    } end_of_wait;
    tbb::flow::graph::wait_for_all();
  }
};

template <class Message>
class Start : public tbb::flow::broadcast_node<Message> {
 public:
  using tbb::flow::broadcast_node<Message>::broadcast_node;
  bool try_put(const Message& message) {
    before(graph_begun);
    return tbb::flow::broadcast_node<Message>::try_put(message);
  }
};

}  // namespace told

namespace tbb::flow {
template <class Message>
void told_make_edge(told::Node<Message>& earlier, told::Node<Message>& later) {
  later.comes_after(earlier);
  make_edge(earlier, later);
}
template <class Message>
void told_make_edge(told::Start<Message>& start, told::Node<Message>& later) {
  make_edge(start, later);
}
using told_graph = told::Graph;
template <class Message>
using told_continue_node = told::Node<Message>;
template <class Message>
using told_broadcast_node = told::Start<Message>;
}  // namespace tbb::flow

#define continue_node told_continue_node
#define broadcast_node told_broadcast_node
#define make_edge told_make_edge
#define graph told_graph
