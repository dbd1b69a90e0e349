#!/usr/bin/env python3
"""Prints a public header as Doxygen has to see it: the conventions of its comments, written out.

- The comment at the top describes the file. Indented lines of a comment are code.
- A comment describes all declarations up to the next empty line or comment.
- A `//` comment of its own in a class is the heading of the members that follow it; what it says holds for all.
  One that says "as the functions of" explains those that have no comment.
- Fields without a comment are explained by that of their record, which must have one.
- What serves the library alone, and the hash of ids, is left out.
- Calls, constants and fields of kinesphere.h without a comment mean what their counterparts in C++ mean.

Usage: doxygen_filter.py HEADER
"""

import re
import sys
from pathlib import Path

header = Path(sys.argv[1])
include = next(folder for folder in header.resolve().parents if folder.name == "include")
in_c = header.suffix == ".h"

# A declaration begins at the indentation of its comment, neither with a brace nor with an access specifier.
BEGIN = re.compile(r"( *)[A-Za-z_~\[]")
NO_DECLARATION = re.compile(r" *(public|private|protected|namespace|extern|using namespace|case|default)\b")
FIELD = re.compile(r" +(?!using|friend|static|return)(const )?[\w:<>,*& ]+ [\w, ]+(\[\w+\])?( = .+|\{.*\})?;")
COUNTERPARTS = {
    "KS_ERROR_": "ErrorCode",
    "KS_EVENT_": "EventKind",
    "KS_WALL_": "Wall",
    "KS_CONTACTS_": "ContactEvents",
    "KS_MONITOR_": "MonitorEventKind",
    "KS_VERDICT_": "Verdict",
}
OBVIOUS = {
    r"ks_\w+_init\(": "Fills a record with the library's defaults. `struct_size` is the size of the caller's record.",
    r"ks_(default|new)_\w+\(": "Returns a record with its size, and else the defaults.",
    r"operator(==|<=>|<)\(": "Compares the two, member by member.",
    r"operator=\(\w+ ?&&": "Moves the other one here.",
    r"\w+\(\w+ ?&&\w*\) noexcept": "Moves the other one into a new one.",
}


def members_of(kind: str) -> str:
    """The text of a class, struct or enum of the C++ headers."""
    for source in include.rglob("*.hpp"):
        found = re.search(rf"^(class|struct|enum class) {kind}\b.*?^}};", source.read_text(), re.M | re.S)
        if found:
            return found[0]
    return ""


def counterpart(line: str, record: str) -> str:
    """The comment of a declaration in C that has none, if something in C++ has its meaning; else nothing."""
    if call := re.search(r"\bks_(world|monitor)_(\w+)\(", line):
        kind, name = call[1].capitalize(), call[2]
    elif constant := re.match(r" *((KS_[A-Z]+_)(\w+)) =", line):
        kind, name = COUNTERPARTS.get(constant[2], ""), constant[3].lower()
    elif field := re.match(r" +[\w ]+ \*?(\w+)(\[\d\])?;", line):
        kind, name = "".join(part.capitalize() for part in record.split("_")[1:]), field[1]
    else:
        return ""
    if kind and re.search(rf"\b{name}\b", members_of(kind)):
        return f"Means what kinesphere::{kind}::{name} means, with its units, errors and cost."
    return ""


def as_text(line: str) -> str:
    """A line without what Doxygen would take for tags, and with the words in bold that people look for."""
    line = re.sub(r"<(\w+)>", r"\\<\1\\>", line)
    return re.sub(
        r"(^|[.;] )( ?)(Errors|Cost|Threads|Lifetimes|Guarantee|Throws)(?= |:|\. )", r"\1\2<b>\3</b>", line
    )


def with_code(comment: list[str]) -> list[str]:
    """Marks the indented lines of a comment, but for those of a list, as code."""
    marked, in_code, in_list = [], False, False
    for line in comment:
        text = line.lstrip().lstrip("/")
        in_list = text.startswith("   - ") or (in_list and text.startswith("     "))
        is_code = text.startswith("   ") and not in_list
        if is_code != in_code and (is_code or text.strip()):
            marked.append("/// @code{.cpp}" if is_code else "/// @endcode")
            in_code = is_code
        marked.append("///" + (text if in_code else as_text(text)))
    return marked + ["/// @endcode"] * in_code


def text_of(comment: list[str]) -> str:
    return " ".join(line.lstrip().lstrip("/").strip() for line in comment)


# Of a line with several fields Doxygen would explain the first one alone.
SEVERAL = re.compile(r"^( +[\w:<>]+(?: [\w:<>]+)?) (\w+[^,;(]*(?:, \w+[^,;(]*)+);(.*)$", re.M)
HIDDEN = re.compile(
    r"^( *)template <(class Self, class Archive)?>\n *(static void serialize|struct std::hash).*?^\1\};?\n",
    re.M | re.S,
)


def one_by_one(found: re.Match[str]) -> str:
    return "\n".join(f"{found[1]} {field};{found[3]}" for field in found[2].split(", "))


lines = SEVERAL.sub(one_by_one, HIDDEN.sub("", header.read_text())).splitlines()
end = next(k for k, line in enumerate(lines) if not line.startswith("//"))
shown = ["/// @file"] + with_code(lines[:end])
comment: list[str] = []
depth, before, record, heading = -1, "", "", ""
explained: dict[int, bool] = {}  # by indentation: whether a record with a comment is open there
k = end
while k < len(lines):
    line = lines[k]
    if re.match(r" *///(?!<)", line):
        comment = []
        while re.match(r" *///(?!<)", lines[k]):
            comment.append(lines[k])
            k += 1
        comment = with_code(comment)
        depth, before = len(lines[k]) - len(lines[k].lstrip()), ""
        shown += comment
        continue
    if line.startswith("  // ") and not before and not in_c:
        about = []
        while re.match(r"  //(?!/)", lines[k]):
            about.append(lines[k])
            k += 1
        if not lines[k]:
            shown += ["/// @}"] * bool(heading)
            heading = text_of(about)
            title, _, rest = heading.partition(". ")
            shown += [f"/// @name {title.rstrip('.')}", f"/// {rest}", "/// @{"]
        comment = []
        continue
    if heading and (line.startswith("}") or re.match(r" private:", line)):
        shown.append("/// @}")
        heading = ""
    if found := re.match(r"( *)(?:typedef )?(struct|class|union) (\w+).*{$", line):
        record = found[3]
        explained[len(found[1]) + 2] = found[2] == "struct" and bool(comment)
    begin = BEGIN.match(line)
    if not line.strip() or (line.lstrip().startswith("//") and not before):
        comment, before = [], ""
    elif begin and not NO_DECLARATION.match(line) and "///<" not in line:
        indent = len(begin[1])
        obvious = [text for pattern, text in OBVIOUS.items() if re.search(pattern, line)]
        if comment and indent == depth and (not before or re.match(r" *template <.*>$", before)):
            pass  # its comment has been shown; what follows `template <...>` is the same declaration
        elif obvious:
            shown.append("/// " + obvious[0])
        elif in_c and (meaning := counterpart(line, record)):
            shown.append("/// " + meaning)
        elif comment and indent == depth and not re.search(r"\) (const )?(override|final);|^ *~", line):
            shown += comment  # overriding functions inherit theirs
        elif indent == 2 and re.search(r"as the functions|of equal name", heading):
            shown.append("/// " + heading)
        elif FIELD.match(line) and explained.get(indent):
            shown.append("/// The description of the record explains this field.")
    if begin and len(begin[1]) == depth:
        before = line
    shown.append(line)
    k += 1
print("\n".join(shown))
