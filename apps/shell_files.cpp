#include "apps/shell_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <sstream>
#include <string_view>
#include <vector>

namespace curvefusion {

namespace {

// What is asked of an option or an argument.
struct Argument {
  std::vector<std::string> names;   // "-o", "--output"; none for an argument by position
  std::string position;             // "SCENE", or empty
  std::string value;                // "TEXT", "FLOAT", or empty for a flag
  std::vector<std::string> values;  // where there is a list of them
  std::string description;

  bool is_path() const { return value == "TEXT" && values.empty(); }
};

// CLI11 names a list of values "TEXT:{best,paper}".
std::vector<std::string> ListedValues(const std::string& type) {
  const size_t open = type.find('{');
  const size_t close = type.find('}', open);
  std::vector<std::string> values;
  if (open == std::string::npos || close == std::string::npos) return values;
  std::istringstream list(type.substr(open + 1, close - open - 1));
  for (std::string value; std::getline(list, value, ',');) values.push_back(value);
  return values;
}

Argument ArgumentOf(const CLI::Option& option) {
  Argument argument;
  for (const std::string& name : option.get_snames()) argument.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) argument.names.push_back("--" + name);
  if (option.get_positional()) argument.position = option.get_name(true);
  const std::string type = option.get_type_name();
  if (option.get_items_expected_max() > 0) argument.value = type.substr(0, type.find(':'));
  argument.values = ListedValues(type);
  argument.description = option.get_description();
  return argument;
}

std::vector<Argument> ArgumentsOf(const CLI::App& command, bool by_position) {
  std::vector<Argument> arguments;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional() == by_position) arguments.push_back(ArgumentOf(*option));
  }
  return arguments;
}

std::vector<const CLI::App*> CommandsOf(const CLI::App& app) { return app.get_subcommands({}); }

std::vector<std::string> NamesOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : CommandsOf(app)) names.push_back(command->get_name());
  names.emplace_back("help");
  return names;
}

std::string Replaced(std::string text, std::string_view what, std::string_view by) {
  for (size_t i = text.find(what); i != std::string::npos; i = text.find(what, i + by.size())) {
    text.replace(i, what.size(), by);
  }
  return text;
}

// A text inside single quotes of a shell.
std::string Quoted(const std::string& text) { return "'" + Replaced(text, "'", "'\\''") + "'"; }

// A text of a manual page: no character of it is a command of roff.
std::string Roff(const std::string& text) {
  std::istringstream lines(Replaced(Replaced(text, "\\", "\\e"), "-", "\\-"));
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    if (!result.empty()) result += '\n';
    if (line.starts_with('.') || line.starts_with('\'')) result += "\\&";
    result += line;
  }
  return result;
}

std::string ManualEntry(const Argument& argument) {
  std::string heading;
  for (const std::string& name : argument.names) {
    heading += (heading.empty() ? "" : ", ") + fmt::format("\\fB{}\\fR", Roff(name));
  }
  if (heading.empty()) heading = fmt::format("\\fI{}\\fR", Roff(argument.position));
  if (!argument.names.empty() && !argument.value.empty()) {
    const std::string value = argument.values.empty()
                                  ? argument.value
                                  : fmt::format("{}", fmt::join(argument.values, "|"));
    heading += fmt::format(" \\fI{}\\fR", Roff(value));
  }
  return fmt::format(".TP\n{}\n{}\n", heading, Roff(argument.description));
}

std::string ManualSection(const CLI::App& command) {
  std::string text = fmt::format(".SS curvefusion {}\n{}.\n", Roff(command.get_name()),
                                 Roff(command.get_description()));
  for (const bool by_position : {true, false}) {
    for (const Argument& argument : ArgumentsOf(command, by_position)) {
      text += ManualEntry(argument);
    }
  }
  if (!command.get_footer().empty()) {
    text += fmt::format(".PP\n.nf\n{}\n.fi\n", Roff(command.get_footer()));
  }
  return text;
}

// The cases of bash for one command: values of its options, then what else may stand there.
std::string BashCases(const CLI::App& command) {
  std::string cases;
  std::vector<std::string> names;
  for (const Argument& option : ArgumentsOf(command, false)) {
    names.insert(names.end(), option.names.begin(), option.names.end());
    if (option.value.empty()) continue;
    cases += fmt::format("    '{0} {1}') words={2} ;;\n", command.get_name(),
                         fmt::join(option.names, fmt::format("'|'{} ", command.get_name())),
                         Quoted(fmt::format("{}", fmt::join(option.values, " "))));
  }
  cases += fmt::format("    '{} '*) [[ $current != -* ]] || words={} ;;\n", command.get_name(),
                       Quoted(fmt::format("{}", fmt::join(names, " "))));
  return cases;
}

