#include "scenes/lever/mesh/gmsh_file.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <sstream>

#include "engine/files/input_file.hpp"
#include "scenes/language/problem.hpp"

namespace pulvis {
namespace {

constexpr std::size_t largest_file = 256U << 20U;  // bytes
constexpr int line2 = 1, quad4 = 3, hexahedron8 = 5, line3 = 8, triangle6 = 9, tetrahedron10 = 11,
              point1 = 15;

const char* name_of(int type) {
  switch (type) {
    case 2:
      return "a triangle of three nodes";
    case 4:
      return "a tetrahedron of four nodes";
    case 6:
      return "a prism";
    case 7:
      return "a pyramid";
    case 10:
    case 12:
    case 13:
    case 14:
    case 16:
    case 17:
    case 18:
    case 19:
      return "another second-order element";
    default:
      return "of an unknown kind";
  }
}

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file) {
    try {
      stream_.str(text_of_input(file, largest_file));
    } catch (const UnfitInput& unfit) {
      refuse("gmsh", fmt::format("{}, allowed: an MSH file of Gmsh (ASCII)", unfit.what()));
    }
  }

  GmshMesh read() {
    std::string section;
    while (next_line(section)) {
      if (section == "$MeshFormat")
        format();
      else if (version_ == 0)
        refuse("gmsh", "does not start with $MeshFormat, allowed: an MSH file of Gmsh (ASCII)");
      else if (section == "$PhysicalNames")
        names();
      else if (section == "$Entities")
        entities();
      else if (section == "$Nodes")
        version_ == 2 ? nodes_2() : nodes_4();
      else if (section == "$Elements")
        version_ == 2 ? elements_2() : elements_4();
      else if (section.starts_with("$"))
        skip("$End" + section.substr(1));
    }
    if (version_ == 0) refuse("gmsh", "is empty, allowed: an MSH file of Gmsh (ASCII)");
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void refuse(const std::string& key, const std::string& message) const {
    throw SceneError({{file_.string(), std::max(line_, 1), 1, "", key, message}});
  }

  bool next_line(std::string& text) {
    if (!std::getline(stream_, text)) return false;
    ++line_;
    while (!text.empty() && (text.back() == '\r' || text.back() == ' ')) text.pop_back();
    return true;
  }

  std::istringstream line(const char* key) {
    std::string text;
    if (!next_line(text) || text.starts_with("$"))
      refuse(key, "the section ends too early, allowed: as many lines as its header gives");
    return std::istringstream(text);
  }

  template <class... Numbers>
  void take(std::istringstream& from, const char* key, Numbers&... numbers) {
    if (!((from >> numbers) && ...)) refuse(key, "a number is missing, allowed: MSH 2.2 or 4.1");
  }

  void end(const std::string& word) {
    std::string text;
    if (!next_line(text) || text != word)
      refuse("gmsh", fmt::format("'{}' is not expected here, allowed: {}", text, word));
  }

  void skip(const std::string& word) {
    std::string text;
    while (next_line(text))
      if (text == word) return;
    refuse("gmsh", fmt::format("the section does not end, allowed: {}", word));
  }

  void format() {
    auto head = line("MeshFormat");
    std::string version;
    int binary = 0, size = 0;
    take(head, "MeshFormat", version, binary, size);
    version_ = version == "2.2" ? 2 : version == "4.1" ? 4 : 0;
    if (version_ == 0) refuse("MeshFormat", fmt::format("version {}, allowed: 2.2, 4.1", version));
    if (binary != 0) refuse("MeshFormat", "is binary, allowed: ASCII (Mesh.Binary = 0)");
    end("$EndMeshFormat");
  }

  void names() {
    int count = 0;
    auto head = line("PhysicalNames");
    take(head, "PhysicalNames", count);
    for (int i = 0; i < count; ++i) {
      auto one = line("PhysicalNames");
      int dimension = 0, tag = 0;
      take(one, "PhysicalNames", dimension, tag);
      std::string name;
      std::getline(one, name);
      const auto first = name.find('"'), last = name.rfind('"');
      if (first == std::string::npos || last == first)
        refuse("PhysicalNames", "a name without quotes, allowed: dimension tag \"name\"");
      names_[{dimension, tag}] = name.substr(first + 1, last - first - 1);
    }
    end("$EndPhysicalNames");
  }

  // 4.1: entities carry the physical tags of their elements.
  void entities() {
    std::array<std::size_t, 4> counts{};
    auto head = line("Entities");
    take(head, "Entities", counts[0], counts[1], counts[2], counts[3]);
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
        auto one = line("Entities");
        int tag = 0, physical = 0;
        std::size_t tags = 0;
        double box = 0;
        take(one, "Entities", tag);
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) take(one, "Entities", box);
        take(one, "Entities", tags);
        if (tags > 0) take(one, "Entities", physical);
        if (tags > 0) physical_[{dimension, tag}] = physical;
      }
    end("$EndEntities");
  }

  void add_node(std::istringstream& from, std::size_t tag) {
    Eigen::Vector3d x;
    take(from, "Nodes", x[0], x[1], x[2]);
    if (!x.allFinite()) refuse("Nodes", "has a coordinate that is not finite, allowed: numbers");
    if (!places_.try_emplace(tag, static_cast<int>(mesh_.nodes.size())).second)
      refuse("Nodes", fmt::format("node {} occurs twice, allowed: each once", tag));
    mesh_.nodes.push_back(x);
  }

  void nodes_2() {
    std::size_t count = 0;
    auto head = line("Nodes");
    take(head, "Nodes", count);
    for (std::size_t i = 0; i < count; ++i) {
      auto one = line("Nodes");
      std::size_t tag = 0;
      take(one, "Nodes", tag);
      add_node(one, tag);
    }
    end("$EndNodes");
  }

  void nodes_4() {
    std::size_t blocks = 0, count = 0, low = 0, high = 0;
    auto head = line("Nodes");
    take(head, "Nodes", blocks, count, low, high);
    for (std::size_t b = 0; b < blocks; ++b) {
      int dimension = 0, entity = 0, parametric = 0;
      std::size_t own = 0;
      auto block = line("Nodes");
      take(block, "Nodes", dimension, entity, parametric, own);
      std::vector<std::size_t> tags;  // grows line by line: the count is only what the file claims
      for (std::size_t n = 0; n < own; ++n) {
        auto one = line("Nodes");
        take(one, "Nodes", tags.emplace_back());
      }
      for (const std::size_t tag : tags) {
        auto one = line("Nodes");
        add_node(one, tag);
      }
    }
    end("$EndNodes");
  }

  std::vector<int> nodes_of(std::istringstream& from, std::size_t count) {
    std::vector<int> at(count);
    for (int& node : at) {
      std::size_t tag = 0;
      take(from, "Elements", tag);
      const auto found = places_.find(tag);
      if (found == places_.end())
        refuse("Elements", fmt::format("node {} does not exist, allowed: nodes of $Nodes", tag));
      node = found->second;
    }
    return at;
  }

  void add_element(std::istringstream& from, int type, int dimension, int physical) {
    const auto name = names_.find({dimension, physical});
    if (name == names_.end() || type == point1 || type == line2 || type == line3) return;
    if (type == hexahedron8 || type == tetrahedron10)
      mesh_.volumes.push_back({nodes_of(from, type == hexahedron8 ? 8 : 10), name->second, line_});
    else if (type == quad4 || type == triangle6)
      mesh_.facets.push_back({nodes_of(from, type == quad4 ? 4 : 6), name->second, line_});
    else
      refuse("Elements",
             fmt::format("an element of group '{}' is {} (type {}), allowed: hexahedra of eight "
                         "nodes (type 5) with quads of four (type 3), as in transfinite, "
                         "recombined or subdivided meshes, tetrahedra of ten (type 11) with "
                         "triangles of six (type 9), as generated with Mesh.ElementOrder = 2",
                         name->second, name_of(type), type));
  }

  void elements_2() {
    static const std::map<int, int> dimensions{{point1, 0}, {line2, 1},     {2, 2},  {quad4, 2},
                                               {line3, 1},  {triangle6, 2}, {10, 2}, {16, 2}};
    std::size_t count = 0;
    auto head = line("Elements");
    take(head, "Elements", count);
    for (std::size_t i = 0; i < count; ++i) {
      auto one = line("Elements");
      std::size_t tag = 0;
      int type = 0, tags = 0, physical = 0, other = 0;
      take(one, "Elements", tag, type, tags);
      for (int k = 0; k < tags; ++k) take(one, "Elements", k == 0 ? physical : other);
      const auto dimension = dimensions.find(type);
      add_element(one, type, dimension == dimensions.end() ? 3 : dimension->second, physical);
    }
    end("$EndElements");
  }

  void elements_4() {
    std::size_t blocks = 0, count = 0, low = 0, high = 0;
    auto head = line("Elements");
    take(head, "Elements", blocks, count, low, high);
    for (std::size_t b = 0; b < blocks; ++b) {
      int dimension = 0, entity = 0, type = 0;
      std::size_t own = 0, tag = 0;
      auto block = line("Elements");
      take(block, "Elements", dimension, entity, type, own);
      const auto physical = physical_.find({dimension, entity});
      for (std::size_t i = 0; i < own; ++i) {
        auto one = line("Elements");
        take(one, "Elements", tag);
        if (physical != physical_.end()) add_element(one, type, dimension, physical->second);
      }
    }
    end("$EndElements");
  }

  std::filesystem::path file_;
  std::istringstream stream_;
  int line_ = 0, version_ = 0;
  std::map<std::pair<int, int>, std::string> names_;  // by dimension and tag
  std::map<std::pair<int, int>, int> physical_;       // of entities
  std::map<std::size_t, int> places_;                 // of nodes, by tag
  GmshMesh mesh_;
};

}  // namespace

GmshMesh read_gmsh(const std::filesystem::path& file) { return Reader(file).read(); }

}  // namespace pulvis
