# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
"""The texts of words that C++ sources hold, as a user meets them: joined over `+`, lines and formats, each gap as `…`.

    "log file " + path + ": " + error.what()   ->   log file …: …
    fmt::format("{} must be {}", key, type)    ->   … must be …

Neither types nor calls are followed. So a text that is appended or chosen by `?:` is a text of its own.
"""

import re
from pathlib import Path

GAP = "…"
TOKEN = re.compile(
    r'(?P<left_out>//[^\n]*|/\*.*?\*/|#[^\n]*)'
    r'|(?P<text>"(?:\\.|[^"\\\n])*")'
    r"|(?P<rest>'(?:\\.|[^'\\\n])+'|\w[\w.]*(?:'\w+)*|::|->|<<|&&|\|\||[+\-*/=!<>]=|\+\+|--|\S)", re.DOTALL)
ENDS = frozenset([",", ";", "?", ":", "=", "==", "!=", "+=", "<<", "&&", "||", "return"])
ESCAPES = {"n": "\n", "r": "\r", "t": "\t"}
WRAPPERS = ("", "string", "string_view")  # leave a text as it is
FORMATTERS = ("format", "number")  # begin with their text, its gaps marked; number() is of core/calibration


class Group(list):
    """What stands between two brackets, and the name before them."""

    def __init__(self, bracket):
        super().__init__()
        self.bracket = bracket


class Text(str):
    """A literal, without its quotes, and its line."""

    line = 0


def tokens(source):
    line, end = 1, 0
    for found in TOKEN.finditer(source):
        line += source.count("\n", end, found.start())
        end = found.start()
        if found.lastgroup == "text":
            text = Text(re.sub(r"\\(.)", lambda escaped: ESCAPES.get(escaped[1], escaped[1]), found[0][1:-1]))
            text.line = line
            yield text
        elif found.lastgroup == "rest":
            yield found[0]


def grouped(source):
    """Tokens, with what brackets enclose as a Group."""
    stack = [Group("")]
    for token in tokens(source):
        if not isinstance(token, Text) and token in ("(", "[", "{"):
            group = Group(token)
            stack[-1].append(group)
            stack.append(group)
        elif not isinstance(token, Text) and token in (")", "]", "}"):
            if len(stack) > 1:
                stack.pop()
        else:
            stack[-1].append(token)
    return stack[0]


def is_symbol(token, symbols):
    return isinstance(token, str) and not isinstance(token, Text) and token in symbols


def split(items, symbols):
    """[(the symbol before, items)]"""
    parts = [("", [])]
    for item in items:
        if is_symbol(item, symbols):
            parts.append((item, []))
        else:
            parts[-1][1].append(item)
    return parts


def last_name(items):
    """ "error" of `spdlog::error`, "add_option" of `app.add_option`; "" where there is none."""
    name = items[-1] if items else ""
    is_name = isinstance(name, str) and not isinstance(name, Text) and re.match(r"\w", name)
    return name.rsplit(".", 1)[-1] if is_name else ""


def adjacent(items):
    """Literals one behind the other, with names of the preprocessor between them; else None."""
    if not any(isinstance(item, Text) for item in items) or any(isinstance(item, Group) for item in items):
        return None
    return "".join(item if isinstance(item, Text) else GAP for item in items)


def operand(items):
    """Its text; None: a gap."""
    if items and isinstance(items[-1], Group) and items[-1].bracket == "(":
        name, inside = last_name(items[:-1]), items[-1]
        if name in WRAPPERS and len(split(inside, ENDS)) == 1:
            return chain(inside)
        if name in FORMATTERS:
            return adjacent(split(inside, ENDS)[0][1])
        return None
    return adjacent(items)


def chain(items):
    """What is joined by `+`; None without a text."""
    texts = [operand(part) for _, part in split(items, ("+",))]
    return None if all(text is None for text in texts) else "".join(GAP if text is None else text for text in texts)


def normal(text):
    """Gaps as `…`, no blanks at the ends."""
    for _ in range(2):  # a width may be a gap itself
        text = re.sub(r"\{[^{}\s]*\}|%[-+0-9.*lzh]*[a-zA-Z]", GAP, text)
    return re.sub(f"{GAP}+", GAP, text.replace("%%", "%")).strip()


def first_line(items):
    for item in items:
        if isinstance(item, Text):
            return item.line
        if isinstance(item, Group) and (line := first_line(item)):
            return line
    return 0


def remainder(name, group):
    """Without what is already part of the text around it."""
    if group.bracket == "(" and name in FORMATTERS and adjacent(split(group, ENDS)[0][1]) is not None:
        return group[group.index(",") + 1:] if "," in group else []
    if group.bracket == "(" and name in WRAPPERS and len(split(group, ENDS)) == 1 and chain(group) is not None:
        return [item for item in group if isinstance(item, Group)]
    return group


def texts(items, is_left_out, name=""):
    """(line, text) of all in `items`; is_left_out(name, group) of a group and the name before it."""
    for before, part in split(items, ENDS):
        text = chain(part)
        if text is not None:
            yield first_line(part), normal((GAP if before == "+=" else "") + text)
        for at, item in enumerate(part):
            if isinstance(item, Group):
                inner = last_name(part[:at])
                if not is_left_out(inner or name, item):
                    yield from texts(remainder(inner, item), is_left_out, inner or name)


def is_message(text):
    """One line of two words, or of one behind a colon."""
    if "\n" in text:
        return False
    words = re.findall(r"(?<![\w./-])[A-Za-z][a-z]+(?![\w/])", text)
    return len(words) >= 2 or re.search(": [a-z]{2}", text) is not None


def messages(folder, is_left_out, is_left_out_file=lambda path: False):
    """{text: [path:line]} of the sources below `folder`."""
    found = {}
    for path in sorted(path for part in ("core", "daemon", "firmware_link", "tools") for path in
                       (Path(folder) / part).rglob("*.[ch]pp")):
        name = path.relative_to(folder).as_posix()
        if is_left_out_file(name):
            continue
        for line, text in texts(grouped(path.read_text(encoding="utf-8")), is_left_out):
            if is_message(text):
                found.setdefault(text, []).append(f"{name}:{line}")
    return found