// The texts of zsh end at these characters.
std::string ZshText(const std::string& text) {
  std::string escaped = text;
  for (const char* mark : {"\\", "[", "]", ":"}) {
    escaped = Replaced(escaped, mark, std::string("\\") + mark);
  }
  return escaped;
}

std::string ZshAction(const Argument& argument) {
  if (!argument.values.empty()) return fmt::format("({})", fmt::join(argument.values, " "));
  return argument.is_path() ? "_files" : "";
}

std::string ZshCase(const CLI::App& command) {
  std::string text = fmt::format("    {}) _arguments", command.get_name());
  for (const Argument& option : ArgumentsOf(command, false)) {
    for (const std::string& name : option.names) {
      std::string entry = fmt::format("{}[{}]", name, ZshText(option.description));
      if (!option.value.empty()) entry += fmt::format(":{}:{}", option.value, ZshAction(option));
      text += " \\\n      " + Quoted(entry);
    }
  }
  return text + " \\\n      '*:file:_files' ;;\n";
}

std::string FishLines(const CLI::App& command) {
  std::string lines;
  for (const Argument& option : ArgumentsOf(command, false)) {
    std::string line = fmt::format("complete -c curvefusion -n '__fish_seen_subcommand_from {}'",
                                   command.get_name());
    for (const std::string& name : option.names) {
      line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    if (!option.value.empty()) line += option.is_path() ? " -r" : " -x";
    if (!option.values.empty()) {
      line += " -a " + Quoted(fmt::format("{}", fmt::join(option.values, " ")));
    }
    lines += line + " -d " + Quoted(option.description) + "\n";
  }
  return lines;
}

}  // namespace

std::string ManualPage(const CLI::App& app) {
  std::string text = fmt::format(
      ".TH CURVEFUSION 1 \"\" \"\" \"User Commands\"\n.ad l\n.SH NAME\ncurvefusion \\- {}\n"
      ".SH SYNOPSIS\n\\fBcurvefusion\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR] ...\n.SH COMMANDS\n",
      "wire objects from RGB\\-D scans, as curve skeletons and tube meshes");
  for (const CLI::App* command : CommandsOf(app)) text += ManualSection(*command);
  return text + fmt::format(".SH NOTES\n{}\n", Roff(app.get_footer()));
}

std::string BashCompletion(const CLI::App& app) {
  std::string text = fmt::format(
      "_curvefusion() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}} words=\n"
      "  COMPREPLY=()\n"
      "  case \"${{COMP_WORDS[1]}} $previous\" in\n"
      "    *' curvefusion') words={} ;;\n"
      "    'help '*) words={} ;;\n",
      Quoted(fmt::format("{} --help --version", fmt::join(NamesOf(app), " "))),
      Quoted(fmt::format("{}", fmt::join(NamesOf(app), " "))));
  for (const CLI::App* command : CommandsOf(app)) text += BashCases(*command);
  return text +
         "  esac\n"
         "  [[ -z $words ]] || mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "}\n"
         "complete -o default -F _curvefusion curvefusion\n";
}

std::string ZshCompletion(const CLI::App& app) {
  std::string text =
      "#compdef curvefusion\n"
      "_curvefusion() {\n"
      "  local -a commands=(\n";
  for (const CLI::App* command : CommandsOf(app)) {
    text += fmt::format("    {}\n",
                        Quoted(command->get_name() + ":" + ZshText(command->get_description())));
  }
  text +=
      "    'help:Tell what a command does'\n"
      "  )\n"
      "  if ((CURRENT == 2)) || [[ $words[2] == help ]]; then\n"
      "    _describe command commands\n"
      "    return\n"
      "  fi\n"
      "  shift words\n"
      "  ((CURRENT--))\n"
      "  case $words[1] in\n";
  for (const CLI::App* command : CommandsOf(app)) text += ZshCase(*command);
  return text + "  esac\n}\n_curvefusion \"$@\"\n";
}

std::string FishCompletion(const CLI::App& app) {
  std::string text;
  for (const CLI::App* command : CommandsOf(app)) {
    text += fmt::format("complete -c curvefusion -f -n __fish_use_subcommand -a {} -d {}\n",
                        command->get_name(), Quoted(command->get_description()));
  }
  text += fmt::format(
      "complete -c curvefusion -f -n __fish_use_subcommand -a help -d 'Tell what a command does'\n"
      "complete -c curvefusion -f -n '__fish_seen_subcommand_from help' -a {}\n",
      Quoted(fmt::format("{}", fmt::join(NamesOf(app), " "))));
  for (const CLI::App* command : CommandsOf(app)) text += FishLines(*command);
  return text;
}

}  // namespace curvefusion
