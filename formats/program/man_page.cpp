#include "formats/program/man_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/program/output.h"
#include "formats/program/run_program.h"

namespace nightcity::program {
namespace {

constexpr const char* section_number = "1";  // user commands

// Returns `text` so that roff prints it as it is: a backslash starts a command, a plain hyphen may
// become a typographic one that cannot be pasted into a shell, and a line that starts with . or '
// is a request.
std::string escape(std::string_view text) {
  std::string escaped;
  bool starts_line = true;
  for (const char c : text) {
    if (starts_line && (c == '.' || c == '\'')) escaped += "\\&";
    starts_line = c == '\n';
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else if (c == '\'')
      escaped += "\\(aq";
    else if (c == '`')
      escaped += "\\(ga";
    else if (c == '^')
      escaped += "\\(ha";
    else if (c == '~')
      escaped += "\\(ti";
    else
      escaped += c;
  }
  return escaped;
}

std::string to_upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \n");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \n") - first + 1));
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(trim(line));
  return lines;
}

struct Footer {
  std::string description;            // what stands before the examples
  std::vector<std::string> examples;  // one command a line
};

Footer split_footer(const std::string& footer) {
  Footer parts;
  bool in_examples = false;
  for (std::string line : split_lines(footer)) {
    if (line.starts_with("Example")) {
      in_examples = true;
      const auto colon = line.find(':');
      line = colon == std::string::npos ? "" : trim(std::string_view(line).substr(colon + 1));
    }
    if (line.empty()) continue;
    if (in_examples)
      parts.examples.push_back(line);
    else
      parts.description += line + "\n";
  }
  return parts;
}

bool is_group(const CLI::App* command) {
  return command->get_name().empty();
}

std::vector<const CLI::App*> find_commands(const CLI::App& app) {
  return app.get_subcommands(
      [](const CLI::App* command) { return !is_group(command) && !command->get_group().empty(); });
}

class Page {
 public:
  Page(const std::string& name, const std::string& summary, const Program& program) {
    add(".TH {} {} \"\" \"{} {}\" \"User Commands\"\n", to_upper(escape(name)), section_number,
        escape(program.name), escape(program.version));
    add(".SH NAME\n{} \\- {}\n", escape(name), escape(summary));
  }

  template <typename... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    text_ += fmt::format(format, std::forward<Values>(values)...);
  }
  void add_section(const std::string& title, const std::string& text) {
    if (!text.empty()) add(".SH {}\n{}\n", title, escape(trim(text)));
  }
  void add_synopsis(const CLI::App& app, const std::string& command) {
    const CLI::Formatter formatter;
    add(".SH SYNOPSIS\n.B {}\n[\\fIOPTIONS\\fR]", escape(command));
    for (const CLI::Option* option : app.get_options())
      if (option->get_positional()) add(" {}", escape(formatter.make_option_usage(option)));
    add("{}\n", find_commands(app).empty() ? "" : " \\fICOMMAND\\fR ...");
  }
  // One entry for each argument (`positional`) or option, under `title`.
  void add_options(const CLI::App& app, bool positional, const char* title) {
    bool has_title = false;
    for (const CLI::Option* option : app.get_options()) {
      // An option may be both: the argument's old spelling.
      const bool listed = positional ? option->get_positional() : option->nonpositional();
      if (!listed || option->get_group().empty()) continue;
      if (!has_title) add(".SH {}\n", title);
      has_title = true;
      add_option(*option, positional);
    }
  }
  // Options of which only some may be given together: to CLI11, a group is
  // a command without a name.
  void add_option_groups(const CLI::App& app) {
    for (const CLI::App* group : app.get_subcommands(is_group)) {
      add(".PP\n{}:\n", escape(group->get_description()));
      for (const CLI::Option* option : group->get_options())
        if (option != group->get_help_ptr()) add_option(*option, false);
    }
  }
  void add_examples(const std::vector<std::string>& examples) {
    if (examples.empty()) return;
    add(".SH EXAMPLES\n.EX\n");
    for (const std::string& example : examples) add("{}\n", escape(example));
    add(".EE\n");
  }

  std::string take() { return std::move(text_); }

 private:
  void add_option(const CLI::Option& option, bool positional) {
    const CLI::Formatter formatter;
    add(".TP\n.B {}\n{}\n",
        escape(formatter.make_option_name(&option, positional) +
               formatter.make_option_opts(&option)),
        escape(formatter.make_option_desc(&option)));
  }

  std::string text_;
};

std::string to_page_name(const Program& program, const CLI::App& command) {
  return program.name + "-" + command.get_name();
}

void write_page(const std::filesystem::path& folder, const std::string& name,
                const std::string& text) {
  AtomicFile file(folder / (name + "." + section_number));
  file.write(text);
  file.commit();
}

}  // namespace

std::string to_man_page(const Program& program, const CLI::App& app) {
  Page page(program.name, program.description, program);
  page.add_synopsis(app, program.name);
  page.add_section("DESCRIPTION", program.name + " " + program.description +
                                      ". Each command has a manual page of its own, listed below.");
  const auto commands = find_commands(app);
  page.add(".SH COMMANDS\n");
  for (const CLI::App* command : commands)
    page.add(".TP\n.BR {} ({})\n{}\n", escape(to_page_name(program, *command)), section_number,
             escape(command->get_description()));
  page.add_options(app, false, "OPTIONS");
  page.add_section("EXIT STATUS", program.exit_codes);
  page.add(".SH SEE ALSO\n");
  for (const CLI::App* command : commands)
    page.add(".BR {} ({}){}\n", escape(to_page_name(program, *command)), section_number,
             command == commands.back() ? "" : ",");
  return page.take();
}

std::string to_man_page(const Program& program, const CLI::App& app, const CLI::App& command) {
  const Footer footer = split_footer(command.get_footer());
  Page page(to_page_name(program, command), command.get_description(), program);
  page.add_synopsis(command, program.name + " " + command.get_name());
  page.add_section("DESCRIPTION", command.get_description() + ".\n" + footer.description);
  page.add_options(command, true, "ARGUMENTS");
  page.add_options(command, false, "OPTIONS");
  page.add_option_groups(command);
  page.add(".PP\nThe options of\n.BR {} ({})\nare accepted too.\n", escape(app.get_name()),
           section_number);
  page.add_examples(footer.examples);
  page.add_section("EXIT STATUS", program.exit_codes);
  page.add(".SH SEE ALSO\n.BR {} ({})\n", escape(program.name), section_number);
  return page.take();
}

void write_man_pages(const Program& program, const CLI::App& app,
                     const std::filesystem::path& folder) {
  require_writable_folder(folder);
  write_page(folder, program.name, to_man_page(program, app));
  for (const CLI::App* command : find_commands(app))
    write_page(folder, to_page_name(program, *command), to_man_page(program, app, *command));
}

}  // namespace nightcity::program
