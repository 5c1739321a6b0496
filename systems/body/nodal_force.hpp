// The force on a node of a chunk: internal, and of contact on the boundary.
#pragma once

#include "components/bundles.hpp"

namespace pulvis {

template <class D>
class NodalForce {
 public:
  template <class Forces>
  NodalForce(const Forces& forces, const typename D::Shape& shape, Chunk chunk)
      : internal_(forces.internal.chunk(chunk)),
        contact_(forces.contact ? forces.contact->chunk(chunk) : OfContact(nullptr)),
        bearing_(forces.contact ? shape.boundary_nodes : 0) {}

  Lane operator()(Row<Node> n, int k) const {
    if (n.value >= bearing_) return internal_(n, k);
    return internal_(n, k) + contact_(Row<BoundaryNode>(n.value), k);
  }

 private:
  using OfContact = ChunkView<ContactForce<D>, const Lane*>;
  ChunkView<InternalForce<D>, const Lane*> internal_;
  OfContact contact_;
  std::int32_t bearing_;  // the boundary nodes come first
};

}  // namespace pulvis
