#!/usr/bin/python3
"""How long functions are, and how much they take: at most 60 lines and 8 parameters; a system at most 8 members.

usage: sizes.py [ROOT] [--list]

A function counts from the first line of its signature to its closing brace, with the lambdas inside; a lambda's own
parameters count like a function's. Key tables (declare_* in scenes) may be of any length: they are data. What a
system takes are the members of its struct in a *systems.hpp; a bundle of columns counts as one, and holds at most 8
itself. --list prints the longest functions, signatures and systems. Exit code 1 when something is beyond a limit.

clang-tidy measures the same functions by the compiler's own parser (readability-function-size in .clang-tidy), in an
hour instead of a second.
"""
import re
import statistics
import sys
from collections import namedtuple
from pathlib import Path

FOLDERS = ("engine", "components", "systems", "scenes", "cli", "tests", "bench")
SUFFIXES = {".hpp", ".cpp", ".h", ".ipp", ".inl"}
MOST_LINES = 60
MOST_PARAMETERS = 8
MOST_MEMBERS = 8
KEY_TABLES = re.compile(r"^scenes/(keys|records|study|volts)/declare_\w+\.cpp$")

Function = namedtuple("Function", "file line name lines parameters")
Record = namedtuple("Record", "file line name members is_system")

# Everything that is not code but may look like it. A raw string's end is its own delimiter.
NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(?P<tag>[^\s()\\]*)\(.*?\)(?P=tag)"|"(?:\\.|[^"\\\n])*"'
                     r"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'|^[ \t]*#(?:\\\n|[^\n])*", re.S | re.M)
OPEN, CLOSE = "([{", ")]}"
BLOCK = re.compile(r"^(?:else\b|if\b|for\b|while\b|do\b|switch\b|try\b|catch\b|case\b|default\b)")
RECORD = re.compile(r"^(?:template\s*<.*?>\s*)?(?:requires\b.*?)?(?:struct|class|union)\s+(?:alignas\([^)]*\)\s*)?"
                    r"(?P<name>[\w:<>, ]*?)\s*(?:final\s*)?(?::[^:].*)?$", re.S)
# (From the beginning of the white space: blanked comments are much of it, and each start in its middle would be tried.)
SPECIFIERS = re.compile(r"(?<!\s)\s*(?:"
                        r"\b(?:const|override|final|mutable|noexcept|try)\b|&&?|->[^(){};]*(?:\([^()]*\))?[^(){};]*"
                        r"|\bnoexcept\s*\([^()]*\)|\brequires\b[^{};]*)\s*$", re.S)


def code_of(text):
    """The text with comments, literals and directives blanked, line by line the same."""
    def blank(match):
        kept = '""' if match[0][0] in "\"'R" else ""
        return kept + "\n".join(" " * len(line) for line in match[0][len(kept):].split("\n"))
    return NO_CODE.sub(blank, text)


def groups_of(text, opening, closing):
    """Begin and end of every outermost group of brackets."""
    depth, begin = 0, 0
    for at, c in enumerate(text):
        if c in opening:
            if depth == 0:
                begin = at
            depth += 1
        elif c in closing and depth:
            depth -= 1
            if depth == 0:
                yield begin, at


def count_of(parameters):
    """How many parameters lie between two parentheses."""
    text = re.sub(r"->|[<>]=|<<|operator\s*[<>]", " ", parameters)
    if not text.strip() or text.strip() == "void":
        return 0
    depth = commas = 0
    for c in text:
        depth += (c in "([{<") - (c in ")]}>")
        commas += c == "," and depth == 0
    return commas + 1


def without_specifiers(header):
    while (shorter := SPECIFIERS.sub("", header)) != header:
        header = shorter
    return header.rstrip()


def lambda_parameters(header):
    """Of `... [captures]<...>(parameters) mutable -> T`, or None if the header ends in no lambda."""
    match = re.search(r"(?:^|[\s(,={&|?:!+]|\breturn)(\[[^\[\]]*\])\s*(?:<[^()]*>\s*)?"
                      r"(?:\((?P<parameters>(?:[^()]|\([^()]*\))*)\))?[^()\[\]{};]*$", header, re.S)
    if not match or re.search(r"\boperator\s*$", header[:match.start(1)]):
        return None
    return count_of(match["parameters"] or "")


def signature_of(header):
    """Name and number of parameters of a function's header, or None."""
    text = without_specifiers(re.sub(r"\boperator\s*\(\s*\)", "operator__call", header))
    text = re.sub(r"^(?:template\s*<(?:[^<>]|<(?:[^<>]|<[^<>]*>)*>)*>\s*)+", lambda m: " " * len(m[0]), text)
    if not text.endswith((")", "}")):
        return None
    for begin, end in groups_of(text, "(", ")"):
        name = re.search(r"([\w~:]+(?:<[^()]*>)?(?:::[\w~]+)*|operator\s*[^\s\w()]+)\s*$", text[:begin])
        if not name or name[1] in ("requires", "noexcept", "decltype", "alignas", "explicit", "__attribute__"):
            continue
        if re.search(r"(?<![=!<>])=(?!=)", re.sub(r"operator\s*\S+", "", text[:begin])):
            return None  # an initialiser
        return name[1].strip().replace("operator__call", "operator()"), count_of(text[begin + 1:end])
    return None


class Walk:
    """Goes through a file's brackets and notes functions and records."""

    def __init__(self, file, text):
        self.file, self.code = file, code_of(text)
        self.functions, self.records, self.stack = [], [], []
        self.hidden = []  # functions of anonymous namespaces
        self.begin = 0  # of the statement at hand
        self.run()

    def line(self, at):
        return self.code.count("\n", 0, at) + 1

    def run(self):
        for match in re.finditer(r"[()\[\]{};]", self.code):
            at, c = match.start(), match[0]
            inside = self.stack[-1] if self.stack else None
            if c in "([":
                self.stack.append((c, None, self.begin))
            elif c == "{":
                self.stack.append((c, self.opened(at), self.begin))
                self.begin = at + 1
            elif c in ")]":
                self.begin = self.stack.pop()[2]
            elif c == "}":
                _, what, begin = self.stack.pop()
                self.begin = begin if what == "list" else at + 1
                if isinstance(what, tuple):
                    self.closed(what, at)
            elif c == ";" and (inside is None or inside[0] == "{"):
                self.begin = at + 1

    def place(self):
        """What is around: 'function' code, or declarations."""
        for _, what, _ in reversed(self.stack):
            if isinstance(what, tuple):
                return what[0]
        return "declarations"

    def opened(self, at):
        raw = self.code[self.begin:at]
        header = re.sub(r"^(?:\s*(?:public|private|protected)\s*:(?!:))+", "", raw.strip()).strip()
        begin = self.begin + len(raw) - len(raw.lstrip())
        parameters = lambda_parameters(header)
        if parameters is not None:
            return ("lambda", begin, at, "lambda", parameters)
        if self.stack and self.stack[-1][0] != "{":
            return "list"
        if header == "namespace":
            return "anonymous"
        if not header or BLOCK.match(header) or re.search(r"\bnamespace\b|^extern\b", header):
            return "block"
        if re.search(r"\benum\b", header):
            return "block"
        record = RECORD.match(header)
        if record and "(" not in record["name"]:
            return ("record", begin, at, record["name"].strip(), 0)
        if self.place() in ("declarations", "record"):
            signature = signature_of(header)
            if signature:
                return ("function", begin, at, *signature)
        return "list"

    def closed(self, what, end):
        kind, begin, brace, name, parameters = what
        if kind == "record":
            self.records.append(Record(self.file, self.line(begin), name, *self.members(brace, end)))
        else:
            lines = self.line(end) - self.line(begin) + 1
            function = Function(self.file, self.line(begin), name, lines, parameters)
            self.functions.append(function)
            around = [what for _, what, _ in self.stack]
            if "anonymous" in around and not any(isinstance(what, tuple) for what in around):
                self.hidden.append(function)

    def members(self, brace, end):
        """Number of data members between two braces, and whether the record can be called."""
        body = self.code[brace + 1:end]
        for begin, last in reversed(list(groups_of(body, "{", "}"))):
            of_function = without_specifiers(body[:begin]).endswith((")", "}"))
            body = body[:begin] + (";" if of_function else "{}") + body[last + 1:]
        count = 0
        for statement in re.sub(r"\b(?:public|private|protected)\s*:(?!:)", "", body).split(";"):
            statement = statement.strip()
            if statement and "(" not in re.sub(r"[={].*", "", statement, flags=re.S) and not re.match(
                    r"using\b|friend\b|static\b|typedef\b|enum\b|template\b|(?:struct|class)\s+\w+\s*(?:\{\s*\})?$",
                    statement):
                plain = re.sub(r"<[^;]*>|\{[^;]*?\}", "", statement)
                count += 1 + plain.count(",")
        return count, bool(re.search(r"\bvoid operator\(\)\s*\(", body))


def sources_of(root):
    return [f for folder in FOLDERS for f in sorted((root / folder).rglob("*")) if f.suffix in SUFFIXES]


def measured(root):
    functions, records = [], []
    for source in sources_of(root):
        walk = Walk(source.relative_to(root).as_posix(), source.read_text(encoding="utf-8"))
        if walk.stack:
            sys.exit(f"sizes: {walk.file}: brackets do not match: what was read is not what the compiler reads")
        functions += walk.functions
        if walk.file.startswith(("systems/", "components/")):
            records += walk.records
    return functions, records


def is_bundle(record):
    """Of accesses: what a system declares, or columns that several of them declare as one."""
    return re.search(r"(systems|bundles)\.hpp$", record.file) is not None


def faults(functions, records):
    for f in functions:
        if f.lines > MOST_LINES and not KEY_TABLES.match(f.file):
            yield f"{f.file}:{f.line}: {f.name} has {f.lines} lines, at most {MOST_LINES}: name its parts"
        if f.parameters > MOST_PARAMETERS:
            yield (f"{f.file}:{f.line}: {f.name} takes {f.parameters} parameters, at most {MOST_PARAMETERS}: "
                   "those that belong together are one struct")
    for r in filter(is_bundle, records):
        if r.members > MOST_MEMBERS:
            yield f"{r.file}:{r.line}: {r.name} has {r.members} members, at most {MOST_MEMBERS}: bundle them"


def listed(title, entries, size, least):
    """Those of at least a size, largest first."""
    print(f"\n{title}")
    for entry in sorted(filter(lambda e: size(e) >= least, entries), key=lambda e: (-size(e), e.file)):
        print(f"  {size(entry):4}  {entry.file}:{entry.line}: {entry.name}")


def middle(values):
    values = list(values)
    return f"at most {max(values)}, {statistics.median(values):g} in the median"


def main():
    words = [word for word in sys.argv[1:] if word != "--list"]
    root = Path(words[0] if words else Path(__file__).parents[2]).resolve()
    functions, records = measured(root)
    systems = [r for r in records if r.is_system]
    if not functions or not systems:
        sys.exit(f"sizes: no functions or no systems under {root}: is this the root?")
    wrong = list(faults(functions, records))
    print(*wrong, sep="\n", end="\n" if wrong else "")
    if "--list" in sys.argv:
        listed("lines of a function, key tables apart",
               [f for f in functions if not KEY_TABLES.match(f.file)], lambda f: f.lines, 50)
        listed("parameters of a function or lambda", functions, lambda f: f.parameters, 7)
        listed("members of a system", systems, lambda r: r.members, 7)
        print()
    named = [f for f in functions if f.name != "lambda"]
    print(f"sizes: {len(named)} functions: lines {middle(f.lines for f in named if not KEY_TABLES.match(f.file))}; "
          f"parameters {middle(f.parameters for f in named)}")
    print(f"sizes: {len(systems)} systems: members {middle(r.members for r in systems)}; {len(wrong)} beyond a limit")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
