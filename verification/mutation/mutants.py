"""Places in C++ source where a fault can be planted, and the source with all of them behind switches.

The source is read as .clang-format leaves it: a binary operator has a space on either side, and the
brackets of a template have none. What a fault would make of the source is the same as if its text
were changed: no operator here changes how the rest of an expression is read.
"""
import dataclasses
import hashlib
import re


@dataclasses.dataclass(frozen=True)
class Mutant:
    """One fault: `edits` are (position, end, text) with {0} for the fault's number."""
    file: str
    line: int
    operator: str
    text: str      # of the line, without what surrounds it
    column: int    # within that text
    edits: tuple

    @property
    def name(self):
        """The same as long as its line stays the same, wherever that moves."""
        return f"{self.file} {self.operator} @{self.column} {self.text}"

    @property
    def place(self):
        return f"{self.file}:{self.line}"


def code_mask(source):
    """Of each character: is it code, and no comment, string or preprocessor line?"""
    mask = [True] * len(source)
    pattern = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|^#[^\n]*'
    for found in re.finditer(pattern, source, re.S | re.M):
        mask[found.start():found.end()] = [False] * (found.end() - found.start())
    return mask


OPENING, CLOSING = "([{", ")]}"


class Source:
    def __init__(self, file, source):
        self.file, self.source, self.mask = file, source, code_mask(source)
        self.mutants = []

    def closing(self, opening):
        """Where the bracket that opens there is closed."""
        depth = 0
        for i in range(opening, len(self.source)):
            if self.mask[i] and self.source[i] in OPENING:
                depth += 1
            elif self.mask[i] and self.source[i] in CLOSING:
                depth -= 1
                if depth == 0:
                    return i
        return len(self.source)

    def end_of_operand(self, start, stops):
        """The first place from `start` on where one of these stands outside of brackets."""
        depth, i = 0, start
        while i < len(self.source):
            if self.mask[i]:
                if depth == 0 and any(self.source.startswith(s, i) for s in stops):
                    return i
                if self.source[i] in OPENING:
                    depth += 1
                elif self.source[i] in CLOSING:
                    depth -= 1
                    if depth < 0:
                        return i
            i += 1
        return i

    def start_of_operand(self, end, stops):
        """The place behind the last of these before `end`, outside of brackets."""
        depth, i = 0, end
        while i > 0:
            if self.mask[i - 1]:
                if depth == 0:
                    for s in stops:
                        if self.source.endswith(s, 0, i):
                            return i
                if self.source[i - 1] in CLOSING:
                    depth += 1
                elif self.source[i - 1] in OPENING:
                    depth -= 1
                    if depth < 0:
                        return i
            i -= 1
        return 0

    def add(self, operator, at, *edits):
        begin = self.source.rfind("\n", 0, at) + 1
        end = self.source.find("\n", at)
        line = self.source[begin:end]
        text = re.sub(r"\s*//.*", "", line).strip()
        column = at - begin - (len(line) - len(line.lstrip()))
        number = self.source.count("\n", 0, at) + 1
        self.mutants.append(Mutant(self.file, number, operator, text, column, tuple(edits)))

    def around(self, operator, at, begin, end, before, after=")"):
        """A fault that is written before and after a piece of the source."""
        while self.source[begin] in " \n":
            begin += 1
        while self.source[end - 1] in " \n":
            end -= 1
        self.add(operator, at, (begin, begin, before), (end, end, after))

    def matches(self, pattern, flags=0):
        for found in re.finditer(pattern, self.source, flags):
            if self.mask[found.start()] and self.mask[max(found.start(), found.end() - 1)]:
                yield found


FORCED_TRUE = "::touchstone::planted::is({0}) || ("
FORCED_FALSE = "!::touchstone::planted::is({0}) && ("


