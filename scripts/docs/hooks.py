"""Hooks of MkDocs: the pages and links that docs/ alone does not have. Markdown there is written for GitHub, too.

- Links to headers lead to the reference that Doxygen wrote; links to Markdown elsewhere to pages `project/...`; links
  to any other file or folder to pages `sources/...`, made here.
- The pages that scripts/docs.sh has made, as the reference of Python, are in the folder that KINESPHERE_GENERATED names.
- The first page gets a first screen (hero.py). KINESPHERE_LIVE names the folder of its live parts, if they have been
  built, and KINESPHERE_VIEWER is set if scripts/docs.sh will put the viewer into the site.
"""

import json
import os
import posixpath
import re
import shutil
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any, Optional

from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File

sys.path.insert(0, str(Path(__file__).parent))
import hero

root = Path(__file__).resolve().parents[2]
live = os.environ.get("KINESPHERE_LIVE")
generated = Path(os.environ.get("KINESPHERE_GENERATED", root / "build/docs/generated"))
languages = {
    ".cpp": "cpp",
    ".hpp": "cpp",
    ".h": "c",
    ".c": "c",
    ".py": "python",
    ".pyi": "python",
    ".rs": "rust",
    ".cs": "csharp",
    ".ts": "typescript",
    ".sh": "bash",
    ".json": "json",
    ".toml": "toml",
    ".cmake": "cmake",
}
# What visitors look for in words that the guides may not use themselves.
SOUGHT = ("tunneling", "raycast", "GPU", "demo", "Jupyter")
# A link to a file or folder of the project. Code has no target like that.
LINK = re.compile(r"\]\((?![a-z]+:|#|/)([\w./+-]+)(#[^)\s]*)?\)")
LIST_ITEM = re.compile(r" *([-*]|\d+\.) ")
# A link that MkDocs is not to check: scripts/docs/check_links.py does so when all parts of the site are there.
UNCHECKED = "/site-root/"
page_of_repository: dict[str, str] = {}
references = {"python/kinesphere/_kinesphere.pyi": "reference/python.md"}
if (root / "build/docs/typedoc/node_modules/.bin/typedoc").exists():
    references["browser/package/src/index.ts"] = UNCHECKED + "reference/typescript/index.html"


def page_for(path: str) -> Optional[str]:
    """Where the site shows a file or folder of the repository, by its path there."""
    if path in references:
        return references[path]
    if path.startswith("docs/"):
        return path[len("docs/") :]
    if path == "README.md":
        return "index.md"
    if path.startswith("include"):
        name = posixpath.basename(path)
        if not name.endswith((".h", ".hpp")):
            return UNCHECKED + "reference/cpp/annotated.html"
        return UNCHECKED + "reference/cpp/" + name.replace("_", "__").replace(".", "_8") + ".html"
    if path.endswith(".md"):
        return "project/" + path
    if (root / path).exists():
        return "sources/" + path + ("/index.md" if (root / path).is_dir() else ".md")
    return None


def source_page(path: str) -> str:
    """A page that shows a file, or lists a folder."""
    here = root / path
    if here.is_dir():
        entries = sorted(entry for entry in here.iterdir() if entry.name[0] not in "._" and is_shown(entry))
        rows = [
            f"- [{one.name}{'/' * one.is_dir()}]({posixpath.relpath(one.relative_to(root), path)})"
            for one in entries
        ]
        return f"# {path}/\n\n" + "\n".join(rows) + "\n"
    if here.suffix in (".png", ".jpg", ".gz", ".svg"):
        return f"# {path}\n\nThis file is in the repository.\n"
    text = here.read_text()
    if len(text) > 100_000:
        text = text[:2000] + "\n... (cut off here: see the repository)\n"
    return f"# {path}\n\n``````{languages.get(here.suffix, 'text')}\n{text.rstrip()}\n``````\n"


def is_shown(entry: Path) -> bool:
    return (
        entry.is_dir()
        or entry.suffix in languages
        or entry.suffix in (".txt", ".nmea", ".jsonl", ".csv", ".md")
    )


def linked(path: str, text: str) -> list[str]:
    """The paths in the repository that a page links to."""
    found = [
        posixpath.normpath(posixpath.join(posixpath.dirname(path), link[1])) for link in LINK.finditer(text)
    ]
    return [one for one in found if (root / one).exists()]


def on_files(files: Any, config: Any) -> Any:
    """Adds the pages that docs/ does not have."""
    made = generated / "pages"
    waiting = ["docs/" + file.src_path for file in files.documentation_pages()] + [
        "CHANGELOG.md",
        "CONTRIBUTING.md",
    ]
    seen: set[str] = set()
    while waiting:
        path = waiting.pop()
        page = page_for(path)
        if path in seen or page is None or path in references or page.startswith(UNCHECKED):
            continue
        seen.add(path)
        if path.startswith("docs/"):
            if path.endswith(".md"):
                waiting += linked(path, (root / path).read_text())
            continue
        text = (root / path).read_text() if path.endswith(".md") else source_page(path)
        if path != "README.md":
            (made / page).parent.mkdir(parents=True, exist_ok=True)
            (made / page).write_text(text)
            files.append(File(page, str(made), config["site_dir"], config["use_directory_urls"]))
            page_of_repository[page] = path + "/x" * (root / path).is_dir()
        waiting += linked(page_of_repository.get(page, path), text)
    for extra in sorted((generated / "reference").rglob("*.md")):
        path = str(extra.relative_to(generated))
        files.append(File(path, str(generated), config["site_dir"], config["use_directory_urls"]))
    return files


