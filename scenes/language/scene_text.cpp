#include "scenes/language/scene_text.hpp"

#include <algorithm>

namespace pulvis {
namespace {

using document::Table;
using document::Value;

struct Block {  // one table with its header
  const schema::TableView* view;
  const Value* table;
};

std::string write_keys(const Table& table, const schema::TableView& view) {
  std::string text;
  for (const schema::KeyInfo& key : view.keys)
    if (const document::Entry* entry = document::find(table, key.name))
      text += key.name + " = " + document::value_text(entry->value) + "\n";
  return text;
}

// The tables of `parent` directly below `path`, in declaration order.
std::vector<Block> blocks_in(const Table& parent, const std::string& path,
                             const schema::Language& language) {
  std::vector<Block> blocks;
  for (const schema::TableView& view : language) {
    if (view.info.path.empty()) continue;
    const std::string key = view.info.path.substr(view.info.path.rfind('.') + 1);
    if (schema::joined_path(path, key) != view.info.path) continue;
    const document::Entry* entry = document::find(parent, key);
    if (entry == nullptr) continue;
    if (!view.info.repeated) blocks.push_back({&view, &entry->value});
    if (view.info.repeated)
      for (const Value& element : entry->value.get<document::Array>())
        blocks.push_back({&view, &element});
  }
  return blocks;
}

bool places_particles(const Block& block) {
  return block.view->info.path == "body" || block.view->info.path == "packing";
}

bool comes_before(const Block& a, const Block& b) {
  return written_before(a.table->origin.mark, b.table->origin.mark);
}

std::string write_block(const Block& block, const schema::Language& language) {
  const std::string& path = block.view->info.path;
  const Table& table = block.table->get<Table>();
  const std::string header = block.view->info.repeated ? "[[" + path + "]]" : "[" + path + "]";
  std::string text = "\n" + header + "\n" + write_keys(table, *block.view);
  for (const Block& child : blocks_in(table, path, language)) text += write_block(child, language);
  return text;
}

}  // namespace

std::string scene_text(const Table& root, const schema::Language& language) {
  std::vector<Block> blocks = blocks_in(root, "", language);
  // body and packing are declared next to each other, so their blocks are contiguous in the list.
  const auto first = std::find_if(blocks.begin(), blocks.end(), places_particles);
  const auto last = std::find_if_not(first, blocks.end(), places_particles);
  std::stable_sort(first, last, comes_before);

  std::string text = write_keys(root, language.front());
  for (const Block& block : blocks) text += write_block(block, language);
  return text;
}

}  // namespace pulvis
