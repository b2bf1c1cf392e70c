#include "tools/bake/recipe/reference.h"

#include <algorithm>
#include <sstream>

#include "formats/error.h"
#include "formats/program/nearest_word.h"
#include "tools/bake/recipe/tables.h"

namespace nightcity::recipe {
namespace {

constexpr std::size_t text_width = 80;

// Calls `use` with all tables, rows of luminaires and inventories included, as an empty recipe has
// them.
template <class Use>
void with_tables(const Use& use) {
  bake::Recipe recipe;
  bake::LuminaireFile luminaire;
  inventory::InventoryFile inventory;
  std::vector<Table> tables = make_tables(recipe, {});
  const auto lamps = std::find_if(tables.begin(), tables.end(),
                                  [](const Table& table) { return table.name == "lamps"; });
  tables.insert(lamps + 1,
                {make_luminaire_table(luminaire, {}), make_inventory_table(inventory, {})});
  use(tables);
}

bool is_row(const Table& table) {
  return table.name.find('.') != std::string::npos;
}

std::string to_title(const Table& table) {
  if (!is_row(table)) return "[" + table.name + "]";
  return "[[" + table.name + "]]";
}

// Returns `text` wrapped at text_width, every line indented by `indent` spaces.
std::string wrap(const std::string& text, std::size_t indent) {
  std::istringstream words(text);
  const std::string margin(indent, ' ');
  std::string result, line = margin;
  for (std::string word; words >> word;) {
    if (line.size() > indent && line.size() + 1 + word.size() > text_width) {
      result += line + "\n";
      line = margin;
    }
    line += (line.size() > indent ? " " : "") + word;
  }
  return result + line + "\n";
}

std::string without_backticks(std::string text) {
  std::erase(text, '`');
  return text;
}

std::string to_example(const Key& key) {
  return key.name + " = " + (key.example.empty() ? key.default_value : key.example);
}

// Returns the type, unit and range of a key.
std::string to_facts(const Key& key) {
  std::string facts = key.type;
  if (!key.unit.empty()) facts += ", " + key.unit;
  if (!key.range.empty()) facts += "; " + key.range;
  return facts;
}

std::string to_text(const Key& key) {
  std::string facts = to_facts(key);
  if (!key.default_value.empty()) facts += "; default " + key.default_value;
  return "  " + key.name + "\n" + wrap(without_backticks(facts), 6) +
         wrap(without_backticks(key.help), 6) + "      Example: " + to_example(key) + "\n";
}

std::string to_text(const Table& table) {
  std::string text = to_title(table) + "\n" + wrap(without_backticks(table.help), 2);
  for (const Key& key : table.keys) text += "\n" + to_text(key);
  return text;
}

std::string to_markdown(const Table& table) {
  std::string text = "### `" + to_title(table) + "`\n\n" + table.help + "\n\n";
  text += "| key | takes | default | meaning |\n|---|---|---|---|\n";
  std::string examples;
  for (const Key& key : table.keys) {
    const std::string shown = key.default_value.empty() ? "" : "`" + key.default_value + "`";
    text += "| `" + key.name + "` | " + to_facts(key) + " | " + shown + " | " + key.help + " |\n";
    examples += to_example(key) + "\n";
  }
  return text + "\n```toml\n" + to_title(table) + "\n" + examples + "```\n";
}

}  // namespace

std::string make_markdown_reference() {
  std::string text;
  with_tables([&text](const std::vector<Table>& tables) {
    for (const Table& table : tables) text += (text.empty() ? "" : "\n") + to_markdown(table);
  });
  return text;
}

std::string make_text_reference(const std::string& word) {
  std::string text;
  std::vector<std::string> known;
  with_tables([&](const std::vector<Table>& tables) {
    for (const Table& table : tables) {
      known.push_back(table.name);
      const auto add = [&text](const std::string& part) {
        text += (text.empty() ? "" : "\n") + part;
      };
      if (word.empty() || word == table.name) add(to_text(table));
      for (const Key& key : table.keys) {
        known.push_back(key.name);
        if (word == key.name || word == table.name + "." + key.name)
          add(to_title(table) + "\n" + to_text(key));
      }
    }
  });
  if (!text.empty()) return text;
  const std::string nearest = program::find_nearest_word(word, known);
  throw UsageError("", "a recipe has no table or key \"" + word + "\"" +
                           (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

}  // namespace nightcity::recipe