def indented(text: str) -> str:
    """Nested lists with the four spaces that Python-Markdown wants, and lists apart from what comes before."""
    shown: list[str] = []
    in_code = in_list = False
    for line in text.splitlines():
        if line.lstrip().startswith("```"):
            in_code = not in_code
        if not in_code:
            item = bool(LIST_ITEM.match(line))
            if item and not in_list and shown and shown[-1].strip():
                shown.append("")
            in_list = item or (in_list and (not line.strip() or line.startswith(" ")))
            if in_list and (spaces := len(line) - len(line.lstrip())):
                line = " " * (4 * -(-spaces // 3)) + line.lstrip()
        shown.append(line)
    return "\n".join(shown) + "\n"


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Turns links into the repository into links within the site."""
    here = page.file.src_path
    path = page_of_repository.get(here, "docs/" + here)

    def to_page(link: re.Match[str]) -> str:
        target = posixpath.normpath(posixpath.join(posixpath.dirname(path), link[1]))
        to = page_for(target) if (root / target).exists() else None
        if to is None:
            return link[0]
        if not to.startswith(UNCHECKED):
            to = posixpath.relpath(to, posixpath.dirname(here) or ".")
        return f"]({to}{link[2] or ''})"

    parts = re.split(r"(^ *```.*?^ *```$)", markdown, flags=re.M | re.S)
    markdown = "".join(part if k % 2 else LINK.sub(to_page, part) for k, part in enumerate(parts))
    return markdown if here.startswith("sources/") else indented(markdown)


def on_page_content(html: str, page: Any, **_: Any) -> str:
    """Makes links to pages that MkDocs does not make relative, as all others; makes the first screen, and pages live."""
    if page.file.src_path == "index.md":
        found = re.search(
            r"^project\(kinesphere VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text(), re.M
        )
        first, html = hero.split(html, found[1], live is not None, "KINESPHERE_VIEWER" in os.environ)
        page.meta |= {
            "template": "home.html",
            "hide": ["navigation", "toc"],
            "hero": first,
        }
    page.meta["live"] = live is not None and "data-live=" in page.meta.get("hero", "") + html
    up = posixpath.relpath(".", posixpath.dirname(page.url) or ".")
    return html.replace(f'"{UNCHECKED}', f'"{up}/')


def brief_of(element: Any) -> str:
    """What Doxygen tells of a class or member first."""
    return " ".join("".join(element.find("briefdescription").itertext()).split())


def names_of_cpp() -> list[dict[str, str]]:
    """What the search finds in the reference of C++ and C: each class and each member with a description."""
    entries = []
    for path in sorted((generated / "xml").glob("*.xml")):
        for compound in ElementTree.parse(path).iterfind("compounddef"):
            page = f"reference/cpp/{compound.get('id')}.html"
            name = compound.findtext("compoundname", "").removeprefix("kinesphere::")
            about = {"title": f"{name} (C++)", "text": brief_of(compound)}
            # The theme shows a page by its first place.
            of_page = [{"location": page, **about}, {"location": f"{page}#top", **about}]
            is_class = compound.get("kind") in ("class", "struct")
            for member in compound.iterfind("sectiondef/memberdef"):
                # A member of a namespace is told in its file, too: its id names the page that has it.
                of_compound, anchor = member.get("id").rsplit("_1", 1)
                if of_compound != compound.get("id") or not brief_of(member):
                    continue
                # The search knows whole words alone: World::ask is ask, and of World.
                scopes = name.split("::")[::-1] if is_class else []
                title = " · ".join([member.findtext("name", ""), *scopes])
                of_page.append(
                    {"location": f"{page}#{anchor}", "title": f"{title} (C++)", "text": brief_of(member)}
                )
            # The search needs the page of each member.
            if is_class or len(of_page) > 2:
                entries += of_page
    return entries


def on_post_build(config: Any) -> None:
    """Takes the copies of sources out of the search, where they would hide the guides; adds the names of C++ there, and
    the live parts to the site."""
    if live is not None:
        shutil.copytree(live, Path(config["site_dir"]) / "assets/live")
    index = Path(config["site_dir"]) / "search/search_index.json"
    content = json.loads(index.read_text())
    content["docs"] = [entry for entry in content["docs"] if not entry["location"].startswith("sources/")]
    content["docs"] += names_of_cpp()
    texts = " ".join(f"{entry['title']} {entry['text']}" for entry in content["docs"]).lower()
    absent = [word for word in SOUGHT if word.lower() not in texts]
    if absent:
        raise PluginError(f"the search would not find {', '.join(absent)}: a page has to say what there is")
    index.write_text(json.dumps(content, separators=(",", ":")))