def plant_branches(s):
    """Conditions and results that are forced."""
    for found in s.matches(r"\b(?:else )?if \("):
        opening, closing = found.end() - 1, s.closing(found.end() - 1)
        condition = s.source[opening + 1:closing]
        if ";" in condition or condition.startswith("const ") or "constexpr" in found.group():
            continue
        s.around("condition forced true", opening + 1, opening + 1, closing, FORCED_TRUE)
        s.around("condition forced false", opening + 1, opening + 1, closing, FORCED_FALSE)
    for found in s.matches(r"\breturn "):
        end = s.end_of_operand(found.end(), ";")
        value = s.source[found.end():end]
        outside = re.sub(r"\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)|\{.*\}", "", value, flags=re.S)
        if " ? " in outside or value.lstrip().startswith("{"):
            continue
        if re.search(r" (?:<|>|<=|>=|==|!=|&&|\|\|) ", outside):
            s.around("result forced true", found.end(), found.end(), end, FORCED_TRUE)
            s.around("result forced false", found.end(), found.end(), end, FORCED_FALSE)
    for found in s.matches(r"\breturn (true|false);"):
        s.around("result inverted", found.start(1), found.start(1), found.end(1),
                 "::touchstone::planted::is({0}) != (")
    for found in s.matches(r" \? "):
        begin = s.start_of_operand(found.start(), [" = ", "return ", ", ", " ? ", " : ", "; ", ";\n", "{\n"])
        s.around("alternatives exchanged", found.start() + 1, begin, found.start(),
                 "::touchstone::planted::is({0}) != bool(")


def plant_operands(s):
    """A condition of several that is left out."""
    stops = [" && ", " || ", " ? ", " : ", ";", ", ", "\n  && ", "=>"]
    for found in s.matches(r" (&&|\|\|)(?=[ \n])"):
        neutral = FORCED_TRUE if found.group(1) == "&&" else FORCED_FALSE
        end = s.end_of_operand(found.end(), [" &&", " ||", " ?", " :", ";", ", "])
        s.around("second operand left out", found.start(1), found.end(), end, "(" + neutral, "))")
        begin = s.start_of_operand(found.start(),
                                   ["&& ", "|| ", "&&\n", "||\n", " = ", "return ", ", ", "? ", ": "])
        s.around("first operand left out", found.start(1), begin, found.start(), "(" + neutral, "))")


def plant_operators(s):
    loops = [(f.end() - 1, s.closing(f.end() - 1)) for f in s.matches(r"\bfor \(")]
    for found in s.matches(r" (\+|-|\*|/|<|>|<=|>=|==|!=)(?=[ \n])"):
        at = found.start(1)
        if any(lo < at < hi for lo, hi in loops):
            continue
        symbol = found.group(1)
        s.add(f"{symbol} replaced", at,
              (found.end(), found.end(), " ::touchstone::planted::Replaced{{{0}}} " + symbol))
        if symbol in ("-", "/"):
            s.add(f"{symbol} exchanged", at,
                  (found.end(), found.end(), " ::touchstone::planted::Exchanged{{{0}}} " + symbol))
    for found in s.matches(r"(?<=[(,=?:{+*/\-] )-(?=[\w(])|(?<=[(\[{])-(?=[\w(])|(?<=return )-(?=[\w(])"):
        # What is divided by −b is divided by the sign and by b.
        operator = "/" if s.source[found.start() - 2] == "/" else "*"
        s.add("minus left out", found.start(),
              (found.start(), found.end(), f"::touchstone::planted::sign({{0}}) {operator} "))


def plant_functions(s):
    for found in s.matches(r"\bstd::(abs|min|max|sqrt|sin|cos|acos|atan2|copysign|clamp)\("):
        word = {"abs": "left out", "sqrt": "left out", "clamp": "left out"}.get(found.group(1),
                                                                              "replaced")
        s.add(f"{found.group(1)} {word}", found.start(),
              (found.start(), found.end(), "::touchstone::planted::" + found.group(1) + "({0}, "))
    for found in s.matches(r"\.cwiseAbs\(\)"):
        s.add("cwiseAbs left out", found.start(),
              (found.start(), found.end(),
               ".unaryExpr([](double x) {{ return ::touchstone::planted::abs({0}, x); }})"))


def plant_numbers(s):
    for found in s.matches(r"(?<![\w.])(\d+\.\d+(?:e[-+]?\d+)?|\d+e[-+]?\d+)(?![\w.])"):
        if float(found.group()) == 0:
            continue
        small = "e-" in found.group() or float(found.group()) < 0.01
        for factor in ("100", "0.01") if small else ("2", "0.5"):
            edits = [(found.start(), found.end(),
                      "::touchstone::planted::scaled({0}, %s, %s)" % (factor, found.group()))]
            # A number that a switch changes is no constant expression.
            begin = max(s.source.rfind(c, 0, found.start()) for c in ";{}")
            constant = re.search(r"\bconstexpr double\b", s.source[begin:found.start()])
            if constant:
                before = s.source[begin:begin + constant.start()]
                edits.append((begin + constant.start(), begin + constant.end(),
                              "inline const double" if "static " in before else "const double"))
            s.add(f"{found.group()} times {factor}", found.start(), *edits)


