#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes man pages, completions for bash, zsh and fish, and pages of Markdown from what a command says of itself.

Usage: command_manual.py COMMAND... [--man DIR] [--completions DIR] [--markdown DIR]

COMMAND is `delone`, `delone-mpi` or another command whose `--help` is CLI11's: the command is run, and so is each of its sub-commands.
Words before it, such as an emulator, are run with it.
--man DIR          delone.1 and delone-hull.1 …: one page for the command, and one for each sub-command
--completions DIR  bash/delone, zsh/_delone, fish/delone.fish
--markdown DIR     delone.md and delone-hull.md …, for the documentation site (definition lists)
"""
import argparse
import dataclasses
import pathlib
import re
import subprocess
import sys


class HelpError(Exception):
    """The help is not of the form that is understood."""


@dataclasses.dataclass
class Option:
    """An option, or an argument by position: then `names` holds the name of its value only."""
    names: list
    value: str = ""  # what the help calls its value; empty for a flag
    choices: list = dataclasses.field(default_factory=list)
    limits: str = ""
    required: bool = False
    repeated: bool = False
    excludes: list = dataclasses.field(default_factory=list)
    text: str = ""

    @property
    def is_file(self):
        return bool(re.search(r"FILE|^(IN|OUT|COMPLEX)$", self.value))

    @property
    def sentence(self):
        """What it is, with its limits."""
        return ". ".join([self.text.rstrip(".")] + [self.limits] * bool(self.limits) + ["Required"] * self.required) + "."


@dataclasses.dataclass
class Command:
    name: str
    description: str = ""
    usage: str = ""
    positionals: list = dataclasses.field(default_factory=list)
    groups: list = dataclasses.field(default_factory=list)  # (title, options)
    commands: list = dataclasses.field(default_factory=list)  # (name, description)
    footer: list = dataclasses.field(default_factory=list)  # lines

    @property
    def options(self):
        return [option for _, options in self.groups for option in options]


# The types and checks of CLI11, between a value's name and the words REQUIRED, Excludes: and Needs:.
LEFT = re.compile(r"(?P<names>\S+)(?: (?!REQUIRED|Needs:|Excludes:)(?P<value>[^\s:{]+)(?::(?P<check>\{[^}]*\}|\w+ in \[[^\]]*\]|POSITIVE))?)?(?P<repeated> \.\.\.)?"
                  r"(?P<required> REQUIRED)?(?: Needs: (?P<needs>.+?))?(?: Excludes: (?P<excludes>.+?))?")


def parse_option(left, text):
    found = LEFT.fullmatch(left)
    if not found:
        raise HelpError(f"cannot read the option '{left}'")
    names, check = found["names"].split(","), found["check"] or ""
    value = found["value"] or ""
    if not names[0].startswith("-"):
        value = names[0]
    option = Option(names, {"TEXT": "WORD", "UINT": "N", "INT": "N", "FLOAT": "X"}.get(value, value), text=text)
    if check.startswith("{"):
        option.choices = check[1:-1].split(",")
    elif check == "POSITIVE":
        option.limits = "Above 0"
    elif check:
        option.limits = "From " + " to ".join(check[check.index("[") + 1:-1].split(" - "))
    option.required, option.repeated = bool(found["required"]), bool(found["repeated"])
    option.excludes = (found["excludes"] or "").split()
    return option


def entries(lines, column):
    """(left, right) of each entry of a section; a left part that reaches the column has its text on the next line."""
    found = []
    for line in lines:
        if line.startswith(" " * column) and found:
            found[-1][1] = (found[-1][1] + " " + line.strip()).strip()
        elif line[column - 1:column] == " ":
            found.append([line[:column].strip(), line[column:].strip()])
        else:
            found.append([line.strip(), ""])
    return found


def parse_help(name, text):
    """The command that a help text of CLI11 describes."""
    command, lines = Command(name), text.rstrip("\n").split("\n")
    column = next((len(m[1]) for m in (re.match(r"(  -h,--help +)\S", line) for line in lines) if m), None)
    usage = next((i for i, line in enumerate(lines) if line.startswith("Usage: ")), None)
    if column is None or usage is None:
        raise HelpError(f"the help of '{name}' has no line 'Usage: …' or no option '-h,--help'")
    command.description, command.usage = " ".join(lines[:usage]).strip(), lines[usage][len("Usage: "):].strip()
    at = usage + 1
    while at < len(lines):
        if not lines[at].strip():
            at += 1
            continue
        title, end = lines[at].rstrip(), at + 1
        while end < len(lines) and lines[end].startswith("  "):
            end += 1
        section = entries(lines[at + 1:end], column)
        if title == "Positionals:":
            command.positionals = [parse_option(*entry) for entry in section]
        elif title == "Subcommands:":
            command.commands = [tuple(entry) for entry in section]
        elif title.endswith(":") and end > at + 1 and lines[at + 1].startswith("  -"):
            command.groups.append((title[:-1], [parse_option(*entry) for entry in section]))
        else:
            break
        at = end
    command.footer = lines[at:]
    for positional in command.positionals:  # a list "Kinds:" in the footer holds the values of KIND
        heading = f"{positional.value.capitalize()}s:"
        if heading in command.footer:
            for line in command.footer[command.footer.index(heading) + 1:]:
                if not line.startswith("  "):
                    break
                positional.choices.append(line.split()[0])
    return command


def describe(program):
    """(version, the command and its sub-commands), as the program tells them."""
    def say(*arguments):
        return subprocess.run([*program, *arguments], check=True, capture_output=True, text=True, timeout=60).stdout
    top = parse_help(pathlib.Path(program[-1]).stem, say("--help"))
    return say("--version").split()[-1], top, [parse_help(f"{top.name} {name}", say(name, "--help")) for name, _ in top.commands]


def blocks(lines):
    """The footer: ("text", paragraph), ("term", tag, text) for rows of tables, ("title", heading) above these, ("code", lines) of the examples at its end."""
    paragraph = []
    examples = lines.index("Examples:") if "Examples:" in lines else len(lines)
    for i, line in enumerate(lines[:examples]):
        row = re.fullmatch(r"  (\S.*)\s{2,}(\S.*)", line)
        is_title = line.endswith(":") and i + 1 < len(lines) and lines[i + 1].startswith("  ")
        if (row or is_title or not line.strip()) and paragraph:
            yield "text", " ".join(paragraph)
            paragraph = []
        if row:
            yield "term", re.sub(" {2,}", "  ", row[1].strip()), row[2]
        elif is_title:
            yield "title", line[:-1]
        elif line.strip():
            paragraph.append(line.strip())
    if paragraph:
        yield "text", " ".join(paragraph)
    if lines[examples:]:
        yield "title", "Examples"
        yield "code", "\n".join(line.strip() for line in lines[examples + 1:])


# ---- man pages

def roff(text):
    """The text, with nothing in it that troff interprets."""
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq").replace("^", "\\(ha").replace("~", "\\(ti").replace("`", "\\(ga")
    text = "".join(c if ord(c) < 128 else f"\\[u{ord(c):04X}]" for c in text)
    return "\\&" + text if text.startswith((".", "\\(aq")) else text


def roff_option(option):
    value = f"\\fI{roff(option.value)}\\fR" if option.value else ""
    if not option.names[0].startswith("-"):
        tag = value
    else:
        tag = ", ".join(f"\\fB{roff(name)}\\fR" for name in option.names) + (" " + value if value else "")
    repeated = " ..." if option.repeated else ""
    choices = f"\n{roff('One of')} " + ", ".join(f"\\fB{roff(choice)}\\fR" for choice in option.choices) + "." if option.choices else ""
    excludes = f"\n{roff('Not with')} " + ", ".join(f"\\fB{roff(name)}\\fR" for name in option.excludes) + "." if option.excludes else ""
    return f".TP\n{tag}{repeated}\n{roff(option.sentence)}{choices if '-' in option.names[0] else ''}{excludes}\n"


def heading(title):
    """In capitals, but for options and names of files."""
    return " ".join(word if "/" in word or word.lstrip("(").startswith("-") else word.upper() for word in title.split())


def man_page(version, command, top, others):
    page = command.name.replace(" ", "-")
    synopsis = roff(command.usage.removeprefix(command.name).strip())
    out = [f".\\\" Made by tools/command_manual.py from the help of the command.\n.TH {roff(page.upper())} 1 \"\" \"{roff(f'{top.name} {version}')}\""
           f" \"{roff(f'{top.name} manual')}\"\n.SH NAME\n{roff(page)} \\- {roff(command.description[0].lower() + command.description[1:].rstrip('.'))}\n"
           f".SH SYNOPSIS\n.B {roff(command.name)}\n{synopsis}\n"]
    if command.positionals:
        out.append(".SH ARGUMENTS\n" + "".join(map(roff_option, command.positionals)))
    if command.commands:
        out.append(".SH COMMANDS\n" + "".join(f".TP\n\\fB{roff(name)}\\fR\n{roff(text)}. See \\fB{roff(top.name)}\\-{roff(name)}\\fR(1).\n"
                                              for name, text in command.commands))
    for title, options in command.groups:
        out.append(f".SH {roff(heading(title))}\n" + "".join(map(roff_option, options)))
    notes = []
    for kind, *parts in blocks(command.footer):
        if kind == "term":
            notes.append(f".TP\n\\fB{roff(parts[0])}\\fR\n{roff(parts[1])}\n")
        elif kind == "code":
            notes.append(f".RS\n.nf\n{roff(parts[0])}\n.fi\n.RE\n")
        else:
            notes.append((f".SS {roff(parts[0])}\n" if kind == "title" else f".PP\n{roff(parts[0])}\n"))
    if notes:
        out.append(".SH NOTES\n" + "".join(notes).replace(".PP\n", "", 1) if notes[0].startswith(".PP") else ".SH NOTES\n" + "".join(notes))
    also = [top.name] if command is not top else [other.name.replace(" ", "-") for other in others]
    out.append(".SH SEE ALSO\n" + ",\n".join(f"\\fB{roff(name)}\\fR(1)" for name in also) + "\n")
    return "".join(out)


def write_man(folder, version, top, others):
    for command in [top, *others]:
        (folder / (command.name.replace(" ", "-") + ".1")).write_text(man_page(version, command, top, others), encoding="ascii")


# ---- completions

def function_name(top):
    return "_" + top.name.replace("-", "_")


def bash_completion(top, others):
    def values(option):
        if option.choices:
            return f'{function_name(top)}_words "{" ".join(option.choices)}"'
        return function_name(top) + "_files" if option.is_file else ":"

    cases = []
    for command in others:
        word = command.name.split()[-1]
        for option in command.options:
            if option.value:
                cases.append(f"    {'|'.join(f'{word}/{name}' for name in option.names)}) {values(option)}; return ;;")
    words = [f"    {command.name.split()[-1]}/-*) {function_name(top)}_words \"{' '.join(n for o in command.options for n in o.names)}\" ;;\n"
             f"    {command.name.split()[-1]}/*) {values(command.positionals[0]) if command.positionals else ':'} ;;" for command in others]
    options = " ".join(name for option in top.options for name in option.names)
    f, newline = function_name(top), "\n"
    return f"""# bash completion for {top.name}. Made by tools/command_manual.py from the help of the command.
{f}_words() {{ mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur"); }}
{f}_files() {{ compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- "$cur"); }}
{f}() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} command=
  COMPREPLY=()
  if [[ $cur == = ]]; then cur=; elif [[ $prev == = ]]; then prev=${{COMP_WORDS[COMP_CWORD-2]}}; fi
  (( COMP_CWORD > 1 )) && command=${{COMP_WORDS[1]}}
  case $command/$prev in
{newline.join(cases)}
  esac
  case $command/$cur in
    /-*) {f}_words "{options}" ;;
    /*) {f}_words "{' '.join(name for name, _ in top.commands)}" ;;
{newline.join(words)}
  esac
}}
complete -F {f} {top.name}
"""


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def zsh_completion(top, others):
    def escaped(text):
        return re.sub(r"([\[\]:\\])", r"\\\1", text)

    def action(option):
        return f"({' '.join(option.choices)})" if option.choices else "_files" if option.is_file else " "

    def spec(option):
        if not option.names[0].startswith("-"):
            return quoted(f"1:{escaped(option.value)}:{action(option)}")
        value = f":{escaped(option.value)}:{action(option)}" if option.value else ""
        together = [name for name in option.names] + option.excludes
        exclude = f"({' '.join(together)})" if len(together) > 1 else ""
        names = [name + ("" if not value else "=" if name.startswith("--") else "+") for name in option.names]
        tail = quoted(f"[{escaped(option.sentence)}]{value}")
        return " ".join(quoted(exclude + name) + tail for name in names)

    f, newline = function_name(top), " \\\n"
    cases = "\n".join(f"        {command.name.split()[-1]})\n          _arguments -s \\\n" + newline.join(
        "            " + spec(option) for option in command.options + command.positionals) + " ;;" for command in others)
    names = "\n".join("        " + quoted(f"{name}:{escaped(text)}") for name, text in top.commands)
    return f"""#compdef {top.name}
# zsh completion for {top.name}. Made by tools/command_manual.py from the help of the command.
{f}() {{
  local curcontext=$curcontext state line
  typeset -A opt_args
  _arguments -C \\
{newline.join('    ' + spec(option) for option in top.options)} \\
    '1:command:->command' '*::argument:->arguments'
  case $state in
    command)
      local -a commands
      commands=(
{names}
      )
      _describe command commands ;;
    arguments)
      case $line[1] in
{cases}
      esac ;;
  esac
}}
{f} "$@"
"""


def fish_completion(top, others):
    def text(words):
        return "'" + words.replace("\\", "\\\\").replace("'", "\\'") + "'"

    def value(option):
        return f" -x -a {text(' '.join(option.choices))}" if option.choices else " -r -F" if option.is_file else " -x" if option.value else ""

    def line(condition, option):
        if not option.names[0].startswith("-"):
            return f"complete -c {top.name} -n {text(condition)}" + (f" -a {text(' '.join(option.choices))}" if option.choices else " -F")
        names = " ".join(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}" for name in option.names)
        return f"complete -c {top.name} -n {text(condition)} {names}{value(option)} -d {text(option.sentence)}"

    lines = [f"# fish completion for {top.name}. Made by tools/command_manual.py from the help of the command.", f"complete -c {top.name} -f"]
    lines += [line("__fish_use_subcommand", option) for option in top.options]
    lines += [f"complete -c {top.name} -n __fish_use_subcommand -a {name} -d {text(what)}" for name, what in top.commands]
    for command in others:
        condition = f"__fish_seen_subcommand_from {command.name.split()[-1]}"
        lines += [line(condition, option) for option in command.positionals + command.options]
    return "\n".join(lines) + "\n"


def write_completions(folder, top, others):
    for shell, name, make in (("bash", top.name, bash_completion), ("zsh", "_" + top.name, zsh_completion), ("fish", top.name + ".fish", fish_completion)):
        (folder / shell).mkdir(parents=True, exist_ok=True)
        (folder / shell / name).write_text(make(top, others), encoding="utf-8")


# ---- Markdown

def markdown(text):
    """The text, with options as code, and with nothing else in it that Markdown interprets."""
    return re.sub(r"(?<!\S)(--\w[\w-]*)|([\\`*_{}\[\]<>#|$~])", lambda match: f"`{match[1]}`" if match[1] else "\\" + match[2], text)


def markdown_option(option):
    tag = ", ".join(f"`{name}`" for name in option.names) if option.names[0].startswith("-") else ""
    tag += (" " if tag and option.value else "") + (f"*{markdown(option.value)}*" if option.value else "")
    choices = " One of " + ", ".join(f"`{choice}`" for choice in option.choices) + "." if option.choices and "-" in option.names[0] else ""
    excludes = " Not with " + ", ".join(f"`{name}`" for name in option.excludes) + "." if option.excludes else ""
    return f"{tag}\n: {markdown(option.sentence)}{choices}{excludes}\n\n"


def markdown_page(command, top):
    out = [f"# {command.name}\n\n{markdown(command.description.rstrip('.'))}.\n\n```text\n{command.usage}\n```\n\n"]
    if command.positionals:
        out.append("## Arguments\n\n" + "".join(map(markdown_option, command.positionals)))
    if command.commands:
        out.append("## Commands\n\n" + "".join(f"[`{top.name} {name}`]({top.name}-{name}.md)\n: {markdown(text)}.\n\n" for name, text in command.commands))
    for title, options in command.groups:
        out.append(f"## {markdown(title)}\n\n" + "".join(map(markdown_option, options)))
    notes = []
    for kind, *parts in blocks(command.footer):
        if kind == "term":
            notes.append(f"{markdown(parts[0])}\n: {markdown(parts[1])}\n\n")
        elif kind == "code":
            notes.append(f"```sh\n{parts[0]}\n```\n\n")
        else:
            notes.append(("### " if kind == "title" else "") + markdown(parts[0]) + "\n\n")
    if command.commands:
        notes.append("```{toctree}\n:hidden:\n\n" + "\n".join(f"{top.name}-{name}" for name, _ in command.commands) + "\n```\n")
    return "".join(out) + ("## Notes\n\n" if command.footer else "") + "".join(notes)


def write_markdown(folder, top, others):
    for command in [top, *others]:
        (folder / (command.name.replace(" ", "-") + ".md")).write_text(markdown_page(command, top), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description="Writes man pages, completions and pages of Markdown from the help of a command.")
    parser.add_argument("command", nargs="+")
    for what in ("man", "completions", "markdown"):
        parser.add_argument(f"--{what}", type=pathlib.Path, metavar="DIR")
    arguments = parser.parse_args()
    try:
        version, top, others = describe(arguments.command)
    except (HelpError, OSError, subprocess.SubprocessError) as error:
        sys.exit(f"command_manual.py: {error}")
    for folder in (arguments.man, arguments.completions, arguments.markdown):
        if folder:
            folder.mkdir(parents=True, exist_ok=True)
    if arguments.man:
        write_man(arguments.man, version, top, others)
    if arguments.completions:
        write_completions(arguments.completions, top, others)
    if arguments.markdown:
        write_markdown(arguments.markdown, top, others)


if __name__ == "__main__":
    main()