def plant_loops(s):
    for found in s.matches(r"\bfor \(int \w+ = (-?\w+); \w+ <=? "):
        end = s.end_of_operand(found.end(), [";", " && "])
        s.add("loop ends early", found.end(), (end, end, " - ::touchstone::planted::is({0})"))
        s.add("loop begins late", found.start(1),
              (found.end(1), found.end(1), " + ::touchstone::planted::is({0})"))
    for found in s.matches(r"\bfor \(const double \w+ : \{"):
        end = s.closing(found.end() - 1)
        comma = s.source.find(",", found.end())
        if comma < end:
            first = s.source[found.end():comma]
            s.add("loop without its last", found.end(),
                  (comma + 1, end, " ::touchstone::planted::is({0}) ? %s : %s" %
                   (first, s.source[comma + 1:end].strip())))


def plant_statements(s):
    """Calls and assignments that are left out."""
    keywords = r"(?!return\b|if\b|for\b|while\b|else\b|const\b|constexpr\b|double\b|int\b|auto\b|static\b|throw\b|using\b|switch\b|case\b|default\b|break\b|template\b|inline\b|explicit\b|bool\b|struct\b|class\b|enum\b|operator\b)"
    pattern = r"(?<=[;{})\n])([ \n]+)" + keywords + r"(\+\+|--|\*)?([a-z_][\w.]*(?:->\w+|\[[^\]\n]*\]|\([\w ]*\)\.\w+\(\)|\([^()\n]*\))?(?:\.\w+)*)( [-+*/]?= |\()"
    for found in s.matches(pattern):
        begin = found.start() + len(found.group(1))
        previous = s.source[:found.start() + 1].rstrip()
        if not previous or previous[-1] not in ";{})":
            continue
        end = s.end_of_operand(begin, [";"])
        statement = s.source[begin:end]
        if end >= len(s.source) or s.source[end] != ";" or "{\n" in statement or "\n\n" in statement:
            continue
        s.around("statement left out", begin, begin, end,
                 "::touchstone::planted::is({0}) ? (void)0 : (void)(")


def mutants_of(file, source):
    """Every fault that can be planted, in the order of the source."""
    s = Source(file, source)
    for plant in (plant_branches, plant_operands, plant_operators, plant_functions, plant_numbers,
                  plant_loops, plant_statements):
        plant(s)
    s.mutants.sort(key=lambda m: (m.edits[0][0], m.operator))
    return s.mutants


def draw(mutants, count, seed):
    """Evenly over lines: one fault of each line that has any, and of these lines `count`. What is
    drawn of a line depends on its own text alone, so that other lines may change."""
    lines, seen = {}, {}
    for m in mutants:
        key = (m.file, m.line)
        if key not in lines:
            again = seen[m.file, m.text] = seen.get((m.file, m.text), 0) + 1
            lines[key] = (again, [])
        lines[key][1].append(m)

    def rank(*parts):
        return hashlib.sha256("\0".join(map(str, (seed, *parts))).encode()).hexdigest()

    drawn = []
    for (file, _), (again, of_line) in lines.items():
        one = min(of_line, key=lambda m: rank(m.name))
        drawn.append((rank("line", file, one.text, again), one))
    return [m for _, m in sorted(drawn, key=lambda x: x[0])[:count]]


def planted(source, numbered):
    """The source with these faults, as pairs of a number and a mutant, behind their switches."""
    edits, constants = [], set()
    for number, mutant in numbered:
        for begin, end, text in mutant.edits:
            if text.endswith("const double"):
                if begin in constants:
                    continue
                constants.add(begin)
            edits.append((begin, end, text.format(number)))
    # Of two at one place what is inserted stands before what is replaced, and closing brackets first.
    edits.sort(key=lambda e: (e[0], e[1] > e[0], not e[2].startswith(")")))
    result, at = [], 0
    for begin, end, text in edits:
        if begin < at:
            raise ValueError(f"two faults at one place: {text}")
        result.append(source[at:begin] + text)
        at = end
    return "".join(result) + source[at:]
